//! What every step of reading one scene shares.

use super::spans::{Lines, Span};
use crate::findings::Findings;
use crate::obj::Materials;
use crate::picture::Room;
use crate::reach::Root;
use crate::{Loaded, Problem, Problems, Reach};
use isolux::scene::UpAxis;
use std::path::{Path, PathBuf};

/// So many problems are put into the order of the file; the rest follow as they were found.
const MOST_SORTED: usize = 100;
/// More triangles than this in one scene are refused.
const MOST_TRIANGLES: usize = 50_000_000;
/// More luminaires than this in one scene are refused.
pub(super) const MOST_LUMINAIRES: usize = 1_000_000;

/// The file, its conventions, and what was found.
pub(super) struct Context {
    pub(super) findings: Findings,
    /// Problems of this file, by where they start.
    problems: Vec<(usize, Problem)>,
    lines: Lines,
    /// Metres in one unit of length of the file.
    pub(super) unit_m: f64,
    pub(super) up: UpAxis,
    /// Whether materials of other formats are read as meant.
    pub(super) materials: Materials,
    /// Where the files lie that the scene names.
    pub(super) root: Root,
    /// Room for pictures.
    pub(super) pictures: Room,
    triangles_left: usize,
    luminaires_left: usize,
}

impl Context {
    pub(super) fn new(path: &Path, text: &str) -> Self {
        Self {
            findings: Findings::new(path),
            problems: Vec::new(),
            lines: Lines::new(text),
            unit_m: 1.0,
            up: UpAxis::Z,
            materials: Materials::AsMeant,
            root: Root::of(path, Reach::Inside),
            pictures: Room::default(),
            triangles_left: MOST_TRIANGLES,
            luminaires_left: MOST_LUMINAIRES,
        }
    }

    /// Something that keeps the scene from being used.
    pub(super) fn problem(
        &mut self,
        at: &Span,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let place = self.lines.place(at);
        if self.problems.len() < MOST_SORTED {
            let problem = Problem::new(self.findings.file(), place, what, remedy);
            self.problems.push((at.start, problem));
        } else {
            self.findings.problem(place, what, remedy);
        }
    }

    /// Whether something keeps the scene from being used.
    pub(super) fn has_problems(&self) -> bool {
        !self.problems.is_empty() || self.findings.has_problems()
    }

    /// All problems, those of this file in its order; or the value.
    pub(super) fn finish<T>(mut self, value: T) -> Result<Loaded<T>, Problems> {
        self.problems.sort_by_key(|(start, _)| *start);
        let own: Vec<Problem> = self.problems.into_iter().map(|(_, problem)| problem).collect();
        let of_other_files = self.findings.finish(value);
        match of_other_files {
            Err(Problems(rest)) => Err(Problems(own.into_iter().chain(rest).collect())),
            Ok(_) if !own.is_empty() => Err(Problems(own)),
            Ok(loaded) => Ok(loaded),
        }
    }

    /// Something left out or guessed.
    pub(super) fn warning(
        &mut self,
        at: &Span,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        self.findings.warning(self.lines.place(at), what, remedy);
    }

    /// The one key of several that is there; a problem if there is none, or more.
    pub(super) fn one_of(
        &mut self,
        at: &Span,
        thing: &str,
        keys: &[(&'static str, bool)],
    ) -> Option<&'static str> {
        let given: Vec<_> = keys.iter().filter(|(_, there)| *there).map(|(key, _)| *key).collect();
        if let [only] = given[..] {
            return Some(only);
        }
        let all: Vec<_> = keys.iter().map(|(key, _)| format!("`{key}`")).collect();
        let what = match given[..] {
            [] => format!("{thing} has nothing to say what it is"),
            _ => format!("{thing} has both `{}`", given.join("` and `")),
        };
        self.problem(at, what, format!("give one of {}", all.join(", ")));
        None
    }

    /// The path of a file that the scene names.
    pub(super) fn path_of(&mut self, at: &Span, name: &str) -> Option<PathBuf> {
        match self.root.file(name) {
            Ok(path) => Some(path),
            Err(why) => {
                let (what, remedy) = why.explain(name);
                self.problem(at, what, remedy);
                None
            }
        }
    }

    /// What another file holds; a problem there is told of the place that names it, too.
    pub(super) fn absorb<T>(
        &mut self,
        at: &Span,
        name: &str,
        read: Result<Loaded<T>, Problems>,
    ) -> Option<T> {
        if read.is_err() {
            let what = format!("`{name}` cannot be used, for the reason that follows");
            self.problem(at, what, "mend it, or name another file");
        }
        self.findings.absorb(read)
    }

    /// Sets triangles aside before they are made; whether there was room.
    pub(super) fn take_triangles(&mut self, at: &Span, count: usize, copies: usize) -> bool {
        let Some(left) = left_after(self.triangles_left, count, copies) else {
            let what =
                format!("{copies} times {count} triangles are more than {MOST_TRIANGLES} in all");
            self.problem(at, what, "lower the number of placements or the detail");
            return false;
        };
        self.triangles_left = left;
        true
    }

    /// Sets luminaires aside before they are made; whether there was room.
    pub(super) fn take_luminaires(&mut self, at: &Span, count: usize, copies: usize) -> bool {
        let Some(left) = left_after(self.luminaires_left, count, copies) else {
            let what = format!("more than {MOST_LUMINAIRES} luminaires in all");
            self.problem(at, what, "lower the counts");
            return false;
        };
        self.luminaires_left = left;
        true
    }
}

fn left_after(left: usize, count: usize, copies: usize) -> Option<usize> {
    count.checked_mul(copies).and_then(|taken| left.checked_sub(taken))
}
