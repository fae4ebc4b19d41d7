//! How a run of the command ends.

use crate::notes::Note;
use crate::trouble::Trouble;
use std::fmt::Display;
use std::path::Path;

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

/// A run without a result.
#[derive(Debug)]
#[non_exhaustive]
pub enum Failure {
    /// Problems that the user can mend.
    BadInput(Vec<Trouble>),
    /// What the machine cannot do: memory, space.
    Refused(String),
    /// Whoever read our output has gone.
    ReaderGone,
}

impl Failure {
    /// One problem of the input.
    pub(crate) fn bad_input(problem: impl Display) -> Self {
        Self::bad_inputs([problem])
    }

    /// One problem of a file.
    pub(crate) fn of_file(file: &Path, problem: impl Display) -> Self {
        Self::BadInput(vec![Trouble::about(file, problem)])
    }

    /// Several problems of the input, or one in several lines.
    pub(crate) fn bad_inputs(problems: impl IntoIterator<Item = impl Display>) -> Self {
        let texts = problems.into_iter().map(|problem| problem.to_string());
        let troubles =
            texts.flat_map(|text| text.lines().map(Trouble::in_words).collect::<Vec<_>>());
        Self::BadInput(troubles.collect())
    }

    /// The lines for standard error.
    pub(crate) fn lines(&self) -> Vec<(Note, String)> {
        let kind = if matches!(self, Self::Refused(_)) { Note::Refused } else { Note::Error };
        self.troubles().into_iter().map(|trouble| (kind, trouble.message)).collect()
    }

    /// All problems.
    pub fn troubles(&self) -> Vec<Trouble> {
        match self {
            Self::BadInput(troubles) => troubles.clone(),
            Self::Refused(why) => vec![Trouble::in_words(why)],
            Self::ReaderGone => Vec::new(),
        }
    }
}

/// The exit code, as documented in the README.
pub(crate) fn exit_code(end: &Result<Outcome, Failure>) -> u8 {
    match end {
        Ok(outcome) => outcome.exit_code(),
        Err(Failure::ReaderGone) => 0,
        Err(Failure::BadInput(_)) => 2,
        Err(Failure::Refused(_)) => 4,
    }
}

impl Outcome {
    /// The exit code that tells of it.
    pub(crate) const fn exit_code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::CheckFailed => 1,
            Self::Unusable => 2,
            Self::StoppedEarly => 3,
            Self::Interrupted => 130,
        }
    }
}
