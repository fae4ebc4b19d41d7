//! Faces that lie exactly on others.

use super::record::{Corner, ObjFile};
use std::collections::{HashMap, HashSet};

/// Positions by place: equal coordinates share the index of the first.
pub(super) struct Places {
    first_at: Vec<u32>,
}

impl Places {
    pub(super) fn of(file: &ObjFile) -> Self {
        let mut known = HashMap::with_capacity(file.positions.len());
        let first_at = (0..).zip(&file.positions).map(|(index, position)| {
            // Adding zero makes the two zeros one.
            let bits = position.map(|c| (c + 0.0).to_bits());
            *known.entry(bits).or_insert(index)
        });
        Self { first_at: first_at.collect() }
    }

    fn outline(&self, corners: &[Corner]) -> Vec<u32> {
        let mut places: Vec<u32> =
            corners.iter().map(|c| self.first_at[c.position as usize]).collect();
        places.sort_unstable();
        places
    }
}

/// The outlines met so far in one part. Files made for pictures double a face, often turned round,
/// to show it from both sides; here one face already has both.
pub(super) struct Copies<'a> {
    places: &'a Places,
    seen: HashSet<Vec<u32>>,
}

impl<'a> Copies<'a> {
    pub(super) fn new(places: &'a Places) -> Self {
        Self { places, seen: HashSet::new() }
    }

    /// Whether a face has the same corners as one before.
    pub(super) fn is_copy(&mut self, corners: &[Corner]) -> bool {
        !self.seen.insert(self.places.outline(corners))
    }
}
