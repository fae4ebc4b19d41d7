//! Particles on their way over specular surfaces: how they fly, and how many it takes.

use super::aim::{Aim, Aimed, specular};
use crate::ablation::without;
use crate::engine::gather::NOISE_SHARE;
use crate::engine::light::{Emission, Lighting, Particle, scatterings};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::{Key, Sequence};
use crate::scene::{Body, Scene};
use crate::units::Rgb;
use rayon::prelude::*;
use std::cell::Cell;

/// Particles a vertex and increment at most.
const PARTICLES_A_VERTEX: usize = 4;

/// Particles of an increment at least, and of a trial at most: let go or aimed.
const FEWEST: f64 = 1024.0;
const TRIED: u32 = 1 << 15;
const TRIED_AIMED: u32 = 1 << 13;

/// Particles of an increment at most.
const MOST: u32 = 1 << 20;

/// Particles are aimed where no more than this share of those let go come to a specular surface first, as told by so many.
const SELDOM: f64 = 0.25;
const LET_GO: u32 = 1024;

/// The part of the noise allowed, in the square, that caustics may take.
pub(crate) const LEAST_SHARE: f64 = 0.1;
const MOST_SHARE: f64 = 0.75;
/// What a particle costs, in rays that gather.
const RAYS_OF_ONE: f64 = 4.0;
/// How much may be in doubt of the error of interpolation, in the square, as a part of the accuracy asked for.
pub(crate) const DOUBT: f64 = 0.15;

/// The most particles of an increment for so many vertices.
pub(crate) fn particles(vertices: usize) -> u32 {
    (PARTICLES_A_VERTEX * vertices).next_power_of_two() as u32
}

/// How noisy caustics are.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CausticNoise {
    /// Mean square over the surface if one particle carried all light, lx2: it falls with their number.
    lx2: f64,
    /// On so many vertices, with which it grows.
    vertices: usize,
    /// The standard error of the mean square of what interpolation errs by if there were one particle, lx2: it falls likewise.
    doubt_lx2: f64,
}

impl CausticNoise {
    /// Tries some particles; also returns where they are best aimed, if they are, and the rays they took. `read` gives the vertices
    /// and weights at a place, and `areas_m2` what each stands for.
    pub(crate) fn tried(
        of: (&Scene, &Lighting),
        areas_m2: &[f64],
        read: impl Fn(&SurfacePoint) -> Option<[(u32, f64); 3]> + Sync,
        key: Key,
    ) -> (Self, Option<Aim>, u64) {
        // A deposit of flux f makes f w / area of illuminance at a vertex, by its weight there.
        let square = |at: &SurfacePoint, flux_lm: f64| -> f64 {
            let corners = read(at).into_iter().flatten();
            let known = corners.filter(|&(v, _)| areas_m2[v as usize] > 0.0);
            known.map(|(v, w)| flux_lm * flux_lm * w * w / areas_m2[v as usize]).sum()
        };
        let vertices = areas_m2.len();
        let most = particles(vertices);
        let Some(emission) = Emission::new(of.0).filter(|_| of.1.leaves_caustics()) else {
            return Default::default();
        };
        let is_seldom = specular_is_seldom_met(of.0, &emission, key);
        let aim =
            if is_seldom && !without("aimed-particles") { Aim::new(of.0, &emission) } else { None };
        let (aim, first_rays) = match aim {
            Some(aim) => {
                let flights = Flights::new(of, Some(&aim), most.min(TRIED_AIMED), key.with(1));
                let Some(flights) = flights else { return Default::default() };
                let (brought, rays) = flights.brought(&aim, square);
                (Some(aim.learned(&brought)), rays + u64::from(LET_GO))
            }
            None => (None, 0),
        };
        let count = most.min(if aim.is_some() { TRIED_AIMED } else { TRIED });
        let Some(flights) = Flights::new(of, aim.as_ref(), count, key) else {
            return Default::default();
        };
        // In the order of the particles, whoever flies them.
        let all = flights.squares(square);
        let sum: f64 = all.iter().map(|(square, _)| square).sum();
        let area_m2: f64 = areas_m2.iter().sum();
        // Each carries one part of `count`.
        let lx2 = if area_m2 > 0.0 { sum * f64::from(count) / area_m2 } else { 0.0 };
        let rays = first_rays + all.iter().map(|(_, rays)| rays).sum::<u64>();
        (Self { lx2, vertices, doubt_lx2: 0.0 }, aim, rays)
    }

    /// As seen of particles that shared all light: the mean square over the surface for one, lx2, on so many vertices, and the
    /// standard error of the squared error of interpolation.
    pub(crate) const fn seen(lx2: f64, vertices: usize, doubt_lx2: f64) -> Self {
        Self { lx2, vertices, doubt_lx2 }
    }

    /// Particles of each of so many increments on so many vertices for a target, if they are to make such a part of its noise.
    pub(crate) fn particles(
        self,
        vertices: usize,
        goal: (f64, f64),
        increments: u64,
        share: f64,
    ) -> u32 {
        let least = particles(vertices);
        // Without light to compare with, as few as there may be.
        let Some(wanted) = self.wanted(vertices, goal, increments, share) else { return least };
        // On few vertices the most is less than the fewest.
        let fewest = FEWEST.min(f64::from(least));
        let wanted = wanted.clamp(fewest, f64::from(least.max(MOST)));
        libm::exp2(libm::ceil(libm::log2(wanted))) as u32
    }

    /// Particles of all increments together for a target on the vertices of which this was seen.
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
        (goal_lx2 > 0.0).then(|| by_noise.max(self.doubt_lx2 / (DOUBT * goal_lx2)))
    }

    /// The part of all noise that caustics best have, beside so many rays of an increment that gather.
    pub(crate) fn share(
        self,
        vertices: usize,
        goal: (f64, f64),
        increments: u64,
        rays: f64,
    ) -> f64 {
        let alone = RAYS_OF_ONE * self.wanted(vertices, goal, increments, 1.0).unwrap_or(0.0);
        let share = alone.sqrt() / (alone.sqrt() + rays.sqrt()).max(f64::MIN_POSITIVE);
        share.clamp(LEAST_SHARE, MOST_SHARE)
    }
}

/// Particles that share all light, before they are reflected diffusely.
pub(crate) struct Flights<'a> {
    scene: &'a Scene,
    lighting: &'a Lighting<'a>,
    emission: Emission<'a>,
    /// Where most are sent, if they are.
    aim: Option<&'a Aim>,
    /// Those let go, and those aimed.
    sequences: [Sequence; 2],
    count: u32,
    /// Scatterings of each at most.
    most: u32,
}

impl<'a> Flights<'a> {
    /// None where there is no light.
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

    /// How many of them are let go as luminaires send them.
    fn unaimed(&self) -> u32 {
        if self.aim.is_some() { Aim::unaimed(self.count) } else { self.count }
    }

    /// Numbers for a particle, and whether it is aimed.
    fn dice(&self, index: u32) -> (Dice, Option<&'a Aim>) {
        let unaimed = self.unaimed();
        match index.checked_sub(unaimed) {
            Some(aimed) => (Dice::new(self.sequences[1], aimed), self.aim),
            None => (Dice::new(self.sequences[0], index), None),
        }
    }

    /// Follows a particle until it is reflected diffusely; `deposit` is told where it comes on its way, and with which
    /// flux. Returns the rays it took, and the flux that was given up.
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
        let mut rays = 1;
        while let Some(at) = particle.advance(scene) {
            if rays == 1
                && let Some(aim) = self.aim
            {
                let unaimed = f64::from(self.unaimed()) / f64::from(*count);
                let Some(weight) = aim.weight(emission, &aimed, &at, unaimed) else { break };
                particle.flux_lm = particle.flux_lm * weight;
            }
            let opaque = matches!(scene.material(at.triangle).body, Body::Opaque { .. });
            // What virtual luminaires bring is theirs.
            if opaque && !particle.is_covered(lighting) {
                deposit(&at, particle.flux_lm);
            }
            // Diffuse reflection ends a caustic.
            if !particle.scatter_specular(scene, lighting) {
                break;
            }
            if particle.is_given_up() {
                return (rays, Some(particle.flux_lm));
            }
            rays += 1;
        }
        (rays, None)
    }

    /// What every particle adds to a sum over its deposits, and its rays.
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

    /// The root of the mean of that over the particles aimed at each group, and the rays they took.
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

    /// All light, lm.
    pub(crate) fn flux_lm(&self) -> f64 {
        self.emission.flux_lm()
    }
}

/// Whether few of the particles that are let go come to a specular surface first.
fn specular_is_seldom_met(scene: &Scene, emission: &Emission, key: Key) -> bool {
    let sequence = Sequence::new(key.with(2));
    let is_specular = specular(scene);
    let meets = |index: &u32| {
        let aimed = Aimed::let_go(emission, &mut Dice::new(sequence, *index));
        let hit = aimed.and_then(|aimed| scene.bvh().closest_hit(&aimed.emitted.ray));
        hit.is_some_and(|hit| is_specular[scene.material_index(hit.triangle) as usize])
    };
    let met = (0..LET_GO).into_par_iter().filter(meets).count();
    met as f64 <= SELDOM * f64::from(LET_GO)
}
