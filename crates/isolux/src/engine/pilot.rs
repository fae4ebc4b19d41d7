//! The pilot: a deterministic first look that fixes the elements before increments are counted.
//!
//! Coarse to fine: solve, see where the details are, bisect there, until the interpolation error is
//! a fixed part of the accuracy asked for. All receivers use the same random numbers here, so that
//! noise is smooth over surfaces and does not pass for detail.

use super::detail::{LeafError, leaf_errors, refine_worst};
use super::direct::Lighting;
use super::gather::{Gatherer, Gathering};
use super::path::Dice;
use super::surface::SurfacePoint;
use crate::elements::{Elements, Subdivision};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;

/// Vertices that the pilot starts with, unless the scene has more.
const FIRST_VERTICES: f64 = 1500.0;
/// Rounds of refinement at most.
const MAX_ROUNDS: usize = 16;
/// The part of the accuracy asked for that interpolating indirect light may take.
const DISCRETIZATION_SHARE: f64 = 0.4;
/// Elements are not bisected below this share of the scene's extent.
const LEAST_EDGE_SHARE: f64 = 1e-4;
/// Receivers on borders are pulled in by this share of the way to the middle of their element.
const PULL_IN: f64 = 2e-3;
/// With more sources than this, rays read direct light from the map where they end.
const MOST_SOURCES_EVALUATED: usize = 64;
/// Vertices for the direct light of emitting surfaces, in multiples of those for indirect light.
const MOST_FOR_SAMPLED_LIGHT: usize = 4;
/// Sweeps of the pilot end when they change less than this.
const PILOT_TOLERANCE: f64 = 1e-4;

/// What the pilot has fixed.
pub(super) struct Plan<'s> {
    pub(super) scene: &'s Scene,
    pub(super) lighting: &'s Lighting<'s>,
    pub(super) elements: Elements,
    pub(super) gatherers: Vec<Gatherer>,
    /// Indirect light lives on the first so many vertices and the nodes below `level`.
    pub(super) indirect_vertices: usize,
    pub(super) level: u32,
    /// Which vertices are not hidden in other geometry.
    pub(super) known: Vec<bool>,
    /// Direct light at the vertices; exact if the lighting is.
    pub(super) direct: Vec<Rgb>,
    /// First guess of the indirect light.
    pub(super) guess: Vec<Rgb>,
    pub(super) direct_from_map: bool,
    /// Errors of the elements that indirect light lives on.
    pub(super) indirect_errors: Vec<LeafError>,
    /// Those elements, by node, as triangles of the scene.
    pub(super) subdivision: Subdivision,
    /// Root mean square of the photometric illuminance over all known surfaces, lx.
    pub(super) rms_lx: f64,
    pub(super) rays: u64,
}

impl Plan<'_> {
    /// Values for the vertices that only direct light needs: interpolated from their parents.
    pub(super) fn prolongate(&self, coarse: &[Rgb]) -> Vec<Rgb> {
        let mut values = coarse.to_vec();
        for vertex in &self.elements.vertices()[coarse.len()..] {
            let [a, b] = vertex.parents.expect("vertices beyond the input are made by bisection");
            let read = |end: u32| (self.known[end as usize]).then(|| values[end as usize]);
            let value = match (read(a), read(b)) {
                (Some(a), Some(b)) => (a + b) * 0.5,
                (Some(one), None) | (None, Some(one)) => one,
                (None, None) => Rgb::BLACK,
            };
            values.push(value);
        }
        values
    }
}

/// What is asked of the pilot.
#[derive(Clone, Copy, Debug)]
pub(super) struct PilotRequest {
    pub(super) target: f64,
    pub(super) mesh_target: f64,
    pub(super) seed: u64,
    pub(super) max_vertices: usize,
}

struct Pilot<'s> {
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    key: Key,
    subdivision: Subdivision,
    direct: Vec<Rgb>,
    rays: u32,
    traced: u64,
    least_edge_m: f64,
}

/// One solution of the pilot.
struct Look {
    elements: Elements,
    indirect: Vec<Rgb>,
    known: Vec<bool>,
    errors: Vec<LeafError>,
    rms_lx: f64,
}

/// Looks and refines; `go_on` is asked after every round.
pub(super) fn pilot<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    go_on: &mut dyn FnMut(usize, u64) -> bool,
) -> Plan<'s> {
    let mut pilot = Pilot::new(scene, lighting, request);
    let goal = DISCRETIZATION_SHARE * request.target;
    let mut look = pilot.look();
    for _ in 0..MAX_ROUNDS {
        let error = relative_error(&look.errors, look.rms_lx);
        if error <= goal || !go_on(pilot.subdivision.vertex_count(), pilot.traced) {
            break;
        }
        let (least, most) = (pilot.least_edge_m, request.max_vertices);
        if !refine_worst(&mut pilot.subdivision, &look.errors, least, most) {
            break;
        }
        look = pilot.look();
    }
    pilot.finish(look, request, go_on)
}

/// The error of the scene, relative to its root mean square illuminance.
fn relative_error(errors: &[LeafError], rms_lx: f64) -> f64 {
    let area: f64 = errors.iter().map(|e| e.area_m2).sum();
    let squared: f64 = errors.iter().map(LeafError::squared).sum();
    if rms_lx > 0.0 { (squared / area).sqrt() / rms_lx } else { 0.0 }
}

impl<'s> Pilot<'s> {
    fn new(scene: &'s Scene, lighting: &'s Lighting<'s>, request: &PilotRequest) -> Self {
        let mut subdivision = Subdivision::new(scene);
        let area_m2: f64 = subdivision.leaves().map(|n| subdivision.triangle(n).area()).sum();
        // Half squares of hypotenuse h have area h^2 / 4, and there are two a vertex.
        let edge_m = (2.0 * area_m2 / FIRST_VERTICES).sqrt();
        subdivision.bisect_to(edge_m, request.max_vertices);
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        Self {
            scene,
            lighting,
            key: Key::new(request.seed).with(0),
            subdivision,
            direct: Vec::new(),
            rays: pilot_rays(request.target),
            traced: 0,
            least_edge_m: LEAST_EDGE_SHARE * extent_m,
        }
    }

    fn direct_from_map(&self) -> bool {
        self.lighting.source_count() > MOST_SOURCES_EVALUATED
    }

    fn gatherers(&self) -> Vec<Gatherer> {
        let receivers = self.subdivision.receivers(PULL_IN);
        receivers.iter().map(|r| Gatherer::at_vertex(self.scene, r)).collect()
    }

    /// Direct light at the vertices that have none yet.
    fn complete_direct(&mut self, gatherers: &[Gatherer]) {
        let sequence = Sequence::new(self.key.with(1));
        let new = &gatherers[self.direct.len()..];
        let values: Vec<Rgb> = new
            .par_iter()
            .map(|g| self.lighting.illuminance(&g.surface, &mut Dice::new(sequence, 0)))
            .collect();
        self.direct.extend(values);
    }

    fn look(&mut self) -> Look {
        let elements = self.subdivision.elements();
        let gatherers = self.gatherers();
        self.complete_direct(&gatherers);
        let known = vec![true; elements.vertices().len()];
        let gathering = Gathering {
            scene: self.scene,
            lighting: self.lighting,
            elements: &elements,
            level: u32::MAX,
            known: &known,
            direct_from_map: self.direct_from_map(),
            rays: self.rays,
        };
        let key = self.key.with(2);
        let operator = gathering.operator(&gatherers, |_| key);
        self.traced += operator.rays;
        let black = vec![Rgb::BLACK; gatherers.len()];
        let given = if self.direct_from_map() { self.direct.clone() } else { black.clone() };
        let indirect = operator.solve(&black, &given, PILOT_TOLERANCE);
        let open = operator.open();
        let is_known = |k: usize| open[k] || !(self.direct[k] + indirect[k]).is_black();
        let known: Vec<bool> = (0..gatherers.len()).map(is_known).collect();
        let luminances: Vec<Option<f64>> =
            (0..known.len()).map(|k| known[k].then(|| indirect[k].luminance())).collect();
        let errors = leaf_errors(&self.subdivision, &elements, &luminances);
        let rms_lx = rms(&elements, &known, |k| (self.direct[k] + indirect[k]).luminance());
        Look { elements, indirect, known, errors, rms_lx }
    }

    /// Refines further for direct light as interpolated, and puts the plan together.
    fn finish(
        mut self,
        look: Look,
        request: &PilotRequest,
        go_on: &mut dyn FnMut(usize, u64) -> bool,
    ) -> Plan<'s> {
        let indirect_vertices = self.subdivision.vertex_count();
        let coarse = self.subdivision.clone();
        let level = coarse.node_count() as u32;
        let mut known = look.known;
        let mut elements = look.elements;
        // Sampled direct light has noise, which refinement cannot tell from shadow borders.
        let most = if self.lighting.is_exact() {
            request.max_vertices
        } else {
            request.max_vertices.min(MOST_FOR_SAMPLED_LIGHT * indirect_vertices)
        };
        for _ in 0..MAX_ROUNDS {
            let luminances: Vec<Option<f64>> =
                (0..known.len()).map(|k| known[k].then(|| self.direct[k].luminance())).collect();
            let errors = leaf_errors(&self.subdivision, &elements, &luminances);
            let good = relative_error(&errors, look.rms_lx) <= request.mesh_target;
            if good || !go_on(self.subdivision.vertex_count(), self.traced) {
                break;
            }
            let least = self.least_edge_m;
            if !refine_worst(&mut self.subdivision, &errors, least, most) {
                break;
            }
            elements = self.subdivision.elements();
            self.complete_direct(&self.gatherers());
            extend_known(&elements, &mut known, &self.direct);
        }
        // Once more for all: refinement has moved the receivers on borders.
        let gatherers = self.gatherers();
        self.direct.clear();
        self.complete_direct(&gatherers);
        Plan {
            direct_from_map: self.direct_from_map(),
            scene: self.scene,
            lighting: self.lighting,
            elements,
            gatherers,
            indirect_vertices,
            level,
            known,
            direct: self.direct,
            guess: look.indirect,
            indirect_errors: look.errors,
            subdivision: coarse,
            rms_lx: look.rms_lx,
            rays: self.traced,
        }
    }
}

/// Vertices added for direct light are hidden if both ends of their edge are and no light arrives.
fn extend_known(elements: &Elements, known: &mut Vec<bool>, direct: &[Rgb]) {
    let first = known.len();
    for (vertex, direct) in elements.vertices().iter().zip(direct).skip(first) {
        let ends = vertex.parents.unwrap_or([0, 0]);
        known.push(!direct.is_black() || ends.iter().any(|&end| known[end as usize]));
    }
}

/// Root mean square over the known surface.
pub(super) fn rms(elements: &Elements, known: &[bool], value: impl Fn(usize) -> f64) -> f64 {
    let (mut area, mut sum) = (0.0, 0.0);
    for (k, vertex) in elements.vertices().iter().enumerate().filter(|&(k, _)| known[k]) {
        area += vertex.area_m2;
        sum += vertex.area_m2 * value(k) * value(k);
    }
    if area > 0.0 { (sum / area).sqrt() } else { 0.0 }
}

/// Rays of a receiver in the pilot: more for finer accuracies, so that their noise stays below the
/// details looked for.
fn pilot_rays(target: f64) -> u32 {
    ((0.64 / target.max(1e-6)) as u32).clamp(32, 1024).next_power_of_two()
}

/// A place of an element of the plan that indirect light lives on.
pub(super) fn place_in_leaf(plan: &Plan, node: u32, [a, b]: [f64; 2]) -> SurfacePoint {
    let (_, origin) = plan.subdivision.node(node);
    let root = a.sqrt();
    let leaf = plan.subdivision.triangle(node);
    let point = leaf.point(root * (1.0 - b), root * b);
    let [u, v] = plan.scene.triangle(origin.triangle).barycentric(point);
    SurfacePoint::new(plan.scene, origin.triangle, origin.back, u, v)
}
