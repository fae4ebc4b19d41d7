//! The end of the time for a computation: a moment, or a request to stop.

use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// A request to stop a run soon, with the map that it has. All clones share one request. Unlike the answer of a
/// watcher, it is heard within the steps of a run.
#[derive(Clone, Debug, Default)]
pub struct StopFlag(Arc<OnceLock<Instant>>);

impl StopFlag {
    /// Asks to stop. Returns whether that was asked before.
    pub fn raise(&self) -> bool {
        self.0.set(Instant::now()).is_err()
    }

    /// Whether somebody has asked to stop.
    pub fn is_raised(&self) -> bool {
        self.0.get().is_some()
    }
}

impl PartialEq for StopFlag {
    /// Flags are equal if one request raises both.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The time that what gives a map its light may take beyond the end: the first increment, the reflections of the pilot's light. A map
/// is written after it; both together are to take no more than two seconds.
const GRACE: Duration = Duration::from_secs(1);

/// The end of the time allowed; the pilot and increments check it while they run. The default is no limit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Deadline {
    /// The end; `None` means no limit.
    pub(crate) end: Option<Instant>,
    /// The request to stop, which ends the time, too.
    pub(crate) stop: Option<StopFlag>,
    /// The time allowed beyond the end.
    pub(crate) grace: Duration,
}

/// No deadline, for work that always runs to its end.
pub(crate) static NEVER: Deadline = Deadline::at(None);

impl Deadline {
    /// The deadline at a moment.
    pub(crate) const fn at(end: Option<Instant>) -> Self {
        Self { end, stop: None, grace: Duration::ZERO }
    }

    /// Whether the deadline has passed.
    pub(crate) fn has_passed(&self) -> bool {
        let stop = self.stop.as_ref().and_then(|stop| stop.0.get());
        if self.end.is_none() && stop.is_none() {
            return false;
        }
        let now = Instant::now();
        let is_over =
            |end: &Instant| now.checked_duration_since(*end).is_some_and(|late| late >= self.grace);
        self.end.iter().chain(stop).any(is_over)
    }

    /// The deadline with [`GRACE`], or more if asked for.
    pub(crate) fn with_grace(self, least: Duration) -> Self {
        Self { grace: GRACE.max(least), ..self }
    }

    /// The deadline that leaves so much time for what comes after it.
    pub(crate) fn ahead_by(self, time: Duration) -> Self {
        // What would have been up before there were clocks is up.
        let ahead = |end: Instant| end.checked_sub(time).unwrap_or_else(Instant::now);
        Self { end: self.end.map(ahead), ..self }
    }

    /// The share of some work of this duration, s, that the time left allows, at most one.
    pub(crate) fn share_of(&self, work_s: f64) -> f64 {
        if self.stop.as_ref().is_some_and(StopFlag::is_raised) {
            return 0.0;
        }
        let Some(end) = self.end else { return 1.0 };
        let left_s = end.saturating_duration_since(Instant::now()).as_secs_f64();
        if left_s < work_s { left_s / work_s } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deadline_passes_at_its_end_or_once_somebody_asks_to_stop_and_never_before() {
        assert!(!NEVER.has_passed() && NEVER.share_of(1e9) == 1.0);
        let long = Duration::from_secs(1000);
        let later = Instant::now() + long;
        assert!(!Deadline::at(Some(later)).has_passed());
        assert!(Deadline::at(Some(Instant::now())).has_passed());
        assert!((0.4..0.51).contains(&Deadline::at(Some(later)).share_of(2000.0)));
        let stop = StopFlag::default();
        let end = Deadline { stop: Some(stop.clone()), ..Deadline::at(Some(later)) };
        let kinder = Deadline { grace: long, ..end.clone() };
        assert!(!end.has_passed() && !stop.is_raised());
        assert!(!stop.raise() && stop.raise() && stop.is_raised());
        assert!(!Deadline::at(Some(later)).ahead_by(long / 2).has_passed());
        assert!(Deadline::at(Some(later)).ahead_by(2 * long).has_passed());
        assert!(end.has_passed() && end.share_of(1.0) == 0.0 && !kinder.has_passed());
    }
}
