//! What energy allows, and maps that have more.

use super::*;
use crate::engine::gather::Unlit;
use crate::engine::judge::{Allowed, allowed_lx};
use crate::engine::light::Lighting;
use crate::engine::pilot::pilot;
use std::f64::consts::PI;

fn room(reflectance: f64) -> Scene {
    let walls = inward_box([3.0, 2.0, 2.5], 0);
    scene(walls, vec![painted(Rgb::grey(reflectance))], vec![isotropic([1.0, 1.2, 1.5], 100.0)])
}

const AREA_M2: f64 = 2.0 * (3.0 * 2.0 + 3.0 * 2.5 + 2.0 * 2.5);

/// In a closed room of one reflectance it is what there is.
#[test]
fn a_closed_room_has_all_that_energy_allows() {
    for reflectance in [0.0, 0.5, 0.99] {
        let expected = 400.0 * PI / AREA_M2 * reflectance / (1.0 - reflectance);
        let found = allowed_lx(&room(reflectance), AREA_M2);
        assert!((found - expected).abs() <= 1e-9 * expected, "{found} {expected}");
    }
    assert_eq!(allowed_lx(&room(1.0), AREA_M2), f64::INFINITY);
}

#[test]
fn more_than_that_is_found_and_what_is_no_number_too() {
    let scene = room(0.5);
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let allowed = allowed_lx(&scene, plan.area_m2());
    let energy = Allowed::of(&plan);
    let excess = |lx: &dyn Fn(usize) -> f64| energy.excess_lx(lx);
    assert!(excess(&|k| plan.light.guess[k].luminance()).is_none());
    assert!(excess(&|_| 1.9 * allowed).is_none(), "noise may be as much as the light");
    let [mean, most] = excess(&|_| 1e8).expect("it is more");
    assert!((mean / 1e8 - 1.0).abs() < 1e-9 && most == allowed);
    assert!(excess(&|k| if k == 0 { f64::NAN } else { 0.0 }).is_some());
}
