//! Tests with a room below a sky, a box that shines inwards or one infinitely far away: its direct light is that of its windows.

use super::super::lighting::Lighting;
use super::super::polygon::steradians;
use super::*;
use crate::engine::tests::{glowing, inward_box, rectangle, scene};
use crate::photometry::{GeneralSky, Sky, SkyPicture};
use crate::sampling::{Key, Sequence};
use crate::scene::{Finish, Luminaire, LuminaireKind, Material, Scene, Shape};
use isolux_geometry::Transform;
use std::sync::Arc;

const SKY_CD_M2: f64 = 4000.0;

/// Rays of every measurement.
const RAYS: u32 = 2048;
/// Standard errors by which none of a hundred such means is off.
const SIGMAS: f64 = 4.5;

/// A wall from a corner along two axes, divided into cells, without the cells in `holes` (start and
/// end along both axes).
fn wall(
    corner: [f64; 3],
    [along, up]: [[f64; 3]; 2],
    sizes: [f64; 2],
    holes: &[[f64; 4]],
    material: u32,
) -> Vec<Shape> {
    let cuts = |axis: usize| {
        let mut all = vec![0.0, sizes[axis]];
        all.extend(holes.iter().flat_map(|hole| [hole[2 * axis], hole[2 * axis + 1]]));
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let times = |v: [f64; 3], by: f64| v.map(|x| x * by);
    let mut shapes = Vec::new();
    for a in cuts(0).windows(2) {
        for b in cuts(1).windows(2) {
            let (x, y) = (0.5 * (a[0] + a[1]), 0.5 * (b[0] + b[1]));
            let is_open = |h: &[f64; 4]| h[0] < x && x < h[1] && h[2] < y && y < h[3];
            if !holes.iter().any(is_open) {
                let at = |k: usize| corner[k] + along[k] * a[0] + up[k] * b[0];
                let sides = (times(along, a[1] - a[0]), times(up, b[1] - b[0]));
                shapes.push(rectangle([at(0), at(1), at(2)], sides.0, sides.1, material));
            }
        }
    }
    shapes
}

/// A room of 4 x 5 x 3 m with two windows and a skylight, below a sky all around that is a box.
fn room() -> Scene {
    let mut shapes = walls();
    shapes.push(sky());
    scene(shapes, vec![wall_paint(), glowing(SKY_CD_M2)], vec![])
}

/// The same below a sky that is infinitely far away.
fn room_below(sky: Sky) -> Scene {
    let kind = LuminaireKind::Sky { world_from_sky: Transform::IDENTITY, sky };
    let sky = Luminaire { name: "sky".into(), group: 0, colour: Rgb::WHITE, kind };
    scene(walls(), vec![wall_paint()], vec![sky])
}

fn uniform() -> Sky {
    Sky::General { sky: GeneralSky::uniform(SKY_CD_M2), ground_cd_m2: SKY_CD_M2 }
}

fn wall_paint() -> Material {
    Material::two_sided("wall", Finish::diffuse(Rgb::grey(0.5)))
}

fn walls() -> Vec<Shape> {
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let windows = [[0.5, 1.7, 0.9, 2.1], [2.2, 3.4, 0.9, 2.1]];
    let mut shapes = wall([0.0; 3], [x, z], [4.0, 3.0], &windows, 0);
    shapes.extend(wall([0.0; 3], [x, y], [4.0, 5.0], &[], 0));
    shapes.extend(wall([0.0, 0.0, 3.0], [x, y], [4.0, 5.0], &[[1.5, 2.0, 3.0, 4.0]], 0));
    shapes.extend(wall([0.0; 3], [y, z], [5.0, 3.0], &[], 0));
    shapes.extend(wall([4.0, 0.0, 0.0], [y, z], [5.0, 3.0], &[], 0));
    shapes.extend(wall([0.0, 5.0, 0.0], [x, z], [4.0, 3.0], &[], 0));
    shapes
}

/// A cube of 160 m that emits inwards, in one piece.
fn sky() -> Shape {
    let mut whole = Shape { name: "sky".into(), material: 1, ..Shape::default() };
    for side in inward_box([160.0; 3], 1) {
        let first = whole.positions.len() as u32;
        whole.positions.extend(side.positions.iter().map(|corner| corner.map(|x| x - 80.0)));
        whole.triangles.extend(side.triangles.iter().map(|t| t.map(|corner| first + corner)));
    }
    whole
}

/// Illuminance from the windows at a place that sees all of them without obstacles, lx.
fn windows_lx(at: &SurfacePoint) -> f64 {
    let window = |low: [f64; 3], high: [f64; 3], sides: [usize; 2]| {
        let corner = |s: usize, t: usize| {
            let mut corner = low;
            (corner[sides[0]], corner[sides[1]]) =
                ([low, high][s][sides[0]], [low, high][t][sides[1]]);
            Point::from(corner)
        };
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        let both_ways = [[a, b, c], [a, c, d], [a, c, b], [a, d, c]];
        both_ways.iter().map(|half| steradians(at, *half)).sum::<f64>()
    };
    let front = |x: f64| window([x, 0.0, 0.9], [x + 1.2, 0.0, 2.1], [0, 2]);
    let roof = window([1.5, 3.0, 3.0], [2.0, 4.0, 3.0], [0, 1]);
    SKY_CD_M2 * (front(0.5) + front(2.2) + roof)
}

/// Places inside the room, on floor and walls, or outside, on roof and walls.
fn places(scene: &Scene, is_inside: bool) -> Vec<SurfacePoint> {
    let sides = (0..scene.triangle_count()).flat_map(|t| [(t, false), (t, true)]);
    let middle = |(triangle, back)| SurfacePoint::new(scene, triangle, back, 0.4, 0.25);
    let is_it = |at: &SurfacePoint| {
        let in_room = (at.point + at.geometric * 0.01).to_vector();
        let lies_in = |x: f64, most: f64| 0.0 < x && x < most;
        let lies_inside =
            lies_in(in_room.x, 4.0) && lies_in(in_room.y, 5.0) && lies_in(in_room.z, 3.0);
        lies_inside == is_inside && scene.material_index(at.triangle) == 0
    };
    sides.map(middle).filter(is_it).collect()
}

/// Mean and variance of estimates by one ray, lx.
fn by_one_ray(lighting: &Lighting, at: &SurfacePoint, seed: u64) -> [f64; 2] {
    let sequence = |k: u32| Sequence::new(Key::new(seed).with(u64::from(k)));
    let one = |k: u32| lighting.estimate(at, &mut Dice::new(sequence(k), 0)).luminance();
    let values: Vec<f64> = (0..RAYS).map(one).collect();
    let mean = values.iter().sum::<f64>() / f64::from(RAYS);
    let squares = values.iter().map(|lx| (lx - mean).powi(2)).sum::<f64>();
    [mean, squares / f64::from(RAYS - 1)]
}

#[test]
fn windows_are_found_where_they_are() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    check_openings(lighting.openings.surfaces[0].as_ref().unwrap());
    let scene = room_below(uniform());
    let lighting = Lighting::new(&scene);
    check_openings(&lighting.openings.skies[0].1);
}

/// Whether they are the windows and the skylight.
fn check_openings(before: &Before) {
    assert!(before.surrounds);
    let mut found: Vec<_> = before
        .openings
        .iter()
        .map(|opening| {
            let [a, c] = [opening.corner, opening.corner + opening.sides[0] + opening.sides[1]];
            let [a, c] = [a.to_vector(), c.to_vector()];
            let low = [a.x.min(c.x), a.y.min(c.y), a.z.min(c.z)];
            (low, opening.sides.map(Vector::length), opening.outwards)
        })
        .collect();
    found.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap());
    assert_eq!(found.len(), 3, "{found:?}");
    let expected = [
        ([0.5, 0.0, 0.9], 1.2 * 1.2, [0.0, -1.0, 0.0]),
        ([1.5, 3.0, 3.0], 0.5, [0.0, 0.0, 1.0]),
        ([2.2, 0.0, 0.9], 1.2 * 1.2, [0.0, -1.0, 0.0]),
    ];
    for ((low, sides, outwards), (corner, area, normal)) in found.iter().zip(expected) {
        // Ends are at the corners of walls, to a millionth of their length.
        assert!(low.iter().zip(corner).all(|(a, b)| (a - b).abs() < 1e-5), "{low:?}");
        assert!((sides[0] * sides[1] - area).abs() < 1e-5, "{sides:?}");
        assert!((*outwards - Vector::from(normal)).length() < 1e-9, "{outwards:?}");
    }
}

#[test]
fn light_through_windows_is_exact_with_little_noise() {
    let scene = room();
    let mut without = Lighting::new(&scene);
    without.openings = Openings::default();
    check_windows(&scene, &without, windows_lx, 0.05);
}

#[test]
fn light_of_skies_through_windows_is_exact_with_little_noise() {
    let sun = Vector::new(-0.5, -0.4, 0.5).direction().unwrap();
    let clear = GeneralSky::cie(12, sun).unwrap().with_horizontal_lx(1e4).unwrap();
    let clear = Sky::General { sky: clear, ground_cd_m2: 600.0 };
    // A hundredth of the sky is a hundred times as bright as the rest: it has rays of its own.
    let mut rgb_cd_m2 = vec![[1000.0; 3]; 16 * 32];
    rgb_cd_m2[4 * 32 + 17] = [1e5; 3];
    rgb_cd_m2[12 * 32 + 17] = [1e5; 3];
    let picture = Sky::Picture(Arc::new(SkyPicture { width: 32, height: 16, rgb_cd_m2 }));
    for (sky, spread) in [(uniform(), 0.05), (clear, 0.3), (picture, 1.5)] {
        let scene = room_below(sky.clone());
        let mut without = Lighting::new(&scene);
        let LuminaireKind::Sky { sky: of, .. } = &scene.luminaires()[0].kind else { panic!() };
        let far = FarSky::new(of, Transform::IDENTITY);
        without.openings = Openings::new(Vec::new(), vec![(0, Before::sky(far))]);
        check_windows(&scene, &without, |at| sky_through_windows_lx(at, &sky), spread);
    }
}

/// Illuminance from the windows, by the middles of many small parts of them, lx.
fn sky_through_windows_lx(at: &SurfacePoint, sky: &Sky) -> f64 {
    const STEPS: usize = 300;
    let window = |corner: [f64; 3], sides: [[f64; 3]; 2]| {
        let [u, v] = sides.map(Vector::from);
        let normal = u.cross(v).normal().unwrap();
        let part_m2 = u.cross(v).length() / (STEPS * STEPS) as f64;
        let one = |k: usize| {
            let share = |k: usize| (k as f64 + 0.5) / STEPS as f64;
            let place = Point::from(corner) + u * share(k % STEPS) + v * share(k / STEPS);
            let way = place - at.point;
            let towards = way.direction().unwrap();
            let cos = facing_cos(towards, at.shading, at.geometric).unwrap_or(0.0);
            let sr = part_m2 * towards.cos(normal).abs() / way.length_squared();
            sky.luminance_cd_m2(towards).luminance() * cos * sr
        };
        (0..STEPS * STEPS).map(one).sum::<f64>()
    };
    let [x, z] = [[1.2, 0.0, 0.0], [0.0, 0.0, 1.2]];
    window([0.5, 0.0, 0.9], [x, z])
        + window([2.2, 0.0, 0.9], [x, z])
        + window([1.5, 3.0, 3.0], [[0.5, 0.0, 0.0], [0.0, 1.0, 0.0]])
}

/// Whether light is the exact one, and rays through openings have less noise than those without. `allowed` is the relative
/// deviation of sixty-four rays.
fn check_windows(
    scene: &Scene,
    without: &Lighting,
    exact_lx: impl Fn(&SurfacePoint) -> f64,
    allowed: f64,
) {
    let lighting = Lighting::new(scene);
    let [mut compared, mut spread, mut usual] = [0.0; 3];
    for (k, at) in places(scene, true).iter().enumerate() {
        let exact = exact_lx(at);
        if exact < 1.0 {
            continue;
        }
        let [mean, variance] = by_one_ray(&lighting, at, k as u64);
        let error = (variance / f64::from(RAYS)).sqrt();
        assert!((mean - exact).abs() < SIGMAS * error, "{k}: {mean} +- {error}, not {exact}");
        // A quarter of the rays is spread over the hemisphere; the rest share the openings.
        let lx = lighting.illuminance(at, &mut Dice::new(Sequence::new(Key::new(k as u64)), 0));
        assert!((lx.luminance() / exact - 1.0).abs() < allowed, "{k}: {lx:?}, not {exact}");
        compared += 1.0;
        spread += variance / (exact * exact);
        let [_, variance] = by_one_ray(without, at, k as u64);
        usual += variance / (exact * exact);
    }
    assert!(compared > 20.0, "{compared}");
    assert!(spread < 0.1 * usual, "{spread} and {usual} of {compared}");
}

#[test]
fn light_outside_is_what_it_was() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let mut without = Lighting::new(&scene);
    without.openings = Openings::default();
    for (k, at) in places(&scene, false).iter().enumerate() {
        let [mean, variance] = by_one_ray(&lighting, at, k as u64);
        let [usual, of_usual] = by_one_ray(&without, at, 1000 + k as u64);
        let error = ((variance + of_usual) / f64::from(RAYS)).sqrt();
        assert!(
            (mean - usual).abs() <= SIGMAS * error + 1e-6 * usual,
            "{k}: {mean} +- {error}, not {usual}"
        );
    }
}

#[test]
fn what_is_seen_from_everywhere_has_no_openings() {
    let mut shapes = inward_box([4.0, 5.0, 3.0], 0);
    shapes.push(rectangle([0.2, 0.2, 2.9], [0.0, 4.6, 0.0], [3.6, 0.0, 0.0], 1));
    let wall = Material::two_sided("wall", Finish::diffuse(Rgb::grey(0.5)));
    let scene = scene(shapes, vec![wall, glowing(SKY_CD_M2)], vec![]);
    assert!(Lighting::new(&scene).openings.surfaces.iter().all(Option::is_none));
}
