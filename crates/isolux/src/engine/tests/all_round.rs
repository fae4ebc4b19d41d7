//! Sensors with a bent surface, against closed forms.

use super::*;
use crate::engine::{MapReader, Sensor, SolveRequest, Watch, solve};
use crate::map::{Illuminance, IlluminationMap};
use crate::photometry::{GeneralSky, Sky};
use crate::scene::{AreaShape, LuminousArea};
use isolux_geometry::Direction;
use std::f64::consts::PI;

/// Standard errors that chance exceeds once in a hundred thousand readings.
const DEVIATIONS: f64 = 4.5;

fn solved(scene: &Scene, accuracy: f64) -> IlluminationMap {
    let request = SolveRequest { accuracy: Some(accuracy), ..SolveRequest::default() };
    solve(scene, &request, None, &mut |_| Watch::Continue).unwrap().map
}

/// A cylinder, a half cylinder that faces the way of x, and a hemisphere.
fn sensors() -> [Sensor; 3] {
    let up = Direction::Z;
    let facing = Vector::new(1.0, 0.0, 0.0);
    [Sensor::cylinder(up), Sensor::half_cylinder(up, facing).unwrap(), Sensor::hemisphere(up)]
}

fn readings(scene: &Scene, accuracy: f64, at: [f64; 3]) -> [Illuminance; 3] {
    let map = solved(scene, accuracy);
    let reader = MapReader::new(scene, &map);
    sensors().map(|sensor| reader.on_sensor(Point::from(at), &sensor).unwrap())
}

/// By light from a direction: of the illuminance of a plane that faces it.
fn shares([x, y, z]: [f64; 3]) -> [f64; 3] {
    let flat = libm::hypot(x, y);
    [flat / PI, (flat + x) / PI, 0.25 * (1.0 + z)]
}

fn black_floor() -> Shape {
    rectangle([-3.0, -3.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], 0)
}

fn assert_near(found: &Illuminance, lx: f64, rounding: f64) {
    let off = (found.illuminance_lx() - lx).abs();
    assert!(off <= DEVIATIONS * found.standard_error_lx + rounding * lx, "{found:?}, not {lx}");
}

/// Ez = I sin / (pi r^2), Esc = I (1 + cos alpha) sin / (pi r^2), Ehs = I (1 + cos) / (4 r^2): without noise.
#[test]
fn a_point_source_gives_the_closed_forms() {
    let lamp = [1.2, 0.9, 2.7];
    let scene =
        scene(vec![black_floor()], vec![painted(Rgb::BLACK)], vec![isotropic(lamp, 1000.0)]);
    for at in [[0.0, 0.0, 1.2], [2.0, 0.9, 1.2], [1.2, 0.9, 1.6], [0.0, 0.0, 2.9]] {
        let way = Vector::from([0, 1, 2].map(|k| lamp[k] - at[k]));
        let facing_lx = 1000.0 / way.length_squared();
        let towards = (way / way.length()).into();
        for (found, share) in readings(&scene, 0.1, at).iter().zip(shares(towards)) {
            let lx = facing_lx * share;
            // Straight below it a cylinder gets nothing but rounding, of the root of a square.
            let off = (found.illuminance_lx() - lx).abs();
            assert!(off <= 1e-9 * lx + 1e-7 * facing_lx, "{at:?}: {found:?}, not {lx}");
            assert!(found.standard_error_lx <= 1e-9 * facing_lx, "{found:?}");
        }
    }
}

/// What stands before a lamp hides it from every sensor.
#[test]
fn shadows_are_seen() {
    let screen = rectangle([-1.0, -1.0, 1.5], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], 0);
    let black = Material::two_sided("black", Finish::BLACK);
    let scene =
        scene(vec![black_floor(), screen], vec![black], vec![isotropic([0.0, 0.0, 2.5], 100.0)]);
    let found = readings(&scene, 0.1, [0.2, 0.1, 1.0]);
    assert!(found.iter().all(|found| found.illuminance_lx() == 0.0), "{found:?}");
}

/// In a room whose walls all have one luminance, every sensor has pi times that, wherever it stands. Half of the light is direct.
#[test]
fn a_furnace_gives_pi_times_its_luminance() {
    let finish = Finish { luminance_cd_m2: Rgb::grey(100.0), ..Finish::diffuse(Rgb::grey(0.5)) };
    let walls = inward_box([4.0, 3.0, 2.5], 0);
    let scene = scene(walls, vec![Material::one_sided("furnace", finish)], vec![]);
    let map = solved(&scene, 0.02);
    let reader = MapReader::new(&scene, &map);
    let lx = PI * 100.0 / 0.5;
    let mut within = 0;
    for k in 0..24_u64 {
        let c = |n: u64, size: f64| size * (0.1 + 0.8 * Key::new(3).with(k).with(n).uniform());
        let at = Point::new(c(0, 4.0), c(1, 3.0), c(2, 2.5));
        for sensor in sensors() {
            let found = reader.on_sensor(at, &sensor).unwrap();
            assert_near(&found, lx, 0.0);
            assert!(found.standard_error_lx < 0.03 * lx, "{found:?}");
            let off = (found.illuminance_lx() - lx).abs();
            within += u32::from(off <= 1.96 * found.standard_error_lx);
        }
    }
    // Of 72 intervals of 95 %, that share the errors of one map: at least 60.
    assert!(within >= 60, "{within}");
}

/// Below half a sphere of one luminance, over ground of another: Ez = pi / 2 (L + G), Ehs = pi / 4 (3 L + G).
#[test]
fn an_open_sky_gives_the_closed_forms() {
    let sky = Sky::General { sky: GeneralSky::uniform(1000.0), ground_cd_m2: 200.0 };
    let sky = luminaire(LuminaireKind::Sky { world_from_sky: Transform::IDENTITY, sky });
    let scene = scene(vec![black_floor()], vec![painted(Rgb::BLACK)], vec![sky]);
    // So high that the floor hides nothing.
    let found = readings(&scene, 0.1, [0.0, 0.0, 1e4]);
    let level = 0.5 * PI * 1200.0;
    for (found, lx) in found.iter().zip([level, level, 0.25 * PI * 3200.0]) {
        assert_near(found, lx, 1e-6);
        assert!(found.standard_error_lx < 0.01 * lx, "{found:?}");
    }
}

/// The sun's disc, and a small luminous area, give what light from their middles does.
#[test]
fn small_extents_are_as_points() {
    let towards = Vector::new(-0.6, 0.3, 0.7).direction().unwrap();
    let sun = |half_angle_rad: f64| {
        let illuminance_lx = 1e4;
        luminaire(LuminaireKind::Directional {
            direction: -towards,
            illuminance_lx,
            half_angle_rad,
        })
    };
    let mut lamp = isotropic([-0.6, 0.3, 1.7], 100.0);
    let LuminaireKind::Point { area, .. } = &mut lamp.kind else { panic!("a point") };
    *area = Some(LuminousArea { shape: AreaShape::Box, half_m: [1e-3; 3], middle_m: [0.0; 3] });
    let distance2 = 0.36 + 0.09 + 0.49;
    for (source, facing_lx) in [(sun(0.0), 1e4), (sun(0.004_65), 1e4), (lamp, 100.0 / distance2)] {
        let scene = scene(vec![black_floor()], vec![painted(Rgb::BLACK)], vec![source]);
        let found = readings(&scene, 0.1, [0.0, 0.0, 1.0]);
        for (found, share) in found.iter().zip(shares(towards.to_vector().into())) {
            // Extents of 0.005 and of 0.001 change means by squares of them.
            assert_near(found, facing_lx * share, 1e-4);
        }
    }
}

/// An emitting ceiling, seen all round, is the mean of planar readings at many azimuths: both have noise.
#[test]
fn a_room_is_the_mean_of_its_vertical_readings() {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.push(rectangle([1.0, 1.0, 2.4], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0], 1));
    let materials = vec![painted(Rgb::grey(0.5)), glowing(3000.0)];
    let scene = scene(shapes, materials, vec![]);
    let map = solved(&scene, 0.03);
    let reader = MapReader::new(&scene, &map);
    let position = Point::new(0.8, 1.1, 1.2);
    let cylinder = reader.on_sensor(position, &sensors()[0]).unwrap();
    const AZIMUTHS: u32 = 24;
    let vertical = |k: u32| {
        let (sin, cos) = libm::sincos(2.0 * PI * f64::from(k) / f64::from(AZIMUTHS));
        let normal = Vector::new(cos, sin, 0.0).normal().unwrap();
        reader.measure(crate::engine::ProbePoint { position, normal }).unwrap()
    };
    let all: Vec<Illuminance> = (0..AZIMUTHS).map(vertical).collect();
    let mean =
        |of: &dyn Fn(&Illuminance) -> f64| all.iter().map(of).sum::<f64>() / f64::from(AZIMUTHS);
    let (lx, error_lx) = (mean(&Illuminance::illuminance_lx), mean(&|v| v.standard_error_lx));
    let off = (cylinder.illuminance_lx() - lx).abs();
    // Equal steps of a cosine with a bend err by 2 / (24^2 - 1), relative: 0.4 %.
    let allowed = DEVIATIONS * libm::hypot(error_lx, cylinder.standard_error_lx) + 4e-3 * lx;
    assert!(off <= allowed, "{cylinder:?}, not {lx} +- {error_lx}");
    assert!(cylinder.standard_error_lx < 0.05 * lx, "{cylinder:?}");
}

/// On a floor it stands just above; inside of a solid there is no reading.
#[test]
fn places_on_surfaces_and_inside_of_things() {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    let solid: Vec<Shape> = inward_box([1.0, 1.0, 1.0], 0)
        .into_iter()
        .map(|mut shape| {
            shape.positions.iter_mut().for_each(|p| *p = p.map(|c| c + 0.5));
            shape.triangles.iter_mut().for_each(|t| t.swap(1, 2));
            shape
        })
        .collect();
    shapes.extend(solid);
    let scene =
        scene(shapes, vec![painted(Rgb::grey(0.5))], vec![isotropic([2.5, 2.0, 2.0], 300.0)]);
    let map = solved(&scene, 0.1);
    let reader = MapReader::new(&scene, &map);
    for sensor in sensors() {
        let inside = reader.on_sensor(Point::new(1.0, 1.0, 1.0), &sensor);
        assert_eq!(inside, None);
        let read = |z: f64| reader.on_sensor(Point::new(3.0, 2.0, z), &sensor).unwrap();
        let (on, above) = (read(0.0), read(1e-3));
        let error_lx = libm::hypot(on.standard_error_lx, above.standard_error_lx);
        let off = (on.illuminance_lx() - above.illuminance_lx()).abs();
        // A millimetre of 2 m changes direct light by a thousandth of it.
        assert!(off < DEVIATIONS * error_lx + 2e-3 * above.illuminance_lx(), "{on:?} {above:?}");
    }
}
