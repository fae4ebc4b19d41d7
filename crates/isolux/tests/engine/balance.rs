//! The balance of light: in a closed room whose surfaces absorb the same share of what they get,
//! and where nothing else absorbs, the flux that arrives is that of the luminaires over that share,
//! whatever stands in the room.

use crate::rooms::{
    clear_glass, glowing, inward_box, lamp, mirror, outward_box, painted, rectangle, scene,
};
use crate::runs::{METHODS, coarse, run};
use isolux::engine::SolveRequest;
use isolux::map::{IlluminationMap, Method};
use isolux::scene::{Material, Scene, Shape};
use std::f64::consts::PI;
use std::ops::Range;

const REFLECTANCE: f64 = 0.6;
const ROOM: [f64; 3] = [3.0, 2.0, 2.5];

fn walls() -> Vec<Shape> {
    inward_box([0.0; 3], ROOM, 0)
}

fn with(shapes: Vec<Shape>, material: Material) -> Scene {
    let all = walls().into_iter().chain(shapes).collect();
    scene(all, vec![painted(REFLECTANCE), material], vec![lamp([1.0, 1.2, 1.5], 100.0)])
}

fn check(name: &str, scene: &Scene, method: Method) {
    let request = SolveRequest { accuracy: Some(0.05), ..coarse(method, 1600) };
    let map = run(scene, &request, 16).expect("the scene has light").map;
    let accuracy = map.provenance.accuracy.expect("enough increments");
    let (mut arriving_lm, mut area_m2, mut squares) = (0.0, 0.0, 0.0);
    // As readers do, who add what stands for light that was not shot.
    let ambient_lx = map.ambient_lx().luminance();
    for (value, vertex) in map.values.iter().zip(map.elements.vertices()) {
        let lx = value.map_or(0.0, |v| v.illuminance_lx() + ambient_lx);
        arriving_lm += lx * vertex.area_m2;
        squares += lx * lx * vertex.area_m2;
        area_m2 += vertex.area_m2;
    }
    let expected_lm = scene.luminous_flux_lm() / (1.0 - REFLECTANCE);
    // The error of a mean is at most the root mean square that the map reports of itself.
    let allowed_lm = 3.0 * accuracy.reached * (squares / area_m2).sqrt() * area_m2;
    assert!(
        (arriving_lm - expected_lm).abs() < allowed_lm,
        "{name}, {method:?}: {arriving_lm} lm arrive of {expected_lm} +- {allowed_lm}"
    );
}

fn check_both(name: &str, scene: &Scene) {
    METHODS.into_iter().for_each(|method| check(name, scene, method));
}

#[test]
fn of_a_room() {
    check_both("empty", &with(vec![], painted(REFLECTANCE)));
    let block = outward_box([0.3, 0.3, 0.2], [0.8, 0.9, 0.8], 1);
    check_both("a block", &with(block, painted(REFLECTANCE)));
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn of_mirrors() {
    let block = outward_box([0.3, 0.3, 0.2], [0.8, 0.9, 0.8], 1);
    check_both("a block of mirrors", &with(block, mirror(1.0)));
}

#[test]
fn of_glass() {
    let pane = rectangle([0.4, 0.3, 0.3], [2.0, 0.0, 0.0], [0.0, 0.8, 1.2], 1);
    check_both("a pane", &with(vec![pane], clear_glass(1.5, true)));
    let block = outward_box([0.3, 0.3, 0.2], [0.8, 0.9, 0.8], 1);
    check_both("a block of glass", &with(block, clear_glass(1.5, false)));
}

/// All light comes through glass: no luminaire is seen from anywhere.
#[test]
fn of_a_lamp_in_a_box_of_glass() {
    let mut shade = outward_box([0.8, 1.0, 1.3], [0.4, 0.4, 0.4], 1);
    shade.extend(inward_box([0.81, 1.01, 1.31], [0.38, 0.38, 0.38], 1));
    check_both("a lamp in a box of glass", &with(shade, clear_glass(1.5, false)));
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn of_glowing_surfaces() {
    let panel = rectangle([1.0, 0.8, 2.4], [0.0, 0.4, 0.0], [0.6, 0.0, 0.0], 1);
    let shapes: Vec<Shape> = walls().into_iter().chain([panel]).collect();
    let materials = vec![painted(REFLECTANCE), glowing(500.0, REFLECTANCE)];
    let lit = scene(shapes, materials, vec![]);
    assert!((lit.luminous_flux_lm() - PI * 500.0 * 0.24).abs() < 1e-3);
    check_both("a panel below the ceiling", &lit);
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn of_parallel_mirrors() {
    // A passage half a metre wide; the walls at y = 0 and y = 0.5 are mirrors.
    let mut shapes = inward_box([0.0; 3], [3.0, 0.5, 2.5], 0);
    shapes[2].material = 1;
    shapes[3].material = 1;
    let materials = vec![painted(REFLECTANCE), mirror(1.0)];
    let passage = scene(shapes, materials, vec![lamp([1.0, 0.2, 1.5], 100.0)]);
    check_both("parallel mirrors", &passage);
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn of_water() {
    let surface = rectangle([0.0, 0.0, 1.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0], 1);
    check_both("a floor under water", &with(vec![surface], clear_glass(1.33, false)));
}

/// A pool: where the luminance is the same all around it stays so, but under water it is larger by
/// the square of the index, and so is the illuminance.
#[test]
fn of_even_light_under_water() {
    let (ior, luminance_cd_m2) = (1.33, 100.0);
    let [x, y, z] = ROOM;
    let level_m = 1.0;
    let water = inward_box([0.0; 3], [x, y, level_m], 0);
    let air = inward_box([0.0, 0.0, level_m], [x, y, z], 1);
    // Walls, the floor of the one, the ceiling of the other; the surface between them.
    let mut shapes: Vec<Shape> = [&water[..5], &air[..4], &air[5..]].concat();
    shapes.push(rectangle([0.0, 0.0, level_m], [x, 0.0, 0.0], [0.0, y, 0.0], 2));
    let glow = |times: f64| glowing(times * luminance_cd_m2, REFLECTANCE);
    let pool = scene(shapes, vec![glow(ior * ior), glow(1.0), clear_glass(ior, false)], vec![]);
    let air_lx = PI * luminance_cd_m2 / (1.0 - REFLECTANCE);
    for method in METHODS {
        let request = SolveRequest { accuracy: Some(0.05), ..coarse(method, 1600) };
        let map = run(&pool, &request, 16).expect("the scene has light").map;
        check_level(&map, "water", 0.0..level_m, ior * ior * air_lx);
        check_level(&map, "air", level_m + 1e-3..z + 1e-3, air_lx);
    }
}

/// The mean illuminance of vertices at the heights given.
fn check_level(map: &IlluminationMap, name: &str, heights_m: Range<f64>, expected_lx: f64) {
    let (mut arriving_lm, mut area_m2) = (0.0, 0.0);
    for (value, vertex) in map.values.iter().zip(map.elements.vertices()) {
        if let Some(value) = value.filter(|_| heights_m.contains(&vertex.position.z)) {
            arriving_lm += value.illuminance_lx() * vertex.area_m2;
            area_m2 += vertex.area_m2;
        }
    }
    let mean_lx = arriving_lm / area_m2;
    let reached = map.provenance.accuracy.expect("enough increments").reached;
    // As above; and the two parts, which share it, may each have twice the squared error.
    let allowed_lx = 3.0 * std::f64::consts::SQRT_2 * reached * expected_lx;
    let method = map.provenance.method;
    assert!(
        (mean_lx - expected_lx).abs() < allowed_lx,
        "{name}, {method:?}: {mean_lx} lx for {expected_lx} +- {allowed_lx}"
    );
}
