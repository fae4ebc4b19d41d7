//! Light that comes in through openings.

use super::*;
use crate::engine::gather::{Gatherer, Gathering, Unlit};
use crate::engine::light::{Goal, Lighting};
use crate::engine::mesh::{LEAST, lend_noise};
use crate::engine::method::{Hybrid, IncrementSize, PathTracer};
use crate::engine::pilot::pilot;
use crate::engine::ray::{NEVER, ProbePoint};
use crate::engine::read::{ExactSettings, MapReader};
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::{Standing, VertexLight};

/// Half the side of a square hole, 1 m above the floor, and the luminance of what is seen through it.
const HALF: f64 = 0.1;
const SKY_CD_M2: f64 = 4000.0;

/// A sheet with a hole below a luminous ceiling that is far larger.
fn hole() -> Scene {
    let (wide, out) = (30.0, 30.0 - HALF);
    let sheet = |corner: [f64; 2], u: f64, v: f64| {
        rectangle([corner[0], corner[1], 1.0], [0.0, v, 0.0], [u, 0.0, 0.0], 0)
    };
    let shapes = vec![
        sheet([-wide, -wide], out, 2.0 * wide),
        sheet([HALF, -wide], out, 2.0 * wide),
        sheet([-HALF, -wide], 2.0 * HALF, out),
        sheet([-HALF, HALF], 2.0 * HALF, out),
        rectangle([-wide, -wide, 2.0], [0.0, 2.0 * wide, 0.0], [2.0 * wide, 0.0, 0.0], 1),
        rectangle([-wide, -wide, 0.0], [2.0 * wide, 0.0, 0.0], [0.0, 2.0 * wide, 0.0], 0),
    ];
    let black = Material::two_sided("black", Finish::BLACK);
    scene(shapes, vec![black, glowing(SKY_CD_M2)], vec![])
}

/// Luminance times the projected solid angle of the hole, by its middle points.
fn through_hole_lx(at: Point) -> f64 {
    const STEPS: usize = 64;
    let step = 2.0 * HALF / STEPS as f64;
    let place = |k: usize| (k as f64 + 0.5) * step - HALF;
    let each = (0..STEPS * STEPS).map(|k| {
        let to = Point::new(place(k % STEPS), place(k / STEPS), 1.0) - at;
        let squared = to.length_squared();
        step * step * to.z * to.z / (squared * squared)
    });
    SKY_CD_M2 * each.sum::<f64>()
}

#[test]
fn light_through_a_small_hole_is_read_with_its_error() {
    let scene = hole();
    let lighting = Lighting::new(&scene);
    let up = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
    let (mut squared, mut sure) = (0.0, 0);
    let places = 24_u64;
    for k in 0..places {
        let at = Point::new(0.05 * k as f64, 0.02 * k as f64, 0.0);
        let surface = SurfacePoint::in_space(at, up, 0.0);
        let goal = Goal { lx: 0.5, ..Goal::reading(0.01) };
        let read = lighting.read(&surface, goal, Sequence::new(Key::new(4).with(k)));
        let exact = through_hole_lx(at);
        let (error, said) = (read.lx.luminance() - exact, read.variance.sqrt());
        assert!(said > 0.0, "nothing is known for sure in half-shadow: {k}");
        // By shadow rays at most this: what one of them in 32,768 brings, and as many as come through.
        let one_lx = std::f64::consts::PI * SKY_CD_M2 / 32_768.0;
        assert!(said < 2.0 * (exact * one_lx).sqrt() + one_lx, "{k}: {said} of {exact}");
        squared += (error / said).powi(2);
        sure += u64::from(error.abs() < 2.0 * said);
    }
    // The mean of 24 squares of Student's distribution of seven degrees of freedom, 1.4, and three times its spread.
    assert!(squared / (places as f64) < 3.0, "{squared}");
    assert!(sure >= places - 5, "{sure}");
}

#[test]
fn paths_ask_for_direct_light_as_often_as_for_the_rest() {
    let scene = hole();
    let tracer = PathTracer::new(&scene);
    let normal = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
    let at = ProbePoint { position: Point::new(0.4, 0.1, 0.5), normal };
    let said = |rays: u32| {
        let settings = ExactSettings { rays, ..ExactSettings::default() };
        tracer.estimate(at, &settings).standard_error_lx
    };
    let [few, many] = [256, 16_384].map(said);
    assert!(many > 0.0 && many < 0.3 * few, "{many} after {few}");
}

/// Two rooms of 4 x 4 x 3 m, a wall between them that leaves 80 cm open, and a lamp in the first.
#[test]
fn a_dim_room_keeps_what_comes_in_beside_a_wall() {
    let mut shapes = inward_box([8.0, 4.0, 3.0], 0);
    let (thick, deep, high) = ([0.1, 0.0, 0.0], [0.0, 3.2, 0.0], [0.0, 0.0, 3.0]);
    shapes.push(rectangle([3.95, 0.0, 0.0], high, deep, 0));
    shapes.push(rectangle([4.05, 0.0, 0.0], deep, high, 0));
    shapes.push(rectangle([3.95, 3.2, 0.0], high, thick, 0));
    let scene =
        scene(shapes, vec![painted(Rgb::grey(0.7))], vec![isotropic([1.5, 1.0, 2.0], 800.0)]);
    let request = SolveRequest { accuracy: Some(0.01), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let (reader, tracer) = (MapReader::new(&scene, &map), PathTracer::new(&scene));
    let normal = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
    let (mut read_lx, mut true_lx) = (0.0, 0.0);
    for k in 0..12 {
        let position = Point::new(5.1 + 0.2 * f64::from(k), 0.3 + 0.3 * f64::from(k), 0.8);
        let at = ProbePoint { position, normal };
        let settings = ExactSettings { rays: 1024, ..ExactSettings::default() };
        read_lx += reader.estimate(at, &settings).illuminance_lx();
        true_lx += tracer.estimate(at, &settings).illuminance_lx();
    }
    // Light of the dim room is known to some per cent; a tenth of it was lost where elements reach through the wall.
    assert!((read_lx / true_lx - 1.0).abs() < 0.05, "{read_lx} {true_lx}");
}

#[test]
fn vertices_have_noise_as_those_about_them() {
    let floor = rectangle([0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], 0);
    let scene = scene(vec![floor], vec![painted(Rgb::WHITE)], vec![]);
    let mut subdivision = crate::elements::Subdivision::new(&scene);
    subdivision.bisect_to(1.0, 1000);
    let elements = subdivision.elements();
    let noisy = |lx: f64| {
        Some(VertexLight {
            indirect_standard_error_lx: lx,
            standard_error_lx: libm::hypot(lx, 3.0),
            standing: Standing::Open,
            ..VertexLight::NOTHING
        })
    };
    let mut values = vec![noisy(4.0); elements.vertices().len()];
    values[5] = noisy(0.0);
    values[6] = None;
    lend_noise(&elements, &mut values);
    let told = values[5].unwrap();
    // A third to a fifth of what its elements have is its own.
    let [low, high] = [0.6, 1.0].map(|share| 4.0 * (share * LEAST).sqrt());
    assert!((low..high).contains(&told.indirect_standard_error_lx), "{told:?}");
    let whole = libm::hypot(told.indirect_standard_error_lx, 3.0);
    assert!((told.standard_error_lx - whole).abs() < 1e-9);
    assert!(values[6].is_none());
    assert!(values[0].is_some_and(|v| (v.indirect_standard_error_lx - 4.0).abs() < 1e-12));
}

/// A room of 4 x 4 x 3 m with a window of 1.2 x 1.2 m, in the sun, slats in the window, and what the room reflects.
fn room_behind_slats(reflectance: f64) -> Scene {
    let wall = |x: [f64; 2], z: [f64; 2]| {
        let (u, w) = ([x[1] - x[0], 0.0, 0.0], [0.0, 0.0, z[1] - z[0]]);
        rectangle([x[0], 0.0, z[0]], w, u, 1)
    };
    let mut shapes = inward_box([4.0, 4.0, 3.0], 1);
    // The wall towards the yard.
    shapes.remove(3);
    shapes.extend([
        wall([0.0, 1.4], [0.0, 3.0]),
        wall([2.6, 4.0], [0.0, 3.0]),
        wall([1.4, 2.6], [0.0, 1.0]),
        wall([1.4, 2.6], [2.2, 3.0]),
        rectangle([-8.0, -12.0, -0.1], [20.0, 0.0, 0.0], [0.0, 12.0, 0.0], 0),
    ]);
    let slat = |k: u32| {
        rectangle([1.4, -0.1, 1.05 + 0.1 * f64::from(k)], [1.2, 0.0, 0.0], [0.0, 0.1, 0.0], 2)
    };
    shapes.extend((0..12).map(slat));
    let both = |name: &str, rho: f64| Material::two_sided(name, Finish::diffuse(Rgb::grey(rho)));
    let materials = vec![both("yard", 0.2), both("room", reflectance), both("slat", 0.7)];
    let direction = direction([0.0, 0.6, -0.8]);
    let kind =
        LuminaireKind::Directional { direction, illuminance_lx: 60_000.0, half_angle_rad: 0.0 };
    scene(shapes, materials, vec![luminaire(kind)])
}

#[test]
fn errors_count_for_the_dim_room_that_sees_them() {
    let most_on = |material: u32, reflectance: f64| {
        let scene = room_behind_slats(reflectance);
        let lighting = Lighting::new(&scene);
        let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
        let material_of = |node: u32| {
            let (_, origin) = plan.mesh.subdivision.node(node);
            scene.material_index(origin.triangle)
        };
        let of = plan.errors.of_elements.iter().filter(|e| material_of(e.node) == material);
        of.map(|e| e.seen).fold(0.0, f64::max)
    };
    // By reciprocity as often as a surface reflects and sees the room: slats to a third of their hemisphere or more, and the room
    // has less than a tenth of the light. The yard is seen by what is as bright.
    let [yard, slats] = [0, 2].map(|material| most_on(material, 0.6));
    assert!(slats > 0.7 / 3.0 * 10.0 && yard < 1.0, "{slats} on slats, {yard} in the yard");
}

#[test]
fn noise_that_readings_have_in_common_is_told_at_vertices() {
    const INCREMENTS: u64 = 48;
    let scene = room_behind_slats(0.6);
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let size = IncrementSize { rays: 64.0, halvings: 0, particles: 0, goal: 0.02 };
    let mut hybrid = Hybrid::new(&plan, &[], size, 1 << 10, 1);
    // Floor, a side and the back of the room, by so many rays that theirs is no noise beside that of what they read.
    let places = [[1.9, 2.1, 0.0], [4.0, 1.7, 1.3], [1.1, 4.0, 1.6]];
    let places = places.map(|at| front_at(&scene, Point::from(at)));
    let gathering = Gathering::of(&plan, &plan.light.direct);
    let rows = places.map(|at| Gatherer::on_surface(at, 1 << 13));
    let operator = gathering.operator(&rows, |row| Key::new(77).with(row as u64));
    let (mut read, mut told) = (vec![Vec::new(); 3], vec![Vec::new(); 3]);
    for index in 0..INCREMENTS {
        let increment = hybrid.increment(index, &[], &NEVER).unwrap();
        let light: Vec<Rgb> =
            increment.receivers[..plan.mesh.indirect_vertices].iter().map(|s| s.indirect).collect();
        for (k, lx) in operator.reflected(&light).into_iter().enumerate() {
            read[k].push(lx.luminance());
            let SurfacePoint { triangle, back, u, v, .. } = places[k];
            let corners = plan.mesh.elements.locate(triangle, back, u, v).unwrap();
            let of = |&(vertex, weight): &(u32, f64)| {
                weight * increment.receivers[vertex as usize].passed_on
            };
            told[k].push(corners.iter().map(of).sum::<f64>());
        }
    }
    for (read, told) in read.into_iter().zip(told) {
        let [mean, read, told] = {
            let [(mean, read), (_, told)] = [read, told].map(|of| mean_and_error(of.into_iter()));
            [mean, read, told]
        };
        // By 48 increments either is known to a tenth; what own rays leave may be as much again as half of it.
        assert!(read > 1e-3 * mean, "there is noise to be told: {read} of {mean}");
        assert!(told > 0.7 * read && told < 2.0 * read, "{told} told, {read} of {mean}");
    }
}
