//! What is wrong and what is left out, while a file is read.

use crate::{Problem, Problems};
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use super::limits;

/// A finding whose file is known from the context.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Flaw {
    place: String,
    /// Whether the place starts at the root of the file.
    is_rooted: bool,
    what: String,
    remedy: String,
}

impl Flaw {
    pub(super) fn new(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { place: String::new(), is_rooted: false, what: what.into(), remedy: remedy.into() }
    }

    /// The same finding, its place taken relative to `outer`, unless it is known from the root on.
    pub(super) fn at(mut self, outer: impl Into<String>) -> Self {
        if self.is_rooted {
            return self;
        }
        let outer = outer.into();
        self.place = if self.place.is_empty() { outer } else { format!("{outer}.{}", self.place) };
        self
    }

    /// The same finding, its place taken relative to one that starts at the root of the file.
    pub(super) fn rooted(self, outer: impl Into<String>) -> Self {
        Self { is_rooted: true, ..self.at(outer) }
    }

    pub(super) fn into_problem(self, file: &Path) -> Problem {
        Problem::new(file, self.place, self.what, self.remedy)
    }
}

/// An index that names nothing.
pub(super) fn no_such(list: &str, index: usize, length: usize) -> Flaw {
    let there = match length {
        0 => format!("there are no {list}"),
        1 => format!("there is only {list}[0]"),
        _ => format!("{list} ends at {}", length - 1),
    };
    Flaw::new(format!("{list}[{index}] does not exist, {there}"), "export the file again")
}

/// All findings about one file, each said once.
pub(super) struct Notes {
    file: PathBuf,
    problems: Vec<Flaw>,
    known_problems: HashSet<Flaw>,
    warnings: Vec<(Flaw, usize)>,
    warning_by_text: HashMap<(String, String), usize>,
}

impl Notes {
    pub(super) fn new(file: &Path) -> Self {
        Self {
            file: file.to_owned(),
            problems: Vec::new(),
            known_problems: HashSet::new(),
            warnings: Vec::new(),
            warning_by_text: HashMap::new(),
        }
    }

    pub(super) fn problem(&mut self, flaw: Flaw) {
        if self.problems.len() < limits::PROBLEMS && self.known_problems.insert(flaw.clone()) {
            self.problems.push(flaw);
        }
    }

    /// The value, or a problem noted.
    pub(super) fn accept<T>(&mut self, result: Result<T, Flaw>) -> Option<T> {
        result.map_err(|flaw| self.problem(flaw)).ok()
    }

    /// Warnings of the same words are one, with their first place and their number.
    pub(super) fn warn(&mut self, flaw: Flaw) {
        let text = (flaw.what.clone(), flaw.remedy.clone());
        match self.warning_by_text.get(&text) {
            Some(&index) => {
                if self.warnings[index].0.place != flaw.place {
                    self.warnings[index].1 += 1;
                }
            }
            None => {
                self.warning_by_text.insert(text, self.warnings.len());
                self.warnings.push((flaw, 0));
            }
        }
    }

    /// Fails with all problems so far, if there are any.
    pub(super) fn check(&mut self) -> Result<(), Problems> {
        if self.problems.is_empty() { Ok(()) } else { Err(self.take_problems()) }
    }

    pub(super) fn take_problems(&mut self) -> Problems {
        let problems = std::mem::take(&mut self.problems);
        Problems(problems.into_iter().map(|flaw| flaw.into_problem(&self.file)).collect())
    }

    pub(super) fn into_warnings(self) -> Vec<Problem> {
        let file = self.file;
        let shown = |(mut flaw, more): (Flaw, usize)| {
            if more > 0 {
                flaw.place = format!("{} and {more} more", flaw.place);
            }
            flaw.into_problem(&file)
        };
        self.warnings.into_iter().map(shown).collect()
    }
}
