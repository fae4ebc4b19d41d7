//! Work on many texels, watched.

use super::plan::LightmapError;
use crate::engine::Watch;
use rayon::prelude::*;
use std::time::Instant;

/// Pieces of work between two looks at whether to go on.
const BLOCK: usize = 256;

/// Work done so far, and whoever watches it.
pub(super) struct Work<'a> {
    watch: &'a mut dyn FnMut(f64) -> Watch,
    started: Instant,
    /// Readings of the map.
    pub(super) readings: u64,
}

/// Time of what comes after a kind of work, as far as that can be told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct After {
    /// Pieces of the same kind.
    pub(super) pieces: f64,
    /// Other work, s.
    pub(super) other_s: f64,
}

impl After {
    /// More than can be told yet: no share of the work is done.
    pub(super) const UNFORESEEN: Self = Self { pieces: 0.0, other_s: f64::INFINITY };
}

impl<'a> Work<'a> {
    /// Nothing done yet.
    pub(super) fn new(watch: &'a mut dyn FnMut(f64) -> Watch) -> Self {
        Self { watch, started: Instant::now(), readings: 0 }
    }

    /// Does something to each of many, on all threads; results are in their order. Whoever watches is told the share
    /// of all work that is done, by the time that the pieces done so far took.
    pub(super) fn each<T: Sync, R: Send>(
        &mut self,
        all: &[T],
        after: After,
        one: impl Fn(&T) -> R + Sync,
    ) -> Result<Vec<R>, LightmapError> {
        let started = Instant::now();
        let mut done = Vec::with_capacity(all.len());
        for block in all.chunks(BLOCK) {
            let a_piece_s = started.elapsed().as_secs_f64() / done.len().max(1) as f64;
            let pieces = (all.len() - done.len()) as f64 + after.pieces;
            let left_s = pieces * a_piece_s + after.other_s;
            let past_s = self.started.elapsed().as_secs_f64();
            let share = if done.is_empty() { 0.0 } else { past_s / (past_s + left_s) };
            if (self.watch)(share) == Watch::Stop {
                return Err(LightmapError::Stopped);
            }
            done.par_extend(block.par_iter().map(&one));
        }
        Ok(done)
    }

    /// Does a few of many to see how long all would take, s; what they find is left to be found again.
    pub(super) fn foresee<T: Sync>(
        &mut self,
        (all, few): (&[T], usize),
        one: impl Fn(&T) + Sync,
    ) -> Result<f64, LightmapError> {
        let apart = all.len().div_ceil(few).max(1);
        let some: Vec<&T> = all.iter().step_by(apart).collect();
        let started = Instant::now();
        self.each(&some, After::UNFORESEEN, |piece| one(piece))?;
        let share = all.len() as f64 / some.len().max(1) as f64;
        Ok(started.elapsed().as_secs_f64() * share)
    }
}
