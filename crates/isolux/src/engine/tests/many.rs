//! Many luminaires by few shadow rays, against all of them one by one.

use super::*;
use crate::engine::gather::Unlit;
use crate::engine::judge::check_points;
use crate::engine::light::{Goal, Lighting, Measured, Patches};
use crate::engine::pilot::pilot;
use crate::engine::ray::{NEVER, SurfacePoint};
use crate::engine::{SolveRequest, Watch, solve};
use crate::photometry::PhotometricWeb;
use std::sync::Arc;

/// Uniform numbers of [-1, 1).
pub(in crate::engine) fn number(k: u64, n: u64) -> f64 {
    2.0 * Key::new(9).with(k).with(n).uniform() - 1.0
}

/// A web with a dark half, a peak narrower than a texel of the tables, and a hard edge.
fn peaked() -> IntensityDistribution {
    let gammas = vec![0.0, 20.0, 20.5, 21.0, 60.0, 60.1, 90.0];
    let lit = [100.0, 80.0, 4000.0, 80.0, 120.0, 0.0, 0.0];
    let dark = [100.0, 10.0, 10.0, 5.0, 0.0, 0.0, 0.0];
    let web =
        PhotometricWeb::new(vec![0.0, 90.0, 180.0, 270.0], gammas, [lit, lit, dark, dark].concat());
    IntensityDistribution::Web(Arc::new(web.unwrap()))
}

fn kind(k: u64) -> IntensityDistribution {
    match k % 4 {
        0 => IntensityDistribution::CosinePower { peak_cd: 100.0, exponent: 3.0 },
        1 => IntensityDistribution::Spot { peak_cd: 900.0, inner_rad: 0.2, outer_rad: 0.2001 },
        2 => IntensityDistribution::Isotropic { intensity_cd: 30.0 },
        _ => peaked(),
    }
}

/// Luminaires below a ceiling, in patches of one kind, every second patch turned any way.
fn lamps(count: u64) -> Vec<Luminaire> {
    let web = kind(3);
    let lamp = |k: u64| {
        let patch = k / 60;
        let position = Point::new(8.0 * number(k, 0), 8.0 * number(k, 1), 2.5 + 0.2 * number(k, 2));
        let q = [3, 4, 5, 6].map(|n| number(k, n));
        let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
        let turned = Transform::rotation(q.map(|c| c / length));
        let world_from_luminaire =
            if patch.is_multiple_of(2) { Transform::IDENTITY } else { turned };
        let intensity =
            if patch % 4 == 3 { web.scaled(1.0 + 0.1 * number(k, 7)) } else { kind(patch) };
        Luminaire {
            colour: Rgb::new(1.0, 0.5 + 0.4 * number(k, 8), 0.2),
            ..luminaire(LuminaireKind::Point {
                position,
                world_from_luminaire,
                intensity,
                area: None,
            })
        }
    };
    (0..count).map(lamp).collect()
}

/// A floor with screens that hide a good part of the luminaires, and two mirrors that see each other.
pub(in crate::engine) fn hall(count: u64) -> Scene {
    hall_of(Vec::new(), Vec::new(), lamps(count))
}

/// The same with emitting surfaces in place of some luminaires: coloured panels turned any way, panels that see themselves in a
/// mirror, and globes of eight triangles.
pub(in crate::engine) fn hall_of_panels(count: u64, points: u64) -> Scene {
    let finish =
        |r: f64| Finish { luminance_cd_m2: Rgb::new(r, 0.7, 0.4) * 900.0, ..Finish::BLACK };
    let glow = [0.2, 0.6, 1.0].map(|r| Material::one_sided("glow", finish(r)));
    let shape = |k: u64| {
        let corner = [8.0 * number(k, 0), 8.0 * number(k, 1), 2.5 + 0.2 * number(k, 2)];
        let (u, v) = ([0.0, 0.6 + 0.5 * number(k, 3), 0.0], [0.5, 0.0, 0.0]);
        let material = 2 + (k % 3) as u32;
        match k % 4 {
            0 => octahedron(corner, 0.2, material),
            1 => rectangle(corner, u, v, material),
            2 => rectangle(
                [8.8, 6.0 * number(k, 0), 1.0 + number(k, 2)],
                [0.0, 0.2, 0.0],
                v,
                material,
            ),
            _ => {
                let any = |n: u64| [n, n + 1, n + 2].map(|n| 0.6 * number(k, n));
                rectangle(corner, any(10), any(13), material)
            }
        }
    };
    hall_of((0..count).map(shape).collect(), glow.to_vec(), lamps(points))
}

/// A globe of eight triangles that face out.
fn octahedron(centre: [f64; 3], radius_m: f64, material: u32) -> Shape {
    let tip = |axis: usize, sign: f64| {
        let mut tip = centre;
        tip[axis] += sign * radius_m;
        tip
    };
    let positions = (0..6).map(|k| tip(k / 2, if k % 2 == 0 { 1.0 } else { -1.0 })).collect();
    let triangles = vec![
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    Shape { name: "globe".into(), positions, triangles, material, ..Shape::default() }
}

fn hall_of(emitters: Vec<Shape>, glow: Vec<Material>, lamps: Vec<Luminaire>) -> Scene {
    let mirror = Material::one_sided("mirror", Finish::mirror(Rgb::new(0.8, 0.7, 0.6)));
    let mut shapes = vec![
        rectangle([-9.0, -9.0, 0.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 0),
        rectangle([-9.0, -4.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 2.0], 1),
        rectangle([9.0, 3.0, 0.5], [0.0, -8.0, 0.0], [0.0, 0.0, 2.0], 1),
    ];
    for k in 0..12 {
        let corner = [7.0 * number(k, 20), 7.0 * number(k, 21), 0.8 + number(k, 22)];
        let (u, v) = ([1.5, 0.4 * number(k, 23), 0.0], [0.3, 1.5, 0.5 * number(k, 24)]);
        shapes.push(rectangle(corner, u, v, 0));
        shapes.push(rectangle(corner, v, u, 0));
    }
    shapes.extend(emitters);
    scene(shapes, [vec![painted(Rgb::grey(0.5)), mirror], glow].concat(), lamps)
}

/// Receivers on the floor, on the ceiling's height looking down or aside, and tilted.
pub(in crate::engine) fn receivers(count: u64) -> impl Iterator<Item = SurfacePoint> {
    (0..count).map(|k| {
        let height = if k % 3 == 0 { 1e-3 } else { 1.2 + 1.1 * number(k, 30) };
        let place = Point::new(8.5 * number(k, 31), 8.5 * number(k, 32), height);
        let tilt = if k % 3 == 0 { 0.0 } else { 1.0 };
        let normal = Vector::new(tilt * number(k, 33), tilt * number(k, 34), 0.5);
        SurfacePoint::in_space(place, normal.normal().unwrap(), 0.0)
    })
}

/// Largest deviation of means of many estimates from all luminaires one by one, in standard errors, and
/// the spread of one estimate, relative.
fn deviation(
    scene: &Scene,
    estimate: impl Fn(&Lighting, &SurfacePoint, &mut Dice) -> Rgb,
    receivers: impl Iterator<Item = SurfacePoint>,
) -> (f64, f64) {
    let lighting = Lighting::new(scene);
    let (mut largest, mut spread) = (0.0_f64, 0.0);
    let mut count = 0.0;
    for at in receivers {
        let exact = lighting.by_all(&at, 1, &mut dice(0));
        let values: Vec<Rgb> =
            (0..TRIALS).map(|seed| estimate(&lighting, &at, &mut dice(seed))).collect();
        for channel in 0..3 {
            let (mean, error) = mean_and_error(values.iter().map(|v| v.0[channel]));
            let rounding = RAY_ROUNDING * exact.0[channel];
            largest = largest.max((mean - exact.0[channel]).abs() / (error + rounding).max(1e-300));
            let relative = error * (TRIALS as f64).sqrt() / exact.0[channel].max(1e-300);
            spread += relative * relative;
            count += 1.0;
        }
    }
    (largest, (spread / count).sqrt())
}

/// Estimates a receiver.
const TRIALS: u64 = 1000;

#[test]
fn many_luminaires_by_few_rays_are_unbiased() {
    let scene = hall(600);
    assert!(Lighting::new(&scene).has_many());
    let estimate =
        |lighting: &Lighting, at: &SurfacePoint, dice: &mut Dice| lighting.illuminance(at, dice);
    let (largest, spread) = deviation(&scene, estimate, receivers(40));
    assert!(largest < SIGMAS, "{largest} standard errors");
    // Measured 0.45: half of the luminaires are turned any way, and a quarter have beams narrower than what
    // tells how likely they are to be drawn.
    assert!(spread < 0.6, "{spread}");
}

#[test]
fn one_luminaire_of_many_is_unbiased() {
    let scene = hall(100);
    let estimate =
        |lighting: &Lighting, at: &SurfacePoint, dice: &mut Dice| lighting.estimate(at, dice);
    let (largest, _) = deviation(&scene, estimate, receivers(40));
    assert!(largest < SIGMAS, "{largest} standard errors");
}

#[test]
fn one_luminaire_drawn_from_afar_is_unbiased() {
    let scene = hall(100);
    // A distribution made elsewhere than for the places asked: worse, but as right.
    let from = Point::new(1.0, -2.0, 1.0);
    let estimate = |lighting: &Lighting, at: &SurfacePoint, dice: &mut Dice| {
        let about = lighting.about(from, 0.5).expect("there are many");
        lighting.estimate_by(&about, at, dice)
    };
    let (largest, _) = deviation(&scene, estimate, receivers(20));
    assert!(largest < SIGMAS, "{largest} standard errors");
    assert!(Lighting::new(&hall(1)).about(from, 0.5).is_none());
}

#[test]
fn many_luminaires_as_seen_from_patches_are_unbiased() {
    let scene = hall(600);
    let patches = Patches::new();
    let estimate = |lighting: &Lighting, at: &SurfacePoint, dice: &mut Dice| {
        lighting.sampled_on(&patches, at, 1, dice)
    };
    // Close to each other, on all triangles: of the many that share a patch none is its middle.
    let places = || {
        (0..60).map(|k| {
            let triangle = (k / 2 % scene.triangle_count() as u64) as u32;
            let [u, v] = [40, 41].map(|n| 0.3 + 0.1 * number(k / 2, n) + 1e-3 * number(k, n + 2));
            SurfacePoint::new(&scene, triangle, k % 4 > 1, u, v)
        })
    };
    let (largest, spread) = deviation(&scene, estimate, places());
    assert!(largest < SIGMAS, "{largest} standard errors");
    let of_own =
        |lighting: &Lighting, at: &SurfacePoint, dice: &mut Dice| lighting.sampled(at, 1, dice);
    let (_, with_own_cuts) = deviation(&scene, of_own, places());
    // Patches reach as far as a tenth of the distance of the nearest luminaire.
    assert!(spread < 1.2 * with_own_cuts, "{spread}, with cuts of their own {with_own_cuts}");
    // Whoever was there before, the same bits.
    let lighting = Lighting::new(&scene);
    let fresh = |at: &SurfacePoint| lighting.sampled_on(&Patches::new(), at, 1, &mut dice(1));
    let again = |at: &SurfacePoint| lighting.sampled_on(&patches, at, 1, &mut dice(1));
    assert!(places().all(|at| fresh(&at) == again(&at)));
}

/// Root mean square errors, relative: of measurements, as they say, and of their means at a place.
fn errors(scene: &Scene, goal: Goal) -> [f64; 3] {
    let lighting = Lighting::new(scene);
    let mut squared = [0.0; 3];
    for (k, at) in receivers(PLACES).enumerate() {
        let exact = lighting.by_all(&at, 1, &mut dice(0)).luminance();
        let key = Key::new(7).with(k as u64);
        let measured = |seed: u64| lighting.measured(&at, goal, Sequence::new(key.with(seed)));
        let values: Vec<Measured> = (0..MEASURED).map(measured).collect();
        let error = |m: &Measured| m.lx.luminance() / exact - 1.0;
        let mean =
            |of: &dyn Fn(&Measured) -> f64| values.iter().map(of).sum::<f64>() / MEASURED as f64;
        squared[0] += mean(&|m| error(m) * error(m));
        squared[1] += mean(&|m| m.variance / (exact * exact));
        squared[2] += mean(&error) * mean(&error);
    }
    squared.map(|s| (s / PLACES as f64).sqrt())
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn measured_light_is_as_near_as_it_says() {
    let scene = hall(3000);
    let [_, said_at_once, _] = errors(&scene, Goal::ANY);
    let [found, said, of_means] = errors(&scene, Goal::reading(0.01));
    // Their squares at 30 places spread by the root of 2 / 30, a quarter: here of three times that.
    let expected = found / (MEASURED as f64).sqrt();
    assert!(of_means < 1.32 * expected, "{of_means} for {expected}");
    // The combs of a measurement interleave: their mean is nearer than independent ones would be, until a second one is added. What is found
    // spreads by three per cent.
    assert!(found < 1.1 * said && said < 2.0 * found, "{found}, said {said}");
    assert!(said < 0.5 * said_at_once, "{said} after {said_at_once}");
}

/// Places, and measurements of each.
const PLACES: u64 = 30;
const MEASURED: u64 = 50;

/// All increments read the same direct light, so that their spread does not tell its noise.
#[test]
fn noise_of_direct_light_is_part_of_the_accuracy() {
    let floor = vec![rectangle([-9.0, -9.0, 0.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 0)];
    let scene = scene(floor, vec![painted(Rgb::grey(0.5))], lamps(700));
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let checks = check_points::draw(&plan, 0, Key::new(2));
    let noise = |accuracy: f64| {
        let noise_lx2 =
            check_points::direct(&plan, &checks, accuracy, (Key::new(3), &NEVER)).noise_lx2;
        noise_lx2.sqrt() / plan.light.reference_lx
    };
    let told = noise(0.01);
    assert!(noise(0.002) < 0.6 * told && told < 0.02, "{told}");
    let request = SolveRequest { accuracy: Some(0.01), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    // Nothing reflects on to a floor: there is no other noise.
    let statistical = map.provenance.accuracy.unwrap().statistical;
    assert!((0.5..2.0).contains(&(statistical / told)), "{statistical} for {told}");
}
