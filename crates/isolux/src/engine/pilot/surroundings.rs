//! The light of the surroundings: errors in dim rooms beside bright ones count by what they are there.

use super::Pilot;
use crate::engine::detail::LeafError;
use crate::engine::gather::Operator;
use crate::units::Rgb;

/// Surroundings count once they have less than this part of the light of the whole scene, by the square of what they lack, until they
/// count by their own light; and no more than so many times.
const DIM: f64 = 0.25;
const MOST_WEIGHT: f64 = 1e3;
/// Reflections over which light is taken to be that of the surroundings.
const REFLECTIONS: usize = 3;

impl Pilot<'_> {
    /// Finds the light of the surroundings of every vertex, lx: of what it sees, and what is seen from there. In one room it is about
    /// the same everywhere.
    pub(super) fn look_about(&mut self, operator: &Operator) {
        let waiting = self.carriers.waiting();
        let whole = operator.reflected(&vec![Rgb::grey(1.0); self.indirect.len()]);
        let mut seen = self.indirect.clone();
        for reflection in 0..REFLECTIONS {
            if reflection > 0 {
                seen = operator.reflected(&seen);
            }
            for (seen, whole) in seen.iter_mut().zip(&whole) {
                let share = whole.luminance();
                *seen = Rgb::grey(if share > 0.0 { seen.luminance() / share } else { 0.0 });
            }
            waiting.fill(&mut seen);
        }
        self.surroundings_lx = seen.iter().map(|seen| seen.luminance()).collect();
    }

    /// Has errors in dim surroundings count by what they are there.
    pub(super) fn weigh(&mut self, errors: &mut [LeafError], reference_lx: f64) {
        for vertex in &self.subdivision.vertices()[self.surroundings_lx.len()..] {
            let of = |end: u32| self.surroundings_lx[end as usize];
            let ends = vertex.parents.map(|ends| ends.map(of));
            self.surroundings_lx.push(ends.map_or(0.0, |[a, b]| a.max(b)));
        }
        for error in errors {
            let corners = self.subdivision.node(error.node).0.vertices;
            let about_lx = corners.map(|v| self.surroundings_lx[v as usize]);
            let about_lx = about_lx.into_iter().fold(0.0, f64::max);
            if about_lx > 0.0 {
                let times = reference_lx / about_lx;
                let dim = (DIM * times).max(1.0);
                error.weight = (dim * dim).min(times.max(1.0)).min(MOST_WEIGHT);
            }
        }
    }
}
