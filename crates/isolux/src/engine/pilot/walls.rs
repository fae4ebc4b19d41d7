//! Walls that rays are judged by: whether there are any, and how much noise that takes off.

use super::Pilot;
use crate::elements::Elements;
use crate::engine::backdrop::Backdrop;
use crate::engine::gather::{Gatherer, known_at};
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::engine::trial::{self, NET_ORDER, Trial};
use crate::sampling::Sequence;
use crate::units::Rgb;

/// The share of all places that have to see mostly walls.
const CLEAR: f64 = 0.75;
/// A first look at the light, with so many rays; vertices have as many later at least.
const FIRST_RAYS: u32 = 16;
/// Noise that is left of what it is without walls, for which it is worth while; and for which the pilot has fewer rays.
const WORTH: f64 = 0.7;
const MUCH: f64 = 0.35;

/// Accuracies for which the first look is too coarse.
const FINE: f64 = 2e-3;

impl Pilot<'_> {
    /// Looks whether rays are to be judged by walls.
    pub(super) fn find_walls(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let every = gatherers.len().div_ceil(trial::RECEIVERS).max(1);
        let some: Vec<Gatherer> = gatherers.iter().step_by(every).copied().collect();
        let is_clear = |b: &Backdrop| b.share_of_clear(self.scene, &some) >= CLEAR;
        let Some(mut backdrop) = Backdrop::of(&self.subdivision).filter(is_clear) else { return };
        let key = self.key.with(8);
        let rows: Vec<u32> = (0..gatherers.len() as u32).collect();
        let rows = self.rows(&rows, gatherers).into_iter();
        let rows: Vec<Gatherer> =
            rows.map(|g| g.with_rays(g.rays.min(FIRST_RAYS))).collect();
        let gathering = self.gathering(elements, u32::MAX, &self.standings);
        let operator = gathering.operator(&rows, |_| key);
        self.traced += operator.rays;
        let black = vec![Rgb::BLACK; gatherers.len()];
        self.indirect = operator.solve(&black, &black, &self.carriers.waiting(), super::PILOT_TOLERANCE);
        self.look_at_walls(&mut backdrop, elements);
        self.backdrop = Some(backdrop);
        let weight = |v: usize| elements.vertices()[v].area_m2;
        let with: Vec<(Gatherer, f64)> = (0..gatherers.len())
            .step_by(every)
            .map(|v| (self.before_walls(v as u32, gatherers[v]), weight(v)))
            .collect();
        let without: Vec<(Gatherer, f64)> =
            with.iter().map(|&(g, m2)| (Gatherer { behind: None, ..g }, m2)).collect();
        let gathering = self.gathering(elements, u32::MAX, &self.standings);
        let rms_lx = super::rms(elements, &self.standings, |v| (self.direct[v] + self.indirect[v]).luminance());
        let noise = |some: &[(Gatherer, f64)]| {
            Trial::noise(&gathering, some, &self.indirect, (rms_lx, key.with(1)))
        };

        let [(with_lx, traced), (without_lx, _)] = [noise(&with), noise(&without)];
        self.traced += 2 * traced;
        let left = with_lx / without_lx;
        if !(left < WORTH) {
            self.backdrop = None;
        } else if left < MUCH {
            let fewer = libm::pow(left, 1.0 / NET_ORDER);
            let rays = |of: &u32| {
                let wanted = (f64::from(*of) * fewer) as u32;
                wanted.next_power_of_two().max(FIRST_RAYS).min(*of)
            };
            self.rays = self.rays.iter().map(rays).collect();
        }
        eprintln!("backdrop left {left} rays {:?}", self.rays.iter().max());
    }

    /// Takes down the light of the walls once more, where what the first look made of it may add to the noise.
    pub(super) fn look_at_walls_again(&mut self, elements: &Elements, target: f64) {
        let Some(mut backdrop) = self.backdrop.take() else { return };
        if target < FINE {
            self.look_at_walls(&mut backdrop, elements);
            self.behind.clear();
        }
        self.backdrop = Some(backdrop);
    }

    /// Takes down the light of the walls that rays are judged by.
    fn look_at_walls(&self, backdrop: &mut Backdrop, elements: &Elements) {
        let light_at = |at: &SurfacePoint| {
            let known = known_at(elements, u32::MAX, &self.standings, at)?;
            let read = |values: &[Rgb]| -> Rgb {
                known.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
            };
            let direct = if self.lighting.are_read_at_ends() {
                read(&self.direct)
            } else {
                self.lighting.estimate(at, &mut Dice::new(Sequence::new(self.key.with(9)), 0))
            };
            Some(direct + read(&self.indirect))
        };
        backdrop.see(self.scene, light_at);
    }

    /// A vertex that gathers, with what it gets from the walls.
    pub(super) fn before_walls(&self, vertex: u32, of: Gatherer) -> Gatherer {
        let Some(backdrop) = &self.backdrop else { return of };
        // Those on borders move as elements become smaller.
        let known = self.behind.get(&vertex).filter(|(origin, _)| *origin == of.origin);
        let behind = known.map_or_else(|| backdrop.behind(self.scene, &of), |&(_, light)| light);
        Gatherer { behind, ..of }
    }

    /// Keeps that for later.
    pub(super) fn keep_behind(&mut self, vertices: &[u32], rows: &[Gatherer]) {
        if self.backdrop.is_some() {
            let of = vertices.iter().zip(rows).filter(|(_, row)| row.rays > 0);
            self.behind.extend(of.map(|(&vertex, row)| (vertex, (row.origin, row.behind))));
        }
    }
}
