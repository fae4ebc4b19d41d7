//! The commands of the README, as written, in the order written, in an empty folder.

use crate::ran::Home;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Words of commands that take minutes, serve until they are stopped, or need a copy of the repository.
const LEFT_OUT: [&str; 7] =
    ["--live", " view ", "cargo ", " audit ", " validate ", " compare ", " demo"];

/// A limit for runs: their maps are valid, whatever their error.
const TIME_LIMIT: &str = "--time-limit 1s";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The blocks of a kind of code in a text.
fn blocks<'a>(text: &'a str, kind: &str) -> Vec<&'a str> {
    let fence = format!("```{kind}\n");
    text.split(&fence).skip(1).filter_map(|rest| rest.split("\n```").next()).collect()
}

/// Runs a line of a shell in which `isolux` is the command under test.
fn shell(home: &Home, line: &str) -> (i32, String) {
    let command = PathBuf::from(env!("CARGO_BIN_EXE_isolux"));
    let mut folders = vec![command.parent().unwrap().to_owned()];
    folders.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()));
    let path = std::env::join_paths(folders).unwrap();
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).current_dir(home.path("")).env("PATH", path).stdin(Stdio::null());
    let ran = shell.output().unwrap();
    (ran.status.code().unwrap_or(-1), String::from_utf8_lossy(&ran.stderr).into_owned())
}

/// The line with a time limit, if it solves.
fn limited(line: &str) -> String {
    let line = line.split("  #").next().unwrap_or_default();
    let solves = line.starts_with("isolux solve") || line.starts_with("isolux bake");
    if solves { format!("{line} {TIME_LIMIT}") } else { line.to_owned() }
}

#[test]
fn every_command_of_the_readme_runs_as_written() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let home = Home::new();
    let scene = blocks(&readme, "toml")[0];
    home.file("room.toml", scene);
    let all = blocks(&readme, "sh").join("\n");
    let mut count = 0;
    for line in all.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if LEFT_OUT.iter().any(|word| line.contains(word)) {
            continue;
        }
        let line = limited(line);
        let (code, err) = shell(&home, &line);
        let expected: &[i32] = if line.contains(TIME_LIMIT) { &[0, 3] } else { &[0] };
        assert!(expected.contains(&code), "{line}: {code}\n{err}");
        count += 1;
    }
    assert!(count >= 25, "{count} commands found");
}
