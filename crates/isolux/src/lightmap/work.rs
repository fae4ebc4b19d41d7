//! Work on many texels, watched.

use super::plan::LightmapError;
use rayon::prelude::*;
use std::time::Instant;

/// Pieces of work between two looks at how to go on.
const BLOCK: usize = 256;

/// How baking is to go on, as whoever watches says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// As well as the map allows.
    Whole,
    /// From now on in the cheapest way that gives every texel a value: there is no more time. What has been read stays.
    Coarse,
    /// The time is over: what is left has the values that the map has between its vertices, without any ray.
    Late,
    /// Not at all.
    Stop,
}

/// Work done so far, and whoever watches it.
pub(super) struct Work<'a> {
    watch: &'a mut dyn FnMut(f64) -> Pace,
    started: Instant,
    /// Whether there is no more time: whoever has said so once is not asked whether it still holds.
    pub(super) is_coarse: bool,
    /// Whether the time is over.
    is_late: bool,
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
    pub(super) fn new(watch: &'a mut dyn FnMut(f64) -> Pace) -> Self {
        Self { watch, started: Instant::now(), is_coarse: false, is_late: false, readings: 0 }
    }

    /// Does something to each of many, on all threads; results are in their order. They are those of the first of them alone
    /// where the time ends before all are done. Whoever watches is told the share of all work that is done, by the time that the
    /// pieces done so far took.
    pub(super) fn each<T: Sync, R: Send>(
        &mut self,
        all: &[T],
        after: After,
        one: impl Fn(&T) -> R + Sync,
    ) -> Result<Vec<R>, LightmapError> {
        self.blocks((all, after), |work| work.is_coarse, one)
    }

    /// The same for what is so cheap that it is done even where the time has ended.
    pub(super) fn each_coarsely<T: Sync, R: Send>(
        &mut self,
        all: &[T],
        one: impl Fn(&T) -> R + Sync,
    ) -> Result<Vec<R>, LightmapError> {
        self.blocks((all, After::default()), |_| false, one)
    }

    /// The same for what is cheap: results are those of the first of them alone where the time is over before all are done.
    pub(super) fn each_unless_late<T: Sync, R: Send>(
        &mut self,
        all: &[T],
        one: impl Fn(&T) -> R + Sync,
    ) -> Result<Vec<R>, LightmapError> {
        self.blocks((all, After::default()), |work| work.is_late, one)
    }

    fn blocks<T: Sync, R: Send>(
        &mut self,
        (all, after): (&[T], After),
        is_out_of_time: impl Fn(&Self) -> bool,
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
            match (self.watch)(share) {
                Pace::Whole => {}
                Pace::Coarse => self.is_coarse = true,
                Pace::Late => (self.is_coarse, self.is_late) = (true, true),
                Pace::Stop => return Err(LightmapError::Stopped),
            }
            if is_out_of_time(self) {
                break;
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
        let done = self.each(&some, After::UNFORESEEN, |piece| one(piece))?;
        let share = all.len() as f64 / done.len().max(1) as f64;
        Ok(started.elapsed().as_secs_f64() * share)
    }
}
