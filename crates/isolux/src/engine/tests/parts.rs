//! What maps lack of caustics, seen in parts of elements.

use super::errors::room;
use super::*;
use crate::elements::Subdivision;
use crate::engine::gather::Unlit;
use crate::engine::light::Lighting;
use crate::engine::method::deposit;
use crate::engine::particle::{ElementParts, PARTS, Squared, part_of, read_in_parts, samples};
use crate::engine::pilot::{PilotRequest, pilot};
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, NEVER, Noise};
use crate::map::Standing;
use crate::scene::{Body, Dielectric};
use std::sync::Arc;

#[test]
fn parts_of_an_element_are_told_apart_and_have_their_middles() {
    let standings = [Some(Standing::Open); 3];
    // The first weight, read in the middles, tells where they are; so do the others.
    let read = |corner: usize| {
        let mut values = [0.0; 3];
        values[corner] = 1.0;
        read_in_parts([0, 1, 2], values, &standings)
    };
    let (a, b, c) = (read(0), read(1), read(2));
    for part in 0..PARTS {
        assert_eq!(part_of([a[part], b[part], c[part]]), part);
    }
    // They are of one size: their middles lie about that of the element.
    let mean = a.iter().sum::<f64>() / PARTS as f64;
    assert!((mean - 1.0 / 3.0).abs() < 1e-12, "{mean}");
    // Nothing is read where nothing is known.
    assert_eq!(read_in_parts([0, 1, 2], [1.0; 3], &[None; 3]), [0.0; PARTS]);
}

/// Sums over increments of what parts lack: the same in all, and noise of the middle of two numbers.
fn sums(
    parts: &ElementParts,
    lacking: impl Fn(usize) -> f64,
    sigma: f64,
    increments: u64,
) -> Accumulator {
    let mut sums = Accumulator::new(parts.count(), 100.0);
    for increment in 0..increments {
        let key = Key::new(7).with(increment);
        // Even between -1 and 1, variance one third.
        let noise = |k: usize| 2.0 * key.with(k as u64).uniform() - 1.0;
        let of: Vec<f64> = (0..parts.count()).map(|k| lacking(k) + sigma * noise(k)).collect();
        sums.add(samples(&of));
    }
    sums
}

fn some_parts() -> (ElementParts, f64) {
    let scene = room();
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(0.4, 10_000);
    let nodes: Vec<u32> = subdivision.leaves().collect();
    let area_m2 = nodes.iter().map(|&n| subdivision.triangle(n).area()).sum();
    (ElementParts::new(&subdivision, &nodes), area_m2)
}

#[test]
fn errors_are_seen_beyond_noise() {
    let (parts, area_m2) = some_parts();
    let root = |lacking: f64, sigma: f64, noise_is: Noise| {
        let seen: Squared = parts.errors(&sums(&parts, |_| lacking, sigma, 8)).into_iter().sum();
        (seen.with(noise_is) / area_m2).sqrt()
    };
    // A fourth of the squared error is taken to differ within parts.
    let whole = 1.25_f64.sqrt();
    assert!((root(3.0, 0.0, Noise::TakenOff) - 3.0 * whole).abs() < 1e-5);
    assert_eq!(root(0.0, 0.0, Noise::Counted), 0.0);
    // Noise of the mean of eight, 2 lx, over thousands of parts: what is seen of it is far less, what is in doubt little more.
    let sigma = 2.0 * (3.0_f64 * 8.0).sqrt();
    assert!(root(0.0, sigma, Noise::Counted) < 0.7, "{}", root(0.0, sigma, Noise::Counted));
    let seen = root(3.0, sigma, Noise::TakenOff);
    assert!((seen - 3.0 * whole).abs() < 0.25, "{seen}");
}

#[test]
fn errors_lie_at_their_vertices() {
    let (parts, _) = some_parts();
    let errors = parts.errors(&sums(&parts, |k| if k < PARTS { 8.0 } else { 0.0 }, 0.0, 2));
    let at_vertices = parts.at_vertices(&errors);
    let with: Vec<f64> =
        at_vertices.iter().map(|&(_, lx2)| lx2).filter(|&lx2| lx2 > 1e-6).collect();
    assert_eq!(with.len(), 3);
    // The mean of the elements there: some have none.
    assert!(with.iter().all(|&lx2| lx2 < 1.25 * 64.0));
}

/// A room in which a ball of glass of 0.3 m throws the light of a lamp together on the floor.
fn room_with_a_lens() -> Scene {
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    shapes.push(ball([1.0, 1.0, 0.6], 0.3, 48));
    let glass = Dielectric { ior: 1.5, transmittance: Rgb::WHITE, thin: false };
    let glass = Material { name: "glass".into(), body: Body::Dielectric(glass) };
    scene(shapes, vec![painted(Rgb::grey(0.5)), glass], vec![isotropic([1.6, 1.3, 2.3], 100.0)])
}

/// A ball of flat triangles, fronts outside.
fn ball(middle: [f64; 3], radius_m: f64, segments: u32) -> Shape {
    let rings = segments / 2;
    let at = |ring: u32, k: u32| {
        let (s, c) = libm::sincos(std::f64::consts::PI * f64::from(ring) / f64::from(rings));
        let (sk, ck) =
            libm::sincos(2.0 * std::f64::consts::PI * f64::from(k) / f64::from(segments));
        let unit = [s * ck, s * sk, c];
        ([0, 1, 2].map(|axis| middle[axis] + radius_m * unit[axis]), unit)
    };
    let (positions, normals): (Vec<_>, Vec<_>) =
        (0..=rings).flat_map(|ring| (0..segments).map(move |k| at(ring, k))).unzip();
    let vertex = |ring: u32, k: u32| ring * segments + k % segments;
    let mut triangles = Vec::new();
    for (ring, k) in (0..rings).flat_map(|ring| (0..segments).map(move |k| (ring, k))) {
        if ring > 0 {
            triangles.push([vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring, k + 1)]);
        }
        if ring + 1 < rings {
            triangles.push([vertex(ring, k), vertex(ring + 1, k), vertex(ring + 1, k + 1)]);
        }
    }
    Shape {
        name: "ball".into(),
        positions,
        triangles,
        material: 1,
        normals: Some(normals),
        ..Shape::default()
    }
}

fn request(target: f64) -> PilotRequest {
    PilotRequest {
        target,
        goal: target,
        mesh_target: 1.0,
        seed: 1,
        is_fitted: true,
        is_hybrid: true,
        refines_caustics: true,
        max_vertices: 100_000,
        most_for_indirect_light: None,
        least_edge_m: None,
        deadline: NEVER.clone(),
        end: NEVER.clone(),
    }
}

/// What caustics err by on the elements of a plan, of all light, by so many particles altogether.
fn caustic_error(plan: &Plan, particles: u32) -> f64 {
    let increments = 8;
    let mut sums = Accumulator::new(plan.errors.parts.count(), plan.light.reference_lx);
    for k in 0..increments {
        sums.add(samples(
            &deposit(plan, particles / increments, Key::new(99).with(u64::from(k)), &NEVER)
                .unwrap()
                .lacking,
        ));
    }
    let seen: Squared = plan.errors.parts.errors(&sums).into_iter().sum();
    (seen.with(Noise::TakenOff) / plan.area_m2()).sqrt() / plan.light.reference_lx
}

#[test]
fn elements_are_as_fine_as_a_sharp_caustic_needs() {
    let scene = room_with_a_lens();
    let lighting = Lighting::new(&scene);
    let mut coarse = pilot(&scene, &lighting, &request(1.0), &Unlit::default(), &mut |_| true);
    let mut fine = pilot(&scene, &lighting, &request(0.03), &Unlit::default(), &mut |_| true);
    let all_parts = |plan: &Plan| {
        let leaves: Vec<u32> = plan.mesh.subdivision.leaves().collect();
        ElementParts::new(&plan.mesh.subdivision, &leaves)
    };
    // Elements as they are for other light blur the spot that the lamp makes below the ball.
    let parts = all_parts(&coarse);
    Arc::get_mut(&mut coarse.result.errors).unwrap().parts = parts;
    let as_for_other_light = caustic_error(&coarse, 1 << 18);
    assert!(as_for_other_light > 0.03, "{as_for_other_light}");
    // Those of a pilot that was asked for 3 % are to take 0.9 % of it for caustics, and what is in doubt.
    let told = fine.errors.caustics_lx / fine.light.reference_lx;
    let parts = all_parts(&fine);
    Arc::get_mut(&mut fine.result.errors).unwrap().parts = parts;
    let seen = caustic_error(&fine, 1 << 18);
    assert!(seen < 0.015 && told < 0.02, "{seen}, {told} told");
}
