//! Time that one thread spent on a processor: what other programs take does not count.

use std::time::Duration;

/// Runs from where it is made, in the thread that made it.
pub(crate) struct ThreadClock(Instant);

#[cfg(unix)]
type Instant = Duration;
#[cfg(not(unix))]
type Instant = std::time::Instant;

impl ThreadClock {
    pub(crate) fn start() -> Self {
        Self(now())
    }

    #[cfg(unix)]
    pub(crate) fn seconds(&self) -> f64 {
        now().saturating_sub(self.0).as_secs_f64()
    }

    /// Time on the wall, where nothing better is known.
    #[cfg(not(unix))]
    pub(crate) fn seconds(&self) -> f64 {
        self.0.elapsed().as_secs_f64()
    }
}

#[cfg(unix)]
fn now() -> Instant {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

#[cfg(not(unix))]
fn now() -> Instant {
    Instant::now()
}
