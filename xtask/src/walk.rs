//! Judge of the walk-through: its page in Chromium, beside what the command says of the same maps.

use crate::built::built;
use crate::peers::wait;
use crate::worlds::missing_for_pages;
use std::path::Path;
use std::process::Command;

/// Walks through maps as people do. Without Node or a browser it is left out; where `CI` is `true`, without a browser alone.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let checks = root.join("checks");
    if let Some(missing) = missing_for_pages(&checks)? {
        return Ok(format!("skipped, as it is optional: {missing}"));
    }
    let mut node = Command::new("node");
    node.arg("walk.mjs").arg(built(root)?).current_dir(&checks);
    wait(&mut node, "checks/walk.mjs")?;
    Ok("the page shows and tells what the command does".to_owned())
}
