//! Rays a second of one thread in a furnished hall, closest hit and any hit.
//!
//! `cargo run --release -p isolux-geometry --example ray_rates`
#![allow(clippy::print_stdout, reason = "a program whose result is a table")]

#[path = "../tests/kernel/room.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod room;

use isolux_geometry::bvh::{InstructionSet, Preset};
use isolux_geometry::{Bvh, Ray};
use room::Random;
use std::hint::black_box;
use std::time::{Duration, Instant};

const RAYS: usize = 1 << 17;
const ROUNDS: usize = 7;

fn main() {
    let mesh = room::hall();
    let start = Instant::now();
    let bvh = Bvh::build(mesh, |_| false);
    println!(
        "{} triangles, built in {:.1} ms",
        bvh.mesh().len(),
        1e3 * start.elapsed().as_secs_f64()
    );
    let walk = walk(&bvh);
    let segments = segments(&walk);
    println!("{:10} {:>20} {:>20}", "Mrays/s", "closest", "any");
    for set in InstructionSet::ALL {
        if !set.is_available() {
            println!("{set:?}: not on this processor");
            continue;
        }
        let bvh = Bvh::build_with(Preset::Medium, set, bvh.mesh().clone(), |_| false);
        let closest = rate(&walk, |ray| bvh.closest_hit(ray).is_some());
        let any = rate(&segments, |ray| bvh.any_hit(ray));
        println!("{:10} {closest:>20} {any:>20}", format!("{set:?}"));
    }
}

/// Cosine-distributed reflections, each ray from where the one before arrived: incoherent, and
/// where light goes. A path starts anew with probability 1/5.
fn walk(bvh: &Bvh) -> Vec<Ray> {
    let mut random = Random(1);
    let mut next = room::random_ray(&mut random);
    let mut rays = Vec::with_capacity(RAYS);
    while rays.len() < RAYS {
        rays.push(next);
        next = match bvh.closest_hit(&next) {
            Some(hit) if random.below(5) > 0 => reflected(bvh, &next, hit, &mut random),
            _ => room::random_ray(&mut random),
        };
    }
    rays
}

fn reflected(bvh: &Bvh, ray: &Ray, hit: isolux_geometry::Hit, random: &mut Random) -> Ray {
    let triangle = bvh.mesh().triangle(hit.triangle);
    let Some(normal) = triangle.normal() else { return *ray };
    let normal = if hit.back { -normal } else { normal };
    let point = triangle.point(f64::from(hit.u), f64::from(hit.v));
    // A point of the unit sphere around the tip of the normal is cosine-distributed.
    let sphere = loop {
        let v = random.direction().map(f64::from);
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.01 && length < 1.0 {
            break isolux_geometry::Vector::from(v) / length;
        }
    };
    match (normal.to_vector() + sphere).direction() {
        Some(direction) => Ray::new(point, direction).skipping(hit.triangle),
        None => *ray,
    }
}

/// From every start of the walk to that of a ray a while later: two thirds of them are blocked.
fn segments(walk: &[Ray]) -> Vec<Ray> {
    let later = walk.iter().cycle().skip(walk.len() / 3);
    walk.iter().zip(later).map(|(from, to)| Ray::between(from.origin, to.origin)).collect()
}

/// Millions a second in the best round, and the share of rays that hit.
fn rate(rays: &[Ray], query: impl Fn(&Ray) -> bool) -> String {
    let mut best = Duration::MAX;
    let mut hits = 0;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        hits = black_box(rays.iter().filter(|ray| query(black_box(ray))).count());
        best = best.min(start.elapsed());
    }
    let rate = rays.len() as f64 / best.as_secs_f64() * 1e-6;
    format!("{rate:.2} ({:.1} % hit)", 100.0 * hits as f64 / rays.len() as f64)
}
