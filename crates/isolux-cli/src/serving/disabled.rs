//! What there is without the feature `serve`.

use crate::failure::{Failure, Outcome};
use crate::flags::{ServerFlags, ViewFlags};
use isolux::engine::{Progress, SoFar, Solution, SolveRequest, Watch};
use isolux::scene::Scene;
use std::path::Path;

const WHY: &str = "this program was built without the feature `serve`; `isolux export map.glb -o room.html` \
                   writes the walk-through as a file";

/// Refuses.
pub(crate) fn view(_: &ViewFlags, _: bool) -> Result<Outcome, Failure> {
    Err(Failure::bad_input(WHY))
}

/// A run that is watched: there is none.
pub(crate) enum Live {}

impl Live {
    pub(crate) fn start(_: &ServerFlags, _: &Scene, _: &Path) -> Result<Self, Failure> {
        Err(Failure::bad_input(WHY))
    }

    pub(crate) fn begin(&mut self, _: &SolveRequest) {
        match *self {}
    }

    pub(crate) fn look(&mut self, _: &Progress, _: &SoFar<'_>, _: &dyn Fn() -> bool) -> Watch {
        match *self {}
    }

    pub(crate) fn begins_anew(&self) -> bool {
        match *self {}
    }

    pub(crate) fn next_target(&mut self) -> Option<f64> {
        match *self {}
    }

    pub(crate) fn is_stopped(&self) -> bool {
        match *self {}
    }

    pub(crate) fn end(&mut self, _: &Solution, _: &Path) {
        match *self {}
    }

    pub(crate) fn linger(self) {
        match self {}
    }
}
