//! The pilot: a deterministic first look that fixes the elements before increments are counted.
//!
//! Coarse to fine: solve, see where the details are, bisect there, until the interpolation error is
//! a fixed part of the accuracy asked for. All receivers use the same random numbers here, so that
//! noise is smooth over surfaces and does not pass for detail.

use super::detail::{
    LeafError, Refinement, bisect_twice, leaf_errors, left_by_fit, refine_worst, told_error,
};
use super::direct::{Goal, Lighting, Measured};
use super::fit::Fit;
use super::gather::{DirectAtEnds, Gatherer, Gathering};
use super::hidden::Sight;
use super::path::Dice;
use super::plan::Plan;
use super::shrink::beyond_noise;
use super::surface::SurfacePoint;
use super::trust;
use crate::elements::{Elements, Subdivision};
use crate::map::Standing;
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;
use std::collections::HashMap;

/// Vertices that the pilot starts with, unless the scene has more.
const FIRST_VERTICES: f64 = 700.0;
/// And for each that the scene has: among many things light varies on walls, too, in ways that a
/// coarse look does not find.
const MORE_A_VERTEX: f64 = 0.05;
/// The first again where nothing is fitted: particles, whose hat functions blur what they are deposited in.
const FIRST_UNFITTED: f64 = 1500.0;
/// Rounds of refinement at most.
const MAX_ROUNDS: usize = 16;
/// The part of the accuracy asked for that interpolating indirect light may take.
const DISCRETIZATION_SHARE: f64 = 0.5;
/// The part of the area whose elements may stay coarse, as readers gather afresh there; and what it
/// may be where refinement comes to nothing.
const FRESH_SHARE: f64 = 0.1;
const MOST_FRESH: f64 = 0.5;
/// What all elements may err by, in accuracies asked for: rays read them all, but in the mean over many. Measured
/// on CUBE: at 3 the bias at its edges takes half of the accuracy, at 1 a third more elements bring nothing.
const BARE: f64 = 2.0;
/// Elements are not bisected below this share of the scene's extent: a centimetre in a room.
const LEAST_EDGE_SHARE: f64 = 1e-3;
/// Receivers on borders are pulled in by this share of the way to the middle of their element.
const PULL_IN: f64 = 2e-3;
/// Vertices for direct light as interpolated, in multiples of those for indirect light, unless so
/// many are cheap anyway.
const MOST_FOR_DIRECT_LIGHT: usize = 2;
const ALWAYS_FOR_DIRECT_LIGHT: usize = 50_000;
/// The part of the mesh accuracy asked for that noise of direct light may take, where it is not exact.
const NOISE_OF_DIRECT_LIGHT: f64 = 0.25;
/// A round in which the error falls with a lower power of the vertices was in vain. Where functions
/// are smooth it is one; chasing light that comes in through narrow places, less for some rounds.
const LEAST_ORDER: f64 = 0.25;
/// Vertices for indirect light, unless the scene has nearly as many from the start.
const MOST_FOR_INDIRECT_LIGHT: usize = 40_000;
/// Bisections of elements with hidden vertices, and the places in one that are asked whether light
/// comes there.
const ROUNDS_FOR_HIDDEN: usize = 4;
const PLACES_OF_HIDDEN: u32 = 4;
/// Sweeps of the pilot end when they change less than this.
const PILOT_TOLERANCE: f64 = 1e-4;

/// What is asked of the pilot.
#[derive(Clone, Copy, Debug)]
pub(super) struct PilotRequest {
    pub(super) target: f64,
    pub(super) mesh_target: f64,
    pub(super) seed: u64,
    /// Whether the map will be fitted to the light over elements.
    pub(super) is_fitted: bool,
    pub(super) max_vertices: usize,
}

struct Pilot<'s> {
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    key: Key,
    subdivision: Subdivision,
    /// At the vertices looked at so far: light, and whether they are open to it.
    direct: Vec<Rgb>,
    direct_variance: Vec<f64>,
    indirect: Vec<Rgb>,
    known: Vec<bool>,
    /// What they stand for.
    standings: Vec<Option<Standing>>,
    /// By node, whether something stands close before its middle.
    beset: Vec<bool>,
    /// In the middle of elements that no details tell of, by node.
    middles: HashMap<u32, f64>,
    /// Nodes there were then.
    solved_nodes: u32,
    rays: u32,
    traced: u64,
    least_edge_m: f64,
}

/// What a round of the pilot sees.
struct Look {
    elements: Elements,
    vertices: usize,
    errors: Vec<LeafError>,
    /// Share of them that a fit leaves.
    left_by_fit: f64,
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
    let mut look = pilot.look();
    let most = request.max_vertices.min(MOST_FOR_INDIRECT_LIGHT.max(look.vertices / 2 * 3));
    for _ in 0..ROUNDS_FOR_HIDDEN {
        if !pilot.open_up(&look.elements, most) {
            break;
        }
        look = pilot.look();
        if !go_on(pilot.subdivision.vertex_count(), pilot.traced) {
            break;
        }
    }
    // Readers gather over gathered maps alone: particles blur what is close by.
    let reads = if request.is_fitted { &[Read::Trusted, Read::All][..] } else { &[Read::All] };
    for &what in reads {
        look = pilot.refine(look, request, (what, most), go_on);
    }
    pilot.finish(look, request, go_on)
}

/// What elements are read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Read {
    /// By readers that interpolate.
    Trusted,
    /// By rays, and with the bare map.
    All,
}

impl Look {
    /// The elements that are read so, and how many times their error is what it should be, if it is more.
    fn excess(&self, what: Read, request: &PilotRequest) -> Option<(Vec<LeafError>, f64)> {
        let goal_lx = self.goal_lx(request.target, request);
        let limit = trust::limit(&self.errors, goal_lx, FRESH_SHARE);
        let is_read = |e: &LeafError| what == Read::All || !e.is_beset && e.error <= limit;
        let goal_lx = match what {
            // Fits do little for what is steep at edges.
            Read::All if request.is_fitted => {
                request.mesh_target.min(BARE * request.target) * self.rms_lx
            }
            _ => goal_lx,
        };
        let excess = trust::error_of(&self.errors, is_read) / goal_lx;
        let read = || self.errors.iter().copied().filter(is_read).collect();
        (excess > 1.0 && self.rms_lx > 0.0).then(|| (read(), excess))
    }

    /// The error of elements up to which readers trust the map.
    fn trusted_up_to_lx(&self, request: &PilotRequest) -> f64 {
        trust::limit(&self.errors, self.goal_lx(request.target, request), MOST_FRESH)
    }

    /// What interpolation may err by, before it is fitted, lx.
    fn goal_lx(&self, target: f64, request: &PilotRequest) -> f64 {
        let left = if request.is_fitted { self.left_by_fit } else { 1.0 };
        DISCRETIZATION_SHARE * target * self.rms_lx / left
    }
}

impl<'s> Pilot<'s> {
    fn new(scene: &'s Scene, lighting: &'s Lighting<'s>, request: &PilotRequest) -> Self {
        let mut subdivision = Subdivision::new(scene);
        let area_m2: f64 = subdivision.leaves().map(|n| subdivision.triangle(n).area()).sum();
        // Half squares of hypotenuse h have area h^2 / 4, and there are two a vertex.
        let first = if request.is_fitted { FIRST_VERTICES } else { FIRST_UNFITTED };
        let first = first + MORE_A_VERTEX * subdivision.vertex_count() as f64;
        let edge_m = (2.0 * area_m2 / first).sqrt();
        subdivision.bisect_to(edge_m, request.max_vertices);
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        Self {
            scene,
            lighting,
            key: Key::new(request.seed).with(0),
            subdivision,
            direct: Vec::new(),
            direct_variance: Vec::new(),
            indirect: Vec::new(),
            known: Vec::new(),
            standings: Vec::new(),
            beset: Vec::new(),
            middles: HashMap::new(),
            solved_nodes: 0,
            rays: pilot_rays(request.target),
            traced: 0,
            least_edge_m: LEAST_EDGE_SHARE * extent_m,
        }
    }

    fn gatherers(&self) -> Vec<Gatherer> {
        let receivers = self.subdivision.receivers(PULL_IN);
        receivers.iter().map(|r| Gatherer::at_vertex(self.scene, r, self.rays)).collect()
    }

    /// Direct light at the vertices that have none yet, by the fewest rays.
    fn complete_direct(&mut self, gatherers: &[Gatherer]) {
        let sequence = Sequence::new(self.key.with(1));
        let measured = |g: &Gatherer| self.lighting.measured(&g.surface, Goal::ANY, sequence);
        let new: Vec<Measured> = gatherers[self.direct.len()..].par_iter().map(measured).collect();
        self.direct.extend(new.iter().map(|m| m.lx));
        self.direct_variance.extend(new.iter().map(|m| m.variance));
    }

    /// Direct light at all vertices for the increments: with noise of their own, where it has noise.
    fn measure_direct(&mut self, gatherers: &[Gatherer], request: &PilotRequest, rms_lx: f64) {
        self.direct.clear();
        self.direct_variance.clear();
        let lighting = self.lighting;
        if !(request.is_fitted && lighting.has_many() && lighting.is_measured_once()) {
            self.complete_direct(gatherers);
            self.direct_variance.fill(0.0);
            return;
        }
        let goal = Goal::lux(NOISE_OF_DIRECT_LIGHT * request.mesh_target * rms_lx);
        let key = self.key.with(5);
        let measured = |(k, g): (usize, &Gatherer)| {
            lighting.measured(&g.surface, goal, Sequence::new(key.with(k as u64)))
        };
        let all: Vec<Measured> = gatherers.par_iter().enumerate().map(measured).collect();
        self.direct.extend(all.iter().map(|m| m.lx));
        self.direct_variance.extend(all.iter().map(|m| m.variance));
    }

    /// Photometric direct light at the known vertices, without details that may be noise.
    fn direct_signal(&self, elements: &Elements) -> Vec<Option<f64>> {
        let luminances = self.in_the_open(&self.direct);
        beyond_noise(elements, &luminances, &self.direct_variance)
    }

    /// Solves on the first mesh; later, gathers at the new vertices over what is known already.
    fn look(&mut self) -> Look {
        let elements = self.subdivision.elements();
        let gatherers = self.gatherers();
        self.complete_direct(&gatherers);
        self.complete_indirect(&elements, &gatherers);
        let luminances = self.in_the_open(&self.indirect);
        self.complete_beset();
        self.complete_middles(&elements, &luminances);
        let lx = |k: usize| (self.direct[k] + self.indirect[k]).luminance();
        let middle = |node: u32| self.middles.get(&node).copied();
        let beset = |node: u32| self.beset[node as usize];
        let errors = leaf_errors(&self.subdivision, &elements, &luminances, middle, beset);
        let rms_lx = rms(&elements, &self.standings, lx);
        let left_by_fit = left_by_fit(&self.subdivision, &elements, &luminances, &errors);
        Look { vertices: gatherers.len(), elements, errors, left_by_fit, rms_lx }
    }

    /// What rays read on a level of the elements.
    fn gathering<'a>(
        &'a self,
        elements: &'a Elements,
        level: u32,
        standings: &'a [Option<Standing>],
    ) -> Gathering<'a> {
        let direct = if self.lighting.are_read_at_ends() {
            DirectAtEnds::Read { values: &self.direct, level }
        } else {
            DirectAtEnds::Evaluated
        };
        Gathering { scene: self.scene, lighting: self.lighting, elements, level, standings, direct }
    }

    /// Whether something stands close before the nodes that were not looked at yet.
    fn complete_beset(&mut self) {
        let new = self.beset.len() as u32..self.subdivision.node_count() as u32;
        let is_beset = |node: u32| {
            let place = SurfacePoint::amid_node(self.scene, &self.subdivision, node);
            trust::is_beset(self.scene, &place, self.subdivision.longest_edge_m(node))
        };
        let new: Vec<bool> = new.into_par_iter().map(is_beset).collect();
        self.beset.extend(new);
    }

    /// Gathers in the middle of the elements that no details tell of, that have something close before
    /// them and that were not looked at yet; not in gaps, where readers gather anyway.
    fn complete_middles(&mut self, elements: &Elements, values: &[Option<f64>]) {
        let is_new = |&node: &u32| {
            !self.middles.contains_key(&node)
                && told_error(&self.subdivision, elements, values, node).is_none()
        };
        let new: Vec<u32> = self.subdivision.leaves().filter(is_new).collect();
        let beset = |node: u32| {
            let place = SurfacePoint::amid_node(self.scene, &self.subdivision, node);
            let edge_m = self.subdivision.longest_edge_m(node);
            let gatherer = Gatherer::on_surface(place, self.rays);
            let asks =
                self.beset[node as usize] && !trust::is_closed_in(self.scene, &place, edge_m);
            asks.then_some((node, gatherer))
        };
        let beset: Vec<(u32, Gatherer)> = new.into_par_iter().filter_map(beset).collect();
        let (nodes, rows): (Vec<u32>, Vec<Gatherer>) = beset.into_iter().unzip();
        let key = self.key.with(2);
        let gathering = self.gathering(elements, self.solved_nodes, &self.standings);
        let operator = gathering.operator(&rows, |_| key);
        let light = operator.apply(&self.indirect);
        self.traced += operator.rays;
        self.middles.extend(nodes.into_iter().zip(light.iter().map(|e| e.luminance())));
    }

    fn complete_indirect(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let first = self.indirect.len();
        // On the first mesh nobody knows yet what is hidden.
        if first == 0 {
            self.standings = self.standings_after(vec![None; gatherers.len()], gatherers);
        }
        let level = if first == 0 { u32::MAX } else { self.solved_nodes };
        let gathering = self.gathering(elements, level, &self.standings);
        let key = self.key.with(2);
        let edges_m = self.subdivision.longest_edges_m();
        let row = |(k, gatherer): (usize, &Gatherer)| {
            let in_gap = trust::is_closed_in(self.scene, &gatherer.surface, edges_m[k]);
            gatherer.in_gap(in_gap)
        };
        let rows: Vec<Gatherer> = gatherers.par_iter().enumerate().skip(first).map(row).collect();
        let operator = gathering.operator(&rows, |_| key);
        self.traced += operator.rays;
        let new = if first == 0 {
            let black = vec![Rgb::BLACK; gatherers.len()];
            operator.solve(&black, &black, PILOT_TOLERANCE)
        } else {
            operator.apply(&self.indirect)
        };
        self.extend_known(elements, gatherers);
        if first == 0 && !self.known.contains(&true) {
            // No light at all: what is not closed in is dark.
            self.known = operator.open();
        }
        self.complete_standings(gatherers);
        self.indirect.extend(new);
        self.solved_nodes = self.subdivision.node_count() as u32;
    }

    /// Photometric values of the vertices in the open.
    fn in_the_open(&self, values: &[Rgb]) -> Vec<Option<f64>> {
        let is_open = |k: usize| self.standings[k] == Some(Standing::Open);
        (0..self.standings.len()).map(|k| is_open(k).then(|| values[k].luminance())).collect()
    }

    fn standings_after(
        &self,
        before: Vec<Option<Standing>>,
        gatherers: &[Gatherer],
    ) -> Vec<Option<Standing>> {
        trust::standings(self.scene, &self.subdivision, before, |k| gatherers[k].surface)
    }

    fn complete_standings(&mut self, gatherers: &[Gatherer]) {
        let mut before = std::mem::take(&mut self.standings);
        before.resize(gatherers.len(), None);
        self.standings = self.standings_after(before, gatherers);
        for (standing, known) in self.standings.iter_mut().zip(&self.known) {
            *standing = standing.filter(|_| *known);
        }
    }

    fn sight<'a>(&'a self, elements: &'a Elements, gatherers: &'a [Gatherer]) -> Sight<'a> {
        let (scene, lighting, key) = (self.scene, self.lighting, self.key.with(3));
        Sight { scene, lighting, elements, gatherers, key }
    }

    fn extend_known(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let mut known = std::mem::take(&mut self.known);
        self.sight(elements, gatherers).extend_known(&self.direct, &mut known);
        self.known = known;
    }

    /// Bisects until elements are good enough for what they are read for, or that comes to nothing.
    fn refine(
        &mut self,
        mut look: Look,
        request: &PilotRequest,
        (what, max_vertices): (Read, usize),
        go_on: &mut dyn FnMut(usize, u64) -> bool,
    ) -> Look {
        let mut before = (f64::INFINITY, look.vertices as f64);
        for _ in 0..MAX_ROUNDS {
            let Some((errors, excess)) = look.excess(what, request) else { break };
            // Where bisection no longer helps, what is left is noise: the check points will tell.
            let vertices = look.vertices as f64;
            let stalled = excess > before.0 * libm::pow(before.1 / vertices, LEAST_ORDER);
            if stalled || !go_on(self.subdivision.vertex_count(), self.traced) {
                break;
            }
            before = (excess, vertices);
            let least_edge_m = self.least_edge_m;
            let how_far = Refinement { wanted: 1.0 / excess, least_edge_m, max_vertices };
            if !refine_worst(&mut self.subdivision, &errors, how_far) {
                break;
            }
            look = self.look();
        }
        look
    }

    /// Bisects elements with hidden vertices where light comes to places that see none of the
    /// others; returns whether there are any.
    fn open_up(&mut self, elements: &Elements, max_vertices: usize) -> bool {
        let gatherers = self.gatherers();
        let sight = self.sight(elements, &gatherers);
        let is_cut_off = |&node: &u32| {
            let sequence = Sequence::new(self.key.with(4).with(u64::from(node)));
            (0..PLACES_OF_HIDDEN).any(|k| {
                let square = Dice::new(sequence, k).pair();
                let place = SurfacePoint::in_node(self.scene, &self.subdivision, node, square);
                sight.is_cut_off(&place, u64::from(node * PLACES_OF_HIDDEN + k), &self.known)
            })
        };
        let hidden: Vec<u32> = self.subdivision.leaves().filter(|&n| self.has_hidden(n)).collect();
        let cut_off: Vec<u32> = hidden.into_par_iter().filter(is_cut_off).collect();
        let rims: Vec<u32> = self.subdivision.leaves().filter(|&n| self.has_only_rim(n)).collect();
        for &node in &cut_off {
            if self.subdivision.vertex_count() < max_vertices {
                bisect_twice(&mut self.subdivision, node);
            }
        }
        for &node in &rims {
            if self.subdivision.vertex_count() < max_vertices {
                self.subdivision.bisect(node);
            }
        }
        !(cut_off.is_empty() && rims.is_empty())
    }

    /// Whether an element can be bisected and lies in a gap without a vertex inside: what comes in at the
    /// rim does not reach far.
    fn has_only_rim(&self, node: u32) -> bool {
        let corners = self.subdivision.node(node).0.vertices;
        self.subdivision.longest_edge_m(node) > 2.0 * self.least_edge_m
            && corners.iter().all(|&v| self.standings[v as usize] == Some(Standing::Rim))
    }

    /// Whether an element can be bisected and has a hidden vertex.
    fn has_hidden(&self, node: u32) -> bool {
        let corners = self.subdivision.node(node).0.vertices;
        self.subdivision.longest_edge_m(node) > 2.0 * self.least_edge_m
            && corners.iter().any(|&v| !self.known[v as usize])
    }

    /// Refines further for direct light as interpolated, and puts the plan together.
    fn finish(
        mut self,
        look: Look,
        request: &PilotRequest,
        go_on: &mut dyn FnMut(usize, u64) -> bool,
    ) -> Plan<'s> {
        let indirect_vertices = self.subdivision.vertex_count();
        let trusted_up_to_lx = look.trusted_up_to_lx(request);
        let coarse = self.subdivision.clone();
        let elements = self.refine_for_direct_light(look.elements, look.rms_lx, request, go_on);
        // Once more for all: refinement has moved the receivers on borders.
        let gatherers = self.gatherers();
        self.measure_direct(&gatherers, request, look.rms_lx);
        self.complete_standings(&gatherers);
        let mut standings = std::mem::take(&mut self.standings);
        forget_orphans(&elements, indirect_vertices, &mut standings);
        let open: Vec<bool> = standings.iter().map(|&of| of == Some(Standing::Open)).collect();
        Plan {
            scene: self.scene,
            lighting: self.lighting,
            elements,
            gatherers,
            indirect_vertices,
            level: coarse.node_count() as u32,
            direct: self.direct,
            direct_variance: self.direct_variance,
            guess: self.indirect,
            trusted_up_to_lx,
            indirect_errors: look.errors,
            rms_lx: look.rms_lx,
            fit: Fit::new(&coarse.elements(), indirect_vertices, &open),
            standings,
            subdivision: coarse,
            rays: self.traced,
        }
    }

    /// Refines where direct light as interpolated errs, until it is as good as asked.
    fn refine_for_direct_light(
        &mut self,
        mut elements: Elements,
        rms_lx: f64,
        request: &PilotRequest,
        go_on: &mut dyn FnMut(usize, u64) -> bool,
    ) -> Elements {
        // Best effort: sharp shadow borders would take elements without end, and of emitting surfaces
        // refinement cannot tell noise from borders.
        let most = MOST_FOR_DIRECT_LIGHT * self.subdivision.vertex_count();
        let most = most.max(ALWAYS_FOR_DIRECT_LIGHT);
        let how_far = Refinement {
            wanted: 0.0,
            least_edge_m: self.least_edge_m,
            max_vertices: most.min(request.max_vertices),
        };
        for _ in 0..MAX_ROUNDS {
            let signal = self.direct_signal(&elements);
            let errors = leaf_errors(&self.subdivision, &elements, &signal, |_| None, |_| false);
            let error_lx = trust::error_of(&errors, |_| true);
            let good = error_lx <= request.mesh_target * rms_lx;
            if good || !go_on(self.subdivision.vertex_count(), self.traced) {
                break;
            }
            if !refine_worst(&mut self.subdivision, &errors, how_far) {
                break;
            }
            elements = self.subdivision.elements();
            let gatherers = self.gatherers();
            self.complete_direct(&gatherers);
            self.extend_known(&elements, &gatherers);
            self.complete_standings(&gatherers);
        }
        elements
    }
}

/// Of vertices added for direct light nothing is known where both ends of their edge are hidden:
/// their indirect light is interpolated from there.
fn forget_orphans(elements: &Elements, first: usize, standings: &mut [Option<Standing>]) {
    for (k, vertex) in elements.vertices().iter().enumerate().skip(first) {
        let ends = vertex.parents.unwrap_or([k as u32; 2]);
        if ends.iter().all(|&end| standings[end as usize].is_none()) {
            standings[k] = None;
        }
    }
}

/// Root mean square over the known surface.
fn rms(elements: &Elements, standings: &[Option<Standing>], value: impl Fn(usize) -> f64) -> f64 {
    let (mut area, mut sum) = (0.0, 0.0);
    for (k, vertex) in
        elements.vertices().iter().enumerate().filter(|&(k, _)| standings[k].is_some())
    {
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
