//! What a check says.

use std::fmt;

/// One thing to mend.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Finding {
    /// Path from the root of the repository.
    pub file: String,
    /// Counted from 1; 0 for the file as a whole.
    pub line: usize,
    /// What is wrong.
    pub what: String,
    /// How to mend it.
    pub remedy: &'static str,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}; {}", self.file, self.line.max(1), self.what, self.remedy)
    }
}
