//! What the pilot knows: elements, light at their vertices, what stands near them.

use super::forecast::Costs;
use super::look::{PilotRequest, Surroundings};
use crate::ablation::without;
use crate::elements::{Elements, FewNumbers, Subdivision, TOGETHER};
use crate::engine::gather::{
    BrightSurfaces, ControlVariate, DirectAtEnds, Gatherer, Gathering, RayTrial, Sight, Unlit,
    allot,
};
use crate::engine::light::Lighting;
use crate::engine::mesh::{Carriers, Details, bisect_to_scale};
use crate::engine::occlusion::{ClosedIn, Footprints};
use crate::engine::particle::{Aim, CausticNoise};
use crate::engine::ray::SurfacePoint;
use crate::map::Standing;
use crate::sampling::Key;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Point;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

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
pub(super) const FIRST_PART: usize = 16;
/// How far apart the coarsest vertices that carry light may be, in edges of the first mesh: four of them, to
/// start with two, as the details of those in between tell more than vertices twice as dense alone.
const COARSEST: f64 = 4.0;
/// Rounds of refinement at most.
pub(super) const MAX_ROUNDS: usize = 16;
/// Elements are not bisected below this share of the scene's extent: a centimetre in a room.
const LEAST_EDGE_SHARE: f64 = 1e-3;
/// Receivers on borders are pulled in by this share of the way to the middle of their element.
const PULL_IN: f64 = 2e-3;
/// A round in which the error falls with a lower power of the vertices was in vain. Where functions
/// are smooth it is one; chasing light that comes in through narrow places, less for some rounds.
pub(super) const LEAST_ORDER: f64 = 0.25;
/// So many rounds in a row may be in vain: at borders of gaps as much error is found as is taken off, until elements are as narrow.
pub(super) const MOST_STALLS: usize = 1;
/// The part of the mesh accuracy asked for that noise of direct light may take, where it is not exact.
const NOISE_OF_DIRECT_LIGHT: f64 = 0.25;
/// Something that stands closer before a vertex than this part of an element takes light from it that the rest of the element
/// has: pictures on walls, shelves.
pub(super) const HEM: f64 = 0.125;
/// Sweeps of the pilot end when they change less than this.
pub(super) const PILOT_TOLERANCE: f64 = 1e-4;

/// The pilot: what it works on, what it knows so far, and what that has cost.
pub(super) struct Pilot<'s> {
    pub(super) scene: &'s Scene,
    pub(super) lighting: &'s Lighting<'s>,
    pub(super) key: Key,
    pub(super) mesh: Mesh,
    pub(super) near: Near,
    pub(super) direct: DirectLight,
    pub(super) indirect: IndirectLight,
    pub(super) walls: WallLight,
    /// Surfaces that direct light makes far brighter than all others.
    pub(super) bright: Option<Arc<BrightSurfaces>>,
    pub(super) tried: Tried,
    pub(super) costs: Costs,
    /// Rays traced so far.
    pub(super) traced: u64,
    /// Whether there was time for all that it wanted to do.
    pub(super) is_whole: bool,
}

/// The elements so far, and how fine they may become.
pub(super) struct Mesh {
    pub(super) subdivision: Subdivision,
    /// The vertices that carry indirect light.
    pub(super) carriers: Carriers,
    /// The greatest distance between the coarsest of them, m.
    pub(super) spacing_m: f64,
    /// Gathering rays of every vertex: the same number all over a surface, so that its noise is the same.
    pub(super) rays: Vec<u32>,
    /// The shortest edge that may be bisected, m.
    pub(super) least_edge_m: f64,
    /// Edges of the usual first mesh, m, where the pilot starts with a coarser one.
    pub(super) usual_edge_m: Option<f64>,
    /// Whether most vertices belong to things in the scene, not to its walls.
    pub(super) has_many_things: bool,
    /// Vertices that indirect light may have; no limit until that is known.
    pub(super) most_for_indirect_light: f64,
    /// Whether there are about as many vertices for indirect light as there may be.
    pub(super) is_full: bool,
    /// Vertices that indirect light is interpolated from, and the surface that each stands for, m2, once they are fixed.
    pub(super) for_indirect_light: Option<(usize, Vec<f64>)>,
}

/// What stands near vertices and elements.
#[derive(Default)]
pub(super) struct Near {
    /// By vertex, whether light can come to it.
    pub(super) known: Vec<bool>,
    /// By vertex, what it stands for.
    pub(super) standings: Vec<Option<Standing>>,
    /// Places of elements that are known to be unlit.
    pub(super) unlit: Unlit,
    /// Places that some particles have reached over specular surfaces.
    pub(super) reached: Vec<SurfacePoint>,
    pub(super) felt: ClosedIn,
    pub(super) footprints: Footprints,
    /// By carrier, the distance to other carriers from which on something stands nearer before it than they do.
    pub(super) beset_from_m: HashMap<u32, f64, FewNumbers>,
    /// By vertex, how close something stands before it, m, if that is less than a part of its elements.
    pub(super) hemmed_in_m: Vec<f64>,
    /// By node, whether something stands close before its middle.
    pub(super) beset: Vec<bool>,
}

/// Direct light at the vertices.
#[derive(Default)]
pub(super) struct DirectLight {
    pub(super) lx: Vec<Rgb>,
    pub(super) variance: Vec<f64>,
    /// Where it was measured.
    pub(super) measured_at: Vec<Point>,
    /// The noise it may have where it is measured once by part of the luminaires: of all light, and in lx.
    pub(super) noise: Option<f64>,
    pub(super) noise_lx: Option<f64>,
    /// By how much its interpolation errs more than it should, with so many vertices.
    pub(super) excess: Option<(usize, f64)>,
    /// Vertices that the last round of refinement for it has added.
    pub(super) added: usize,
    /// Whether it is what it will be.
    pub(super) is_measured: bool,
}

/// Indirect light at the vertices.
#[derive(Default)]
pub(super) struct IndirectLight {
    pub(super) lx: Vec<Rgb>,
    /// By vertex, whether it has gathered.
    pub(super) gathered: Vec<bool>,
    /// Nodes there were when it was last solved for.
    pub(super) solved_nodes: u32,
    /// In the middle of elements without details, by node, lx; nothing where that is not asked for.
    pub(super) middles: HashMap<u32, Option<f64>>,
    /// Whether some of these lay in gaps that luminaires shine into.
    pub(super) sees_lit_gaps: bool,
    /// Whether it has quadratic functions between carriers already.
    pub(super) is_smoothed: bool,
    pub(super) surroundings: Surroundings,
    /// Of the stored map, where elements do not resolve it.
    pub(super) bare: Option<Bare>,
}

/// Light of large plane walls: the control variate of gathering.
#[derive(Default)]
pub(super) struct WallLight {
    pub(super) backdrop: Option<ControlVariate>,
    /// By vertex, where it was and what it gets from them with nothing between.
    pub(super) behind: HashMap<u32, (Point, Option<Rgb>)>,
}

/// What trials with few rays and particles have told of noise.
#[derive(Default)]
pub(super) struct Tried {
    pub(super) trial: Option<RayTrial>,
    pub(super) caustic_noise: CausticNoise,
    pub(super) aim: Option<Aim>,
}

/// What the vertices for direct light have gathered for the bare map.
pub(super) struct Bare {
    /// The first of them, and the light of all from there on.
    pub(super) first: usize,
    pub(super) indirect: Vec<Rgb>,
    /// Elements that something stands close before, on which they gather.
    pub(super) beset: Vec<u32>,
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
    pub(super) fn new(
        scene: &'s Scene,
        lighting: &'s Lighting<'s>,
        request: &PilotRequest,
    ) -> Self {
        let (subdivision, edge_m, has_many_things) = first_mesh(scene, request);
        let rays = Self::shared_rays(&subdivision, request.target);
        let has_noise = request.is_fitted && lighting.has_many() && lighting.is_measured_once();
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        let key = Key::new(request.seed).with(0);
        let (bright, traced) = BrightSurfaces::of(scene, lighting, request.seed);
        let mesh = Mesh {
            subdivision,
            carriers: Carriers::all(),
            spacing_m: if request.is_fitted { COARSEST * edge_m } else { 0.0 },
            rays,
            least_edge_m: request.least_edge_m.unwrap_or(LEAST_EDGE_SHARE * extent_m),
            usual_edge_m: (request.has_means && !without("coarse-start")).then_some(edge_m),
            has_many_things,
            most_for_indirect_light: f64::INFINITY,
            is_full: false,
            for_indirect_light: None,
        };
        let noise = has_noise.then_some(NOISE_OF_DIRECT_LIGHT * request.mesh_target);
        Self {
            scene,
            lighting,
            key,
            mesh,
            near: Near::default(),
            direct: DirectLight { noise, ..DirectLight::default() },
            indirect: IndirectLight::default(),
            walls: WallLight::default(),
            bright,
            tried: Tried::default(),
            costs: Costs::default(),
            traced,
            is_whole: true,
        }
    }

    pub(super) fn gatherers(&self) -> Vec<Gatherer> {
        let receivers = self.mesh.subdivision.receivers(PULL_IN);
        let with = receivers.par_iter().zip(&self.mesh.rays).with_min_len(TOGETHER);
        with.map(|(receiver, &rays)| Gatherer::at_vertex(self.scene, receiver, rays)).collect()
    }

    pub(super) fn details<'a>(
        &'a self,
        elements: &'a Elements,
        values: &'a [Option<f64>],
    ) -> Details<'a> {
        let is_beset = |vertex: u32, spacing_m: f64| self.near.beset_from_m[&vertex] < spacing_m;
        Details::of(&self.mesh.subdivision, elements, values, &self.mesh.carriers, is_beset)
    }

    /// What rays read on a level of the elements.
    pub(super) fn gathering<'a>(
        &'a self,
        elements: &'a Elements,
        level: u32,
        standings: &'a [Option<Standing>],
    ) -> Gathering<'a> {
        let direct = if self.lighting.are_read_at_ends() {
            DirectAtEnds::Read { values: &self.direct.lx, level }
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
            backdrop: self.walls.backdrop.as_ref(),
        }
    }

    pub(super) fn sight<'a>(
        &'a self,
        elements: &'a Elements,
        gatherers: &'a [Gatherer],
    ) -> Sight<'a> {
        let (scene, lighting, key) = (self.scene, self.lighting, self.key.with(3));
        let (reached, footprints) = (&self.near.reached, &self.near.footprints);
        Sight { scene, lighting, elements, gatherers, reached, footprints, key }
    }

    /// New vertices gather as their parents do.
    pub(super) fn complete_rays(&mut self) {
        for vertex in &self.mesh.subdivision.vertices()[self.mesh.rays.len()..] {
            let [parent, _] =
                vertex.parents.expect("vertices beyond the first are made by bisection");
            self.mesh.rays.push(self.mesh.rays[parent as usize]);
        }
    }

    /// Rays of the vertices in the pilot: so many where a surface has no more vertices than others for its area, fewer where it
    /// has (see [`allot`]), a quarter of them at least.
    pub(super) fn shared_rays(subdivision: &Subdivision, target: f64) -> Vec<u32> {
        let usual = pilot_rays(target);
        let surfaces = subdivision.least_connected();
        let mut of_surface = vec![(0.0, 0.0); surfaces.len()];
        for leaf in subdivision.leaves() {
            let surface = surfaces[subdivision.node(leaf).0.vertices[0] as usize];
            of_surface[surface as usize].0 += subdivision.triangle(leaf).area();
        }
        surfaces.iter().for_each(|&surface| of_surface[surface as usize].1 += 1.0);
        let area_m2 = |&surface: &u32| {
            let (area_m2, vertices) = of_surface[surface as usize];
            area_m2 / vertices
        };
        let areas_m2: Vec<f64> = surfaces.iter().map(area_m2).collect();
        let allotted = allot(&areas_m2, f64::from(usual));
        allotted
            .into_iter()
            .map(|rays| if rays == 0 { usual } else { rays.clamp(usual / 4, usual) })
            .collect()
    }
}

/// Rays of a receiver in the pilot: more for finer accuracies, so that their noise stays below the
/// details looked for. The power of two nearest to what was measured on CUBE: with half as many, elements are made
/// anew for 0.3 %.
fn pilot_rays(target: f64) -> u32 {
    let wanted = (0.64 / target.max(1e-6)).clamp(32.0, 1024.0);
    libm::exp2(libm::round(libm::log2(wanted))) as u32
}
