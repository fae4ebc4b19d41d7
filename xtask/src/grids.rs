//! Judges of grids for VTK: VTK itself and PyVista.

use crate::judge::is_ci;
use crate::lamps::{built, has_python};
use crate::peers::{environment, wait};
use crate::smoke::Room;
use std::path::Path;
use std::process::Command;

/// Shows the grid of a map to both, beside its table. Without Python or a package index it is left out, except
/// where `CI` is `true`.
pub(crate) fn run(root: &Path, room: &Room) -> Result<String, String> {
    let source = root.join("checks").join("vtk");
    let folder = root.join("target").join("judge-of-grids");
    let found = has_python().and_then(|()| {
        std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        environment(&source, &folder.join("venv"))
    });
    let python = match found {
        Ok(python) => python,
        Err(missing) if is_ci() => return Err(format!("not optional with CI=true: {missing}")),
        Err(missing) => return Ok(format!("skipped, as it is optional: {missing}")),
    };
    let mut judge = Command::new(python);
    judge.arg(source.join("judge.py")).arg("--isolux").arg(built(root)?);
    judge.args([&room.map, &room.grid, &room.table]);
    wait(&mut judge, "checks/vtk/judge.py")?;
    Ok("VTK and PyVista read the grid as it is".to_owned())
}
