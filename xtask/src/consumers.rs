//! Programs that show light, run on what isolux writes for them: Blender, from the package index, Bevy, from its crates, and
//! Godot, if installed. By hand: Blender weighs a gigabyte, Bevy takes minutes to build, and the lightmap of a room takes one.

mod bevy;

use crate::lamps::has_python;
use crate::peers::{build, environment, wait};
use crate::smoke::{CARD, PICTURE_SIZE, PICTURE_WHITE_CD_M2, card_scene};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What shows as white in Godot's picture of the card, which has 127 cd/m2.
const EXPOSURE_M2_CD: f64 = 1.0 / PICTURE_WHITE_CD_M2;
/// Half a code of eight bits, and half floats of the buffer behind it (2^-11 of the light, 0.05 codes). Measured: 0.18.
const CODES: f64 = 0.6;

/// A folder for the work, and the command as it is shipped.
struct Bench<'a> {
    root: &'a Path,
    folder: PathBuf,
    isolux: PathBuf,
}

/// Shows the card to all, a room to Blender. What is not installed is left out, and said.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let folder = root.join("target").join("consumers");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let bench = Bench { root, isolux: build(root)?, folder };
    let card = bench.folder.join("card-map.glb");
    let scene = card_scene(&bench.folder)?;
    bench.isolux(&["solve", &text(&scene), "-o", &text(&card), "--quality", "draft"])?;
    Ok([bench.blender(&card)?, bench.godot(&card)?, bevy::show(&bench, &card)?].join("\n"))
}

impl Bench<'_> {
    fn blender(&self, map_of_card: &Path) -> Result<String, String> {
        let source = self.root.join("checks").join("blender");
        let found = has_python().and_then(|()| {
            environment(&source, &self.folder.join("blender"))
                .map_err(|e| format!("{e}; {}", blender_needs(&source)))
        });
        let python = match found {
            Ok(python) => python,
            Err(missing) => return Ok(format!("Blender skipped: {missing}")),
        };
        let card = self.lightmap(
            map_of_card,
            "card-blender.glb",
            "blender",
            &["--texels-per-meter", "16"],
        )?;
        let (vertices, _) = self.vertices(map_of_card, "vertices-blender.glb", "blender")?;
        let map = self.folder.join("room-map.glb");
        let scene = self.root.join("scenes").join("cornell_mitsuba").join("scene.xml");
        self.isolux(&["solve", &text(&scene), "--quality", "draft", "-o", &text(&map)])?;
        let room = self.lightmap(&map, "room-blender.glb", "blender", &[])?;
        let picture = self.folder.join("room.png");
        let exposure = format!("{PICTURE_WHITE_CD_M2}cd/m2");
        let look = ["--camera", "front", "--size", PICTURE_SIZE, "--tone", "linear"];
        let into = ["render", &text(&map), "-o", &text(&picture), "--exposure", &exposure];
        self.isolux(&[&into[..], &look].concat())?;
        let mut judge = Command::new(python);
        judge.arg(source.join("judge.py")).arg("--card").arg(card);
        judge.arg("--vertices").arg(vertices);
        judge.args(["--reflectance", &CARD.reflectance.to_string()]);
        judge.args(["--illuminance", &CARD.illuminance_lx.to_string()]);
        judge.arg("--room").arg(room).arg("--picture").arg(picture);
        judge.args(["--white", &PICTURE_WHITE_CD_M2.to_string()]);
        wait(&mut judge, "checks/blender/judge.py")?;
        Ok("Blender shows rho E / pi, as texels and at vertices, and the room as isolux does"
            .to_owned())
    }

    fn godot(&self, card: &Path) -> Result<String, String> {
        let is_missing = |tool: &&str| {
            Command::new("which").arg(tool).output().map_or(true, |found| !found.status.success())
        };
        if let Some(tool) = ["godot3", "xvfb-run"].iter().find(|tool| is_missing(tool)) {
            return Ok(format!("Godot skipped: {tool} is not installed (Debian: godot3, xvfb)"));
        }
        // A project each: Godot keeps materials by their names.
        let texels = self.godot_project("godot")?;
        self.lightmap(card, "godot/card.glb", "godot", &["--texels-per-meter", "16"])?;
        let energy = luminance_cd_m2() * EXPOSURE_M2_CD;
        let texels = godot_shows(&texels, energy, [energy; 2])?;
        let vertices = self.godot_project("godot-vertices")?;
        let (_, white_cd_m2) = self.vertices(card, "godot-vertices/card.glb", "godot")?;
        // Kept in 8 bits, of which the last is cut.
        let share = luminance_cd_m2() / white_cd_m2;
        let kept = (255.0 * share).floor() / 255.0;
        let vertices = godot_shows(&vertices, 0.0, [kept, share])?;
        Ok(format!("Godot shows rho E / pi: {texels}; with light at vertices {vertices}"))
    }

    fn godot_project(&self, name: &str) -> Result<PathBuf, String> {
        let project = self.folder.join(name);
        std::fs::create_dir_all(&project).map_err(|e| format!("{}: {e}", project.display()))?;
        for file in ["project.godot", "judge.gd"] {
            let source = self.root.join("checks").join("godot").join(file);
            std::fs::copy(&source, project.join(file))
                .map_err(|e| format!("{}: {e}", source.display()))?;
        }
        Ok(project)
    }

    /// Light at the vertices of a map for a consumer, and what its colours show as white, cd/m2.
    fn vertices(&self, map: &Path, name: &str, target: &str) -> Result<(PathBuf, f64), String> {
        let file = self.folder.join(name);
        let way = ["--target", target, "--json"];
        let said =
            self.isolux(&[&["export", &text(map), "-o", &text(&file)], &way[..]].concat())?;
        let said: serde_json::Value = serde_json::from_str(&said).map_err(|e| e.to_string())?;
        let white = said["white_cd_m2"].as_f64().ok_or("export does not say `white_cd_m2`")?;
        Ok((file, white))
    }

    /// A lightmap of a map for a consumer.
    fn lightmap(
        &self,
        map: &Path,
        name: &str,
        target: &str,
        density: &[&str],
    ) -> Result<PathBuf, String> {
        let file = self.folder.join(name);
        let into = ["export", &text(map), "-o", &text(&file)];
        let way = ["--layout", "texels", "--target", target];
        self.isolux(&[&into[..], &way, density].concat())?;
        Ok(file)
    }

    /// What the command prints.
    fn isolux(&self, arguments: &[&str]) -> Result<String, String> {
        let line = format!("isolux {}", arguments.join(" "));
        let output = Command::new(&self.isolux).args(arguments).output();
        match output {
            Ok(output) if output.status.success() => {
                Ok(String::from_utf8_lossy(&output.stdout).into_owned())
            }
            Ok(output) => Err(format!("{line}: {}", String::from_utf8_lossy(&output.stderr))),
            Err(e) => Err(format!("cannot run {line}: {e}")),
        }
    }
}

/// Of the card.
fn luminance_cd_m2() -> f64 {
    CARD.reflectance * CARD.illuminance_lx / std::f64::consts::PI
}

/// The codes that Godot shows in the middle of `card.glb`, which are to lie between those of two shares of white.
fn godot_shows(project: &Path, energy: f64, due: [f64; 2]) -> Result<String, String> {
    // The editor imports what it finds, and ends.
    godot(project, &["--editor", "--quit"])?;
    let said = godot(project, &["-s", "judge.gd", &energy.to_string()])?;
    let [least, most] = due.map(|share| 255.0 * srgb(share));
    let codes = said.lines().find_map(|line| line.strip_prefix("codes "));
    let codes: Option<Vec<f64>> =
        codes.and_then(|line| line.split(' ').map(|code| code.parse().ok()).collect());
    let is_due = |code: &f64| (least - CODES..=most + CODES).contains(code);
    match codes {
        Some(codes) if codes.len() == 3 && codes.iter().all(is_due) => {
            Ok(format!("codes {codes:.2?}, due are {least:.2} to {most:.2}"))
        }
        codes => Err(format!("Godot shows {codes:?} in place of {least:.2} to {most:.2}: {said}")),
    }
}

/// What Blender asks of Python.
fn blender_needs(source: &Path) -> String {
    let pinned = std::fs::read_to_string(source.join("requirements.txt")).unwrap_or_default();
    format!("{} needs Python 3.11 as python3", pinned.trim())
}

/// What Godot prints. It complains of sound and of locales, and ends well.
fn godot(project: &Path, arguments: &[&str]) -> Result<String, String> {
    let output = Command::new("xvfb-run")
        .args(["--auto-servernum", "godot3", "--path"])
        .arg(project)
        .args(["--video-driver", "GLES3", "--audio-driver", "Dummy"])
        .args(arguments)
        .output()
        .map_err(|e| format!("cannot run xvfb-run: {e}"))?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// IEC 61966-2-1.
fn srgb(light: f64) -> f64 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
