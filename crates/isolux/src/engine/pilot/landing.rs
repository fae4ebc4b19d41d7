//! Refinement where the light of luminaires lands, from particles.
//!
//! A lamp a centimetre below a ceiling, or a beam a hand wide, lights small places between the vertices of the first
//! mesh, or a single vertex. No rays would be sent to such places, and rare hits by chance do not show as noise.
//! Particles follow the light. Elements that get clearly more or less flux than their vertices show are bisected.

use super::look::PilotRequest;
use super::state::{Pilot, SHARP_EDGE_SHARE};
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::Gatherer;
use crate::engine::light::{
    BELIEVED_DEVIATIONS, Emission, FIRST_PARTICLES, FURTHER_PARTICLES, Landing, Sum, landings,
};
use crate::sampling::Sequence;

/// The largest flux in wrong elements that is accepted, as a share of all flux that lands.
const MOST_WRONG_FLUX_SHARE: f64 = 0.01;

/// The largest number of rounds, of two bisections each.
const MOST_ROUNDS: usize = 24;

impl Pilot<'_> {
    /// Bisects elements until their vertices show about the flux that they get. Returns whether any element was
    /// bisected.
    pub(super) fn resolve_what_lands(
        &mut self,
        (elements, gatherers): (&mut Elements, &mut Vec<Gatherer>),
        request: &PilotRequest,
    ) -> bool {
        if without("landing-check") || self.end.has_passed() {
            return false;
        }
        let Some(emission) = Emission::new(self.scene) else { return false };
        let times = landings::times(&emission);
        let [few, many] = [FIRST_PARTICLES * times, FURTHER_PARTICLES * times];
        let each_lm = |count: u32| emission.flux_lm() / f64::from(count);
        let first = self.landed(&emission, few, 0);
        if self.wrongly_told(elements, (&first, each_lm(few))).is_empty() {
            return false;
        }
        let landed = self.landed(&emission, many, 1);
        let mut any = false;
        for _ in 0..MOST_ROUNDS {
            let wrong = self.wrongly_told(elements, (&landed, each_lm(many)));
            let room = |pilot: &Self| pilot.mesh.subdivision.size() < request.max_vertices;
            if wrong.is_empty() || !room(self) || self.end.has_passed() {
                break;
            }
            for node in wrong {
                if room(self) {
                    self.mesh.subdivision.bisect_twice(node);
                }
            }
            any = true;
            *elements = self.mesh.subdivision.elements();
            self.complete_rays();
            *gatherers = self.gatherers();
            self.complete_direct(elements, gatherers);
        }
        any
    }

    fn landed(&mut self, emission: &Emission<'_>, count: u32, number: u64) -> Vec<Landing> {
        self.traced += u64::from(count);
        let sequence = Sequence::new(self.key.with(12).with(number));
        landings::landed((self.scene, self.lighting), emission, count, sequence, &self.end)
    }

    /// The elements that get clearly more or less flux than their vertices show; empty if the differences are small
    /// in all. `each_lm` is the flux of a particle when sent. Most particles may land on surfaces without a map.
    fn wrongly_told(&self, elements: &Elements, (landed, each_lm): (&[Landing], f64)) -> Vec<u32> {
        let mut sums = vec![Sum::default(); elements.node_count()];
        let mut all_lm = 0.0;
        for of in landed {
            let place = elements.place(u32::MAX, of.triangle, of.back, of.place);
            let Some(place) = place else { continue };
            sums[place.node() as usize].add(of.flux_lm);
            all_lm += of.flux_lm;
        }
        let least_edge_m = self.mesh.least_edge_m * SHARP_EDGE_SHARE;
        let (mut wrong, mut wrong_lm) = (Vec::new(), 0.0);
        for node in self.mesh.subdivision.leaves() {
            let corners = self.mesh.subdivision.node(node).0.vertices;
            let lx: f64 = corners.iter().map(|&v| self.direct.lx[v as usize].luminance()).sum();
            let told_lm = self.mesh.subdivision.triangle(node).area() * lx / 3.0;
            let Sum { flux_lm, squares_lm2 } = sums[node as usize];
            let differs_lm = (flux_lm - told_lm).abs();
            // The expected flux gives a variance, too, since few particles give a poor one. One particle is the least.
            let variance_lm2 = squares_lm2.max(told_lm * each_lm).max(each_lm * each_lm);
            if differs_lm > BELIEVED_DEVIATIONS * variance_lm2.sqrt()
                && self.mesh.subdivision.longest_edge_m(node) > 2.0 * least_edge_m
            {
                wrong.push(node);
                wrong_lm += differs_lm;
            }
        }
        if wrong_lm > MOST_WRONG_FLUX_SHARE * all_lm { wrong } else { Vec::new() }
    }
}
