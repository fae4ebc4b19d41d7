//! The command of isolux, run with a time after which it is ended.

use crate::peers;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// How often a running command is looked at.
const LOOK: Duration = Duration::from_millis(10);

/// The command.
pub(super) struct Isolux {
    program: PathBuf,
    /// Where what it says is kept.
    folder: PathBuf,
    /// The mechanism that runs leave out, in a command that is built for that.
    without: Option<String>,
}

/// How a run of it ended.
pub(super) struct Ended {
    /// None where it was ended from outside.
    pub(super) code: Option<i32>,
    pub(super) stdout: String,
    pub(super) last_words: String,
    pub(super) time_s: f64,
    /// Time of all processors, s; that of the clock where the system does not tell.
    pub(super) cpu_s: f64,
}

impl Isolux {
    /// The one given, or that of the workspace, built as it is shipped.
    pub(super) fn new(root: &Path, given: Option<&Path>, folder: &Path) -> Result<Self, String> {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        let program = given.map_or_else(|| peers::build(root), |path| Ok(path.to_owned()))?;
        Ok(Self { program, folder: folder.to_owned(), without: None })
    }

    /// The same, whose runs leave a mechanism out.
    pub(super) fn without(&self, mechanism: Option<&str>) -> Self {
        Self {
            program: self.program.clone(),
            folder: self.folder.clone(),
            without: mechanism.map(str::to_owned),
        }
    }

    /// What it calls itself.
    pub(super) fn version(&self) -> Result<String, String> {
        let words = ["--version".to_owned()];
        Ok(self.run(&words, Duration::from_secs(10))?.stdout.trim().to_owned())
    }

    /// Runs it for so long at most.
    pub(super) fn run(&self, words: &[String], limit: Duration) -> Result<Ended, String> {
        let fail = |e| format!("cannot run {}: {e}", self.program.display());
        let said = ["stdout", "stderr"].map(|name| self.folder.join(format!("last.{name}")));
        let [stdout, stderr] =
            [File::create(&said[0]).map_err(fail)?, File::create(&said[1]).map_err(fail)?];
        let start = Instant::now();
        let cpu_before_s = cpu_of_children_s();
        let mut command = Command::new(&self.program);
        if let Some(mechanism) = &self.without {
            command.env("ISOLUX_WITHOUT", mechanism);
        }
        command.args(words).stdin(Stdio::null()).stdout(stdout).stderr(stderr);
        let mut child = command.spawn().map_err(fail)?;
        let status = loop {
            if let Some(status) = child.try_wait().map_err(fail)? {
                break Some(status);
            }
            if start.elapsed() > limit {
                child.kill().map_err(fail)?;
                child.wait().map_err(fail)?;
                break None;
            }
            std::thread::sleep(LOOK);
        };
        let time_s = start.elapsed().as_secs_f64();
        let cpu_s =
            cpu_of_children_s().zip(cpu_before_s).map_or(time_s, |(now, before)| now - before);
        let [stdout, stderr] = said.map(|path| std::fs::read(path).unwrap_or_default());
        let [stdout, stderr] = [stdout, stderr].map(|b| String::from_utf8_lossy(&b).into_owned());
        let last_words = stderr.lines().last().unwrap_or_default().to_owned();
        Ok(Ended { code: status.and_then(|s| s.code()), stdout, last_words, time_s, cpu_s })
    }
}

/// Time that children have taken so far which were waited for, s: user and system, in hundredths (Linux, proc(5)).
fn cpu_of_children_s() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the command, in parentheses, may hold spaces.
    let mut after = stat.rsplit_once(')')?.1.split_whitespace().skip(13);
    let ticks = |field: Option<&str>| field?.parse::<f64>().ok();
    Some((ticks(after.next())? + ticks(after.next())?) / 100.0)
}

impl Ended {
    /// What it said as JSON.
    pub(super) fn json(&self) -> Result<serde_json::Value, String> {
        let code = self.code.map_or("ended from outside".to_owned(), |code| format!("exit {code}"));
        serde_json::from_str(&self.stdout).map_err(|_| format!("{code}: {}", self.last_words))
    }
}
