//! What is found while one file is read.

use crate::counted;
use crate::{Loaded, Problem, Problems};
use std::path::{Path, PathBuf};

/// More problems than this, or more warnings, are only counted: a broken file repeats itself.
const MOST_LISTED: usize = 20;

/// Problems and warnings of a file and of the files it names.
#[derive(Debug)]
pub(crate) struct Findings {
    file: PathBuf,
    problems: Listed,
    warnings: Listed,
}

#[derive(Debug, Default)]
struct Listed {
    list: Vec<Problem>,
    unlisted: usize,
}

impl Listed {
    fn push(&mut self, finding: Problem) {
        if self.list.len() < MOST_LISTED { self.list.push(finding) } else { self.unlisted += 1 }
    }

    fn all(mut self, file: &Path) -> Vec<Problem> {
        if self.unlisted > 0 {
            let what = counted(
                self.unlisted,
                "further finding is not listed",
                "further findings are not listed",
            );
            self.list.push(Problem::new(file, "", what, "mend those above first"));
        }
        self.list
    }
}

impl Findings {
    /// Nothing found yet in a file.
    pub(crate) fn new(file: &Path) -> Self {
        Self { file: file.to_owned(), problems: Listed::default(), warnings: Listed::default() }
    }

    /// The file that is read.
    pub(crate) fn file(&self) -> &Path {
        &self.file
    }

    /// Something that keeps the file from being used.
    pub(crate) fn problem(
        &mut self,
        place: impl Into<String>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        self.problems.push(Problem::new(&self.file, place, what, remedy));
    }

    /// Something left out or guessed.
    pub(crate) fn warning(
        &mut self,
        place: impl Into<String>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        self.warnings.push(Problem::new(&self.file, place, what, remedy));
    }

    /// What was found in another file that this one names.
    pub(crate) fn absorb<T>(&mut self, read: Result<Loaded<T>, Problems>) -> Option<T> {
        match read {
            Ok(loaded) => {
                loaded.warnings.into_iter().for_each(|w| self.warnings.push(w));
                Some(loaded.value)
            }
            Err(Problems(list)) => {
                list.into_iter().for_each(|p| self.problems.push(p));
                None
            }
        }
    }

    /// Whether something keeps the file from being used.
    pub(crate) fn has_problems(&self) -> bool {
        !self.problems.list.is_empty()
    }

    /// The value with its warnings, or all problems.
    pub(crate) fn finish<T>(self, value: T) -> Result<Loaded<T>, Problems> {
        if self.has_problems() {
            return Err(Problems(self.problems.all(&self.file)));
        }
        Ok(Loaded { value, warnings: self.warnings.all(&self.file) })
    }
}
