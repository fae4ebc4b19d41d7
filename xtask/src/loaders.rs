//! Judges of the loaders: what other software reads of a map, beside what the command says of it.

use crate::lamps::built;
use crate::peers::wait;
use crate::worlds::missing_for_pages;
use std::path::Path;
use std::process::Command;

/// `loaders/three` in Chromium. Without Node or a browser it is left out; where `CI` is `true`, without a browser alone.
pub(crate) fn three(root: &Path) -> Result<String, String> {
    let checks = root.join("checks");
    if let Some(missing) = missing_for_pages(&checks)? {
        return Ok(format!("skipped, as it is optional: {missing}"));
    }
    let mut node = Command::new("node");
    node.arg("loader-three.mjs").arg(built(root)?).current_dir(&checks);
    wait(&mut node, "checks/loader-three.mjs")?;
    Ok("loaders/three reads, dims and shows what the command does".to_owned())
}
