//! Who gets how many rays and particles.

use super::errors::{noise as normal, small_plan};
use super::*;
use crate::engine::gather::{RayTrial, Shared, allot, allot_by_noise, known_weights, mean_of};
use crate::engine::light::Lighting;
use crate::engine::method::{Hybrid, IncrementSize, deposit};
use crate::engine::particle::{CausticNoise, particles};
use crate::engine::ray::{NEVER, SurfacePoint};
use crate::scene::Gloss;
use std::sync::Arc;

/// Noise over all areas of nets of n rays, in the square.
fn noise(areas_m2: &[f64], rays: impl Fn(usize) -> f64) -> f64 {
    areas_m2.iter().enumerate().map(|(k, m2)| m2 * rays(k).powf(-1.7)).sum()
}

#[test]
fn receivers_of_one_size_get_the_same() {
    assert_eq!(allot(&[0.3; 50], 64.0), [64; 50]);
    // The least power of two that is enough.
    assert_eq!(allot(&[0.3; 50], 70.0), [128; 50]);
    assert_eq!(allot(&[0.0, 2.0], 16.0), [0, 16], "none where there is no area");
    assert!(allot(&[], 16.0).is_empty());
}

#[test]
fn small_receivers_get_fewer_and_the_noise_is_no_more() {
    // As in a furnished room: sizes over three orders of magnitude.
    let areas_m2: Vec<f64> = (0..1000).map(|k| (f64::from(k) * -0.007).exp()).collect();
    for mean in [16.0, 50.0, 64.0, 300.0] {
        let rays = allot(&areas_m2, mean);
        let given = noise(&areas_m2, |k| f64::from(rays[k]));
        assert!(given <= noise(&areas_m2, |_| mean) * (1.0 + 1e-12), "{mean}");
        assert!(rays.windows(2).all(|pair| pair[0] >= pair[1]), "{mean}");
        assert!(rays.iter().all(|n| n.is_power_of_two() && *n >= 8), "{mean}");
        assert!(mean_of(&rays) < 0.85 * mean, "{} of {mean}", mean_of(&rays));
    }
    assert_eq!(mean_of(&[4, 0, 8]), 6.0, "of those that have any");
}

#[test]
fn noisy_receivers_get_more_if_that_leaves_much_less_noise() {
    const COUNT: usize = 1000;
    let (areas_m2, allotted) = (vec![0.3; COUNT], vec![64; COUNT]);
    let share = |variances: &[f64]| allot_by_noise(&areas_m2, variances, &allotted);
    assert!(share(&[2.0; COUNT]).is_none());
    assert!(share(&[0.0; COUNT]).is_none(), "no noise to share by");
    // Variances of four samples each, alike but for chance: sums of three squares of normal deviates.
    let square = |k: u64| normal(Key::new(k)).powi(2);
    let by_chance: Vec<f64> =
        (0..COUNT as u64).map(|k| square(3 * k) + square(3 * k + 1) + square(3 * k + 2)).collect();
    assert!(share(&by_chance).is_none());
    // Every fiftieth has a hundred times the noise, as in housings of lamps.
    let mut uneven = by_chance.clone();
    uneven.iter_mut().step_by(50).for_each(|v| *v *= 1e4);
    let Shared { rays, left_lx, before_lx } =
        share(&uneven).expect("most of the noise is on a fiftieth of them");
    let noise = |rays: &dyn Fn(usize) -> f64| -> f64 {
        uneven.iter().enumerate().map(|(k, v)| v * rays(k).powf(-1.7)).sum()
    };
    let mean_lx = |rays: &dyn Fn(usize) -> f64| (noise(rays) / COUNT as f64).sqrt();
    assert!((left_lx / mean_lx(&|k| f64::from(rays[k])) - 1.0).abs() < 1e-9, "{left_lx}");
    assert!((before_lx / mean_lx(&|_| 64.0) - 1.0).abs() < 1e-9, "{before_lx}");
    assert!(left_lx < 0.3 * before_lx, "{left_lx} {before_lx}");
    assert!(rays.iter().all(|&n| n.is_power_of_two() && (32..=1024).contains(&n)));
    let all: u32 = rays.iter().sum();
    assert!((48_000..80_000).contains(&all), "as many in all: {all}");
    // Who had none has none.
    let but_first = |k: usize| if k == 0 { 0 } else { 64 };
    let allotted: Vec<u32> = (0..COUNT).map(but_first).collect();
    assert_eq!(allot_by_noise(&areas_m2, &uneven, &allotted).unwrap().rays[0], 0);
}

/// A room with a lamp in a box of 20 cm that is open below.
fn room_with_a_can() -> Scene {
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    let (low, high) = ([1.4, 0.9, 2.2], [1.6, 1.1, 2.4]);
    let size = 0.2;
    for (corner, u) in [
        (low, [size, 0.0, 0.0]),
        ([high[0], low[1], low[2]], [0.0, size, 0.0]),
        ([high[0], high[1], low[2]], [-size, 0.0, 0.0]),
        ([low[0], high[1], low[2]], [0.0, -size, 0.0]),
    ] {
        shapes.push(rectangle(corner, u, [0.0, 0.0, size], 0));
    }
    shapes.push(rectangle([low[0], low[1], high[2]], [size, 0.0, 0.0], [0.0, size, 0.0], 0));
    let both = Material::two_sided("paint", Finish::diffuse(Rgb::grey(0.7)));
    scene(shapes, vec![both], vec![isotropic([1.5, 1.0, 2.35], 100.0)])
}

#[test]
fn housings_of_lamps_get_more_rays_than_their_area_is_worth() {
    let rays_of = |scene: &Scene, has_met_it: bool| {
        let lighting = Lighting::new(scene);
        let mut plan = small_plan(scene, &lighting);
        if !has_met_it {
            let usual = RayTrial::usual(plan.light.reference_lx);
            Arc::get_mut(&mut plan.result.tried).unwrap().trial = usual;
        }
        let size = IncrementSize { rays: 64.0, halvings: 0, particles: 0, goal: 0.02 };
        let hybrid = Hybrid::new(&plan, &[], size, 1 << 10, 1);
        let by_area = allot(&plan.areas_m2(), 64.0);
        let places: Vec<Point> = plan.mesh.elements.vertices().iter().map(|v| v.position).collect();
        let rays =
            (0..plan.mesh.indirect_vertices).map(|v| (places[v], hybrid.rays_of(v), by_area[v]));
        rays.collect::<Vec<(Point, u32, u32)>>()
    };
    let is_in_can = |at: Point| (at - Point::new(1.5, 1.0, 2.3)).length() < 0.2;
    let mean = |of: &[(Point, u32, u32)], in_can: bool| {
        let some = of.iter().filter(|(at, ..)| is_in_can(*at) == in_can);
        let (own, by_area) = some.fold((0, 0), |(a, b), &(_, own, by_area)| (a + own, b + by_area));
        f64::from(own) / f64::from(by_area)
    };
    // A trial of a few receivers out of many, none of them in the can.
    let can = rays_of(&room_with_a_can(), false);
    assert!(mean(&can, true) > 2.0, "{} in the can", mean(&can, true));
    assert!(mean(&can, false) > 0.4, "{} elsewhere", mean(&can, false));
    let are_by_area = |of: &[(Point, u32, u32)]| of.iter().all(|(_, own, by_area)| own == by_area);
    assert!(are_by_area(&rays_of(&polished_room(), true)), "an ordinary room");
    // Rays sent to the can take the noise of its light off all places but those in it: these get more, whatever a trial has met.
    let met = rays_of(&room_with_a_can(), true);
    assert!(mean(&met, true) > 2.0, "{} in the can", mean(&met, true));
    assert!(mean(&met, false) > 0.4, "{} elsewhere", mean(&met, false));
}

/// A room of which one wall is polished metal.
pub(super) fn polished_room() -> Scene {
    let polished = Finish {
        gloss: Some(Gloss { f0: Rgb::grey(0.9), alpha: 0.2 }),
        ..Finish::diffuse(Rgb::BLACK)
    };
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    shapes[1].material = 1;
    let materials = vec![painted(Rgb::grey(0.5)), Material::one_sided("polished", polished)];
    scene(shapes, materials, vec![isotropic([1.0, 1.2, 1.5], 100.0)])
}

#[test]
fn caustics_are_as_noisy_as_a_trial_tells() {
    let scene = polished_room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let vertices = plan.mesh.elements.vertices();
    let areas_m2: Vec<f64> = vertices.iter().map(|v| v.area_m2).collect();
    let read = |at: &SurfacePoint| {
        let corners = plan.mesh.elements.locate(at.triangle, at.back, at.u, at.v)?;
        let weights = known_weights(corners, &plan.mesh.standings)?;
        Some([0, 1, 2].map(|k| (corners[k].0, weights[k])))
    };
    let of = (&scene, &lighting);
    let trial = CausticNoise::tried(of, &areas_m2, read, Key::new(3));
    let (told, rays) = (trial.noise, trial.rays);
    assert!(rays > 0);
    // On few vertices a few, a million at most, whatever is asked; without light to compare with, a few.
    assert_eq!(told.particles(20, (1e9, plan.light.reference_lx), 1, 0.1), particles(20));
    assert_eq!(told.particles(20, (1e-9, plan.light.reference_lx), 1, 0.1), 1 << 20);
    assert_eq!(told.particles(20, (1.0, 0.0), 1, 0.1), particles(20));
    // As many as a thousand times the vertices would need for as much error as there is light: in the middle of what may be.
    let count = told.particles(areas_m2.len() * 1000, (1.0, plan.light.reference_lx), 1, 0.1);
    assert!(count > 1024 && count < particles(areas_m2.len() * 1000), "{count}");
    let light = |k| deposit(&plan, 4096, Key::new(k), &NEVER).unwrap().light;
    let maps: Vec<Vec<Rgb>> = (0..16).map(light).collect();
    let (mut squares, mut area) = (0.0, 0.0);
    for (v, m2) in areas_m2.iter().enumerate().take(plan.mesh.indirect_vertices) {
        let (_, error) = mean_and_error(maps.iter().map(|map| map[v].luminance()));
        squares += m2 * error * error * 16.0;
        area += m2;
    }
    // Noise of so many particles falls with their number, and grows with the vertices.
    let noise_lx2 = squares / area * 4096.0 * 1000.0;
    let allowed_lx = 0.45 * plan.light.reference_lx;
    let wanted = noise_lx2 / (0.1 * allowed_lx * allowed_lx);
    // The correction of deposits doubles their noise in the square at most, particles of one sequence lie evenly, and
    // their number is the next power of two.
    let ratio = f64::from(count) / wanted;
    assert!(ratio > 0.25 && ratio < 4.0, "{ratio}");
}
