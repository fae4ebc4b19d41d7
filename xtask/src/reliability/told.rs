//! What is said on the way, and what has failed.

use std::path::Path;
use std::time::Instant;

/// The problems so far. A folder in which something went wrong is not kept: the seed makes it again.
pub(super) struct Told {
    begun: Instant,
    pub(super) problems: Vec<String>,
}

impl Told {
    pub(super) fn new() -> Self {
        Self { begun: Instant::now(), problems: Vec::new() }
    }

    pub(super) fn step(&self, what: &str) {
        println!("{:6.0} s  {what}", self.begun.elapsed().as_secs_f64());
    }

    pub(super) fn problem(&mut self, what: &str) {
        println!("FAILED  {what}");
        self.problems.push(what.to_owned());
    }

    /// A problem unless something holds; whether it does.
    pub(super) fn expect(&mut self, holds: bool, what: impl FnOnce() -> String) -> bool {
        if !holds {
            self.problem(&what());
        }
        holds
    }
}

/// A text in one line, without the folder that a run was made in.
pub(super) fn line(said: &str, folder: &Path) -> String {
    let folder = format!("{}/", folder.display());
    said.replace(&folder, "").split_whitespace().collect::<Vec<_>>().join(" ")
}
