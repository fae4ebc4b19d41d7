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
    /// Column in it, from 1, where one place is meant.
    pub column: Option<usize>,
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
        Self { severity, line, column: None, what: what.into(), remedy: remedy.into() }
    }

    pub(super) fn warning(line: usize, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Warning, line, what, remedy)
    }

    pub(super) fn note(line: usize, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Note, line, what, remedy)
    }

    /// What a reader says of a file.
    pub(super) fn of_reading(problem: &Problem, file: &Path, severity: Severity) -> Self {
        let remedy = problem.remedy.clone();
        // A finding in another file, of a tilt table, says so.
        if problem.file != file {
            let what = problem.without_remedy();
            return Self { severity, line: None, column: None, what, remedy };
        }
        let (line, column) = line_and_column(&problem.place);
        Self { severity, line, column, what: problem.what.clone(), remedy }
    }
}

/// Those of `line 12, column 3` and of `line 12`.
fn line_and_column(place: &str) -> (Option<usize>, Option<usize>) {
    let Some(numbers) = place.strip_prefix("line ") else { return (None, None) };
    match numbers.split_once(", column ") {
        Some((line, column)) => (line.parse().ok(), column.parse().ok()),
        None => (numbers.parse().ok(), None),
    }
}
