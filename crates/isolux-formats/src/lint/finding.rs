//! What an audit says.

use crate::Problem;
use std::path::Path;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The file cannot be used.
    Error,
    /// Results are probably not what is wanted.
    Warning,
    /// Good to know.
    Note,
}

/// One thing found in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// How much it matters.
    pub severity: Severity,
    /// Line of the file, from 1; `None` for the whole file.
    pub line: Option<usize>,
    /// What was found.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

impl Finding {
    pub(super) fn new(
        severity: Severity,
        line: usize,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        let line = Some(line).filter(|line| *line > 0);
        Self { severity, line, what: what.into(), remedy: remedy.into() }
    }

    pub(super) fn warning(line: usize, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Warning, line, what, remedy)
    }

    pub(super) fn note(line: usize, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Note, line, what, remedy)
    }

    /// What a reader says of a file.
    pub(super) fn of_reading(problem: &Problem, file: &Path, severity: Severity) -> Self {
        let line = problem.place.strip_prefix("line ").and_then(|rest| {
            rest.split(|c: char| !c.is_ascii_digit()).next().and_then(|digits| digits.parse().ok())
        });
        // A finding in another file, of a tilt table, says so.
        let what = if problem.file == file {
            problem.what.clone()
        } else {
            format!("{}: {}: {}", problem.file.display(), problem.place, problem.what)
        };
        let line = line.filter(|_| problem.file == file);
        Self { severity, line, what, remedy: problem.remedy.clone() }
    }
}
