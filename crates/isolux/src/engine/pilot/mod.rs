//! The pilot: a deterministic first look that fixes the elements before increments are counted.
//!
//! Coarse to fine: solve, see where the details are, bisect there, until the interpolation error is
//! a fixed part of the accuracy asked for. All receivers use the same random numbers here, so that
//! noise is smooth over surfaces and does not pass for detail.

mod bare;
mod batches;
mod caustics;
mod direct;
mod finish;
mod forecast;
mod indirect;
mod landing;
mod look;
mod middles;
mod opening;
mod round;
mod sharing;
mod smoothing;
mod standings;
mod surroundings;
mod walls;

use crate::ablation::without;
use crate::elements::{Elements, FewNumbers, Subdivision, TOGETHER};
use crate::engine::gather::Trial;
use crate::engine::gather::{Backdrop, Bright, DirectAtEnds, Gatherer, Gathering, Sight, Unlit};
use crate::engine::judge::Light;
use crate::engine::light::Lighting;
use crate::engine::mesh::{Carriers, Details, Refinement, refine_worst};
use crate::engine::mesh::{Walls, Worst, bisect_to_scale};
use crate::engine::occlusion::{Felt, Torn, nearby};
use crate::engine::particle::{Aim, CausticNoise};
use crate::engine::plan::Plan;
use crate::engine::ray::SurfacePoint;
use crate::map::Standing;
use crate::sampling::Key;
use crate::scene::Scene;
use crate::units::Rgb;
use forecast::LONGER;
#[cfg(test)]
pub(super) use forecast::Outlook;
pub(super) use forecast::{Costs, GoOn, Left, Round};
use isolux_geometry::Point;
pub(super) use look::{Look, PilotRequest};
use look::{Read, Surroundings};
use rayon::prelude::*;
use std::collections::HashMap;
use std::mem;
use std::sync::Arc;
use std::time::Instant;

/// Vertices that the pilot starts with, unless the scene has more.
const FIRST_VERTICES: f64 = 700.0;
/// And for each that the scene has: among many things light varies on walls, too, in ways that a
/// coarse look does not find.
const MORE_A_VERTEX: f64 = 0.05;
/// The part of them that tells whether light is so smooth that no more are needed to start with.
const COARSE: f64 = 0.5;
/// The first again where nothing is fitted: particles, whose hat functions blur what they are deposited in.
const FIRST_UNFITTED: f64 = 1500.0;
/// The part of the first gathering, and before it of the first direct light, that tells how long all takes.
const FIRST_PART: usize = 16;
/// How far apart the coarsest vertices that carry light may be, in edges of the first mesh: four of them, to
/// start with two, as the details of those in between tell more than vertices twice as dense alone.
const COARSEST: f64 = 4.0;
/// Rounds of refinement at most.
const MAX_ROUNDS: usize = 16;
/// Elements are not bisected below this share of the scene's extent: a centimetre in a room.
const LEAST_EDGE_SHARE: f64 = 1e-3;
/// Receivers on borders are pulled in by this share of the way to the middle of their element.
const PULL_IN: f64 = 2e-3;
/// A round in which the error falls with a lower power of the vertices was in vain. Where functions
/// are smooth it is one; chasing light that comes in through narrow places, less for some rounds.
const LEAST_ORDER: f64 = 0.25;
/// So often may the error rise instead.
const MOST_RISEN: usize = 3;
/// So many rounds in a row may be in vain: at borders of gaps as much error is found as is taken off, until elements are as narrow.
const MOST_STALLS: usize = 1;
/// Vertices for indirect light, unless the scene has nearly as many from the start.
const MOST_FOR_INDIRECT_LIGHT: usize = 40_000;
/// More than this part of the vertices there may be are all: the worst elements are bisected some at a time.
const FULL: f64 = 0.95;
/// Bisections of elements with hidden vertices.
const ROUNDS_FOR_HIDDEN: usize = 4;
/// The part of the mesh accuracy asked for that noise of direct light may take, where it is not exact.
const NOISE_OF_DIRECT_LIGHT: f64 = 0.25;
/// Something that stands closer before a vertex than this part of an element takes light from it that the rest of the element
/// has: pictures on walls, shelves.
const HEM: f64 = 0.125;
/// Sweeps of the pilot end when they change less than this.
const PILOT_TOLERANCE: f64 = 1e-4;

struct Pilot<'s> {
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    key: Key,
    subdivision: Subdivision,
    /// At the vertices looked at so far: light, and whether they are open to it.
    direct: Vec<Rgb>,
    /// What is bright by that of luminaires.
    bright: Option<Arc<Bright>>,
    direct_variance: Vec<f64>,
    /// Where it was measured.
    measured_at: Vec<Point>,
    /// How noisy it may be where it is measured once by part of the luminaires: of all light, and in lx.
    direct_noise: Option<f64>,
    direct_noise_lx: Option<f64>,
    /// By how much direct light as interpolated errs more than it should, with so many vertices.
    direct_excess: Option<(usize, f64)>,
    /// Vertices that the last round of refinement for it has added.
    added_for_direct: usize,
    indirect: Vec<Rgb>,
    surroundings: Surroundings,
    known: Vec<bool>,
    unlit: Unlit,
    /// Where some particles came over specular surfaces.
    reached: Vec<SurfacePoint>,
    /// What they stand for.
    standings: Vec<Option<Standing>>,
    felt: Felt,
    torn: Torn,
    /// Which of them carry indirect light; how far apart the coarsest may be, m; which have gathered it.
    carriers: Carriers,
    spacing_m: f64,
    /// Edges of the usual first mesh, where it starts with a coarser one.
    usual_edge_m: Option<f64>,
    has_many_things: bool,
    gathered: Vec<bool>,
    /// By carrier, from which distance to others on something stands nearer before it than they.
    beset_from_m: HashMap<u32, f64, FewNumbers>,
    /// By vertex, how close something stands before it, m, if that is less than a part of its elements.
    hemmed_in_m: Vec<f64>,
    /// By node, whether something stands close before its middle.
    beset: Vec<bool>,
    /// In the middle of elements that no details tell of, by node; nothing where that is not asked for.
    middles: HashMap<u32, Option<f64>>,
    /// Whether there were some in gaps that luminaires shine into, at the last look.
    sees_lit_gaps: bool,
    /// Nodes there were then.
    solved_nodes: u32,
    /// Rays that a vertex gathers with, alike all over a surface, so that their noise is.
    rays: Vec<u32>,
    traced: u64,
    least_edge_m: f64,
    costs: Costs,
    /// Whether light has quadratic functions between carriers already.
    is_smoothed: bool,
    /// Vertices that indirect light is interpolated from, and the surface that each stands for, m2, once they are fixed.
    for_indirect_light: Option<(usize, Vec<f64>)>,
    /// Indirect light of the bare map, where that is not resolved.
    bare: Option<Bare>,
    /// Whether direct light is what it will be.
    is_measured: bool,
    /// Walls that rays are judged by, once there is light.
    backdrop: Option<Backdrop>,
    /// What vertices get from them, by vertex, and where it was.
    behind: HashMap<u32, (Point, Option<Rgb>)>,
    /// What a few receivers tell of noise, once there is light: first, where there are walls, those that tell what these take off.
    trial: Option<Trial>,
    caustic_noise: CausticNoise,
    aim: Option<Aim>,
    /// Whether there was time for all that it wanted to do.
    is_whole: bool,
    /// Vertices that indirect light may have; no limit until that is known.
    most_for_indirect_light: f64,
    /// Whether there are about as many vertices for indirect light as there may be.
    is_full: bool,
}

/// What the vertices for direct light have gathered for the bare map.
struct Bare {
    /// The first of them, and the light of all from there on.
    first: usize,
    indirect: Vec<Rgb>,
    /// Elements that something stands close before, on which they gather.
    beset: Vec<u32>,
}

/// Looks and refines; `go_on` is asked after every round. Adds to what earlier pilots of the run have found unlit.
pub(super) fn pilot<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    unlit: &mut Unlit,
    go_on: &mut GoOn<'_>,
) -> Plan<'s> {
    let mut pilot = Pilot { unlit: mem::take(unlit), ..Pilot::new(scene, lighting, request) };
    let look = pilot.elements_for_indirect_light(request, go_on);
    *unlit = mem::take(&mut pilot.unlit);
    pilot.finish(look, request, go_on)
}

/// What a pilot would find, without the whole of its work.
pub(super) fn foresee<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    go_on: &mut GoOn<'_>,
) {
    Pilot::new(scene, lighting, request).elements_for_indirect_light(request, go_on);
}

/// The elements to start with, the edges of the usual ones, m, and whether the scene has so many things that most vertices are theirs.
fn first_mesh(scene: &Scene, request: &PilotRequest) -> (Subdivision, f64, bool) {
    let mut subdivision = Subdivision::new(scene);
    let area_m2: f64 = subdivision.leaves().map(|n| subdivision.triangle(n).area()).sum();
    // Half squares of hypotenuse h have area h^2 / 4, and there are two a vertex.
    let first = if request.is_fitted { FIRST_VERTICES } else { FIRST_UNFITTED };
    let more = MORE_A_VERTEX * subdivision.vertex_count() as f64;
    let edge_m = (2.0 * area_m2 / (first + more)).sqrt();
    let start_m =
        if request.has_means && !without("coarse-start") { edge_m / COARSE.sqrt() } else { edge_m };
    subdivision.bisect_to(start_m, request.max_vertices);
    if request.is_fitted && !without("room-scale") {
        bisect_to_scale(scene, &mut subdivision, request.max_vertices);
    }
    (subdivision, edge_m, more > first)
}

impl<'s> Pilot<'s> {
    fn new(scene: &'s Scene, lighting: &'s Lighting<'s>, request: &PilotRequest) -> Self {
        let (subdivision, edge_m, has_many_things) = first_mesh(scene, request);
        let rays = Self::shared_rays(&subdivision, request.target);
        let has_noise = request.is_fitted && lighting.has_many() && lighting.is_measured_once();
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        let key = Key::new(request.seed).with(0);
        let (bright, traced) = Bright::of(scene, lighting, request.seed);
        Self {
            scene,
            lighting,
            key,
            subdivision,
            direct: Vec::new(),
            bright,
            direct_variance: Vec::new(),
            measured_at: Vec::new(),
            direct_noise: has_noise.then_some(NOISE_OF_DIRECT_LIGHT * request.mesh_target),
            direct_noise_lx: None,
            direct_excess: None,
            added_for_direct: 0,
            indirect: Vec::new(),
            surroundings: Surroundings::default(),
            known: Vec::new(),
            unlit: Unlit::default(),
            reached: Vec::new(),
            standings: Vec::new(),
            felt: Felt::default(),
            torn: Torn::default(),
            carriers: Carriers::all(),
            usual_edge_m: (request.has_means && !without("coarse-start")).then_some(edge_m),
            has_many_things,
            spacing_m: if request.is_fitted { COARSEST * edge_m } else { 0.0 },
            gathered: Vec::new(),
            beset_from_m: HashMap::default(),
            hemmed_in_m: Vec::new(),
            beset: Vec::new(),
            middles: HashMap::new(),
            sees_lit_gaps: false,
            solved_nodes: 0,
            rays,
            traced,
            costs: Costs::default(),
            is_smoothed: false,
            for_indirect_light: None,
            bare: None,
            is_measured: false,
            trial: None,
            backdrop: None,
            behind: HashMap::new(),
            caustic_noise: CausticNoise::default(),
            aim: None,
            is_whole: true,
            most_for_indirect_light: f64::INFINITY,
            is_full: false,
            least_edge_m: request.least_edge_m.unwrap_or(LEAST_EDGE_SHARE * extent_m),
        }
    }

    /// Elements that are fine enough for indirect light, or as fine as there is time for.
    fn elements_for_indirect_light(
        &mut self,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Look {
        let mut look = self.look(request, go_on);
        if let Some(edge_m) = self.usual_edge_m.filter(|_| !look.is_smooth(request)) {
            self.subdivision.bisect_to(edge_m, request.max_vertices);
            look = self.look(request, go_on);
        }
        let most = request.most_for_indirect_light.unwrap_or(MOST_FOR_INDIRECT_LIGHT);
        let most = most.max(look.elements.vertices().len() / 2 * 3);
        let most = request.max_vertices.min(most);
        self.most_for_indirect_light = most as f64;
        self.try_some(&look, request.target);
        let excess = |look: &Look| (Some(look.greatest_excess(request)), None);
        let mut has_time = self.has_time(&look, request, excess(&look), go_on);
        for _ in 0..ROUNDS_FOR_HIDDEN {
            if !(has_time && self.open_up(&look.elements, most)) {
                break;
            }
            look = self.look(request, go_on);
            has_time = self.has_time(&look, request, excess(&look), go_on);
        }
        // Readers gather over gathered maps alone: particles blur what is close by.
        let reads = if request.is_fitted { &Read::EVERY[..] } else { &[Read::All] };
        for &what in reads {
            look = self.refine(look, request, (what, most), go_on);
        }
        self.is_full = look.elements.vertices().len() as f64 > FULL * most as f64;
        look
    }

    fn gatherers(&self) -> Vec<Gatherer> {
        let receivers = self.subdivision.receivers(PULL_IN);
        let with = receivers.par_iter().zip(&self.rays).with_min_len(TOGETHER);
        with.map(|(receiver, &rays)| Gatherer::at_vertex(self.scene, receiver, rays)).collect()
    }

    /// Solves on the first mesh; later, gathers at the new vertices over what is known already.
    fn look(&mut self, request: &PilotRequest, go_on: &mut GoOn<'_>) -> Look {
        let mut elements = self.subdivision.elements();
        let is_first = self.indirect.is_empty();
        self.complete_rays();
        let mut gatherers = self.gatherers();
        if is_first {
            self.begin(&elements, &gatherers, request, go_on);
        }
        let started = Instant::now();
        self.complete_beset();
        self.costs.looks.add(started.elapsed(), 0.0);
        self.complete_direct(&elements, &gatherers);
        if is_first && self.resolve_what_lands((&mut elements, &mut gatherers), request) {
            self.complete_beset();
        }
        self.complete_indirect(&elements, &gatherers, request, go_on);
        let started = Instant::now();
        let luminances = self.in_the_open(&self.indirect);
        self.complete_hemmed(&gatherers);
        if !without("midpoints") {
            self.complete_middles(&elements, &luminances);
        }
        let lx = |k: usize| (self.direct[k] + self.indirect[k]).luminance();
        let middle = |node: u32| self.middles.get(&node).copied().flatten();
        let beset = |node: u32| self.beset[node as usize];
        let details = self.details(&elements, &luminances);
        let hemmed = |vertex: u32, edge_m: f64| {
            self.hemmed_in_m[vertex as usize] < HEM * edge_m && !without("hemmed-errors")
        };
        let mut errors = details.leaf_errors(middle, beset, hemmed);
        let reference_lx = Light::of_vertices(&elements, &self.standings, lx).reference_lx();
        for error in &mut errors {
            error.error = error.error.max(self.error_in_lit_gap_lx(error.node, reference_lx));
        }
        let left_by_fit = details.left_by_fit(&errors);
        self.weigh(&mut errors);
        let carriers = self.carriers.count(gatherers.len());
        let longer = if is_first { LONGER } else { 1.0 };
        self.costs.looks.add(started.elapsed().div_f64(longer), gatherers.len() as f64);
        if is_first {
            self.costs.first.add(started.elapsed(), 0.0);
        }
        let worst = Worst::of(&errors);
        let walls = Walls::default();
        let mut look = Look {
            carriers,
            elements,
            errors,
            walls,
            worst,
            left_by_fit,
            reference_lx,
            dim_m2: self.surroundings.dim_m2,
            is_noisy: self.direct_noise.is_some(),
        };
        if look.is_smooth(request) && !without("edge-falloff") {
            self.look_for_walls(&mut look, request, &luminances);
        }
        look
    }

    /// Finds the walls that surfaces end at, and what elements err by once light is resolved towards them.
    fn look_for_walls(&self, look: &mut Look, request: &PilotRequest, luminances: &[Option<f64>]) {
        let open: Vec<bool> = luminances.iter().map(Option::is_some).collect();
        let walls = Walls::of(self.scene, &self.subdivision, &open);
        look.resolve(walls, &self.subdivision, luminances, request.target * look.reference_lx);
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
        Gathering {
            scene: self.scene,
            lighting: self.lighting,
            elements,
            level,
            standings,
            direct,
            regathers: false,
            bright: self.bright.as_deref(),
            cuts: None,
            backdrop: self.backdrop.as_ref(),
        }
    }

    /// Whether something stands close before the nodes that were not looked at yet.
    fn complete_beset(&mut self) {
        let new = self.beset.len() as u32..self.subdivision.node_count() as u32;
        let is_beset = |node: u32| {
            let place = SurfacePoint::amid_node(self.scene, &self.subdivision, node);
            nearby::is_beset(self.scene, &place, self.subdivision.longest_edge_m(node))
        };
        let new: Vec<bool> = new.into_par_iter().map(is_beset).collect();
        self.beset.extend(new);
    }

    /// How close something stands before the vertices that were not looked at yet, but before those on borders: there walls do.
    fn complete_hemmed(&mut self, gatherers: &[Gatherer]) {
        let on_border = self.subdivision.border_vertices();
        let edges_m = self.subdivision.longest_edges_m();
        let stands_in_m = |vertex: usize| {
            if on_border[vertex] {
                return f64::INFINITY;
            }
            nearby::hemmed_in_m(self.scene, &gatherers[vertex].surface, HEM * edges_m[vertex])
        };
        let new: Vec<f64> =
            (self.hemmed_in_m.len()..gatherers.len()).into_par_iter().map(stands_in_m).collect();
        self.hemmed_in_m.extend(new);
    }

    /// The same for carriers that others are interpolated from.
    fn complete_beset_carriers(&mut self, gatherers: &[Gatherer]) {
        let is_new = |vertex: &u32| !self.beset_from_m.contains_key(vertex);
        let new: Vec<u32> = self.carriers.parents().into_iter().filter(is_new).collect();
        let beset_from_m = |&vertex: &u32| {
            let place = &gatherers[vertex as usize].surface;
            (vertex, nearby::beset_from_m(self.scene, place, self.spacing_m))
        };
        let new: Vec<(u32, f64)> = new.par_iter().map(beset_from_m).collect();
        self.beset_from_m.extend(new);
    }

    fn sight<'a>(&'a self, elements: &'a Elements, gatherers: &'a [Gatherer]) -> Sight<'a> {
        let (scene, lighting, key) = (self.scene, self.lighting, self.key.with(3));
        let (reached, torn) = (&self.reached, &self.torn);
        Sight { scene, lighting, elements, gatherers, reached, torn, key }
    }

    fn extend_known(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        self.look_for_torn();
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
        go_on: &mut GoOn<'_>,
    ) -> Look {
        let mut before = (f64::INFINITY, look.carriers as f64);
        let (mut risen, mut stalls) = (0, 0);
        for _ in 0..MAX_ROUNDS {
            let Some((errors, excess)) = look.excess(what, request) else { break };
            // Where bisection no longer helps, what is left is noise: the check points will tell. As long as it finds light
            // in gaps, errors may rise.
            let carriers = look.carriers as f64;
            let has_risen = self.sees_lit_gaps && excess > before.0;
            risen += usize::from(has_risen);
            let is_excused = has_risen && risen <= MOST_RISEN;
            let fallen = libm::pow(before.1 / carriers, LEAST_ORDER);
            let stalled = !is_excused && excess > before.0 * fallen;
            let known = Some(before).filter(|(excess, _)| excess.is_finite());
            let excesses = (Some(look.greatest_excess(request)), known);
            stalls = if stalled { stalls + 1 } else { 0 };
            if stalls > MOST_STALLS || !self.has_time(&look, request, excesses, go_on) {
                break;
            }
            before = (excess, carriers);
            let least_edge_m = self.least_edge_m;
            let how_far = Refinement { wanted: 1.0 / excess, least_edge_m, max_vertices };
            if !refine_worst(&mut self.subdivision, &mut self.carriers, &errors, how_far) {
                break;
            }
            look = self.look(request, go_on);
        }
        look
    }
}
