//! What an audit says.

use crate::shown::sentence;
use isolux_formats::Problem;
use serde::Serialize;

/// One thing the user should know before a run.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Finding {
    /// How much it matters.
    pub severity: Severity,
    /// Which part of the scene.
    pub place: String,
    /// What was found.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Severity {
    /// Results are probably not what is wanted.
    Warning,
    /// Good to know.
    Note,
}

impl Finding {
    /// Results are probably not what is wanted.
    pub(super) fn warning(
        place: impl Into<String>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        let severity = Severity::Warning;
        Self { severity, place: place.into(), what: what.into(), remedy: remedy.into() }
    }

    /// Good to know.
    pub(super) fn note(
        place: impl Into<String>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { severity: Severity::Note, ..Self::warning(place, what, remedy) }
    }

    /// What a reader left out or guessed.
    pub(super) fn of_reading(problem: &Problem) -> Self {
        let file = problem.file.display().to_string();
        let place =
            if problem.place.is_empty() { file } else { format!("{file}: {}", problem.place) };
        Self::warning(place, problem.what.clone(), problem.remedy.clone())
    }

    /// The finding as a sentence without its severity.
    pub(super) fn sentence(&self) -> String {
        sentence(&format!("{}: {}; {}", self.place, self.what, self.remedy))
    }

    pub(super) fn line(&self) -> String {
        let severity = match self.severity {
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        sentence(&format!("{severity}: {}: {}; {}", self.place, self.what, self.remedy)) + "\n"
    }
}
