//! The commands of the README and of pages of the book, as written, in the order written, in a folder that holds what they say.

use crate::ran::Home;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Words of commands that take minutes, serve until they are stopped, need a copy of the repository or a file of weather.
const LEFT_OUT: [&str; 8] =
    ["--live", " view ", "cargo ", " audit ", " validate ", " compare ", " demo", "--weather "];

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

/// The line with a time limit, if it solves, and with a small picture, if it draws.
fn limited(line: &str) -> String {
    let line = line.split("  #").next().unwrap_or_default().trim_end();
    let begins = |words: &[&str]| words.iter().any(|word| line.starts_with(word));
    match line {
        _ if begins(&["isolux solve", "isolux bake"]) => format!("{line} {TIME_LIMIT}"),
        _ if begins(&["isolux render"]) => format!("{line} --size 64x40"),
        _ => line.to_owned(),
    }
}

/// Runs lines of a shell; how many were run.
fn run_all(home: &Home, lines: &str) -> usize {
    let is_run = |line: &&str| {
        let is_command = !line.is_empty() && !line.starts_with('#');
        is_command && !LEFT_OUT.iter().any(|word| line.contains(word))
    };
    let lines = lines.lines().filter(is_run).map(limited);
    lines
        .inspect(|line| {
            let (code, err) = shell(home, line);
            let expected: &[i32] = if line.contains(TIME_LIMIT) { &[0, 3] } else { &[0] };
            assert!(expected.contains(&code), "{line}: {code}\n{err}");
        })
        .count()
}

fn page(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap()
}

#[test]
fn every_command_of_the_readme_runs_as_written() {
    let readme = page("README.md");
    let home = Home::new();
    home.file("room.toml", blocks(&readme, "toml")[0]);
    let count = run_all(&home, &blocks(&readme, "sh").join("\n"));
    assert!(count >= 25, "{count} commands found");
}

/// Pages whose commands run on the scene of the README, with what they add to it in their first block of TOML.
#[test]
fn commands_of_the_book_run_as_written() {
    let readme = page("README.md");
    for (name, adds) in [
        ("grids", true),
        ("emergency", true),
        ("pictures", false),
        ("groups", true),
        ("methods-cache", false),
        ("exports", false),
    ] {
        let text = page(&format!("docs/book/{name}.md"));
        let added = if adds { blocks(&text, "toml")[0] } else { "" };
        let home = Home::new();
        home.file("room.toml", format!("{}\n{added}\n", blocks(&readme, "toml")[0]));
        let count = run_all(&home, "isolux solve room.toml -o map.glb");
        let count = count + run_all(&home, &blocks(&text, "sh").join("\n"));
        assert!(count >= 4, "{name}: {count} commands found");
    }
}
