//! The balance of energy, where it can be computed by hand.

use super::*;
use crate::engine::{SolveRequest, Watch, energy_balance, solve};
use crate::map::IlluminationMap;

const REFLECTANCE: f64 = 0.5;
const PARTICLES: u32 = 1 << 14;

/// A closed room, and one without a ceiling.
fn rooms() -> [Scene; 2] {
    let lamp = || vec![isotropic([2.0, 1.5, 1.5], 100.0)];
    let named = |(k, shape): (usize, Shape)| Shape { name: format!("wall {k}"), ..shape };
    let walls = || inward_box([4.0, 3.0, 2.5], 0).into_iter().enumerate().map(named);
    let paint = || vec![painted(Rgb::grey(REFLECTANCE))];
    [scene(walls().collect(), paint(), lamp()), scene(walls().take(5).collect(), paint(), lamp())]
}

fn solved(scene: &Scene) -> IlluminationMap {
    let request = SolveRequest { accuracy: Some(0.02), ..SolveRequest::default() };
    solve(scene, &request, None, &mut |_| Watch::Continue).unwrap().map
}

#[test]
fn all_light_of_a_closed_room_is_absorbed() {
    let [room, open] = rooms();
    let map = solved(&room);
    let balance = energy_balance(&room, &map, PARTICLES, 1).unwrap();
    let flux_lm = 400.0 * std::f64::consts::PI;
    assert!((balance.emitted_lm / flux_lm - 1.0).abs() < 1e-9);
    assert_eq!(balance.escaped.lm, 0.0);
    assert!((balance.absorbed.lm / flux_lm - 1.0).abs() < 1e-9, "{balance:?}");
    // Every reflection leaves half of it: what arrives is the sum of a geometric series.
    let arriving = balance.arriving;
    let right_lm = flux_lm / (1.0 - REFLECTANCE);
    assert!((arriving.lm - right_lm).abs() < SIGMAS * arriving.standard_error_lm, "{balance:?}");
    assert!(balance.holds(), "{balance:?}");
    let map = solved(&open);
    let balance = energy_balance(&open, &map, PARTICLES, 1).unwrap();
    let sum = balance.absorbed.lm + balance.escaped.lm;
    assert!((sum / flux_lm - 1.0).abs() < 1e-9 && balance.escaped.lm > 0.1 * flux_lm);
    assert!(balance.holds(), "{balance:?}");
}

/// Regression: a strip that no particle hit in any replicate was told to be lit by 0 lm without an error, and the map to be wrong.
#[test]
fn a_strip_that_few_particles_hit_is_not_judged_by_them_alone() {
    let lamp = vec![isotropic([2.0, 1.5, 1.5], 100.0)];
    let mut walls = inward_box([4.0, 3.0, 2.5], 0);
    // Of 600 particles, each of which arrives twice, some two arrive at 0.1 of 59 m2.
    let strip = rectangle([1.0, 1.0, 0.01], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0], 0);
    walls.push(Shape { name: "strip".into(), ..strip });
    let room = scene(walls, vec![painted(Rgb::grey(REFLECTANCE))], lamp);
    let map = solved(&room);
    let of_seed = |seed: u64| energy_balance(&room, &map, 600, seed).unwrap();
    let missed = (1..=60).map(of_seed).filter(|balance| !balance.holds()).count();
    assert_eq!(missed, 0);
}

#[test]
fn a_wall_that_lost_its_light_is_named() {
    let [room, _] = rooms();
    let mut map = solved(&room);
    for element in map.elements.elements() {
        if room.shape_of(element.triangle) == 3 {
            for vertex in element.vertices {
                if let Some(value) = &mut map.values[vertex as usize] {
                    (value.direct_lx, value.indirect_lx) = (Rgb::BLACK, Rgb::BLACK);
                }
            }
        }
    }
    let balance = energy_balance(&room, &map, PARTICLES, 1).unwrap();
    assert!(!balance.holds());
    assert_eq!(balance.surfaces[0].shape, "wall 3", "{balance:?}");
}

#[test]
fn parallel_light_has_no_balance() {
    let sun = LuminaireKind::Directional {
        direction: direction([0.0, 0.0, -1.0]),
        illuminance_lx: 1e4,
        half_angle_rad: 0.0,
    };
    let [room, _] = rooms();
    let map = solved(&room);
    let mut parts = room.to_parts();
    parts.luminaires.push(luminaire(sun));
    let scene = Scene::assemble(parts).unwrap();
    assert_eq!(energy_balance(&scene, &map, PARTICLES, 1), None);
}
