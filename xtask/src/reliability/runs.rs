//! Runs of the command in a folder of their own, and what they leave there.

use crate::case::Case;
use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The map of every run.
pub(super) const MAP: &str = "m.glb";
/// The state of its run.
pub(super) const CHECKPOINT: &str = "m.checkpoint";
/// What files are called until they are complete.
const UNFINISHED: &str = ".isolux-";

/// A command, and a folder to run it in.
pub(super) struct Bench<'a> {
    pub(super) root: &'a Path,
    pub(super) isolux: PathBuf,
    pub(super) folder: PathBuf,
}

/// How a run has ended.
#[derive(Debug)]
pub(super) struct Ended {
    /// Nothing if a signal has ended it.
    pub(super) code: Option<i32>,
    pub(super) said: String,
}

/// Maps by their names, each as a hash.
pub(super) type Maps = BTreeMap<String, String>;

impl Bench<'_> {
    /// The command on a case; `before` stands in front of it.
    pub(super) fn solve(&self, case: &Case, before: &[&str], flags: &[&str]) -> Command {
        let isolux = self.isolux.to_string_lossy();
        let mut words = before.to_vec();
        words.push(&isolux);
        let scene = match case.scene.strip_prefix("builtin:") {
            Some(_) => case.scene.to_owned(),
            None => self.root.join(case.scene).to_string_lossy().into_owned(),
        };
        let mut command = Command::new(words[0]);
        command.args(&words[1..]).args(["solve", &scene, "-o", MAP, "--method", case.method]);
        command.args(["--accuracy", case.accuracy]).args(case.flags).args(flags);
        command.current_dir(&self.folder).stdin(Stdio::null()).stdout(Stdio::null());
        command.stderr(Stdio::piped());
        command
    }

    /// A run to its end, which is to be a good one; its maps and its time.
    pub(super) fn whole(&self, case: &Case, threads: &str) -> Result<(Maps, Duration), String> {
        self.clear()?;
        let begun = Instant::now();
        let ended = ended(self.solve(case, &[], &["--threads", threads]))?;
        match ended.code {
            Some(0) => Ok((self.maps(), begun.elapsed())),
            _ => Err(format!(
                "{}: an undisturbed run does not reach its accuracy: {ended:?}",
                case.name
            )),
        }
    }

    /// Empties the folder.
    pub(super) fn clear(&self) -> Result<(), String> {
        let _ = fs::remove_dir_all(&self.folder);
        fs::create_dir_all(&self.folder).map_err(|e| format!("{}: {e}", self.folder.display()))
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// The bytes of a file; none where it is missing.
    pub(super) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_default()
    }

    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), String> {
        fs::write(self.path(name), bytes).map_err(|e| format!("{name}: {e}"))
    }

    /// What is in the folder.
    pub(super) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut names: Vec<String> =
            entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Files that are not complete.
    pub(super) fn unfinished(&self) -> usize {
        self.names().iter().filter(|name| name.starts_with(UNFINISHED)).count()
    }

    /// Files that are neither maps nor left by a run that was killed while it wrote.
    pub(super) fn others(&self) -> Vec<String> {
        let is_other = |name: &String| !name.ends_with(".glb") && !name.starts_with(UNFINISHED);
        self.names().into_iter().filter(is_other).collect()
    }

    /// The maps in the folder.
    pub(super) fn maps(&self) -> Maps {
        let maps = self.names().into_iter().filter(|name| name.ends_with(".glb"));
        maps.map(|name| (name.clone(), blake3::hash(&self.bytes(&name)).to_hex().to_string()))
            .collect()
    }

    /// Whether there is a map of a run that needs no resuming. The sum of groups is none.
    pub(super) fn has_complete_map(&self) -> bool {
        let names = self.names();
        let mut maps: Vec<&str> =
            names.iter().filter_map(|name| name.strip_suffix(".glb")).collect();
        if maps.len() > 1 {
            maps.retain(|name| name.contains('.'));
        }
        maps.iter().any(|map| !names.contains(&format!("{map}.checkpoint")))
    }

    /// The first map in the folder that cannot be read.
    pub(super) fn broken_map(&self) -> Result<Option<String>, String> {
        for name in self.maps().into_keys() {
            let mut command = Command::new(&self.isolux);
            command.args(["info", &name]).current_dir(&self.folder);
            command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
            if ended(command)?.code != Some(0) {
                return Ok(Some(name));
            }
        }
        Ok(None)
    }
}

/// Runs a command to its end.
pub(super) fn ended(command: Command) -> Result<Ended, String> {
    wait(start(command)?)
}

/// Starts a command.
pub(super) fn start(mut command: Command) -> Result<Child, String> {
    command.spawn().map_err(|e| format!("cannot run {}: {e}", command.get_program().display()))
}

/// The end of a run. It says little enough for a pipe to hold.
pub(super) fn wait(mut child: Child) -> Result<Ended, String> {
    let mut said = Vec::new();
    if let Some(mut stderr) = child.stderr.take() {
        stderr.read_to_end(&mut said).map_err(|e| format!("standard error: {e}"))?;
    }
    let status = child.wait().map_err(|e| format!("cannot wait for a run: {e}"))?;
    Ok(Ended { code: status.code(), said: String::from_utf8_lossy(&said).into_owned() })
}

/// Sends a signal, by its name without `SIG`. A run that has ended takes none.
pub(super) fn signal(child: &Child, name: &str) -> Result<(), String> {
    let mut kill = Command::new("kill");
    kill.args([&format!("-{name}"), &child.id().to_string()]).stderr(Stdio::null());
    kill.status().map(|_| ()).map_err(|e| format!("cannot run kill: {e}"))
}

/// Whether a run has ended.
pub(super) fn is_over(child: &mut Child) -> bool {
    child.try_wait().is_ok_and(|status| status.is_some())
}
