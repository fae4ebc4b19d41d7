//! Where the light of luminaires lands, by particles that go no further than by mirrors.

use super::emission::Emission;
use super::lighting::Lighting;
use super::particle::Particle;
use crate::elements::carries_map;
use crate::sampling::Sequence;
use crate::scene::Scene;
use rayon::prelude::*;

/// Particles that tell whether there is anything, and how many more tell where it is.
pub(crate) const FIRST: u32 = 1 << 11;
pub(crate) const MORE: u32 = 1 << 14;
/// So many of either for so many luminaires, and for more of them as many times as many, up to so many times.
const OF_FEW: u32 = 8;
const MOST_TIMES: u32 = 16;
/// They go no further than by so many mirrors.
const SCATTERINGS: u32 = 16;

/// What comes to a place differs from what is thought if it does by so many times its standard error: of fifteen thousand
/// places one does by chance.
pub(crate) const BELIEVED: f64 = 4.0;

/// Flux that has come to a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Landing {
    pub(crate) triangle: u32,
    pub(crate) back: bool,
    pub(crate) place: [f64; 2],
    pub(crate) flux_lm: f64,
}

/// What comes to the places of some surface.
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

/// So many times as many particles tell of the luminaires that there are.
pub(crate) fn times(emission: &Emission<'_>) -> u32 {
    (emission.count() as u32 / OF_FEW).clamp(1, MOST_TIMES)
}

/// Where so many particles come straight or over plane mirrors, on surfaces that carry a map.
pub(crate) fn landed(
    (scene, lighting): (&Scene, &Lighting<'_>),
    emission: &Emission<'_>,
    count: u32,
    sequence: Sequence,
) -> Vec<Landing> {
    let one = |index: u32| {
        let mut landed = Vec::new();
        let particle = Particle::emit(emission, sequence, index, count, SCATTERINGS);
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
