//! Weights of interpolation errors by the light of their surroundings.
//!
//! Errors in dim rooms beside bright ones count relative to the light there. So do errors of surfaces that dim rooms
//! see.

use super::state::Pilot;
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::{Gatherer, Operator, areas_m2};
use crate::engine::judge::Light;
use crate::engine::mesh::{LeafError, is_in_room};
use crate::units::Rgb;
use rayon::prelude::*;

/// The illuminance of surroundings below which errors gain weight, as a share of the reference illuminance.
/// The weight grows with the inverse square of that illuminance, until errors count relative to it. With 0.4,
/// the hall makes its elements anew with one seed of five (decision 42).
const DIM_LIGHT_SHARE: f64 = 0.25;
/// The largest weight of an error.
const MOST_WEIGHT: f64 = 1e3;
/// The least area of dim surfaces that is assumed, as a share of all surfaces.
pub(super) const LEAST_DIM_AREA_SHARE: f64 = 1.0 / 64.0;
/// The number of reflections over which light counts as that of the surroundings, and over which errors are followed to
/// dim places.
const REFLECTIONS: usize = 3;

/// The weight of an error, from the illuminance of its surroundings and the reference illuminance, lx.
fn weight(about_lx: f64, reference_lx: f64) -> f64 {
    let times = reference_lx / about_lx;
    let dim = (DIM_LIGHT_SHARE * times).max(1.0);
    (dim * dim).min(times.max(1.0)).min(MOST_WEIGHT)
}

impl Pilot<'_> {
    /// Determines the weights of errors at all vertices.
    pub(super) fn look_about(
        &mut self,
        elements: &Elements,
        gatherers: &[Gatherer],
        operator: &Operator,
    ) {
        let lx = |k: usize| (self.direct.lx[k] + self.indirect.lx[k]).luminance();
        let reference_lx = Light::of_vertices(elements, &self.near.standings, lx).reference_lx();
        let about_lx = self.surroundings_lx(operator);
        // Vertices whose surroundings are dark leave the weight to the other vertices of their elements.
        let own = |&lx: &f64| if lx > 0.0 { weight(lx, reference_lx) } else { f64::INFINITY };
        let own: Vec<f64> = about_lx.iter().map(own).collect();
        let in_rooms = own.par_iter().zip(gatherers).map(|(&own, gatherer)| {
            let is_dim = own > 1.0 && own.is_finite() && !self.end.has_passed();
            let place = gatherer.stand();
            if is_dim && is_in_room(self.scene, place) { own } else { 1.0 }
        });
        let in_rooms: Vec<f64> = in_rooms.collect();
        let seen = self.seen_from_dim(elements, operator, in_rooms.clone());
        let all = own.into_iter().zip(seen).zip(in_rooms);
        self.indirect.surroundings.weights =
            all.map(|((own, seen), in_room)| [own, seen, in_room]).collect();
    }

    /// The weights of errors of vertices for dim places that see them, from the weights at these places. Also sets the
    /// area of dim surfaces.
    fn seen_from_dim(
        &mut self,
        elements: &Elements,
        operator: &Operator,
        mut weights: Vec<f64>,
    ) -> Vec<f64> {
        let vertices = elements.vertices();
        let mut seen = vec![0.0_f64; vertices.len()];
        let (mut all_m2, mut dim_m2) = (0.0, 0.0);
        for (vertex, weight) in vertices.iter().zip(&weights) {
            all_m2 += vertex.area_m2;
            dim_m2 += vertex.area_m2 * (1.0 - 1.0 / weight);
        }
        self.indirect.surroundings.dim_m2 = dim_m2.max(LEAST_DIM_AREA_SHARE * all_m2);
        if dim_m2 > 0.0 {
            let areas_m2 = areas_m2(&self.mesh.subdivision, &self.mesh.carriers);
            for _ in 0..REFLECTIONS {
                weights = read_from_there(operator, elements, (&areas_m2, &weights));
                let most = seen.iter_mut().zip(&weights);
                most.for_each(|(seen, reflected)| *seen = seen.max(*reflected));
            }
        }
        seen
    }

    /// The illuminance of the surroundings of each vertex, lx: of the surfaces it sees, and of those seen from them. It
    /// is about the same everywhere in one room.
    fn surroundings_lx(&self, operator: &Operator) -> Vec<f64> {
        let waiting = self.mesh.carriers.waiting();
        let whole = operator.reflected(&vec![Rgb::grey(1.0); self.indirect.lx.len()]);
        let mut seen = self.indirect.lx.clone();
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
        seen.iter().map(|seen| seen.luminance()).collect()
    }

    /// The errors of direct light, which rays read, with the weights of dim rooms; `None` if there are no dim rooms.
    pub(super) fn weighed_in_rooms(&self, errors: &[LeafError]) -> Option<Vec<LeafError>> {
        let known = &self.indirect.surroundings.weights;
        if known.iter().all(|weights| weights[2] <= 1.0) {
            return None;
        }
        let weights = self.completed_weights();
        let weigh = |error: &LeafError| {
            let corners = self.mesh.subdivision.node(error.node).0.vertices;
            let weights = corners.map(|v| weights[v as usize][2]);
            LeafError { weight: weights.into_iter().fold(f64::INFINITY, f64::min), ..*error }
        };
        Some(errors.iter().map(weigh).collect())
    }

    /// The weights at all vertices. A new vertex has those of the ends of its edge: the smaller one, or the mean for
    /// dim places that see it.
    fn completed_weights(&self) -> Vec<[f64; 3]> {
        let mut weights = self.indirect.surroundings.weights.clone();
        for vertex in &self.mesh.subdivision.vertices()[weights.len()..] {
            let ends = vertex.parents.map(|ends| ends.map(|end| weights[end as usize]));
            let between =
                |[a, b]: [[f64; 3]; 2]| [a[0].min(b[0]), 0.5 * (a[1] + b[1]), a[2].min(b[2])];
            weights.push(ends.map_or([1.0, 0.0, 1.0], between));
        }
        weights
    }

    /// Sets the weights of errors by the light of their surroundings, and for dim places that see them.
    pub(super) fn weigh(&mut self, errors: &mut [LeafError]) {
        self.indirect.surroundings.weights = self.completed_weights();
        if without("surroundings") {
            return;
        }
        for error in errors {
            let corners = self.mesh.subdivision.node(error.node).0.vertices;
            let weights = corners.map(|v| self.indirect.surroundings.weights[v as usize]);
            let own = weights.iter().map(|w| w[0]).fold(f64::INFINITY, f64::min);
            let seen = weights.iter().map(|w| w[1]).sum::<f64>() / 3.0;
            error.weight = if own.is_finite() { own } else { 1.0 };
            error.seen = if seen > error.weight { seen } else { 0.0 };
        }
    }
}

/// The weight of an error at each vertex, from the weights of the receivers that read it. It is their mean over the
/// area that reads the vertex, or over its own area if that is larger.
fn read_from_there(
    operator: &Operator,
    elements: &Elements,
    (areas_m2, weights): (&[f64], &[f64]),
) -> Vec<f64> {
    let weighted: Vec<f64> = areas_m2.iter().zip(weights).map(|(m2, weight)| m2 * weight).collect();
    let vertices = areas_m2.len();
    let [read, counted] =
        [operator.read_by(areas_m2, vertices), operator.read_by(&weighted, vertices)];
    let weight = |v: usize| {
        let all_m2 = elements.vertices()[v].area_m2.max(read[v]);
        if all_m2 > 0.0 { counted[v] / all_m2 } else { 0.0 }
    };
    (0..weights.len()).map(weight).collect()
}
