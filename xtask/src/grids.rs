//! Judges of grids for VTK: VTK itself and PyVista.

use crate::built::built;
use crate::judge::optional;
use crate::peers::{python_of_judge, wait};
use crate::smoke::Room;
use std::path::Path;
use std::process::Command;

/// Shows the grid of a map to both, beside its table. Without Python or a package index it is left out, except
/// where `CI` is `true`.
pub(crate) fn run(root: &Path, room: &Room) -> Result<String, String> {
    let source = root.join("checks").join("vtk");
    let folder = root.join("target").join("judge-of-grids");
    optional(python_of_judge(&source, &folder), |python| {
        let mut judge = Command::new(python);
        judge.arg(source.join("judge.py")).arg("--isolux").arg(built(root)?);
        judge.args([&room.map, &room.grid, &room.table]);
        wait(&mut judge, "checks/vtk/judge.py")?;
        Ok("VTK and PyVista read the grid as it is".to_owned())
    })
}
