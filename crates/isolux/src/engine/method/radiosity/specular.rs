//! Diffuse light by way of gloss, glass, curved mirrors and long chains of mirrors, which form factors and
//! images do not cover.
//!
//! Rays leave every receiver once, cosine-distributed, and pass specular surfaces. A ray that meets a diffuse
//! surface on a covered path is dropped. The others keep the vertices that they read: an extended form factor
//! (Sillion, Puech 1989, "A general two-pass method integrating specular and diffuse reflection").

use crate::engine::gather::{Gatherer, known_weights};
use crate::engine::light::Chain;
use crate::engine::plan::Plan;
use crate::engine::ray::{Dice, SurfacePoint, luminance_ratio, specular_step};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::{Body, Finish};
use crate::units::Rgb;
use isolux_geometry::Ray;
use rayon::prelude::*;

/// The number of specular surfaces after which a path is given up, as elsewhere.
const MAX_SPECULAR: u32 = 128;

/// The number of independent halves of the rays, for the standard error.
const HALVES: u64 = 2;

/// The vertices that one ray reads, with their weights and the share of their light.
#[derive(Clone, Copy, Debug)]
struct Entry {
    vertices: [u32; 3],
    weights: [f32; 3],
    share: [f32; 3],
}

/// The light that all receivers see on uncovered paths, for each half of their rays.
pub(super) struct Specular {
    rows: Vec<[Vec<Entry>; HALVES as usize]>,
    pub(super) rays: u64,
    /// The share of the gathered light whose rays were given up.
    pub(super) given_up: f64,
    /// The mean share of a receiver's view on such paths.
    pub(super) mean_share: f64,
}

impl Specular {
    /// Traces the rays; paths over `chains` are covered.
    pub(super) fn new(plan: &Plan, level: u32, chains: &[Chain], rays: u32, key: Key) -> Self {
        let tracer = Tracer { plan, level, chains };
        let receivers = &plan.mesh.gatherers[..plan.mesh.indirect_vertices];
        let row = |(k, gatherer): (usize, &Gatherer)| {
            if plan.mesh.standings[k].is_none() || !plan.mesh.carriers.is_active(k as u32) {
                return (Default::default(), 0.0);
            }
            let mut given_up = 0.0;
            let halves = [0, 1].map(|half| {
                let sequence = Sequence::new(key.with(k as u64).with(half));
                let mut entries = Vec::new();
                for index in 0..rays {
                    given_up += tracer.ray(gatherer, rays, &mut entries, sequence, index);
                }
                entries
            });
            (halves, given_up / HALVES as f64)
        };
        let found: Vec<_> = receivers.par_iter().enumerate().map(row).collect();
        let count = found.len().max(1) as f64;
        let given_up = found.iter().map(|(_, given_up)| given_up).sum::<f64>() / count;
        let rows: Vec<[Vec<Entry>; 2]> = found.into_iter().map(|(row, _)| row).collect();
        let share = |e: &Entry| Rgb(e.share.map(f64::from)).luminance();
        let sum: f64 = rows.iter().flatten().flatten().map(share).sum();
        Self {
            rays: HALVES * u64::from(rays) * rows.len() as u64,
            rows,
            given_up,
            mean_share: sum / (HALVES as f64 * count),
        }
    }

    /// The light that every receiver gets from light at the vertices, and the variance of its photometric
    /// value.
    pub(super) fn apply(&self, light: &[Rgb]) -> Vec<(Rgb, f64)> {
        let one = |entries: &Vec<Entry>| -> Rgb {
            let read = |e: &Entry| {
                let sum: Rgb =
                    (0..3).map(|k| light[e.vertices[k] as usize] * f64::from(e.weights[k])).sum();
                sum * Rgb(e.share.map(f64::from))
            };
            entries.iter().map(read).sum()
        };
        let row = |[a, b]: &[Vec<Entry>; 2]| {
            let (a, b) = (one(a), one(b));
            let half = 0.5 * (a - b).luminance();
            ((a + b) * 0.5, half * half)
        };
        self.rows.par_iter().map(row).collect()
    }
}

struct Tracer<'a, 's> {
    plan: &'a Plan<'s>,
    level: u32,
    chains: &'a [Chain],
}

/// The path from a receiver so far.
struct Way {
    /// The planar mirrors met, in order from the receiver.
    mirrors: Vec<u32>,
    /// Whether nothing else was met but panes, without refraction.
    is_plain: bool,
}

impl Tracer<'_, '_> {
    /// Adds the entries of one ray; returns the share of its light that was given up.
    fn ray(
        &self,
        gatherer: &Gatherer,
        rays: u32,
        entries: &mut Vec<Entry>,
        sequence: Sequence,
        index: u32,
    ) -> f64 {
        let scene = self.plan.scene;
        let mut dice = Dice::new(sequence, index);
        let axis = gatherer.normal.to_direction();
        let mut direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
        let mut ray = Ray::new(gatherer.origin, direction).skipping(gatherer.surface.triangle);
        let (mut throughput, mut of_start) = (Rgb::WHITE, 1.0);
        let mut way = Way { mirrors: Vec::new(), is_plain: true };
        for _ in 0..MAX_SPECULAR {
            let Some(hit) = scene.bvh().closest_hit(&ray) else { return 0.0 };
            let surface = SurfacePoint::from_hit(scene, &hit);
            let body = &scene.material(hit.triangle).body;
            if let Body::Opaque { front, back } = body
                && !self.is_covered(&way)
            {
                let finish = if surface.back { back } else { front };
                let share = throughput * (of_start / f64::from(rays));
                entries.extend(self.entry(&surface, finish, share));
            }
            let Some(next) = specular_step(body, &surface, direction, throughput, &mut dice) else {
                return 0.0;
            };
            let goes_on = matches!(body, Body::Dielectric(glass) if glass.thin)
                && next.direction == direction;
            let plane = self.plan.lighting.mirror_of(surface.triangle, surface.back);
            match plane.filter(|_| next.mirrored) {
                Some(plane) => way.mirrors.push(plane),
                None => way.is_plain &= goes_on,
            }
            of_start *= luminance_ratio(body, &surface, next.direction);
            (ray, direction, throughput) = (next.ray, next.direction, throughput * next.weight);
        }
        throughput.luminance() / f64::from(rays)
    }

    fn is_covered(&self, way: &Way) -> bool {
        let is_way = |chain: &Chain| chain.planes.iter().rev().eq(&way.mirrors);
        way.is_plain && self.chains.iter().any(is_way)
    }

    fn entry(&self, at: &SurfacePoint, finish: &Finish, share: Rgb) -> Option<Entry> {
        let plan = self.plan;
        let reflectance = plan.scene.diffuse_reflectance(finish, at.triangle, at.u, at.v);
        let share = share * reflectance;
        if share.is_black() {
            return None;
        }
        let corners =
            plan.mesh.elements.locate_above(self.level, at.triangle, at.back, at.u, at.v)?;
        let weights = known_weights(corners, &plan.mesh.standings)?;
        Some(Entry {
            vertices: corners.map(|(vertex, _)| vertex),
            weights: weights.map(|w| w as f32),
            share: share.0.map(|c| c as f32),
        })
    }
}
