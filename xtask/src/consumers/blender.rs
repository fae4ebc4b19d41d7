//! Blender, as a module of Python.

use super::bench::{Bench, text};
use crate::peers::{environment, has_python, wait};
use crate::smoke::{CARD, PICTURE_SIZE, PICTURE_WHITE_CD_M2};
use std::path::Path;
use std::process::Command;

/// Shows the card to Blender, as texels and with its light at vertices, and a room.
pub(super) fn show(bench: &Bench<'_>, map_of_card: &Path) -> Result<String, String> {
    let source = bench.root.join("checks").join("blender");
    let found = has_python().and_then(|()| {
        environment(&source, &bench.folder.join("blender"))
            .map_err(|e| format!("{e}; {}", blender_needs(&source)))
    });
    let python = match found {
        Ok(python) => python,
        Err(missing) => return Ok(format!("Blender skipped: {missing}")),
    };
    let card = bench.lightmap(
        map_of_card,
        "card-blender.glb",
        "blender",
        &["--texels-per-meter", "16"],
    )?;
    let (vertices, _) = bench.vertices(map_of_card, "vertices-blender.glb", "blender")?;
    let map = bench.folder.join("room-map.glb");
    let scene = bench.root.join("scenes").join("cornell_mitsuba").join("scene.xml");
    bench.isolux(&["solve", &text(&scene), "--quality", "draft", "-o", &text(&map)])?;
    let room = bench.lightmap(&map, "room-blender.glb", "blender", &[])?;
    let picture = bench.folder.join("room.png");
    let exposure = format!("{PICTURE_WHITE_CD_M2}cd/m2");
    let look = ["--camera", "front", "--size", PICTURE_SIZE, "--tone", "linear", "--white", "none"];
    let into = ["render", &text(&map), "-o", &text(&picture), "--exposure", &exposure];
    bench.isolux(&[&into[..], &look].concat())?;
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

/// What Blender asks of Python.
fn blender_needs(source: &Path) -> String {
    let pinned = std::fs::read_to_string(source.join("requirements.txt")).unwrap_or_default();
    format!("{} needs Python 3.11 as python3", pinned.trim())
}
