//! The flights of particles over specular surfaces, and their number.

use super::aim::{Aim, Aimed, specular};
use crate::ablation::without;
use crate::engine::gather::NOISE_SHARE;
use crate::engine::light::{Emission, Lighting, Particle, scatterings};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::{Key, Sequence};
use crate::scene::{Body, Scene};
use crate::units::Rgb;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::cell::Cell;

/// The largest number of particles per vertex and increment.
const MOST_PARTICLES_A_VERTEX: usize = 4;

/// The least number of particles in an increment.
const FEWEST_PARTICLES: f64 = 1024.0;
/// The largest number of unaimed particles in a trial.
const MOST_TRIAL_PARTICLES: u32 = 1 << 15;
/// The largest number of aimed particles in a trial.
const MOST_AIMED_TRIAL_PARTICLES: u32 = 1 << 13;

/// The largest number of particles in an increment.
const MOST_PARTICLES: u32 = 1 << 20;

/// The largest share of unaimed particles that meet a specular surface first for which particles are aimed.
const SELDOM_MET_SHARE: f64 = 0.25;
/// The number of unaimed particles that measure this share.
const UNAIMED_PARTICLES: u32 = 1024;

/// The least share of the allowed noise variance that caustics may have.
pub(crate) const LEAST_SHARE: f64 = 0.1;
/// The largest share of the allowed noise variance that caustics may have.
const MOST_VARIANCE_SHARE: f64 = 0.75;
/// The cost of a particle, in gathering rays.
const RAYS_A_PARTICLE: f64 = 4.0;
/// The largest uncertainty of the squared interpolation error, as a share of the squared accuracy goal.
pub(crate) const DOUBT_SHARE: f64 = 0.15;

/// The most particles of an increment for a number of vertices.
pub(crate) fn particles(vertices: usize) -> u32 {
    (MOST_PARTICLES_A_VERTEX * vertices).next_power_of_two() as u32
}

/// The noise of caustics.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct CausticNoise {
    /// The mean square over the surface if one particle carried all light, lx2. It falls with the number of
    /// particles.
    lx2: f64,
    /// The number of vertices, with which the noise grows.
    vertices: usize,
    /// The standard error of the mean square interpolation error for one particle, lx2. It falls in the same
    /// way.
    doubt_lx2: f64,
}

/// The result of a trial with particles.
#[derive(Default)]
pub(crate) struct ParticleTrial {
    pub(crate) noise: CausticNoise,
    /// The aim of the particles, if aiming pays.
    pub(crate) aim: Option<Aim>,
    /// The number of rays traced.
    pub(crate) rays: u64,
}

impl CausticNoise {
    /// Measures the noise with some particles. `read` gives the vertices and weights at a place; `areas_m2`
    /// are the areas that vertices stand for.
    pub(crate) fn tried(
        of: (&Scene, &Lighting),
        areas_m2: &[f64],
        read: impl Fn(&SurfacePoint) -> Option<[(u32, f64); 3]> + Sync,
        key: Key,
    ) -> ParticleTrial {
        // A deposit of flux f adds the illuminance f w / area at a vertex with weight w.
        let square = |at: &SurfacePoint, flux_lm: f64| -> f64 {
            let corners = read(at).into_iter().flatten();
            let known = corners.filter(|&(v, _)| areas_m2[v as usize] > 0.0);
            known.map(|(v, w)| flux_lm * flux_lm * w * w / areas_m2[v as usize]).sum()
        };
        let vertices = areas_m2.len();
        let most = particles(vertices);
        let Some(emission) = Emission::new(of.0).filter(|_| of.1.leaves_caustics()) else {
            return ParticleTrial::default();
        };
        let is_seldom = specular_is_seldom_met(of.0, &emission, key);
        let aim =
            if is_seldom && !without("aimed-particles") { Aim::new(of.0, &emission) } else { None };
        let (aim, first_rays) = match aim {
            Some(aim) => {
                let flights =
                    Flights::new(of, Some(&aim), most.min(MOST_AIMED_TRIAL_PARTICLES), key.with(1));
                let Some(flights) = flights else { return ParticleTrial::default() };
                let (brought, rays) = flights.brought(&aim, square);
                (Some(aim.learned(&brought)), rays + u64::from(UNAIMED_PARTICLES))
            }
            None => (None, 0),
        };
        let count =
            most.min(if aim.is_some() { MOST_AIMED_TRIAL_PARTICLES } else { MOST_TRIAL_PARTICLES });
        let Some(flights) = Flights::new(of, aim.as_ref(), count, key) else {
            return ParticleTrial::default();
        };
        // The squares are in the order of the particles, whichever threads trace them.
        let all = flights.squares(square);
        let sum: f64 = all.iter().map(|(square, _)| square).sum();
        let area_m2: f64 = areas_m2.iter().sum();
        // Each particle carries one part in `count` of the light.
        let lx2 = if area_m2 > 0.0 { sum * f64::from(count) / area_m2 } else { 0.0 };
        let rays = first_rays + all.iter().map(|(_, rays)| rays).sum::<u64>();
        ParticleTrial { noise: Self { lx2, vertices, doubt_lx2: 0.0 }, aim, rays }
    }

    /// The noise as measured with particles that share all light: the mean square over the surface for one
    /// particle, lx2, the number of vertices, and the standard error of the squared interpolation error, lx2.
    pub(crate) const fn seen(lx2: f64, vertices: usize, doubt_lx2: f64) -> Self {
        Self { lx2, vertices, doubt_lx2 }
    }

    /// The number of particles in each increment for an accuracy goal, if they are to cause this share of its
    /// noise variance.
    pub(crate) fn particles(
        self,
        vertices: usize,
        goal: (f64, f64),
        increments: u64,
        share: f64,
    ) -> u32 {
        let least = particles(vertices);
        // Without light to compare with, the number is the least.
        let Some(wanted) = self.wanted(vertices, goal, increments, share) else { return least };
        // On few vertices the most may be less than [`FEWEST_PARTICLES`].
        let fewest = FEWEST_PARTICLES.min(f64::from(least));
        let wanted = wanted.clamp(fewest, f64::from(least.max(MOST_PARTICLES)));
        libm::exp2(libm::ceil(libm::log2(wanted))) as u32
    }

    /// The number of particles in all increments together for a goal, on the vertices of the measurement.
    pub(crate) fn needed(self, goal: (f64, f64)) -> f64 {
        self.wanted(self.vertices, goal, 1, 1.0).unwrap_or(0.0)
    }

    fn wanted(
        self,
        vertices: usize,
        (target, reference_lx): (f64, f64),
        increments: u64,
        share: f64,
    ) -> Option<f64> {
        let goal_lx2 = target * target * reference_lx * reference_lx * increments as f64;
        let growth = vertices as f64 / self.vertices.max(1) as f64;
        let by_noise = self.lx2 * growth / (share * NOISE_SHARE * NOISE_SHARE * goal_lx2);
        (goal_lx2 > 0.0).then(|| by_noise.max(self.doubt_lx2 / (DOUBT_SHARE * goal_lx2)))
    }

    /// The optimal share of caustics in the noise variance, given the number of gathering rays of an
    /// increment.
    pub(crate) fn share(
        self,
        vertices: usize,
        goal: (f64, f64),
        increments: u64,
        rays: f64,
    ) -> f64 {
        let alone = RAYS_A_PARTICLE * self.wanted(vertices, goal, increments, 1.0).unwrap_or(0.0);
        let share = alone.sqrt() / (alone.sqrt() + rays.sqrt()).max(f64::MIN_POSITIVE);
        share.clamp(LEAST_SHARE, MOST_VARIANCE_SHARE)
    }
}

/// The share of the flux below which a reflection is weak: roulette follows stronger ones always.
const WEAK_SHARE: f64 = 0.5;

/// Particles that share all light, until they are reflected diffusely.
pub(crate) struct Flights<'a> {
    scene: &'a Scene,
    lighting: &'a Lighting<'a>,
    emission: Emission<'a>,
    /// The aim of most particles, if they are aimed.
    aim: Option<&'a Aim>,
    /// The sequences of unaimed and of aimed particles.
    sequences: [Sequence; 2],
    count: u32,
    /// The largest number of scatterings of a particle.
    most: u32,
}

impl<'a> Flights<'a> {
    /// The flights of `count` particles; `None` where there is no light.
    pub(crate) fn new(
        (scene, lighting): (&'a Scene, &'a Lighting<'a>),
        aim: Option<&'a Aim>,
        count: u32,
        key: Key,
    ) -> Option<Self> {
        let emission = Emission::new(scene)?;
        let sequences = [Sequence::new(key), Sequence::new(key.with(0))];
        Some(Self { scene, lighting, emission, aim, sequences, count, most: scatterings(scene) })
    }

    /// The number of particles that are not aimed.
    fn unaimed(&self) -> u32 {
        if self.aim.is_some() { Aim::unaimed(self.count) } else { self.count }
    }

    /// The random numbers of a particle, and its aim.
    fn dice(&self, index: u32) -> (Dice, Option<&'a Aim>) {
        let unaimed = self.unaimed();
        match index.checked_sub(unaimed) {
            Some(aimed) => (Dice::new(self.sequences[1], aimed), self.aim),
            None => (Dice::new(self.sequences[0], index), None),
        }
    }

    /// Follows a particle until it is reflected diffusely. `deposit` receives the places on its way and its
    /// flux there. Returns the number of rays, and the flux given up, if any.
    pub(crate) fn fly(
        &self,
        index: u32,
        deposit: impl Fn(&SurfacePoint, Rgb),
    ) -> (u64, Option<Rgb>) {
        let Self { scene, lighting, emission, count, most, .. } = self;
        let (mut dice, aim) = self.dice(index);
        let aimed = match aim {
            Some(aim) => aim.send(scene, emission, &mut dice),
            None => Aimed::let_go(emission, &mut dice),
        };
        let Some(aimed) = aimed else { return (0, None) };
        let flux_lm = emission.flux_lm() / f64::from(*count);
        let mut particle = Particle::sent(&aimed.emitted, flux_lm, dice, *most);
        let (mut rays, mut is_spared) = (1, true);
        while let Some(at) = particle.advance(scene) {
            if rays == 1
                && let Some(aim) = self.aim
            {
                let unaimed = f64::from(self.unaimed()) / f64::from(*count);
                let Some(weight) = aim.weight(emission, &aimed, &at, unaimed) else { break };
                particle.flux_lm = particle.flux_lm * weight;
            }
            let opaque = matches!(scene.material(at.triangle).body, Body::Opaque { .. });
            // Light of virtual luminaires is counted there.
            if opaque && !particle.is_covered(lighting) {
                deposit(&at, particle.flux_lm);
            }
            // Diffuse reflection ends a caustic. Roulette at a weak reflection spares each particle once: most would
            // end before they bring any light.
            let before_lm = particle.flux_lm.max_channel();
            let goes_on = match is_spared {
                true => particle.follow_specular(scene, lighting),
                false => particle.scatter_specular(scene, lighting),
            };
            if !goes_on {
                break;
            }
            is_spared &= particle.flux_lm.max_channel() >= WEAK_SHARE * before_lm;
            if particle.is_given_up() {
                return (rays, Some(particle.flux_lm));
            }
            rays += 1;
        }
        (rays, None)
    }

    /// The sum of `square` over the deposits of each particle, and its number of rays.
    fn squares(&self, square: impl Fn(&SurfacePoint, f64) -> f64 + Sync) -> Vec<(f64, u64)> {
        let of_one = |index: u32| {
            let sum = Cell::new(0.0);
            let (rays, _) = self.fly(index, |at, flux_lm| {
                sum.set(sum.get() + square(at, flux_lm.luminance()));
            });
            (sum.get(), rays)
        };
        (0..self.count).into_par_iter().map(of_one).collect()
    }

    /// The root mean of these sums over the particles aimed at each group, and the number of rays.
    fn brought(
        &self,
        aim: &Aim,
        square: impl Fn(&SurfacePoint, f64) -> f64 + Sync,
    ) -> (Vec<f64>, u64) {
        let all = self.squares(square);
        let mut sums = vec![(0.0, 0.0); aim.groups()];
        for (index, (square, _)) in (0..).zip(&all) {
            if let (mut dice, Some(aim)) = self.dice(index) {
                let (sum, count) = &mut sums[aim.group(&mut dice)];
                *sum += square;
                *count += 1.0;
            }
        }
        let brought =
            sums.into_iter().map(|(sum, count): (f64, f64)| (sum / count.max(1.0)).sqrt());
        (brought.collect(), all.iter().map(|(_, rays)| rays).sum())
    }

    /// The flux of all luminaires, lm.
    pub(crate) fn flux_lm(&self) -> f64 {
        self.emission.flux_lm()
    }
}

/// Whether few unaimed particles meet a specular surface first.
fn specular_is_seldom_met(scene: &Scene, emission: &Emission, key: Key) -> bool {
    let sequence = Sequence::new(key.with(2));
    let is_specular = specular(scene);
    let meets = |index: &u32| {
        let aimed = Aimed::let_go(emission, &mut Dice::new(sequence, *index));
        let hit = aimed.and_then(|aimed| scene.bvh().closest_hit(&aimed.emitted.ray));
        hit.is_some_and(|hit| is_specular[scene.material_index(hit.triangle) as usize])
    };
    let met = (0..UNAIMED_PARTICLES).into_par_iter().filter(meets).count();
    met as f64 <= SELDOM_MET_SHARE * f64::from(UNAIMED_PARTICLES)
}
