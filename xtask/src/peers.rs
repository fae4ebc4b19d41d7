//! The bench against other renderers: what `benchmarks/peers/run.py` needs, then that.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Measures isolux beside its peers; the arguments go on to the script, but for `--save`, which
/// keeps the result in the repository.
pub(crate) fn run(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let source = root.join("benchmarks").join("peers");
    let folder = root.join("target").join("peers");
    let python = environment(&source, &folder.join("venv"))?;
    let isolux = build(root)?;
    let scenes = folder.join("scenes");
    export(root, &scenes, &names(&source, &python)?)?;
    let (save, rest): (Vec<&str>, Vec<&str>) = arguments.iter().partition(|a| **a == "--save");
    let results = if save.is_empty() { folder.join("results") } else { source.join("results") };
    let mut bench = Command::new(python);
    bench.arg(source.join("run.py")).arg("--isolux").arg(isolux);
    bench.arg("--scenes").arg(scenes).arg("--results").arg(results);
    bench.args(["--revision", &revision(root)]).args(rest);
    wait(&mut bench, "the bench of peers")?;
    Ok(String::new())
}

/// Installs the renderers; `also` is what was installed before.
pub(crate) fn setup(root: &Path, also: &str) -> Result<String, String> {
    let folder = root.join("target").join("peers");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    environment(&root.join("benchmarks").join("peers"), &folder.join("venv"))?;
    Ok(format!("{also}; Radiance, Mitsuba and LuxCore are in target/peers"))
}

/// Tests of the scripts themselves, for which no other renderer is installed.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    if let Err(missing) = has_python() {
        return Ok(format!("skipped, as it is optional: {missing}"));
    }
    let folder = root.join("benchmarks").join("peers");
    let tests = ["-B", "-m", "unittest", "--quiet"];
    wait(Command::new("python3").args(tests).current_dir(folder), "python3 -m unittest")?;
    Ok("the scripts refuse what they should".to_owned())
}

pub(crate) fn has_python() -> Result<(), String> {
    let version = Command::new("python3").arg("--version").output();
    let works = version.is_ok_and(|output| output.status.success());
    works.then_some(()).ok_or_else(|| "python3 is not installed".to_owned())
}

/// The Python of a judge whose packages `source` pins, in a folder of its own; an error without Python or a package index.
pub(crate) fn python_of_judge(source: &Path, folder: &Path) -> Result<PathBuf, String> {
    has_python()?;
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    environment(source, &folder.join("venv"))
}

/// A virtual environment with the pinned packages, made anew when they change; its Python.
pub(crate) fn environment(source: &Path, folder: &Path) -> Result<PathBuf, String> {
    let python = folder.join("bin").join("python");
    let list = source.join("requirements.txt");
    let pinned = read(&list)?;
    let installed = folder.join("installed.txt");
    if std::fs::read_to_string(&installed).is_ok_and(|text| text == pinned) {
        return Ok(python);
    }
    wait(Command::new("python3").args(["-m", "venv", "--clear"]).arg(folder), "python3 -m venv")?;
    let pip = ["-m", "pip", "install", "--quiet", "--only-binary", ":all:", "-r"];
    wait(Command::new(&python).args(pip).arg(&list), "pip")?;
    std::fs::write(&installed, pinned).map_err(|e| format!("{}: {e}", installed.display()))?;
    Ok(python)
}

/// Builds isolux as it is shipped; where it is.
pub(crate) fn build(root: &Path) -> Result<PathBuf, String> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let built = root.join(target.unwrap_or_else(|| "target".into()));
    let arguments = ["build", "--release", "--quiet", "--package", "isolux-cli"];
    wait(cargo().args(arguments).current_dir(root), "cargo build")?;
    Ok(built.join("release").join(format!("isolux{}", std::env::consts::EXE_SUFFIX)))
}

/// The scenes that the ladders name, each once.
fn names(source: &Path, python: &Path) -> Result<Vec<String>, String> {
    let wrong = |why: &dyn std::fmt::Display| format!("once.py --list: {why}");
    let said = Command::new(python).arg(source.join("once.py")).arg("--list").output();
    let said = said.map_err(|e| wrong(&e))?;
    let listed: serde_json::Value = serde_json::from_slice(&said.stdout).map_err(|e| wrong(&e))?;
    let ladders = listed["ladders"].as_array().ok_or_else(|| wrong(&"no ladders"))?;
    let scenes = ladders.iter().filter_map(|ladder| ladder["scene"].as_str());
    Ok(scenes.map(str::to_owned).collect::<std::collections::BTreeSet<_>>().into_iter().collect())
}

/// Scenes with their points, each as JSON.
fn export(root: &Path, folder: &Path, names: &[String]) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for scene in names {
        let path = folder.join(format!("{scene}.json"));
        let file = std::fs::File::create(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let example = ["run", "--release", "--quiet", "-p", "isolux-compare", "--example", "peers"];
        let mut command = cargo();
        command
            .args(example)
            .args(["--", scene.as_str()])
            .current_dir(root)
            .stdout(Stdio::from(file));
        wait(&mut command, "the example `peers`")?;
    }
    Ok(())
}

/// The commit measured, marked where files differ from it.
pub(crate) fn revision(root: &Path) -> String {
    let describe = ["describe", "--always", "--dirty"];
    let said = Command::new("git").args(describe).current_dir(root).output();
    let said = said.ok().filter(|output| output.status.success());
    said.map_or("unknown".to_owned(), |s| String::from_utf8_lossy(&s.stdout).trim().to_owned())
}

/// The cargo that runs this.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))
}

/// Waits for a command that must succeed.
pub(crate) fn wait(command: &mut Command, what: &str) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{what}: {status}")),
        Err(e) => Err(format!("cannot run {what}: {e}")),
    }
}
