//! Particles on their way over specular surfaces: how they fly, and how many it takes.

use super::direct::Lighting;
use super::emission::Emission;
use super::particle::{Particle, scatterings};
use super::surface::SurfacePoint;
use super::trial::NOISE_SHARE;
use crate::sampling::{Key, Sequence};
use crate::scene::{Body, Scene};
use crate::units::Rgb;
use rayon::prelude::*;
use std::cell::Cell;

/// Particles a vertex and increment at most.
const PARTICLES_A_VERTEX: usize = 4;

/// Particles of an increment at least, and of a trial at most.
const FEWEST: f64 = 1024.0;
const TRIED: u32 = 1 << 15;

/// The part of the noise allowed, in the square, that caustics may take.
const SHARE_OF_NOISE: f64 = 0.1;

/// The most particles of an increment for so many vertices.
pub(super) fn particles(vertices: usize) -> u32 {
    (PARTICLES_A_VERTEX * vertices).next_power_of_two() as u32
}

/// How noisy caustics are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CausticNoise {
    /// Mean square over the surface if one particle carried all light, lx2: it falls with their number.
    lx2: f64,
    /// On so many vertices, with which it grows.
    vertices: usize,
}

impl CausticNoise {
    /// Tries some particles; also returns the rays they took. `read` gives the vertices and weights at a place, and
    /// `areas_m2` what each stands for.
    pub(super) fn tried(
        of: (&Scene, &Lighting),
        areas_m2: &[f64],
        read: impl Fn(&SurfacePoint) -> Option<[(u32, f64); 3]> + Sync,
        key: Key,
    ) -> (Self, u64) {
        let vertices = areas_m2.len();
        let count = particles(vertices).min(TRIED);
        let flights = Flights::new(of, count, key).filter(|of| of.lighting.leaves_caustics());
        let Some(flights) = flights else { return (Self::default(), 0) };
        // A deposit of flux f makes f w / area of illuminance at a vertex, by its weight there.
        let square = |at: &SurfacePoint, flux_lm: f64| -> f64 {
            let corners = read(at).into_iter().flatten();
            let known = corners.filter(|&(v, _)| areas_m2[v as usize] > 0.0);
            known.map(|(v, w)| flux_lm * flux_lm * w * w / areas_m2[v as usize]).sum()
        };
        let of_one = |index: u32| {
            let sum = Cell::new(0.0);
            let (rays, _) = flights.fly(index, |at, flux_lm| {
                sum.set(sum.get() + square(at, flux_lm.luminance()));
            });
            (sum.get(), rays)
        };
        // In the order of the particles, whoever flies them.
        let all: Vec<(f64, u64)> = (0..count).into_par_iter().map(of_one).collect();
        let sum: f64 = all.iter().map(|(square, _)| square).sum();
        let area_m2: f64 = areas_m2.iter().sum();
        // Each carries one part of `count`.
        let lx2 = if area_m2 > 0.0 { sum * f64::from(count) / area_m2 } else { 0.0 };
        (Self { lx2, vertices }, all.iter().map(|(_, rays)| rays).sum())
    }

    /// Particles of each of so many increments on so many vertices for a target.
    pub(super) fn particles(
        self,
        vertices: usize,
        (target, rms_lx): (f64, f64),
        increments: u64,
    ) -> u32 {
        let allowed_lx = NOISE_SHARE * target * rms_lx;
        let growth = vertices as f64 / self.vertices.max(1) as f64;
        let allowed_lx2 = SHARE_OF_NOISE * allowed_lx * allowed_lx * increments as f64;
        let most = particles(vertices);
        if allowed_lx2 <= 0.0 {
            return most;
        }
        // On few vertices the most is less than the fewest.
        let wanted = (self.lx2 * growth / allowed_lx2).max(FEWEST).min(f64::from(most));
        libm::exp2(libm::ceil(libm::log2(wanted))) as u32
    }
}

/// Particles that share all light, before they are reflected diffusely.
pub(super) struct Flights<'a> {
    scene: &'a Scene,
    lighting: &'a Lighting<'a>,
    emission: Emission<'a>,
    sequence: Sequence,
    count: u32,
    /// Scatterings of each at most.
    most: u32,
}

impl<'a> Flights<'a> {
    /// None where there is no light.
    pub(super) fn new(
        (scene, lighting): (&'a Scene, &'a Lighting<'a>),
        count: u32,
        key: Key,
    ) -> Option<Self> {
        let emission = Emission::new(scene)?;
        let (sequence, most) = (Sequence::new(key), scatterings(scene));
        Some(Self { scene, lighting, emission, sequence, count, most })
    }

    /// Follows a particle until it is reflected diffusely; `deposit` is told where it comes on its way, and with which
    /// flux. Returns the rays it took, and the flux that was given up.
    pub(super) fn fly(
        &self,
        index: u32,
        deposit: impl Fn(&SurfacePoint, Rgb),
    ) -> (u64, Option<Rgb>) {
        let Self { scene, lighting, emission, sequence, count, most } = self;
        let Some(mut particle) = Particle::emit(emission, *sequence, index, *count, *most) else {
            return (0, None);
        };
        let mut rays = 1;
        while let Some(at) = particle.advance(scene) {
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

    /// All light, lm.
    pub(super) fn flux_lm(&self) -> f64 {
        self.emission.flux_lm()
    }
}
