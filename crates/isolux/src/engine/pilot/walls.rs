//! The control variate of walls in the pilot: its construction, its light, and the noise that it leaves.

use super::state::{PILOT_TOLERANCE, Pilot};
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::{
    ControlVariate, Gatherer, NET_ORDER, RayTrial, control_variate, known_at, ray_trial,
};
use crate::engine::judge::Light;
use crate::engine::occlusion::nearby;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::Sequence;
use crate::units::Rgb;
use rayon::prelude::*;

/// The largest number of rays of a vertex in the first estimate of indirect light. It is also the least number to which
/// the control variate reduces the rays of the pilot.
const FIRST_LOOK_RAYS: u32 = 16;
/// The share of noise left by the control variate below which the pilot traces fewer rays.
const MUCH_NOISE_SHARE: f64 = 0.35;

/// The relative accuracy goal below which the walls are fitted to the light again. The first estimate of
/// indirect light is too coarse there. At 1 %, that lowers noise from 0.09 to 0.07 % for a tenth more time
/// (decision 37).
const FINE_GOAL: f64 = 2e-3;

impl Pilot<'_> {
    /// Builds the control variate of walls if enough places see them, polynomials fit their light, and enough noise is
    /// removed. Where little noise is left, vertices of the pilot get fewer rays.
    pub(super) fn find_walls(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        if without("control-variate") || self.end.has_passed() {
            return;
        }
        let lit: Vec<usize> = (0..gatherers.len())
            .filter(|&v| self.near.standings[v].is_some() && self.near.known[v])
            .collect();
        let every = lit.len().div_ceil(control_variate::SOME).max(1);
        let place = |&v: &usize| (gatherers[v], elements.vertices()[v].area_m2);
        let places: Vec<(Gatherer, f64)> = lit.iter().step_by(every).map(place).collect();
        let Some(mut backdrop) = ControlVariate::seen_by(self.scene, ray_trial::stands(&places))
        else {
            return;
        };
        self.indirect.lx = vec![Rgb::BLACK; gatherers.len()];
        let left_out = self.look_at_walls(&mut backdrop, elements);
        // Bright spots may lie between the places of the fit, but not between vertices.
        let reflected = lit.iter().map(|&v| {
            let (stand, area_m2) = (gatherers[v].stand(), elements.vertices()[v].area_m2);
            let SurfacePoint { triangle, back, point, .. } = gatherers[v].surface;
            let [a, b] = self.scene.triangle(triangle).barycentric(point);
            let at = SurfacePoint::new(self.scene, triangle, back, a, b);
            let reflected_lx = (self.direct.lx[v] * at.reflectance(self.scene)).luminance();
            control_variate::LitStand { stand, area_m2, reflected_lx }
        });
        if left_out.max(backdrop.leaves_out(reflected)) > control_variate::LEFT_OUT {
            self.indirect.lx.clear();
            return;
        }
        self.glance(elements, gatherers);
        self.look_at_walls(&mut backdrop, elements);
        self.walls.backdrop = Some(backdrop);
        let left = self.noise_left_by_walls(elements, &places);
        if left.is_none_or(|left| left > control_variate::WORTH) {
            (self.walls.backdrop, self.tried.trial) = (None, None);
        }
        if let Some(left) = left.filter(|&left| left < MUCH_NOISE_SHARE) {
            let fewer = libm::pow(left, 1.0 / NET_ORDER);
            let rays = |of: &u32| {
                let wanted = (f64::from(*of) * fewer) as u32;
                wanted.next_power_of_two().max(FIRST_LOOK_RAYS).min(*of)
            };
            self.mesh.rays = self.mesh.rays.iter().map(rays).collect();
        }
    }

    /// Estimates indirect light at the vertices by few rays.
    fn glance(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let vertices: Vec<u32> = (0..gatherers.len() as u32).collect();
        let mut rows = self.rows(&vertices, gatherers);
        rows.iter_mut().for_each(|row| row.rays = row.rays.min(FIRST_LOOK_RAYS));
        let key = self.key.with(8);
        let gathering = self.gathering(elements, u32::MAX, &self.near.standings);
        let operator = self.operator(&gathering, &rows, key);
        self.traced += operator.rays;
        let black = vec![Rgb::BLACK; gatherers.len()];
        let waiting = self.mesh.carriers.waiting();
        self.indirect.lx =
            operator.solve(&black, &black, &waiting, (PILOT_TOLERANCE, &self.reflects_until));
    }

    /// The noise at some places with the control variate, as a share of the noise without it; `None` if there is no
    /// noise without it. The result of this trial is kept.
    fn noise_left_by_walls(
        &mut self,
        elements: &Elements,
        places: &[(Gatherer, f64)],
    ) -> Option<f64> {
        let lx = |v: usize| (self.direct.lx[v] + self.indirect.lx[v]).luminance();
        let of = (
            Light::of_vertices(elements, &self.near.standings, lx).reference_lx(),
            self.key.with(9),
        );
        let gathering = self.gathering(elements, u32::MAX, &self.near.standings);
        let ray_trial::WallTrial { trial, left, rays } =
            RayTrial::of_walls(&gathering, places, &self.indirect.lx, of);
        self.traced += rays;
        self.tried.trial = Some(trial);
        left
    }

    /// Fits the walls to the light again for fine accuracy goals, where errors of the first estimate may add to the
    /// noise.
    pub(super) fn look_at_walls_again(&mut self, elements: &Elements, target: f64) {
        let Some(mut backdrop) = self.walls.backdrop.take() else { return };
        if target < FINE_GOAL {
            self.look_at_walls(&mut backdrop, elements);
            self.walls.behind.clear();
        }
        self.walls.backdrop = Some(backdrop);
    }

    /// Fits the walls to the present light. Returns the share of the variation of light that the fit leaves out.
    fn look_at_walls(&self, backdrop: &mut ControlVariate, elements: &Elements) -> f64 {
        let light_at = |at: &SurfacePoint| {
            let known = known_at(elements, u32::MAX, &self.near.standings, at)?;
            let read = |values: &[Rgb]| -> Rgb {
                known.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
            };
            let direct = if self.lighting.are_read_at_ends() {
                read(&self.direct.lx)
            } else {
                self.lighting.estimate(at, &mut Dice::new(Sequence::new(self.key.with(10)), 0))
            };
            Some(direct + read(&self.indirect.lx))
        };
        backdrop.see(self.scene, light_at)
    }

    /// The gatherer of a vertex with the illuminance of the unoccluded walls, if there is a control variate.
    pub(super) fn before_walls(&self, vertex: u32, of: Gatherer) -> Gatherer {
        let Some(backdrop) = &self.walls.backdrop else { return of };
        // Receivers on borders move as their elements become smaller.
        let known = self.walls.behind.get(&vertex).filter(|(origin, _)| *origin == of.origin);
        let behind =
            || if self.end.has_passed() { None } else { backdrop.behind(self.scene, &of.stand()) };
        let behind = known.map_or_else(behind, |&(_, light)| light);
        Gatherer { behind, ..of }
    }

    /// Sets the illuminance of the unoccluded walls at all vertices that carry light.
    pub(super) fn stand_before_walls(&self, gatherers: &mut [Gatherer]) {
        gatherers.par_iter_mut().enumerate().for_each(|(v, gatherer)| {
            if self.mesh.carriers.is_active(v as u32) {
                *gatherer = self.before_walls(v as u32, *gatherer);
            }
        });
    }

    /// Keeps the illuminance of the unoccluded walls at vertices with rays, for later use.
    pub(super) fn keep_behind(&mut self, vertices: &[u32], rows: &[Gatherer]) {
        if self.walls.backdrop.is_some() {
            let of = vertices.iter().zip(rows).filter(|(_, row)| row.rays > 0);
            self.walls.behind.extend(of.map(|(&vertex, row)| (vertex, (row.origin, row.behind))));
        }
    }

    /// The gatherers of some vertices, with their rays, gaps and control variate. Vertices that do not carry light have
    /// no rays.
    pub(super) fn rows(&self, vertices: &[u32], gatherers: &[Gatherer]) -> Vec<Gatherer> {
        let edges_m = self.mesh.subdivision.longest_edges_m();
        let row = |&vertex: &u32| {
            let gatherer = &gatherers[vertex as usize];
            let edge_m = edges_m[vertex as usize];
            let rays = if self.mesh.carriers.is_active(vertex) {
                self.mesh.rays[vertex as usize]
            } else {
                0
            };
            let in_gap = !self.end.has_passed()
                && nearby::is_closed_in(self.scene, &gatherer.surface, edge_m);
            let gatherer = gatherer.with_rays(rays).in_gap(in_gap);
            if rays > 0 { self.before_walls(vertex, gatherer) } else { gatherer }
        };
        vertices.par_iter().map(row).collect()
    }
}
