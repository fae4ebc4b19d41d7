//! Places where the light of luminaires lands, found by particles that follow only planar mirrors.

use super::emission::Emission;
use super::lighting::Lighting;
use super::particle::Particle;
use crate::elements::carries_map;
use crate::engine::ray::Deadline;
use crate::sampling::Sequence;
use crate::scene::Scene;
use rayon::prelude::*;

/// Number of particles that tell whether there is any light (decision 51).
pub(crate) const FIRST_PARTICLES: u32 = 1 << 11;
/// Number of further particles that tell where it is.
pub(crate) const FURTHER_PARTICLES: u32 = 1 << 14;
/// Number of luminaires for which [`FIRST_PARTICLES`] and [`FURTHER_PARTICLES`] suffice; the counts grow in
/// proportion to larger numbers.
const FEW_LUMINAIRES: u32 = 8;
/// The largest factor on these counts.
const MOST_PARTICLES_FACTOR: u32 = 16;
/// The most mirrors that a particle follows.
const MOST_MIRRORS: u32 = 16;

/// Standard errors by which the light at a place must differ from the expected value to count as
/// different. By chance one of fifteen thousand places does.
pub(crate) const BELIEVED_DEVIATIONS: f64 = 4.0;

/// The flux that one particle brings to a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Landing {
    pub(crate) triangle: u32,
    pub(crate) back: bool,
    pub(crate) place: [f64; 2],
    pub(crate) flux_lm: f64,
}

/// The flux that particles bring to the places of a surface, and the sum of its squares.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sum {
    pub(crate) flux_lm: f64,
    pub(crate) squares_lm2: f64,
}

impl Sum {
    pub(crate) fn add(&mut self, flux_lm: f64) {
        self.flux_lm += flux_lm;
        self.squares_lm2 += flux_lm * flux_lm;
    }
}

/// Factor on the number of particles that the number of luminaires requires.
pub(crate) fn times(emission: &Emission<'_>) -> u32 {
    (emission.count() as u32 / FEW_LUMINAIRES).clamp(1, MOST_PARTICLES_FACTOR)
}

/// The landings of `count` particles, straight or over planar mirrors, on surfaces that carry a map. Particles whose turn comes after
/// the end are left out.
pub(crate) fn landed(
    (scene, lighting): (&Scene, &Lighting<'_>),
    emission: &Emission<'_>,
    count: u32,
    sequence: Sequence,
    end: &Deadline,
) -> Vec<Landing> {
    let one = |index: u32| {
        let mut landed = Vec::new();
        if end.has_passed() {
            return landed;
        }
        let particle = Particle::emit(emission, sequence, index, count, MOST_MIRRORS);
        let Some(mut particle) = particle else { return landed };
        while !particle.is_given_up() && particle.is_covered(lighting) {
            let Some(at) = particle.advance(scene) else { break };
            if carries_map(scene, at.triangle, at.back) {
                let flux_lm = particle.flux_lm.luminance();
                let (triangle, back, place) = (at.triangle, at.back, [at.u, at.v]);
                landed.push(Landing { triangle, back, place, flux_lm });
            }
            if !particle.scatter_specular(scene, lighting) {
                break;
            }
        }
        landed
    };
    (0..count).into_par_iter().flat_map_iter(one).collect()
}
