//! The page of the walk-through: its own tests, and whether what is committed is what is built of it.

use crate::judge::optional;
use std::path::Path;
use std::process::Command;

/// Where it is built again, below the root.
const BUILT: &str = "target/page";

/// Runs the tests of `web/`, builds the page once more and compares it with `web/dist`. Without its packages it is left out,
/// except where `CI` is `true`.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let web = root.join("web");
    let is_there = web.join("node_modules").is_dir();
    let missing = || "web/node_modules is missing: npm ci --prefix web".to_owned();
    optional(is_there.then_some(()).ok_or_else(missing), |()| check(root, &web))
}

fn check(root: &Path, web: &Path) -> Result<String, String> {
    npm(web, &["test"])?;
    npm(web, &["exec", "--", "tsc", "--noEmit"])?;
    let built = root.join(BUILT);
    let folder = built.to_string_lossy();
    npm(web, &["exec", "--", "vite", "build", "--logLevel", "warn", "--outDir", &folder])?;
    let page = |folder: &Path| {
        let path = folder.join("walk.html");
        std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))
    };
    if page(&built)? != page(&web.join("dist"))? {
        return Err(
            "web/dist/walk.html is not what web/src makes: npm run build --prefix web".into()
        );
    }
    Ok("the page passes its tests and is built of its sources".to_owned())
}

fn npm(web: &Path, arguments: &[&str]) -> Result<(), String> {
    let status = Command::new("npm").args(arguments).current_dir(web).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!("failed: npm {} in web/", arguments.join(" "))),
        Err(e) => Err(format!("cannot run npm: {e}")),
    }
}
