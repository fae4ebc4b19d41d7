//! `isolux demo`: a real interior end to end, from nothing.

use crate::console::{facts, print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::DemoFlags;
use crate::look::Look;
use crate::notes::{Note, note};
use crate::output::{OutputPath, create_folder};
use crate::progress::Reporter;
use crate::solving::Run;
use crate::summary::{self, Lit};
use crate::walk::{self, Opened};
use crate::{
    explain, map_file, render, report, repository, saved_run, solving, source, traced, viewpoint,
};
use isolux::engine::SolveRequest;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Duration;

const SCENE: &str = "scenes/demo/scene.toml";
const PICTURE: (u32, u32) = (1280, 720);
/// Time to look for finer shadows in the walk-through.
const FINER: Duration = Duration::from_secs(5);

/// Runs the subcommand.
pub(crate) fn run(flags: &DemoFlags, json: bool) -> Result<Outcome, Failure> {
    let path = find_scene()?;
    let files = Files::check(&flags.output)?;
    let scene = source::read_scene(&path)?;
    let request = SolveRequest { accuracy: Some(flags.accuracy), ..SolveRequest::default() };
    note(Note::Info, format!("{}, from {}", scene.name(), path.display()));
    explain::lines(&scene, &request).iter().for_each(|line| note(Note::Info, line));
    let run = Run { source: &path, output: &files.map, request: &request };
    let solved = solving::solve(&scene, &run, None, (&mut Reporter::new(None), None))?;
    map_file::write(&files.map, &scene, &solved.solution.map)?;
    // Nothing goes on with this run.
    saved_run::keep(&files.map, &solved.solution.state, true)?;
    let camera = viewpoint::camera(&scene, None).map_err(Failure::bad_input)?;
    let (view, _) = traced::view(&scene, &solved.solution.map, &camera, PICTURE)?;
    let look = Look::usual(&scene);
    render::write(&files.picture, &look.picture(&view)?)?;
    render::write(&files.false_colour, &look.chart(&view)?)?;
    let walk = walk::file(&[Opened::read(files.map.path())?], FINER)?;
    files.walk.write(walk.as_bytes())?;
    let results = Results {
        solution: report::Report::of(
            (&scene, &solved.solution.map),
            solved.solution.time_s,
            &files.map,
        ),
        picture: files.picture.path().display().to_string(),
        false_colour: files.false_colour.path().display().to_string(),
        walk_through: files.walk.path().display().to_string(),
        surfaces: summary::by_shape(&scene, &solved.solution.map),
    };
    if json {
        print_json(&results)?
    } else {
        print(&results.text())?
    }
    Ok(solved.outcome)
}

/// The files written.
struct Files {
    map: OutputPath,
    picture: OutputPath,
    false_colour: OutputPath,
    walk: OutputPath,
}

impl Files {
    fn check(folder: &Path) -> Result<Self, Failure> {
        create_folder(folder)?;
        Ok(Self {
            map: OutputPath::check(&folder.join("map.glb"), "glb")?,
            picture: OutputPath::check(&folder.join("picture.png"), "png")?,
            false_colour: OutputPath::check(&folder.join("false-colour.png"), "png")?,
            walk: OutputPath::check(&folder.join("walk.html"), "html")?,
        })
    }
}

/// The scene in the current folder, or in one above the program (as in `target/release`).
pub(crate) fn find_scene() -> Result<PathBuf, Failure> {
    let mut candidates = repository::folders().map(|folder| folder.join(SCENE));
    candidates.find(|path| path.is_file()).ok_or_else(|| {
        Failure::bad_input(format!(
            "{SCENE}: not found here nor above the program; run it in a copy of the repository"
        ))
    })
}

/// What `demo --json` prints.
#[derive(Serialize)]
struct Results {
    solution: report::Report,
    picture: String,
    false_colour: String,
    /// To be opened in a browser.
    walk_through: String,
    surfaces: Vec<Lit>,
}

impl Results {
    fn text(&self) -> String {
        let pictures = facts(&[
            ("picture", self.picture.clone()),
            ("false colour", self.false_colour.clone()),
            ("walk-through", format!("{}, to be opened in a browser", self.walk_through)),
        ]);
        format!("{}{pictures}\n{}", self.solution.text(), summary::text(&self.surfaces))
    }
}
