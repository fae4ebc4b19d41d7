//! Corners at one place into one vertex.

use std::collections::HashMap;

/// Vertices by place.
#[derive(Default)]
pub(crate) struct Weld {
    positions: Vec<[f64; 3]>,
    known: HashMap<[u64; 3], u32>,
}

impl Weld {
    /// The vertex at a place.
    pub(crate) fn vertex(&mut self, position: [f64; 3]) -> u32 {
        // Adding zero makes the two zeros one.
        let bits = position.map(|c| (c + 0.0).to_bits());
        *self.known.entry(bits).or_insert_with(|| {
            self.positions.push(position);
            self.positions.len() as u32 - 1
        })
    }

    /// All vertices, in the order in which they were first met.
    pub(crate) fn into_positions(self) -> Vec<[f64; 3]> {
        self.positions
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_place_is_one_vertex() {
        let mut weld = Weld::default();
        let places = [[0.0, 1.0, 2.0], [0.0, 1.0, 2.5], [-0.0, 1.0, 2.0]];
        assert_eq!(places.map(|p| weld.vertex(p)), [0, 1, 0]);
        assert_eq!(weld.into_positions(), places[..2]);
    }
}
