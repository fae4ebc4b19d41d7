//! `forward`: particles from the luminaires, reflected until absorbed, counted where they arrive.
//!
//! The way of Inspirer (Kopylov, Khodulev, Volevich 1998). An increment is a range of particles with
//! its own randomization; increments share nothing random.

use super::accumulate::{Accumulator, Effort, Sample};
use super::direct::Lighting;
use super::emission::Emission;
use super::particle::{Particle, scatterings};
use super::plan::Plan;
use super::tally::Tally;
use crate::sampling::{Key, Sequence};
use crate::scene::Body;
use rayon::prelude::*;

/// Particles of an increment for every vertex, within limits.
const PARTICLES_A_VERTEX: usize = 8;
const FEWEST: usize = 1 << 14;
const MOST: usize = 1 << 20;

const DIRECT: usize = 0;
const CAUSTIC: usize = 1;
const INDIRECT: usize = 2;

/// The engine, ready for increments.
pub(super) struct Forward<'p, 's> {
    plan: &'p Plan<'s>,
    emission: Emission<'s>,
    particles: u32,
    scatterings: u32,
    key: Key,
}

impl<'p, 's> Forward<'p, 's> {
    /// With particles in proportion to the vertices.
    pub(super) fn new(plan: &'p Plan<'s>, emission: Emission<'s>, seed: u64) -> Self {
        let particles = (PARTICLES_A_VERTEX * plan.indirect_vertices).clamp(FEWEST, MOST);
        let particles = particles.next_power_of_two() as u32;
        let (scatterings, key) = (scatterings(plan.scene), Key::new(seed).with(2));
        Self { plan, emission, particles, scatterings, key }
    }

    /// Adds increment `index`.
    pub(super) fn increment(&self, index: u64, receivers: &mut Accumulator) -> Effort {
        let tally = Tally::new(self.plan, self.emission.flux_lm(), 3);
        let sequence = Sequence::new(self.key.with(index));
        let rays = (0..self.particles)
            .into_par_iter()
            .map(|particle| self.fly(&tally, sequence, particle))
            .sum();
        let parts =
            [DIRECT, CAUSTIC, INDIRECT].map(|part| self.plan.prolongate(&tally.illuminance(part)));
        receivers.add((0..self.plan.standings.len()).map(|k| Sample {
            direct: parts[DIRECT][k],
            caustic: parts[CAUSTIC][k],
            indirect: parts[INDIRECT][k],
        }));
        Effort { rays, given_up_lx: tally.given_up_lx() }
    }

    fn fly(&self, tally: &Tally, sequence: Sequence, index: u32) -> u64 {
        let (scene, lighting) = (self.plan.scene, self.plan.lighting);
        let (count, scatterings) = (self.particles, self.scatterings);
        let emitted = Particle::emit(&self.emission, sequence, index, count, scatterings);
        let Some(mut particle) = emitted else { return 0 };
        let mut rays = 0;
        loop {
            rays += 1;
            let Some(at) = particle.advance(scene) else { return rays };
            if let Body::Opaque { .. } = scene.material(at.triangle).body {
                tally.add(part(&particle, lighting), &at, particle.flux_lm);
            }
            if !particle.scatter(scene, lighting) {
                return rays;
            }
            if particle.is_given_up() {
                tally.give_up(particle.flux_lm);
                return rays;
            }
        }
    }
}

fn part(particle: &Particle, lighting: &Lighting) -> usize {
    if particle.diffused {
        INDIRECT
    } else if particle.is_covered(lighting) {
        DIRECT
    } else {
        CAUSTIC
    }
}
