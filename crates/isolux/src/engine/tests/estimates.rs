//! The cheap estimate at the ends of rays against the value at receivers.

use super::direct_light::facing;
use super::*;
use crate::engine::light::Lighting;
use crate::engine::ray::ProbePoint;
use crate::engine::read::MapReader;
use crate::engine::{SolveRequest, Watch, solve};

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn check(name: &str, scene: &Scene, place: [f64; 3], normal: [f64; 3]) {
    let lighting = Lighting::new(scene);
    let at = facing(place, normal);
    let (value, known_to) =
        mean_and_error((0..400).map(|k| lighting.illuminance(&at, &mut dice(k)).luminance()));
    let (mean, error) =
        mean_and_error((0..20_000).map(|k| lighting.estimate(&at, &mut dice(k)).luminance()));
    assert!(value > 0.0, "{name}: the case is dark");
    // Where nothing varies the two are the same sum in another order.
    let allowed = SIGMAS * libm::hypot(error, known_to) + 1e-12 * value;
    assert!((mean - value).abs() < allowed, "{name}: {mean} +- {error} for {value} +- {known_to}");
}

fn floor() -> Shape {
    rectangle([-9.0, -9.0, -1.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 0)
}

fn with(mut shapes: Vec<Shape>, luminaires: Vec<Luminaire>) -> Scene {
    shapes.push(floor());
    let mirror = Material::one_sided("mirror", Finish::mirror(Rgb::grey(0.7)));
    let materials = vec![painted(Rgb::grey(0.5)), glowing(1000.0), mirror];
    scene(shapes, materials, luminaires)
}

/// Luminaires in a row, of rising intensity.
fn row(count: u32) -> Vec<Luminaire> {
    let lamp = |k: u32| isotropic([f64::from(k) - 3.0, 0.5, 2.0], 50.0 + 30.0 * f64::from(k));
    (0..count).map(lamp).collect()
}

fn panel(x: f64) -> Shape {
    rectangle([x, -0.5, 1.5], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], 1)
}

#[test]
fn of_points_it_is_unbiased() {
    let screen = || rectangle([-2.0, -2.0, 1.0], [2.5, 0.0, 0.0], [0.0, 4.0, 0.0], 0);
    check("three in the open", &with(vec![], row(3)), [0.0; 3], UP);
    check("eight in the open", &with(vec![], row(8)), [0.0; 3], UP);
    check("eight, some behind a screen", &with(vec![screen()], row(8)), [0.5, 0.0, 0.0], UP);
    let mirror = rectangle([-4.0, 2.0, 0.0], [9.0, 0.0, 0.0], [0.0, 0.0, 4.0], 2);
    check("eight and their images", &with(vec![mirror], row(8)), [0.5, 0.0, 0.0], UP);
}

#[test]
fn of_whole_surfaces_it_is_unbiased() {
    check("one", &with(vec![panel(0.0)], vec![]), [0.0; 3], UP);
    check("six", &with((0..6).map(|k| panel(f64::from(k) - 3.0)).collect(), vec![]), [0.0; 3], UP);
    check(
        "six and points",
        &with((0..6).map(|k| panel(f64::from(k))).collect(), row(3)),
        [0.0; 3],
        UP,
    );
}

/// A wall that glows from the floor, below the receiver, up.
fn wall() -> Shape {
    rectangle([-0.3, -1.0, -0.9], [0.0, 2.0, 0.0], [0.0, 0.0, 1.9], 1)
}

#[test]
fn of_surfaces_that_cross_the_horizon_it_is_unbiased() {
    check("a wall", &with(vec![wall()], vec![]), [0.0; 3], UP);
}

#[test]
fn of_surfaces_half_in_shadow_it_is_unbiased() {
    // The screen hides what is brightest, the part right above.
    let screen = rectangle([-0.1, -9.0, 0.2], [9.0, 0.0, 0.0], [0.0, 18.0, 0.0], 0);
    let wide = rectangle([-3.0, -3.0, 0.5], [0.0, 6.0, 0.0], [6.0, 0.0, 0.0], 1);
    check("a ceiling", &with(vec![wide, screen], vec![]), [0.0; 3], UP);
}

/// Where luminaires are many, readers take direct light from the map where rays end, but look at luminaires again where that is
/// not what lands there.
#[test]
fn readers_look_at_luminaires_again_where_the_map_is_wrong() {
    let lamp =
        |k: usize| isotropic([0.9 + 1.5 * (k / 4) as f64, 0.8 + 1.4 * (k % 4) as f64, 2.6], 40.0);
    let room = inward_box([8.0, 6.0, 3.0], 0);
    let scene = scene(room, vec![painted(Rgb::grey(0.5))], (0..20).map(lamp).collect());
    let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    // Indirect light that comes up, read from direct light so many times what it is, by the number of a vertex.
    let read_lx = |times: &dyn Fn(usize) -> f64| {
        let mut told = map.clone();
        for (k, value) in told.values.iter_mut().enumerate() {
            let Some(value) = value else { continue };
            value.direct_lx = value.direct_lx * times(k);
        }
        let normal = Vector::new(0.0, 0.0, -1.0).normal().unwrap();
        let at = ProbePoint { position: Point::new(3.9, 3.1, 0.7), normal };
        MapReader::new(&scene, &told).measure(at).unwrap().indirect_lx.luminance()
    };
    let right_lx = read_lx(&|_| 1.0);
    let wrong_lx = [read_lx(&|_| 2.0), read_lx(&|k| if k % 2 == 0 { 5.0 } else { 1.0 })];
    // Four samples of every element tell what lands there to a tenth about; taken from the map it would be 1.5 and 1.87 times as much.
    for wrong_lx in wrong_lx {
        assert!((wrong_lx / right_lx - 1.0).abs() < 0.2, "{wrong_lx} {right_lx}");
    }
}
