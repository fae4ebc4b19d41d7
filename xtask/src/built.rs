//! The command, built as its tests are.

use crate::peers::wait;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds isolux as its tests do; where it is. All packages are chosen, so that features are those of the tests and nothing is built twice.
pub(crate) fn built(root: &Path) -> Result<PathBuf, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let build = ["build", "--quiet", "--workspace", "--bin", "isolux"];
    wait(Command::new(cargo).args(build).current_dir(root), "cargo build")?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let folder = root.join(target.unwrap_or_else(|| "target".into())).join("debug");
    Ok(folder.join(format!("isolux{}", std::env::consts::EXE_SUFFIX)))
}
