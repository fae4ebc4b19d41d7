//! The pilot: a deterministic first look that fixes the elements before increments are counted.
//!
//! Coarse to fine: solve, see where the details are, bisect there, until the interpolation error is
//! a fixed part of the accuracy asked for. All receivers use the same random numbers here, so that
//! noise is smooth over surfaces and does not pass for detail.

use super::carriers::Carriers;
use super::detail::{Details, Refinement, bisect_twice, refine_worst};
use super::direct::{Goal, Lighting, Measured};
use super::fit::Fit;
use super::gather::{DirectAtEnds, Gatherer, Gathering};
use super::hidden::Sight;
pub(super) use super::look::PilotRequest;
use super::look::{Look, Read};
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
/// How far apart the coarsest vertices that carry light may be, in edges of the first mesh: four of them, to
/// start with two, as the details of those in between tell more than vertices twice as dense alone.
const COARSEST: f64 = 4.0;
/// Rounds of refinement at most.
const MAX_ROUNDS: usize = 16;
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
    /// Which of them carry indirect light; how far apart the coarsest may be, m; which have gathered it.
    carriers: Carriers,
    spacing_m: f64,
    gathered: Vec<bool>,
    /// By carrier, from which distance to others on something stands nearer before it than they.
    beset_from_m: HashMap<u32, f64>,
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

/// Looks and refines; `go_on` is asked after every round.
pub(super) fn pilot<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    go_on: &mut dyn FnMut(usize, u64) -> bool,
) -> Plan<'s> {
    let mut pilot = Pilot::new(scene, lighting, request);
    let mut look = pilot.look();
    let most = request
        .max_vertices
        .min(MOST_FOR_INDIRECT_LIGHT.max(look.elements.vertices().len() / 2 * 3));
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
            carriers: Carriers::all(),
            spacing_m: if request.is_fitted { COARSEST * edge_m } else { 0.0 },
            gathered: Vec::new(),
            beset_from_m: HashMap::new(),
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
        let details = self.details(&elements, &luminances);
        let errors = details.leaf_errors(middle, beset);
        let rms_lx = rms(&elements, &self.standings, lx);
        let left_by_fit = details.left_by_fit(&errors);
        let carriers = self.carriers.count(gatherers.len());
        Look { carriers, elements, errors, left_by_fit, rms_lx }
    }

    fn details<'a>(&'a self, elements: &'a Elements, values: &'a [Option<f64>]) -> Details<'a> {
        let is_beset = |vertex: u32, spacing_m: f64| self.beset_from_m[&vertex] < spacing_m;
        Details::of(&self.subdivision, elements, values, &self.carriers, is_beset)
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

    /// The same for carriers that others are interpolated from.
    fn complete_beset_carriers(&mut self, gatherers: &[Gatherer]) {
        let is_new = |vertex: &u32| !self.beset_from_m.contains_key(vertex);
        let new: Vec<u32> = self.carriers.parents().into_iter().filter(is_new).collect();
        let beset_from_m = |&vertex: &u32| {
            let place = &gatherers[vertex as usize].surface;
            (vertex, trust::beset_from_m(self.scene, place, self.spacing_m))
        };
        let new: Vec<(u32, f64)> = new.par_iter().map(beset_from_m).collect();
        self.beset_from_m.extend(new);
    }

    /// Gathers in the middle of the elements that no details tell of, that have something close before
    /// them and that were not looked at yet; not in gaps, where readers gather anyway.
    fn complete_middles(&mut self, elements: &Elements, values: &[Option<f64>]) {
        let details = self.details(elements, values);
        let is_new =
            |&node: &u32| !self.middles.contains_key(&node) && details.told_error(node).is_none();
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
        let is_first = self.indirect.is_empty();
        // On the first mesh nobody knows yet what stands close.
        if is_first {
            self.extend_known(elements, gatherers);
            self.complete_standings(gatherers);
            let open: Vec<bool> =
                self.standings.iter().map(|&of| of == Some(Standing::Open)).collect();
            if self.spacing_m > 0.0 {
                self.carriers = Carriers::sparse(&self.subdivision, self.spacing_m, &open);
            }
        }
        self.gathered.resize(gatherers.len(), false);
        let vertices = 0..gatherers.len() as u32;
        let is_new =
            |&v: &u32| is_first || self.carriers.is_active(v) && !self.gathered[v as usize];
        let new: Vec<u32> = vertices.filter(is_new).collect();
        let level = if is_first { u32::MAX } else { self.solved_nodes };
        let gathering = self.gathering(elements, level, &self.standings);
        let key = self.key.with(2);
        let edges_m = self.subdivision.longest_edges_m();
        let row = |&vertex: &u32| {
            let gatherer = &gatherers[vertex as usize];
            let edge_m = edges_m[vertex as usize];
            let rays = if self.carriers.is_active(vertex) { self.rays } else { 0 };
            let in_gap = trust::is_closed_in(self.scene, &gatherer.surface, edge_m);
            gatherer.with_rays(rays).in_gap(in_gap)
        };
        let rows: Vec<Gatherer> = new.par_iter().map(row).collect();
        let operator = gathering.operator(&rows, |_| key);
        self.traced += operator.rays;
        self.indirect.resize(gatherers.len(), Rgb::BLACK);
        if is_first {
            let black = vec![Rgb::BLACK; gatherers.len()];
            self.indirect = operator.solve(&black, &black, &self.carriers, PILOT_TOLERANCE);
            if !self.known.contains(&true) {
                // No light at all: what is not closed in is dark.
                self.known = operator.open();
            }
        } else {
            self.extend_known(elements, gatherers);
            let light = operator.apply(&self.indirect);
            new.iter().zip(light).for_each(|(&v, light)| self.indirect[v as usize] = light);
            self.carriers.fill(&mut self.indirect);
        }
        self.complete_standings(gatherers);
        new.iter().for_each(|&v| self.gathered[v as usize] = self.carriers.is_active(v));
        self.complete_beset_carriers(gatherers);
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
        let mut before = (f64::INFINITY, look.carriers as f64);
        for _ in 0..MAX_ROUNDS {
            let Some((errors, excess)) = look.excess(what, request) else { break };
            // Where bisection no longer helps, what is left is noise: the check points will tell.
            let carriers = look.carriers as f64;
            let stalled = excess > before.0 * libm::pow(before.1 / carriers, LEAST_ORDER);
            if stalled || !go_on(self.subdivision.vertex_count(), self.traced) {
                break;
            }
            before = (excess, carriers);
            let least_edge_m = self.least_edge_m;
            let how_far = Refinement { wanted: 1.0 / excess, least_edge_m, max_vertices };
            if !refine_worst(&mut self.subdivision, &mut self.carriers, &errors, how_far) {
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
            carriers: self.carriers,
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
        // All vertices have direct light of their own.
        let mut carriers = Carriers::all();
        for _ in 0..MAX_ROUNDS {
            let signal = self.direct_signal(&elements);
            let no = |_, _| false;
            let details = Details::of(&self.subdivision, &elements, &signal, &carriers, no);
            let errors = details.leaf_errors(|_| None, |_| false);
            let error_lx = trust::error_of(&errors, |_| true);
            let good = error_lx <= request.mesh_target * rms_lx;
            if good || !go_on(self.subdivision.vertex_count(), self.traced) {
                break;
            }
            if !refine_worst(&mut self.subdivision, &mut carriers, &errors, how_far) {
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
