//! A run whose words are read as it says them.

use super::runs::{Bench, CHECKPOINT, signal, start, wait};
use crate::case::Case;
use std::io::{BufRead, BufReader, Lines};
use std::process::{Child, ChildStderr};

/// It, and its words from here on.
pub(super) struct Watched {
    pub(super) child: Child,
    lines: Lines<BufReader<ChildStderr>>,
}

impl Watched {
    pub(super) fn start(
        bench: &Bench,
        case: &Case,
        before: &[&str],
        flags: &[&str],
    ) -> Result<Self, String> {
        let all = [&["--progress", "json"], flags].concat();
        Self::of(start(bench.solve(case, before, &all))?)
    }

    pub(super) fn of(mut child: Child) -> Result<Self, String> {
        let stderr = child.stderr.take().ok_or("standard error is not there")?;
        Ok(Self { child, lines: BufReader::new(stderr).lines() })
    }

    /// Whether a line with these words comes before the end.
    pub(super) fn says(&mut self, words: &str) -> bool {
        self.lines.by_ref().map_while(Result::ok).any(|line| line.contains(words))
    }

    /// All it says from here to its end.
    pub(super) fn rest(&mut self) -> String {
        self.lines.by_ref().map_while(Result::ok).map(|line| line + "\n").collect()
    }

    /// Ends the run after its first increments, and gives the state that it leaves.
    pub(super) fn stop_in_increments(mut self, bench: &Bench) -> Result<Vec<u8>, String> {
        if !self.says("\"increments\"") {
            return Err("a run says nothing of its increments".to_owned());
        }
        signal(&self.child, "TERM")?;
        let said = self.rest();
        let ended = wait(self.child)?;
        let state = bench.bytes(CHECKPOINT);
        match ended.code {
            Some(130) if !state.is_empty() => Ok(state),
            _ => Err(format!("a run that is stopped leaves no state: {ended:?} {said}")),
        }
    }
}
