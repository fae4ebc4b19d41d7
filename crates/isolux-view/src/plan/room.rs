//! The room on a sheet for lettering: nothing is written over what is written already.

use crate::drawing::{Anchor, At, Drawing, Ink, Lettering, Letters, extent};

/// Free space around lettering, pixels.
const AROUND: f64 = 3.0;

/// Boxes that are taken, and the one that all must lie in.
#[derive(Debug)]
pub(super) struct Room {
    low: At,
    high: At,
    taken: Vec<[At; 2]>,
}

impl Room {
    pub(super) fn new(low: At, high: At) -> Self {
        Self { low, high, taken: Vec::new() }
    }

    /// Takes a box, even if it is taken.
    pub(super) fn take(&mut self, low: At, high: At) {
        self.taken.push([low, high]);
    }

    fn is_free(&self, low: At, high: At) -> bool {
        let inside = (0..2).all(|k| low[k] >= self.low[k] && high[k] <= self.high[k]);
        let apart = |[l, h]: &[At; 2]| (0..2).any(|k| high[k] <= l[k] || low[k] >= h[k]);
        inside && self.taken.iter().all(apart)
    }

    /// Writes a small text around its middle, if there is room for it.
    pub(super) fn write(
        &mut self,
        on: &mut Drawing,
        at: At,
        text: &str,
        (ink, halo): (Ink, Option<Ink>),
    ) -> bool {
        let half = extent(Letters::Small, text).map(|side| 0.5 * side);
        // The letters themselves fill about two thirds of their line.
        let reach = [half[0] + AROUND, 0.7 * half[1] + AROUND];
        let (low, high) =
            ([at[0] - reach[0], at[1] - reach[1]], [at[0] + reach[0], at[1] + reach[1]]);
        let is_free = self.is_free(low, high);
        if is_free {
            self.take(low, high);
            let (anchor, letters) = (Anchor::Middle, Letters::Small);
            on.text(Lettering { at, anchor, letters, ink, halo, text: text.to_owned() });
        }
        is_free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_do_not_overlap_and_stay_inside() {
        let mut drawing = Drawing::new(200, 100).unwrap();
        let mut room = Room::new([0.0; 2], [200.0, 100.0]);
        let mut write = |at| room.write(&mut drawing, at, "500", ([0; 3], None));
        assert!(write([100.0, 50.0]));
        assert!(!write([110.0, 52.0]));
        assert!(write([100.0, 75.0]));
        assert!(!write([5.0, 50.0]));
    }
}
