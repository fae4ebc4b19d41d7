//! What is found at the lines of a scene of several files.

use crate::findings::Findings;
use crate::{Loaded, Problem, Problems};
use std::collections::HashSet;
use std::path::Path;
use std::rc::Rc;

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct At {
    pub(crate) file: Rc<Path>,
    pub(crate) line: usize,
}

/// Problems and warnings; what is said of a line is said once, however often the line is repeated.
pub(crate) struct Notes {
    findings: Findings,
    said: HashSet<(At, String)>,
}

impl Notes {
    pub(crate) fn new(path: &Path) -> Self {
        Self { findings: Findings::new(path), said: HashSet::new() }
    }

    /// Something that keeps the scene from being used.
    pub(crate) fn problem(&mut self, at: &At, what: impl Into<String>, remedy: impl Into<String>) {
        if let Some(problem) = self.new_at(at, what.into(), remedy.into()) {
            self.findings.absorb::<()>(Err(problem.into()));
        }
    }

    /// Something left out or guessed.
    pub(crate) fn warning(&mut self, at: &At, what: impl Into<String>, remedy: impl Into<String>) {
        if let Some(warning) = self.new_at(at, what.into(), remedy.into()) {
            self.findings.absorb(Ok(Loaded { value: (), warnings: vec![warning] }));
        }
    }

    /// Something about the scene as a whole.
    pub(crate) fn findings(&mut self) -> &mut Findings {
        &mut self.findings
    }

    /// The value with its warnings, or all problems.
    pub(crate) fn finish<T>(self, value: T) -> Result<Loaded<T>, Problems> {
        self.findings.finish(value)
    }

    fn new_at(&mut self, at: &At, what: String, remedy: String) -> Option<Problem> {
        let is_new = self.said.insert((at.clone(), what.clone()));
        is_new.then(|| Problem::new(&at.file, format!("line {}", at.line), what, remedy))
    }
}
