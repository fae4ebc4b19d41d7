//! Other renderers, through the scripts of `benchmarks/peers`.

use super::folder::Folder;
use super::kept::Made;
use super::plan::Plan;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::notes::{Note, note};
use crate::repository;
use isolux_compare::peers::{OF_THE_STUDY, WHOLE, scene};
use isolux_compare::study::{System, Version};
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

/// The script that asks a renderer, in a copy of the repository, and the Python that setup makes beside it.
const SCRIPT: &str = "benchmarks/peers/once.py";
const PYTHON: [&str; 2] = ["target/peers/venv/bin/python", "target/peers/venv/Scripts/python.exe"];

/// How to get them.
const REMEDY: &str = "run “cargo xtask bench setup” in a copy of the repository";

/// A run may take so many times the longest time aimed at before it is given up, as those of isolux.
pub(crate) const PATIENCE: f64 = 2.0;

/// Between two looks at whether a renderer has ended.
const LOOK: Duration = Duration::from_millis(20);

/// Those that are installed, and why others are not.
#[derive(Default)]
pub(crate) struct Peers {
    place: Option<Place>,
    efforts: Vec<Efforts>,
    /// Those that have run once, uncounted: what is compiled and read at first is read from caches after.
    warm: RefCell<BTreeSet<System>>,
    /// Those that have failed or run out of time in a scene: dearer efforts would, too.
    failed: RefCell<BTreeSet<(String, System)>>,
    pub(crate) versions: Vec<Version>,
    pub(crate) missing: Vec<String>,
}

struct Place {
    python: PathBuf,
    script: PathBuf,
}

/// What the script lists.
#[derive(Deserialize)]
struct Listed {
    renderers: Vec<Renderer>,
    ladders: Vec<Efforts>,
}

#[derive(Deserialize)]
struct Renderer {
    name: System,
    missing: Option<String>,
    version: Option<String>,
}

/// The efforts of a renderer in a scene, from the cheapest upwards.
#[derive(Deserialize)]
struct Efforts {
    scene: String,
    points: String,
    renderer: System,
    efforts: Vec<String>,
}

/// What a run found, and what it took.
#[derive(Deserialize, Serialize)]
pub(crate) struct FoundByPeer {
    /// As at the points; `None` where it knows nothing.
    pub(crate) values_lx: Vec<Option<f64>>,
    pub(crate) whole_s: f64,
}

/// A run of another renderer.
pub(crate) struct AskedOf<'a> {
    /// The scene, as it is built in or a case of `validate`.
    pub(crate) scene: &'a str,
    /// The name of the set of points of it.
    pub(crate) points: &'static str,
    pub(crate) system: System,
    pub(crate) effort: String,
    /// The beginning of the names of its files.
    pub(crate) stem: String,
}

impl Peers {
    /// Those asked for that are here.
    pub(crate) fn of(asked: &[System]) -> Self {
        let none = |missing| Self { missing, ..Self::default() };
        if asked.is_empty() {
            return none(Vec::new());
        }
        let all = |why: &str| {
            none(asked.iter().map(|system| format!("{} ({why})", system.title())).collect())
        };
        let Some(place) = find() else { return all(&format!("not installed; {REMEDY}")) };
        let Some(listed) = list(&place) else {
            return all(&format!("{SCRIPT} does not run; {REMEDY}"));
        };
        let is_asked = |renderer: &&Renderer| asked.contains(&renderer.name);
        let (here, elsewhere): (Vec<&Renderer>, Vec<&Renderer>) =
            listed.renderers.iter().filter(is_asked).partition(|of| of.missing.is_none());
        let version = |of: &&Renderer| Version {
            system: of.name,
            version: of.version.clone().unwrap_or_default(),
        };
        let missing = |of: &&Renderer| {
            format!("{} ({})", of.name.title(), of.missing.as_deref().unwrap_or_default())
        };
        let is_here = |of: &Efforts| here.iter().any(|renderer| renderer.name == of.renderer);
        Self {
            versions: here.iter().map(version).collect(),
            missing: elsewhere.iter().map(missing).collect(),
            efforts: listed.ladders.into_iter().filter(is_here).collect(),
            place: Some(place),
            ..Self::default()
        }
    }

    /// Those with something to do in a scene.
    pub(crate) fn systems(&self, scene: &str) -> Vec<System> {
        self.efforts.iter().filter(|of| of.is_of(scene)).map(|of| of.renderer).collect()
    }

    /// The effort of a number, from the cheapest upwards.
    pub(crate) fn effort(&self, scene: &str, system: System, number: usize) -> Option<&str> {
        let of_scene = self.efforts.iter().find(|of| of.renderer == system && of.is_of(scene));
        Some(of_scene?.efforts.get(number)?.as_str())
    }

    /// A run, or one that an earlier comparison has left, and whether it was made now; `None` if it fails, which is said, or the user stops it.
    pub(crate) fn ask(
        &self,
        asked: &AskedOf,
        made: &Made,
        (plan, folder): (&Plan, &Folder),
        interrupt: &Interrupt,
    ) -> Result<Option<(FoundByPeer, bool)>, Failure> {
        let made = made.clone().with_effort(&asked.effort);
        if let Some(found) = made.found::<FoundByPeer>(folder, &asked.stem) {
            return Ok(Some((found, false)));
        }
        let is_cold = self.warm.borrow_mut().insert(asked.system);
        if is_cold && let Some(cheapest) = self.effort("cube", asked.system, 0) {
            let (effort, stem) = (cheapest.to_owned(), String::new());
            let (scene, points) = ("cube", OF_THE_STUDY);
            let first = AskedOf { scene, points, system: asked.system, effort, stem };
            self.run(&first, (plan, folder), interrupt)?;
        }
        let Some(found) = self.run(asked, (plan, folder), interrupt)? else { return Ok(None) };
        made.keep(folder, &asked.stem, &found)?;
        Ok(Some((found, true)))
    }

    fn run(
        &self,
        asked: &AskedOf,
        (plan, folder): (&Plan, &Folder),
        interrupt: &Interrupt,
    ) -> Result<Option<FoundByPeer>, Failure> {
        let Some(place) = &self.place else { return Ok(None) };
        let name = asked.scene;
        let whose = (name.to_owned(), asked.system);
        if self.failed.borrow().contains(&whose) {
            return Ok(None);
        }
        let file = format!("maps/{name}-peers.json");
        let Some(scene) = scene(name) else { return Ok(None) };
        folder.write(&file, scene.to_string().as_bytes())?;
        let scratch = tempfile::tempdir().map_err(|e| Failure::Refused(e.to_string()))?;
        let at_most_s = (PATIENCE * plan.limit_s).ceil().max(1.0);
        let mut command = Command::new(&place.python);
        command.arg(&place.script).arg(folder.path(&file)).args(["--points", asked.points]);
        command.args(["--renderer", asked.system.name(), "--effort", &asked.effort]);
        command.args(["--threads", &rayon::current_num_threads().to_string()]);
        command.args(["--seed", &plan.seed.to_string(), "--at-most", &at_most_s.to_string()]);
        command.arg("--folder").arg(scratch.path());
        let Some([said, problem]) = output(command, interrupt)? else { return Ok(None) };
        let found: Option<FoundByPeer> = serde_json::from_slice(&said).ok();
        if found.is_none() {
            let why = String::from_utf8_lossy(&problem).trim().to_owned();
            let what = format!("{name}, {}, {}", asked.system.title(), asked.effort);
            note(Note::Warning, format!("{what}: no result: {why}"));
            self.failed.borrow_mut().insert(whose);
        }
        Ok(found)
    }
}

impl Efforts {
    fn is_of(&self, case: &str) -> bool {
        self.scene == case && self.points == WHOLE
    }
}

fn find() -> Option<Place> {
    repository::folders().find_map(|root| {
        let script = root.join(SCRIPT);
        let python = PYTHON.iter().map(|name| root.join(name)).find(|path| path.is_file())?;
        script.is_file().then_some(Place { python, script })
    })
}

fn list(place: &Place) -> Option<Listed> {
    let said = Command::new(&place.python).arg(&place.script).arg("--list").output().ok()?;
    serde_json::from_slice(&said.stdout).ok()
}

/// What a command prints, and what it complains of; `None` if the user stops it.
fn output(mut command: Command, interrupt: &Interrupt) -> Result<Option<[Vec<u8>; 2]>, Failure> {
    let refused = |e: std::io::Error| Failure::Refused(format!("Python: {e}"));
    let mut child =
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().map_err(refused)?;
    let reading = [reader(child.stdout.take()), reader(child.stderr.take())];
    while child.try_wait().map_err(refused)?.is_none() {
        if interrupt.is_requested() {
            child.kill().map_err(refused)?;
            child.wait().map_err(refused)?;
            return Ok(None);
        }
        std::thread::sleep(LOOK);
    }
    Ok(Some(reading.map(|thread| thread.join().unwrap_or_default())))
}

/// Reads a pipe to its end beside all else, so that it is never full.
fn reader(pipe: Option<impl std::io::Read + Send + 'static>) -> std::thread::JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut pipe) = pipe {
            // What is cut short has no JSON, which is said.
            let _ = pipe.read_to_end(&mut bytes);
        }
        bytes
    })
}
