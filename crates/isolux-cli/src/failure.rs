//! How a run of the command ends.

use crate::notes::Note;
use std::fmt::Display;
use std::process::ExitCode;

/// A run that has a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// All that was asked for.
    Done,
    /// The checks ran and one of them failed.
    CheckFailed,
    /// All inputs were reported on, and one of them cannot be used.
    Unusable,
    /// Stopped by a limit, with a valid map.
    StoppedEarly,
    /// Interrupted, with a valid map.
    Interrupted,
}

/// A run without a result: one line for every problem.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The user can mend it.
    BadInput(Vec<String>),
    /// The machine cannot: memory, space.
    Refused(String),
    /// Whoever read our output has gone.
    ReaderGone,
}

impl Failure {
    /// One problem of the input.
    pub(crate) fn bad_input(problem: impl Display) -> Self {
        Self::BadInput(vec![problem.to_string()])
    }

    /// What to print on standard error, a line each.
    pub(crate) fn lines(&self) -> Vec<(Note, String)> {
        match self {
            Self::BadInput(problems) => {
                let lines = problems.iter().flat_map(|p| p.lines());
                lines.map(|line| (Note::Error, line.to_owned())).collect()
            }
            Self::Refused(why) => vec![(Note::Refused, why.clone())],
            Self::ReaderGone => Vec::new(),
        }
    }
}

/// The exit code, as documented in the README.
pub(crate) fn exit_code(end: &Result<Outcome, Failure>) -> ExitCode {
    ExitCode::from(match end {
        Ok(Outcome::Done) | Err(Failure::ReaderGone) => 0,
        Ok(Outcome::CheckFailed) => 1,
        Ok(Outcome::Unusable) | Err(Failure::BadInput(_)) => 2,
        Ok(Outcome::StoppedEarly) => 3,
        Err(Failure::Refused(_)) => 4,
        Ok(Outcome::Interrupted) => 130,
    })
}
