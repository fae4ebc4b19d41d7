//! A first guess of what a run will need, without running it.

use isolux::elements::Subdivision;
use isolux::engine::SolveRequest;
use isolux::geometry::{Point, Ray, Vector};
use isolux::scene::Scene;
use rayon::prelude::*;
use serde::Serialize;
use std::time::Instant;

/// Elements, sums and gathered rays of a receiver: 2900 in the demo interior.
const BYTES_A_RECEIVER: u64 = 2900;
/// Mesh and hierarchy of a triangle: 3 vertices, normals, texture coordinates, and its nodes.
const BYTES_A_TRIANGLE: u64 = 400;
/// Receivers that refinement adds at 1 %: 3,000 in the empty cube, 34,000 in Cornell boxes; it goes
/// with the inverse of the accuracy.
const REFINED_AT_ONE_PERCENT: f64 = 15_000.0;
/// The engine starts with at least so many receivers.
const FEWEST_RECEIVERS: u64 = 1500;
/// Rays of a receiver at 1 %, pilots and increments together; it goes with the inverse of the
/// accuracy. 500 in the cube, 300 to 450 in Cornell boxes, 1200 in the demo interior.
const RAYS_A_RECEIVER_AT_ONE_PERCENT: f64 = 600.0;
/// What a run traces in the time of so many bare rays: the rest is direct light and bookkeeping.
/// Between 4 and 10 in the cube, Cornell boxes and the demo interior.
const BARE_RAYS_A_RAY: f64 = 6.0;
/// Rays to measure the ray kernel with: some hundredths of a second.
const MEASURED_RAYS: u32 = 1 << 15;

/// Sizes of a run, right to a factor of four or so.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Estimate {
    /// Vertices of the elements.
    pub receivers: u64,
    /// Memory, bytes.
    pub memory_bytes: u64,
    /// Time to the accuracy asked for on this machine, s.
    pub time_s: f64,
}

impl Estimate {
    /// From the size of the scene and the speed of rays in it.
    pub(crate) fn of(scene: &Scene, request: &SolveRequest) -> Self {
        let effort = 0.01 / request.accuracy.unwrap_or(0.01);
        let first = (Subdivision::new(scene).vertex_count() as u64).max(FEWEST_RECEIVERS);
        let receivers = first + (REFINED_AT_ONE_PERCENT * effort) as u64;
        let rays = receivers as f64 * RAYS_A_RECEIVER_AT_ONE_PERCENT * effort;
        let textures: u64 = scene.textures().iter().map(|t| t.srgb.len() as u64).sum();
        let triangles = u64::from(scene.triangle_count());
        let memory_bytes = receivers * BYTES_A_RECEIVER + triangles * BYTES_A_TRIANGLE + textures;
        let time_s = rays * BARE_RAYS_A_RAY / rays_per_second(scene);
        Self {
            receivers,
            memory_bytes: memory_bytes.min(request.max_memory_bytes),
            time_s: request.time_limit.map_or(time_s, |limit| time_s.min(limit.as_secs_f64())),
        }
    }
}

/// Speed of the ray kernel from surfaces of the scene.
fn rays_per_second(scene: &Scene) -> f64 {
    let started = Instant::now();
    let hits = (0..MEASURED_RAYS).into_par_iter().filter(|&k| {
        let triangle = (u64::from(k) * 40_503 % u64::from(scene.triangle_count())) as u32;
        let ray = ray_from(scene.triangle(triangle).centroid(), triangle, k);
        scene.bvh().closest_hit(&ray).is_some()
    });
    // The count is of no interest, but must be made.
    std::hint::black_box(hits.count());
    f64::from(MEASURED_RAYS) / started.elapsed().as_secs_f64().max(1e-6)
}

/// Directions spread over the sphere by the plastic number (Roberts 2018).
fn ray_from(from: Point, triangle: u32, number: u32) -> Ray {
    let spread = |step: f64| 2.0 * (f64::from(number) * step).fract() - 1.0;
    let towards = Vector::new(
        spread(0.819_172_513_396),
        spread(0.671_043_606_704),
        spread(0.549_700_477_901),
    );
    let direction = towards.direction().unwrap_or(isolux::geometry::Direction::Z);
    Ray::new(from, direction).skipping(triangle)
}
