//! Numbers of a scene, drawn one after the other.

use isolux::sampling::Key;

/// A row of random numbers that depends on its key alone.
pub(super) struct Draw {
    key: Key,
    drawn: u64,
}

impl Draw {
    /// The row of a scene.
    pub(super) const fn new(seed: u64, scene: u64) -> Self {
        Self { key: Key::new(seed).with(scene), drawn: 0 }
    }

    fn uniform(&mut self) -> f64 {
        self.drawn += 1;
        self.key.with(self.drawn).uniform()
    }

    /// A number between two, in thousandths, as people measure rooms.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        thousandths(low + (high - low) * self.uniform())
    }

    /// A whole number between two, both of which may come.
    pub(super) fn count(&mut self, low: u32, high: u32) -> u32 {
        low + (f64::from(high - low + 1) * self.uniform()) as u32
    }

    /// One of several, each as likely as another.
    pub(super) fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[(of.len() as f64 * self.uniform()) as usize]
    }

    /// Yes, with a probability.
    pub(super) fn chance(&mut self, share: f64) -> bool {
        self.uniform() < share
    }
}

/// Rounded, so that files of scenes can be read.
pub(super) fn thousandths(x: f64) -> f64 {
    (1000.0 * x).round() / 1000.0
}
