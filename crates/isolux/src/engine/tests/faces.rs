//! Many emitting surfaces by few shadow rays, against all of them one by one.

use super::many::{hall_of_panels, receivers};
use super::*;
use crate::engine::light::{Goal, Lighting, Patches};

/// Estimates a receiver, and looks at all surfaces by so many shadow rays to each.
const TRIALS: u64 = 1000;
const LOOKS: u64 = 100;
const RAYS: usize = 16;

/// Largest deviation of means of many estimates from means of looks at all surfaces, in standard errors of their difference.
pub(super) fn deviation(
    scene: &Scene,
    estimate: impl Fn(&Lighting, &SurfacePoint, u64) -> Rgb,
    receivers: impl Iterator<Item = SurfacePoint>,
) -> f64 {
    let lighting = Lighting::new(scene);
    assert!(lighting.has_many());
    let mut largest = 0.0_f64;
    for at in receivers {
        let values: Vec<Rgb> = (0..TRIALS).map(|seed| estimate(&lighting, &at, seed)).collect();
        let look = |seed: u64| lighting.by_all(&at, RAYS, &mut dice(TRIALS + seed));
        let by_all: Vec<Rgb> = (0..LOOKS).map(look).collect();
        for channel in 0..3 {
            let of = |values: &[Rgb]| mean_and_error(values.iter().map(|v| v.0[channel]));
            let ((mean, error), (right, error_of_right)) = (of(&values), of(&by_all));
            let error = error.hypot(error_of_right) + RAY_ROUNDING * right;
            largest = largest.max((mean - right).abs() / error.max(1e-300));
        }
    }
    largest
}

#[test]
fn many_surfaces_by_few_rays_are_unbiased() {
    for points in [0, 200] {
        let scene = hall_of_panels(60, points);
        assert!(Lighting::new(&scene).is_measured_once());
        let of = |lighting: &Lighting, at: &SurfacePoint, seed: u64| {
            lighting.illuminance(at, &mut dice(seed))
        };
        let largest = deviation(&scene, of, receivers(12));
        assert!(largest < SIGMAS, "{largest} standard errors beside {points} points");
    }
}

#[test]
fn one_face_of_many_is_unbiased() {
    let scene = hall_of_panels(30, 0);
    let of_one =
        |lighting: &Lighting, at: &SurfacePoint, seed: u64| lighting.estimate(at, &mut dice(seed));
    let largest = deviation(&scene, of_one, receivers(12));
    assert!(largest < SIGMAS, "{largest} standard errors");
    let from = Point::new(1.0, -2.0, 1.0);
    let from_afar = |lighting: &Lighting, at: &SurfacePoint, seed: u64| {
        let about = lighting.about(from, 0.5).expect("there are many");
        lighting.estimate_by(&about, at, &mut dice(seed))
    };
    let largest = deviation(&scene, from_afar, receivers(12));
    assert!(largest < SIGMAS, "from afar {largest} standard errors");
    let patches = Patches::new();
    let on_patches = |lighting: &Lighting, at: &SurfacePoint, seed: u64| {
        lighting.sampled_on(&patches, at, 1, &mut dice(seed))
    };
    let places = (0..12).map(|k| SurfacePoint::new(&scene, k % 30, k % 4 > 1, 0.2, 0.3));
    let largest = deviation(&scene, on_patches, places);
    assert!(largest < SIGMAS, "on patches {largest} standard errors");
}

/// Whether few combs are drawn or every face is looked at.
#[test]
#[ignore = "slow: cargo xtask test --all"]
fn measured_faces_are_as_near_as_they_say() {
    for (count, goal) in [(12, Goal::lux(0.5)), (60, Goal::reading(0.01)), (60, Goal::ANY)] {
        let scene = hall_of_panels(count, 0);
        let lighting = Lighting::new(&scene);
        let (mut off, mut said) = (0.0, 0.0);
        for (k, at) in receivers(PLACES).enumerate() {
            let key = Key::new(7).with(k as u64);
            let all = |seed: u64| lighting.by_all(&at, RAYS, &mut dice(seed)).luminance();
            let (right, error) = mean_and_error((0..LOOKS).map(all));
            for seed in 0..MEASURED {
                let measured = lighting.measured(&at, goal, Sequence::new(key.with(seed)));
                off += (measured.lx.luminance() - right).powi(2) - error * error;
                said += measured.variance;
            }
        }
        // As of luminaires without surface: combs of a measurement interleave.
        let ratio = (said / off).sqrt();
        assert!((0.9..2.0).contains(&ratio), "{ratio} with {count} surfaces, {goal:?}");
    }
}

/// Places, and measurements of each.
const PLACES: u64 = 20;
const MEASURED: u64 = 30;

#[test]
fn only_so_many_surfaces_are_sampled_by_themselves_however_large_they_are() {
    let ceiling = |k: u32| {
        let height_m = 2.0 + 0.01 * f64::from(k);
        rectangle([0.0, 0.0, height_m], [0.0, 8.0, 0.0], [8.0, 0.0, 0.0], 1)
    };
    let glow = Finish { luminance_cd_m2: Rgb::grey(100.0), ..Finish::BLACK };
    let with = |count: u32| {
        let floor = rectangle([-9.0, -9.0, 0.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 0);
        let shapes = (0..count).map(ceiling).chain([floor]).collect();
        let grey = Material::one_sided("grey", Finish::diffuse(Rgb::grey(0.5)));
        scene(shapes, vec![grey, Material::one_sided("glow", glow.clone())], Vec::new())
    };
    for (count, by_themselves) in [(10, 10), (50, 16)] {
        let scene = with(count);
        let lighting = Lighting::new(&scene);
        let found = lighting.rays_of_sampled(1) - u64::from(count > 16) * 16;
        assert_eq!(found, by_themselves, "of {count}");
    }
    let of = |lighting: &Lighting, at: &SurfacePoint, seed: u64| {
        lighting.illuminance(at, &mut dice(seed))
    };
    let largest = deviation(&with(50), of, receivers(4));
    assert!(largest < SIGMAS, "{largest} standard errors");
}
