//! The state of the pilot: elements, light at their vertices, geometry near them, costs.

use super::forecast::Costs;
use super::look::{PilotRequest, Surroundings};
use crate::ablation::without;
use crate::elements::{Elements, FewNumbers, Subdivision, TOGETHER};
use crate::engine::gather::{
    BrightSurfaces, ControlVariate, DirectAtEnds, Gatherer, Gathering, Operator, RayTrial, Sight,
    Unlit, allot,
};
use crate::engine::light::Lighting;
use crate::engine::mesh::{Carriers, Details, bisect_to_scale};
use crate::engine::occlusion::{ClosedIn, Footprints};
use crate::engine::particle::{Aim, CausticNoise};
use crate::engine::ray::reflectance::Reflectances;
use crate::engine::ray::{Deadline, NEVER, SurfacePoint};
use crate::map::Standing;
use crate::sampling::Key;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Point;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The number of vertices of the first mesh, unless the scene has more.
const FIRST_VERTICES: f64 = 700.0;
/// The number of vertices added to that per vertex of the scene. Among many objects light varies on walls, too,
/// in ways that a coarse mesh does not show.
const FURTHER_VERTICES_A_VERTEX: f64 = 0.05;
/// The share of the first vertices on which the pilot tests whether light is smooth. Smooth light needs no more
/// vertices to start with. With half as many vertices or fewer, CUBE at 0.1 % misses its goal more often
/// (decision 24).
const COARSE_START_SHARE: f64 = 0.5;
/// The number of vertices of the first mesh where the map is not fitted. Hat functions blur the light of
/// particles there.
const FIRST_UNFITTED_VERTICES: f64 = 1500.0;
/// The divisor for trial portions: one in so many vertices is computed first, to predict the time of all of
/// them. It applies to the first gathering and to the first direct light.
pub(super) const FIRST_PART_DIVISOR: usize = 16;
/// The largest distance between the coarsest vertices that carry light, in edges of the first mesh. At four
/// edges carriers start two apart; details of the vertices between show more than a mesh twice as dense alone.
const COARSEST_SPACING_EDGES: f64 = 4.0;
/// The largest number of rounds of refinement.
pub(super) const MAX_ROUNDS: usize = 16;
/// The shortest edge that is bisected, as a share of the scene's extent: a centimetre in a room. A fourth of
/// it leaves the error of the hall's bare map as it is (decision 55).
const LEAST_EDGE_SHARE: f64 = 1e-3;
/// The shortest edge where light is sharp (caustics, light that lands between vertices), as a share of that for
/// other light.
pub(super) const SHARP_EDGE_SHARE: f64 = 1.0 / 64.0;
/// The displacement of receivers on borders, as a share of the way to the middle of their element.
const PULL_IN_SHARE: f64 = 2e-3;
/// The largest number of successive rounds without progress. At borders of gaps each round finds as much error
/// as it removes, until elements are as narrow as the gap.
pub(super) const MOST_STALLS: usize = 1;
/// The allowed noise of direct light where it is not exact, as a share of the accuracy goal of the mesh.
const DIRECT_NOISE_SHARE: f64 = 0.25;
/// The distance below which an object before a vertex shades the vertex more than the rest of its element, in
/// edges of the element: pictures on walls, shelves.
pub(super) const HEM_EDGE_SHARE: f64 = 0.125;
/// The change of light below which the pilot's sweeps of the fixed point end.
pub(super) const PILOT_TOLERANCE: f64 = 1e-4;

/// The pilot: its scene, its knowledge so far, and the cost of that knowledge.
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
    /// The number of rays traced so far.
    pub(super) traced: u64,
    /// When the pilot was begun.
    pub(super) started: Instant,
    /// The end of the time. What is not measured by then is left unknown.
    pub(super) end: Deadline,
    /// The end of the time for the reflections of light: without them a map is too dark.
    pub(super) reflects_until: Deadline,
    /// The number of rays of a receiver whose turn comes after the end, and of looks at its direct light: one, or none where nobody
    /// will use them.
    pub(super) rays_too_late: u32,
    /// Whether there was time for all steps of the pilot.
    pub(super) is_whole: bool,
}

/// The elements so far, with the limits of their refinement.
pub(super) struct Mesh {
    pub(super) subdivision: Subdivision,
    /// What its elements reflect.
    pub(super) reflectances: Reflectances,
    /// The vertices that carry indirect light.
    pub(super) carriers: Carriers,
    /// The largest distance between the coarsest carriers, m; zero where every vertex carries light.
    pub(super) spacing_m: f64,
    /// Gathering rays by vertex: the same number all over a surface, so that its noise is uniform.
    pub(super) rays: Vec<u32>,
    /// The shortest edge that may be bisected, m.
    pub(super) least_edge_m: f64,
    /// The edge length of the usual first mesh, m, where the pilot starts with a coarser one.
    pub(super) usual_edge_m: Option<f64>,
    /// The largest number of vertices of the usual first mesh.
    pub(super) most_first_vertices: usize,
    /// Whether most vertices belong to objects of the scene, not to its walls.
    pub(super) has_many_things: bool,
    /// The largest number of vertices for indirect light; infinite until it is known.
    pub(super) most_for_indirect_light: f64,
    /// Whether the number of vertices for indirect light is about at its limit.
    pub(super) is_full: bool,
    /// The number of vertices for indirect light, and the area that each stands for, m2; `None` until they are
    /// fixed.
    pub(super) for_indirect_light: Option<(usize, Vec<f64>)>,
}

/// The geometry near vertices and elements.
#[derive(Default)]
pub(super) struct Near {
    /// By vertex, whether light can reach it.
    pub(super) known: Vec<bool>,
    /// By vertex, its standing; `None` where it is hidden in other geometry.
    pub(super) standings: Vec<Option<Standing>>,
    /// Places of elements that are known to get no light.
    pub(super) unlit: Unlit,
    /// Places that trial particles have reached by way of specular surfaces.
    pub(super) reached: Vec<SurfacePoint>,
    pub(super) felt: ClosedIn,
    pub(super) footprints: Footprints,
    /// By carrier, the spacing of carriers above which some object before it is nearer than the next carrier, m.
    pub(super) beset_from_m: HashMap<u32, f64, FewNumbers>,
    /// By vertex, the distance to the nearest object before it, m, if that is less than a share of its elements.
    pub(super) hemmed_in_m: Vec<f64>,
    /// By node, whether an object stands close before its middle.
    pub(super) beset: Vec<bool>,
}

/// Direct light at the vertices.
#[derive(Default)]
pub(super) struct DirectLight {
    pub(super) lx: Vec<Rgb>,
    pub(super) variance: Vec<f64>,
    /// By vertex, the place where direct light was measured.
    pub(super) measured_at: Vec<Point>,
    /// The allowed noise where direct light is measured once with part of the luminaires, as a share of all light.
    pub(super) noise: Option<f64>,
    /// The same allowed noise, lx.
    pub(super) noise_lx: Option<f64>,
    /// The number of vertices, and the ratio of the interpolation error to its goal on them.
    pub(super) excess: Option<(usize, f64)>,
    /// The number of vertices that the last round of refinement for direct light has added.
    pub(super) added: usize,
    /// Whether direct light has its final values.
    pub(super) is_measured: bool,
    /// The end of the time to measure direct light well: first that of the first survey, then that of the pilot.
    pub(super) in_time: Deadline,
    /// Whether some of it was measured in a hurry.
    pub(super) is_hurried: bool,
}

/// Indirect light at the vertices.
#[derive(Default)]
pub(super) struct IndirectLight {
    pub(super) lx: Vec<Rgb>,
    /// By vertex, whether light was gathered there.
    pub(super) gathered: Vec<bool>,
    /// The number of nodes when indirect light was last solved for.
    pub(super) solved_nodes: u32,
    /// By node, indirect light in the middle of elements without details, lx; `None` where none is gathered.
    pub(super) middles: HashMap<u32, Option<f64>>,
    /// Whether some of the latest middles lay in gaps that luminaires shine into.
    pub(super) sees_lit_gaps: bool,
    pub(super) surroundings: Surroundings,
    /// Indirect light of the stored map where the elements for indirect light do not resolve it.
    pub(super) bare: Option<Bare>,
}

/// Light of large plane walls: the control variate of gathering.
#[derive(Default)]
pub(super) struct WallLight {
    pub(super) backdrop: Option<ControlVariate>,
    /// By vertex, its place, and the light that the walls would send there without occluders.
    pub(super) behind: HashMap<u32, (Point, Option<Rgb>)>,
}

/// Noise as measured by trials with few rays and particles.
#[derive(Default)]
pub(super) struct Tried {
    pub(super) trial: Option<RayTrial>,
    pub(super) caustic_noise: CausticNoise,
    pub(super) aim: Option<Aim>,
}

/// Indirect light gathered at the vertices for direct light, for the stored (interpolated) map.
pub(super) struct Bare {
    /// The first vertex for direct light.
    pub(super) first: usize,
    /// Indirect light of the first and all later vertices.
    pub(super) indirect: Vec<Rgb>,
    /// Elements with an object close before them; only vertices on these gather.
    pub(super) beset: Vec<u32>,
}

/// The mesh that the pilot starts with.
struct FirstMesh {
    subdivision: Subdivision,
    /// The edge length of the usual first mesh, m.
    edge_m: f64,
    /// Whether most vertices belong to objects, not to walls.
    has_many_things: bool,
    /// The largest number of vertices of a mesh with that edge length.
    most: usize,
}

/// The largest ratio of the elements of a mesh to those with its edge length: bisection ends at edges between half of
/// that length and all of it.
const MOST_OF_EDGE: f64 = 4.0;
/// The number of vertices that a first mesh may have in any case, since it takes a second at most. Needles take more
/// than [`MOST_OF_EDGE`]: both halves of a needle are needles of half the length, so that one that reaches far away would
/// take elements without bound.
const ANYWAY_VERTICES: usize = 1 << 16;

/// The first mesh of a scene.
fn first_mesh(scene: &Scene, request: &PilotRequest) -> FirstMesh {
    let mut subdivision = Subdivision::new(scene);
    let area_m2: f64 = subdivision.leaves().map(|n| subdivision.triangle(n).area()).sum();
    // Half squares of hypotenuse h have area h^2 / 4, and there are two per vertex.
    let first = if request.is_fitted { FIRST_VERTICES } else { FIRST_UNFITTED_VERTICES };
    let more = FURTHER_VERTICES_A_VERTEX * subdivision.vertex_count() as f64;
    let edge_m = (2.0 * area_m2 / (first + more)).sqrt();
    let start_m = if request.is_hybrid && !without("coarse-start") {
        edge_m / COARSE_START_SHARE.sqrt()
    } else {
        edge_m
    };
    let most = subdivision.size() + (MOST_OF_EDGE * (first + more)) as usize;
    let most = request.max_vertices.min(most.max(ANYWAY_VERTICES));
    subdivision.bisect_to(start_m, most);
    if request.is_fitted && !without("room-scale") {
        bisect_to_scale(scene, &mut subdivision, request.max_vertices, &request.end);
    }
    FirstMesh { subdivision, edge_m, has_many_things: more > first, most }
}

impl<'s> Pilot<'s> {
    pub(super) fn new(
        scene: &'s Scene,
        lighting: &'s Lighting<'s>,
        request: &PilotRequest,
    ) -> Self {
        let started = Instant::now();
        let FirstMesh { subdivision, edge_m, has_many_things, most } = first_mesh(scene, request);
        let rays = Self::shared_rays(&subdivision, request.target);
        let has_noise = request.is_fitted && lighting.has_many() && lighting.is_measured_once();
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        let key = Key::new(request.seed).with(0);
        let (bright, traced) = BrightSurfaces::of(scene, lighting, request.seed, &request.end);
        let mesh = Mesh {
            subdivision,
            reflectances: Reflectances::default(),
            carriers: Carriers::all(),
            spacing_m: if request.is_fitted { COARSEST_SPACING_EDGES * edge_m } else { 0.0 },
            rays,
            least_edge_m: request.least_edge_m.unwrap_or(LEAST_EDGE_SHARE * extent_m),
            usual_edge_m: (request.is_hybrid && !without("coarse-start")).then_some(edge_m),
            most_first_vertices: most,
            has_many_things,
            most_for_indirect_light: f64::INFINITY,
            is_full: false,
            for_indirect_light: None,
        };
        let noise = has_noise.then_some(DIRECT_NOISE_SHARE * request.mesh_target);
        Self {
            scene,
            lighting,
            key,
            mesh,
            near: Near::default(),
            direct: DirectLight {
                noise,
                in_time: request.deadline.clone(),
                ..DirectLight::default()
            },
            indirect: IndirectLight::default(),
            walls: WallLight::default(),
            bright,
            tried: Tried::default(),
            costs: Costs::default(),
            traced,
            started,
            end: request.end.clone(),
            reflects_until: request.end.clone().with_grace(Duration::ZERO),
            rays_too_late: 1,
            is_whole: !request.end.has_passed(),
        }
    }

    /// The mean reflectance of all surfaces, weighted by area.
    pub(super) fn mean_reflectance(&self) -> f64 {
        self.mesh.reflectances.of_all(self.scene, &self.mesh.subdivision)
    }

    pub(super) fn gatherers(&self) -> Vec<Gatherer> {
        let receivers = self.mesh.subdivision.receivers(PULL_IN_SHARE);
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

    /// The gathering of rays that read the light on a level of the elements.
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

    /// The operator of some receivers, all with the same random numbers. Receivers whose turn comes after the end get one
    /// ray each at most.
    pub(super) fn operator(
        &self,
        gathering: &Gathering<'_>,
        rows: &[Gatherer],
        key: Key,
    ) -> Operator {
        let row = |k: usize| match self.end.has_passed() {
            true => rows[k].with_rays(rows[k].rays.min(self.rays_too_late)),
            false => rows[k],
        };
        let operator = gathering.operator_until(&NEVER, (rows.len(), row), |_| key);
        operator.expect("without a deadline nothing is given up")
    }

    pub(super) fn sight<'a>(
        &'a self,
        elements: &'a Elements,
        gatherers: &'a [Gatherer],
    ) -> Sight<'a> {
        let (scene, lighting, key) = (self.scene, self.lighting, self.key.with(3));
        let (reached, footprints) = (&self.near.reached, &self.near.footprints);
        Sight { scene, lighting, elements, gatherers, reached, footprints, key, end: &self.end }
    }

    /// Gives new vertices the number of rays of their parents.
    pub(super) fn complete_rays(&mut self) {
        for vertex in &self.mesh.subdivision.vertices()[self.mesh.rays.len()..] {
            let [parent, _] =
                vertex.parents.expect("vertices beyond the first are made by bisection");
            self.mesh.rays.push(self.mesh.rays[parent as usize]);
        }
    }

    /// Rays by vertex in the pilot: the usual number, or fewer on surfaces with more vertices per area than others
    /// (see [`allot`]), but at least a quarter of it.
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

/// The usual number of rays of a receiver in the pilot. It grows with the accuracy, so that noise stays below
/// the details to be found. It is the power of two nearest to a measurement on CUBE: with half as many rays,
/// elements are made anew for 0.3 %.
fn pilot_rays(target: f64) -> u32 {
    let wanted = (0.64 / target.max(1e-6)).clamp(32.0, 1024.0);
    libm::exp2(libm::round(libm::log2(wanted))) as u32
}
