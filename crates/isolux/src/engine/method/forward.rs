//! `forward`: particles from the luminaires, reflected until absorbed, and counted where they arrive.
//!
//! The method follows Inspirer (Kopylov, Khodulev, Volevich 1998). An increment is a range of particles with
//! its own randomization; increments share nothing random. Few of these particles find caustics, so separate
//! particles are aimed at the surfaces that cause them.

use super::caustics;
use super::tally::Tally;
use crate::engine::judge::BELIEVED_INCREMENTS;
use crate::engine::light::{Emission, Lighting, Particle, scatterings};
use crate::engine::particle::element_parts;
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, Deadline, Effort, Sample};
use crate::sampling::{Key, Sequence};
use crate::scene::Body;
use rayon::prelude::*;

/// The number of particles per vertex in an increment.
const PARTICLES_A_VERTEX: usize = 8;
/// The least number of particles in an increment.
const FEWEST: usize = 1 << 14;
/// The largest number of particles in an increment.
const MOST: usize = 1 << 20;

/// The index of direct light in the tally.
const DIRECT: usize = 0;
/// The index of indirect light in the tally.
const INDIRECT: usize = 1;

/// The method, ready for increments.
pub(crate) struct Forward<'p, 's> {
    plan: &'p Plan<'s>,
    emission: Emission<'s>,
    particles: u32,
    /// The number of particles for caustics per increment.
    of_caustics: u32,
    scatterings: u32,
    key: Key,
}

impl<'p, 's> Forward<'p, 's> {
    /// The method with particles in proportion to the vertices.
    pub(crate) fn new(plan: &'p Plan<'s>, emission: Emission<'s>, target: f64, seed: u64) -> Self {
        let particles = (PARTICLES_A_VERTEX * plan.mesh.indirect_vertices).clamp(FEWEST, MOST);
        let particles = particles.next_power_of_two() as u32;
        let (scatterings, key) = (scatterings(plan.scene), Key::new(seed).with(2));
        let of_caustics = plan.particles(target, BELIEVED_INCREMENTS);
        Self { plan, emission, particles, of_caustics, scatterings, key }
    }

    /// Adds increment `index`, and the caustics that its map lacks in parts of elements; adds nothing and returns `None` if
    /// the deadline passes meanwhile.
    pub(crate) fn increment(
        &self,
        index: u64,
        receivers: &mut Accumulator,
        lacking: &mut Accumulator,
        deadline: &Deadline,
    ) -> Option<Effort> {
        let tally = Tally::new(self.plan, self.emission.flux_lm(), 2);
        let key = self.key.with(index);
        let sequence = Sequence::new(key);
        let of_caustics = caustics::deposit(self.plan, self.of_caustics, key.with(0), deadline)?;
        let rays = (0..self.particles)
            .into_par_iter()
            .map(|particle| (!deadline.has_passed()).then(|| self.fly(&tally, sequence, particle)))
            .sum::<Option<u64>>()?;
        lacking.add(element_parts::samples(&of_caustics.lacking));
        let [direct, indirect] =
            [DIRECT, INDIRECT].map(|part| self.plan.prolongate(&tally.illuminance(part)));
        let caustic = self.plan.prolongate(&of_caustics.light);
        receivers.add((0..self.plan.mesh.standings.len()).map(|k| Sample {
            direct: direct[k],
            caustic: caustic[k],
            indirect: indirect[k],
            passed_on: 0.0,
        }));
        // Flux given up on the way to caustics is counted by these particles already.
        Some(Effort { rays: rays + of_caustics.effort.rays, given_up_lx: tally.given_up_lx() })
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
            if let Body::Opaque { .. } = scene.material(at.triangle).body
                && let Some(part) = part(&particle, lighting)
            {
                tally.add(part, &at, particle.flux_lm);
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

/// The quantity that a particle adds to; `None` for caustics, which have particles of their own. Where
/// nothing makes caustics, the little light beyond luminaires and their images counts as direct.
fn part(particle: &Particle, lighting: &Lighting) -> Option<usize> {
    if particle.diffused {
        return Some(INDIRECT);
    }
    (particle.is_covered(lighting) || !lighting.leaves_caustics()).then_some(DIRECT)
}
