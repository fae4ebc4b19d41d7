//! The ray kernel, which alone holds unsafe code, under the address sanitizer of the nightly compiler.

use crate::judge::optional;
use std::path::Path;
use std::process::Command;

/// The kinds of processors that the sanitizer knows and the kernel has vector instructions for.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// Runs the tests of the kernel, where the nightly compiler is installed.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let missing = "the nightly compiler is not installed: rustup toolchain install nightly";
    optional(has_nightly().then_some(()).ok_or(missing.to_owned()), |()| test(root))
}

fn has_nightly() -> bool {
    let asked = Command::new("rustup").args(["run", "nightly", "rustc", "--version"]).output();
    asked.is_ok_and(|output| output.status.success())
}

fn test(root: &Path) -> Result<String, String> {
    let status = Command::new("rustup")
        .args(["run", "nightly", "cargo", "test", "--quiet", "--package", "isolux-geometry"])
        .args(["--target", TARGET, "--target-dir", "target/sanitized"])
        .env("RUSTFLAGS", "-Zsanitizer=address")
        .current_dir(root)
        .status();
    match status {
        Ok(status) if status.success() => {
            Ok("no access beyond its memory in any test of isolux-geometry".to_owned())
        }
        Ok(_) => Err("failed: the tests of isolux-geometry under the address sanitizer".to_owned()),
        Err(e) => Err(format!("cannot run rustup: {e}")),
    }
}
