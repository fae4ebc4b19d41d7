//! What is wrong with a file, where, and how to mend it.

use std::fmt;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// One finding about one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The file it is about.
    pub file: PathBuf,
    /// Where in the file: `line 12, column 3`, `materials[2].roughness`; empty for the whole file.
    pub place: String,
    /// What is wrong.
    pub what: String,
    /// How to mend it.
    pub remedy: String,
}

impl Problem {
    /// A finding at a place of a file.
    pub fn new(
        file: &Path,
        place: impl Into<String>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self {
            file: file.to_owned(),
            place: place.into(),
            what: what.into(),
            remedy: remedy.into(),
        }
    }

    /// A file that the system does not give, in plain words where they say all.
    pub fn unreadable(path: &Path, error: &io::Error) -> Self {
        let (what, remedy) = match error.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => {
                ("does not exist".to_owned(), "check the name and its case")
            }
            ErrorKind::IsADirectory => ("is a directory".to_owned(), "name a file in it"),
            ErrorKind::PermissionDenied => {
                ("cannot be read: permission denied".to_owned(), "allow reading, or copy it")
            }
            _ => (format!("cannot be read ({error})"), "check the name and the disk"),
        };
        Self::new(path, "", what, remedy)
    }
}

impl Problem {
    /// File, place and what is wrong, for a finding about another file that names this one.
    pub(crate) fn without_remedy(&self) -> String {
        let Self { file, place, what, .. } = self;
        match place.as_str() {
            "" => format!("{}: {what}", file.display()),
            place => format!("{}: {place}: {what}", file.display()),
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.without_remedy(), self.remedy)
    }
}

/// All that keeps a file from being read: at least one finding.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
pub struct Problems(pub Vec<Problem>);

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self(vec![problem])
    }
}

/// What a reader made of a file, and what it had to leave out or guess.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded<T> {
    /// The value.
    pub value: T,
    /// Things left out or guessed, to be shown to the user.
    pub warnings: Vec<Problem>,
}
