//! The plan: the elements that the pilot has fixed, and all data that increments over them share.

use crate::elements::{Elements, Subdivision, carries_map};
use crate::engine::gather::{
    BrightSurfaces, ControlVariate, DirectAtEnds, Gatherer, Gathering, Over, RayTrial, Unlit,
    areas_m2, known_at,
};
use crate::engine::light::{Emission, Lighting};
use crate::engine::mesh::{Carriers, Fit, LeafError, Trust, TrustLevels, Waiting, trust};
use crate::engine::occlusion::Barriers;
use crate::engine::particle::{Aim, CausticNoise, ElementParts, LEAST_SHARE, flights};
use crate::engine::ray::{Deadline, SurfacePoint};
use crate::map::Standing;
use crate::scene::Scene;
use crate::units::Rgb;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// The result of the pilot, with the scene that it belongs to. It reads like that result.
pub(super) struct Plan<'s> {
    pub(super) scene: &'s Scene,
    pub(super) lighting: &'s Lighting<'s>,
    pub(super) result: PilotResult,
    /// The end of the time for the preparation of increments.
    pub(super) end: Deadline,
}

/// The result of a pilot: a plain value, from which increments continue on any machine.
#[derive(Clone, Serialize, Deserialize)]
pub struct PilotResult {
    pub(super) mesh: Arc<PlannedMesh>,
    pub(super) light: Arc<PlannedLight>,
    pub(super) errors: Arc<PlannedErrors>,
    pub(super) tried: Arc<PlannedNoise>,
    /// The places found unlit, for the pilots of finer elements.
    pub(super) unlit: Arc<Unlit>,
    /// Whether there was time for all steps of the pilot.
    pub(super) is_whole: bool,
    /// Whether elements for a higher accuracy would be about the same, since their number is at its limits.
    pub(super) is_finest: bool,
    /// The number of rays that the pilot has traced.
    pub(super) rays: u64,
}

/// The elements, and the interpolation of light over them.
#[derive(Serialize, Deserialize)]
pub(super) struct PlannedMesh {
    pub(super) elements: Elements,
    /// The elements of indirect light, by node, as triangles of the scene.
    pub(super) subdivision: Subdivision,
    /// The number of vertices of indirect light, which are the first ones.
    pub(super) indirect_vertices: usize,
    /// The number of nodes of indirect light, which are the first ones.
    pub(super) level: u32,
    /// The vertices that carry indirect light; the others are interpolated from them.
    pub(super) carriers: Carriers,
    /// The vertices that do not carry it, with the carriers that they are interpolated from.
    pub(super) waiting: Waiting,
    /// The receivers, by vertex.
    pub(super) gatherers: Vec<Gatherer>,
    /// Vertices beyond those of indirect light that also gather, in ascending order, for the stored map alone.
    pub(super) gathering_for_bare: Vec<u32>,
    /// The standing of each vertex; `None` where it is hidden in other geometry.
    pub(super) standings: Vec<Option<Standing>>,
    /// The barriers across elements.
    pub(super) cuts: Barriers,
    /// The fit of piecewise linear functions to indirect light.
    pub(super) fit: Fit,
}

/// The light known to the pilot.
#[derive(Serialize, Deserialize)]
pub(super) struct PlannedLight {
    /// Direct light at the vertices, lx; exact if the lighting is.
    pub(super) direct: Vec<Rgb>,
    /// The variance of direct light at the vertices, lx2, if it is measured once for all increments; zero otherwise.
    pub(super) direct_variance: Vec<f64>,
    /// Indirect light at the vertices as estimated by the pilot, lx: the first guess of each fixed point.
    pub(super) guess: Vec<Rgb>,
    /// Surfaces that direct light makes far brighter than all others.
    pub(super) bright: Option<Arc<BrightSurfaces>>,
    /// The control variate of walls for gathering.
    pub(super) backdrop: Option<ControlVariate>,
    /// The reference of relative errors, lx: the root mean square of the photometric illuminance over all known
    /// surfaces, or twice its mean over the lit ones if that is less.
    pub(super) reference_lx: f64,
    /// The mean reflectance of the diffuse surfaces.
    pub(super) mean_reflectance: f64,
}

/// The expected interpolation errors.
#[derive(Serialize, Deserialize)]
pub(super) struct PlannedErrors {
    /// The errors of the elements of indirect light.
    pub(super) of_elements: Vec<LeafError>,
    /// The levels of trust: the errors of elements up to which readers interpolate.
    pub(super) trusts: TrustLevels,
    /// The interpolation error where readers trust the map, caustics included, as a share of all light.
    pub(super) interpolation: f64,
    /// The interpolation error of caustics, root mean square over the surface, lx.
    pub(super) caustics_lx: f64,
    /// The elements in which increments measure the error of caustics.
    pub(super) parts: ElementParts,
    /// The mean squared error of caustics in all other elements over the surface, lx2.
    pub(super) caustics_beside_lx2: f64,
}

/// The noise measured by trials with few rays and particles.
#[derive(Serialize, Deserialize)]
pub(super) struct PlannedNoise {
    /// The noise of gathered light.
    pub(super) trial: RayTrial,
    /// The noise of caustics.
    pub(super) caustic_noise: CausticNoise,
    /// The distribution of particles for caustics, if they are aimed.
    pub(super) aim: Option<Aim>,
}

impl<'s> Deref for Plan<'s> {
    type Target = PilotResult;

    fn deref(&self) -> &PilotResult {
        &self.result
    }
}

impl fmt::Debug for PilotResult {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.debug_struct("PilotResult").field("receivers", &self.receivers()).finish_non_exhaustive()
    }
}

impl PilotResult {
    /// The number of vertices of the elements.
    pub fn receivers(&self) -> usize {
        self.mesh.elements.vertices().len()
    }

    /// Whether the result can be that of a pilot of this scene: all arrays have their lengths, and all indices point to
    /// something. Results from a file may hold anything.
    pub(super) fn is_of(&self, scene: &Scene) -> bool {
        let Self { mesh, light, errors, tried, .. } = self;
        let PlannedMesh { elements, subdivision, indirect_vertices: indirect, level, .. } = &**mesh;
        let (triangles, indirect) = (scene.triangle_count(), *indirect);
        let (all, nodes) = (elements.vertices().len(), elements.node_count());
        let coarse = subdivision.node_count();
        let is_side = |(triangle, roots): (u32, &[Option<u32>; 2])| {
            [false, true].map(|back| carries_map(scene, triangle, back))
                == roots.map(|r| r.is_some())
        };
        let are_sides = |roots: &[[Option<u32>; 2]]| {
            roots.len() == triangles as usize && (0..).zip(roots).all(is_side)
        };
        let are_indices =
            |indices: &[u32], below: usize| indices.iter().all(|&k| (k as usize) < below);
        let are_known = |values: &[Rgb], count: usize| {
            values.len() == count
                && values.iter().all(|value| value.0.iter().all(|lx| lx.is_finite()))
        };
        let known = |values: &[f64]| values.iter().all(|value| value.is_finite());
        // The elements of indirect light are the first ones.
        let is_first = |node: u32| {
            let (fine, (coarse_node, _)) = (elements.node(node), subdivision.node(node));
            let split = fine.split.filter(|split| (split.first_child as usize) < coarse);
            (fine.vertices, split) == (coarse_node.vertices, coarse_node.split)
        };
        are_sides(elements.roots())
            && are_sides(subdivision.roots())
            && (*level as usize, subdivision.vertex_count()) == (coarse, indirect)
            && coarse <= nodes
            && (0..coarse as u32).all(is_first)
            && indirect <= all
            && [mesh.standings.len(), mesh.gatherers.len()] == [all; 2]
            && mesh.gatherers.iter().all(|of| of.surface.triangle < triangles)
            && mesh.gathering_for_bare.is_sorted_by(|a, b| a < b)
            && are_indices(&mesh.gathering_for_bare, all)
            && mesh.carriers.are_of(indirect)
            && mesh.cuts.are_of(nodes, all)
            && mesh.fit.is_of(indirect)
            && are_known(&light.direct, all)
            && are_known(&light.guess, indirect)
            && light.direct_variance.len() == all
            && known(&light.direct_variance)
            && known(&[light.reference_lx, light.mean_reflectance, errors.interpolation])
            && light.bright.as_ref().is_none_or(|bright| bright.are_of(triangles))
            && !errors.of_elements.is_empty()
            && errors.of_elements.iter().all(|of| (of.node as usize) < coarse && of.is_sound())
            && errors.parts.are_of(nodes, indirect)
            && tried.aim.as_ref().is_none_or(|aim| {
                Emission::new(scene).is_some_and(|emission| aim.is_of(scene, &emission))
            })
    }
}

impl Plan<'_> {
    /// The numbers of vertices for indirect light, of all vertices, and of carriers. Plans of one scene that agree in
    /// these numbers are the same, since elements are only ever bisected further.
    pub(super) fn size(&self) -> [usize; 3] {
        let all = self.mesh.elements.vertices().len();
        [self.mesh.indirect_vertices, all, self.mesh.carriers.count(all)]
    }

    /// The area that the light of each vertex for indirect light stands for, m2; zero for hidden vertices.
    pub(super) fn areas_m2(&self) -> Vec<f64> {
        let mut areas_m2 = areas_m2(&self.mesh.subdivision, &self.mesh.carriers);
        let hidden = areas_m2.iter_mut().zip(&self.mesh.standings).filter(|(_, of)| of.is_none());
        hidden.for_each(|(m2, _)| *m2 = 0.0);
        areas_m2
    }

    /// The number of particles in each of `increments` increments for a target, if they do not share the noise with
    /// rays.
    pub(super) fn particles(&self, target: f64, increments: u64) -> u32 {
        let (vertices, goal) = (self.mesh.indirect_vertices, (target, self.light.reference_lx));
        let wanted = self.tried.caustic_noise.particles(vertices, goal, increments, LEAST_SHARE);
        wanted.max(flights::particles(vertices))
    }

    /// The area of all elements, m2.
    pub(super) fn area_m2(&self) -> f64 {
        self.errors.of_elements.iter().map(|e| e.area_m2).sum()
    }

    /// The trust of readers unless check points show otherwise.
    pub(super) fn trust(&self) -> Trust {
        self.errors.trusts.foreseen()
    }

    /// The expected interpolation error at each vertex, lx, for readers with this trust.
    pub(super) fn expected_lx(&self, trust: Trust) -> Vec<f64> {
        trust::at_vertices(&self.mesh.elements, &self.errors.of_elements, trust)
    }

    /// The values at vertices, interpolated at a place; black where they are not known. Nodes from number `level` on
    /// are left out.
    pub(super) fn read(&self, level: u32, values: &[Rgb], at: &SurfacePoint) -> Rgb {
        let corners = known_at(&self.mesh.elements, level, &self.mesh.standings, at);
        corners.map_or(Rgb::BLACK, |corners| {
            corners.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
        })
    }

    /// A map of direct light with these values at the vertices, lx, for its residual between them.
    pub(super) fn over<'a>(&'a self, direct: &'a [Rgb]) -> Over<'a> {
        Over {
            scene: self.scene,
            lighting: self.lighting,
            elements: &self.mesh.elements,
            standings: &self.mesh.standings,
            direct,
            bright: self.light.bright.as_deref(),
        }
    }

    /// Whether a vertex is open.
    pub(super) fn is_open(&self, vertex: u32) -> bool {
        self.mesh.standings[vertex as usize] == Some(Standing::Open)
    }

    /// The expected light at the vertices, lx.
    pub(super) fn expected(&self) -> Vec<Rgb> {
        let indirect = self.prolongate(&self.light.guess);
        self.light
            .direct
            .iter()
            .zip(indirect)
            .map(|(&direct, indirect)| direct + indirect)
            .collect()
    }

    /// The values at all vertices, from those for indirect light. Vertices made for direct light alone are interpolated
    /// from the ends of their edges.
    pub(super) fn prolongate(&self, coarse: &[Rgb]) -> Vec<Rgb> {
        self.prolongate_beside(coarse, &[])
    }

    /// The values at all vertices as from [`Plan::prolongate`]. Vertices that gather for the stored map have the values
    /// `own`, unless these are empty.
    pub(super) fn prolongate_beside(&self, coarse: &[Rgb], own: &[Rgb]) -> Vec<Rgb> {
        let mut own = self.mesh.gathering_for_bare.iter().zip(own).peekable();
        let mut values = coarse.to_vec();
        for (k, vertex) in self.mesh.elements.vertices().iter().enumerate().skip(coarse.len()) {
            if let Some((_, &value)) = own.next_if(|(vertex, _)| **vertex as usize == k) {
                values.push(value);
                continue;
            }
            let ends = vertex.parents.expect("vertices beyond the input are made by bisection");
            let of = ends.map(|end| self.mesh.standings[end as usize]);
            // Ends of the vertex's own standing are read; without any, those of the highest standing, as in elements.
            let own = self.mesh.standings[k].filter(|own| of.contains(&Some(*own)));
            let read = own.or(Standing::highest(of));
            let reads = |e: usize| read.is_some() && of[e] == read;
            // Beside a barrier, only the end that the vertex sees is read, if it has the standing to be read.
            let seen = self
                .mesh
                .cuts
                .end_of(k as u32)
                .filter(|end| (0..2).any(|e| ends[e] == *end && reads(e)));
            let known = (0..2).filter(|&e| reads(e) && seen.is_none_or(|end| end == ends[e]));
            let known: Vec<Rgb> = known.map(|e| values[ends[e] as usize]).collect();
            values.push(known.iter().copied().sum::<Rgb>() / known.len().max(1) as f64);
        }
        values
    }
}

impl<'a> Gathering<'a> {
    /// The gathering over a plan. If rays read direct light from the map, they read these values, lx.
    pub(super) fn of(plan: &'a Plan<'_>, direct: &'a [Rgb]) -> Self {
        Self {
            scene: plan.scene,
            lighting: plan.lighting,
            elements: &plan.mesh.elements,
            level: plan.mesh.level,
            standings: &plan.mesh.standings,
            direct: if plan.lighting.are_read_at_ends() {
                DirectAtEnds::Read { values: direct, level: u32::MAX }
            } else {
                DirectAtEnds::Evaluated
            },
            regathers: false,
            bright: plan.light.bright.as_deref(),
            cuts: Some(&plan.mesh.cuts),
            backdrop: plan.light.backdrop.as_ref(),
        }
    }
}
