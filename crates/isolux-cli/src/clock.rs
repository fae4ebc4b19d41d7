//! A time limit over what is solved and what is baked of it.

use std::time::{Duration, Instant};

/// Solving gets this share of the time at least, whatever is foreseen for lightmaps: without a map there is nothing to bake.
const LEAST_FOR_SOLVING: f64 = 0.75;

/// When to stop, if ever.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    ends: Option<Instant>,
}

impl Clock {
    /// Without a limit.
    pub(crate) const ENDLESS: Self = Self { ends: None };

    /// From now on.
    pub(crate) fn start(limit: Option<Duration>) -> Self {
        // What no clock can count is no limit.
        Self { ends: limit.and_then(|limit| Instant::now().checked_add(limit)) }
    }

    /// Whether the time is up.
    pub(crate) fn is_up(&self) -> bool {
        self.left().is_some_and(|left| left.is_zero())
    }

    /// What is left; nothing where there is no limit.
    fn left(&self) -> Option<Duration> {
        self.ends.map(|ends| ends.saturating_duration_since(Instant::now()))
    }

    /// What solving may take where lightmaps are foreseen to take so long afterwards.
    pub(crate) fn for_solving(&self, baking_s: f64) -> Option<Duration> {
        self.left().map(|left| {
            let least = left.mul_f64(LEAST_FOR_SOLVING);
            left.saturating_sub(Duration::try_from_secs_f64(baking_s).unwrap_or(left)).max(least)
        })
    }

    /// The same, but up so much earlier: what is still to be done then takes its time, too.
    pub(crate) fn ahead_by(&self, s: f64) -> Self {
        let ahead = Duration::try_from_secs_f64(s).unwrap_or(Duration::ZERO);
        // What would have been up before there were clocks is up.
        Self { ends: self.ends.map(|ends| ends.checked_sub(ahead).unwrap_or_else(Instant::now)) }
    }

    /// The time of the next of so many that share what is left.
    pub(crate) fn next_of(&self, turns: usize) -> Self {
        Self::start(self.left().map(|left| left / turns.max(1) as u32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solving_leaves_time_for_lightmaps_but_not_more_than_a_quarter() {
        let clock = Clock::start(Some(Duration::from_secs(1000)));
        for (baking_s, expected_s) in
            [(0.0, 1000.0), (200.0, 800.0), (600.0, 750.0), (f64::INFINITY, 750.0)]
        {
            let left_s = clock.for_solving(baking_s).unwrap().as_secs_f64();
            assert!((expected_s - 10.0..=expected_s).contains(&left_s), "{baking_s}: {left_s}");
        }
        assert_eq!(Clock::ENDLESS.for_solving(200.0), None);
        assert!(!Clock::ENDLESS.next_of(3).is_up());
        let third_s = clock.next_of(3).left().unwrap().as_secs_f64();
        assert!((320.0..=334.0).contains(&third_s), "{third_s}");
        assert!(clock.ahead_by(2000.0).is_up() && !clock.ahead_by(500.0).is_up());
        let over = Clock::start(Some(Duration::ZERO));
        assert!(
            over.is_up()
                && over.next_of(2).is_up()
                && over.for_solving(1.0) == Some(Duration::ZERO)
        );
        assert!(!Clock::start(Some(Duration::MAX)).is_up());
    }
}
