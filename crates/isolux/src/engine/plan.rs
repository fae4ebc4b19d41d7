//! What the pilot has fixed: the elements, and all that increments over them share.

use crate::elements::{Elements, Subdivision};
use crate::engine::gather::{
    BrightSurfaces, ControlVariate, DirectAtEnds, Gatherer, Gathering,
    Over, RayTrial, areas_m2, known_at,
};
use crate::engine::light::Lighting;
use crate::engine::mesh::{Carriers, Fit, LeafError, Trust, TrustLevels, Waiting, trust};
use crate::engine::occlusion::Barriers;
use crate::engine::particle::{Aim, CausticNoise, ElementParts, LEAST_SHARE, flights};
use crate::engine::ray::SurfacePoint;
use crate::map::Standing;
use crate::scene::Scene;
use crate::units::Rgb;
use std::sync::Arc;

/// What the pilot has fixed.
pub(super) struct Plan<'s> {
    pub(super) scene: &'s Scene,
    pub(super) lighting: &'s Lighting<'s>,
    pub(super) mesh: PlannedMesh,
    pub(super) light: PlannedLight,
    pub(super) errors: PlannedErrors,
    pub(super) tried: PlannedNoise,
    /// Whether there was time for all of it.
    pub(super) is_whole: bool,
    /// Whether elements for a higher accuracy would be about the same: there are as many as there may be.
    pub(super) is_finest: bool,
    /// Rays that the pilot has traced.
    pub(super) rays: u64,
}

/// The elements, and how light is interpolated over them.
pub(super) struct PlannedMesh {
    pub(super) elements: Elements,
    /// The elements that indirect light lives on, by node, as triangles of the scene.
    pub(super) subdivision: Subdivision,
    /// Indirect light lives on the first so many vertices and the nodes below `level`.
    pub(super) indirect_vertices: usize,
    pub(super) level: u32,
    /// The vertices that carry it; the others are interpolated.
    pub(super) carriers: Carriers,
    pub(super) waiting: Waiting,
    /// The receivers, by vertex.
    pub(super) gatherers: Vec<Gatherer>,
    /// Vertices beyond those for indirect light that gather all the same, in order, for the stored map alone.
    pub(super) gathering_for_bare: Vec<u32>,
    /// By vertex, what it stands for; none where it is hidden in other geometry.
    pub(super) standings: Vec<Option<Standing>>,
    /// Elements that something stands across.
    pub(super) cuts: Barriers,
    /// From indirect light at the vertices to the function that fits best.
    pub(super) fit: Fit,
}

/// Light as the pilot knows it.
pub(super) struct PlannedLight {
    /// Direct light at the vertices; exact if the lighting is.
    pub(super) direct: Vec<Rgb>,
    /// The variance of its noise, where it is measured once for all increments, lx2; else zero.
    pub(super) direct_variance: Vec<f64>,
    /// First guess of the indirect light.
    pub(super) guess: Vec<Rgb>,
    /// Surfaces that are far brighter than all others.
    pub(super) bright: Option<Arc<BrightSurfaces>>,
    /// Large plane walls: the control variate of gathering.
    pub(super) backdrop: Option<ControlVariate>,
    /// Root mean square of the photometric illuminance over all known surfaces, lx.
    pub(super) reference_lx: f64,
    /// Mean reflectance of the diffuse surfaces.
    pub(super) mean_reflectance: f64,
}

/// What interpolation is expected to err by.
pub(super) struct PlannedErrors {
    /// Errors of the elements that indirect light lives on.
    pub(super) of_elements: Vec<LeafError>,
    /// Errors up to which elements may be trusted.
    pub(super) trusts: TrustLevels,
    /// What interpolating indirect light errs by where readers trust it, of all light.
    pub(super) interpolation: f64,
    /// What interpolating caustics errs by, root mean square over the surface, lx.
    pub(super) caustics_lx: f64,
    /// Elements that increments check for that, and the rest of the squared error, lx2.
    pub(super) parts: ElementParts,
    pub(super) caustics_beside_lx2: f64,
}

/// What trials with few rays and particles have told of noise.
pub(super) struct PlannedNoise {
    /// How noisy gathered light is.
    pub(super) trial: RayTrial,
    /// How noisy caustics are.
    pub(super) caustic_noise: CausticNoise,
    /// Where particles for them are sent, if not anywhere.
    pub(super) aim: Option<Aim>,
}

impl Plan<'_> {
    /// How many vertices there are, for indirect light and in all, and how many carry light: plans of one scene that
    /// agree in these are the same, as elements are only ever bisected further.
    pub(super) fn size(&self) -> [usize; 3] {
        let all = self.mesh.elements.vertices().len();
        [self.mesh.indirect_vertices, all, self.mesh.carriers.count(all)]
    }

    /// Surface that the light of every vertex for indirect light stands for, m2; none where it is hidden.
    pub(super) fn areas_m2(&self) -> Vec<f64> {
        let mut areas_m2 = areas_m2(&self.mesh.subdivision, &self.mesh.carriers);
        let hidden = areas_m2.iter_mut().zip(&self.mesh.standings).filter(|(_, of)| of.is_none());
        hidden.for_each(|(m2, _)| *m2 = 0.0);
        areas_m2
    }

    /// Particles of each of so many increments for a target, where they are not weighed against rays.
    pub(super) fn particles(&self, target: f64, increments: u64) -> u32 {
        let (vertices, goal) = (self.mesh.indirect_vertices, (target, self.light.reference_lx));
        let wanted = self.tried.caustic_noise.particles(vertices, goal, increments, LEAST_SHARE);
        wanted.max(flights::particles(vertices))
    }

    /// Area of all elements, m2.
    pub(super) fn area_m2(&self) -> f64 {
        self.errors.of_elements.iter().map(|e| e.area_m2).sum()
    }

    /// What readers trust, unless check points tell otherwise.
    pub(super) const fn trust(&self) -> Trust {
        self.errors.trusts.foreseen()
    }

    /// What interpolation errs by in the elements at the vertices, lx, told to readers who trust them so far.
    pub(super) fn expected_lx(&self, trust: Trust) -> Vec<f64> {
        trust::at_vertices(&self.mesh.elements, &self.errors.of_elements, trust)
    }

    /// What a place reads of values at vertices, nodes from number `level` on left out.
    pub(super) fn read(&self, level: u32, values: &[Rgb], at: &SurfacePoint) -> Rgb {
        let corners = known_at(&self.mesh.elements, level, &self.mesh.standings, at);
        corners.map_or(Rgb::BLACK, |corners| {
            corners.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
        })
    }

    /// Direct light, for what is lacking between vertices.
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

    /// Whether a vertex lies in the open.
    pub(super) fn is_open(&self, vertex: u32) -> bool {
        self.mesh.standings[vertex as usize] == Some(Standing::Open)
    }

    /// The light that is expected at the vertices.
    pub(super) fn expected(&self) -> Vec<Rgb> {
        let indirect = self.prolongate(&self.light.guess);
        self.light
            .direct
            .iter()
            .zip(indirect)
            .map(|(&direct, indirect)| direct + indirect)
            .collect()
    }

    /// Values for the vertices that only direct light needs: interpolated from their parents.
    pub(super) fn prolongate(&self, coarse: &[Rgb]) -> Vec<Rgb> {
        self.prolongate_beside(coarse, &[])
    }

    /// The same beside what those have that gather for the bare map, if that is given.
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
            // From what stands as it does, if it can be, else as elements do.
            let own = self.mesh.standings[k].filter(|own| of.contains(&Some(*own)));
            let read = own.or(Standing::highest(of));
            let reads = |e: usize| read.is_some() && of[e] == read;
            // What stands between keeps light of the other end away.
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
    /// Over what a plan has fixed; rays that read direct light from the map read these values.
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
