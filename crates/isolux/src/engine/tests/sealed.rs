//! Luminous boxes, and what shines inside of them.

use super::*;
use crate::engine::light::Lighting;
use crate::engine::ray::SurfacePoint;
use crate::engine::{SolveRequest, Watch, solve};
use isolux_geometry::Vector;

const ROOM: u32 = 0;
const LAMP: u32 = 1;

/// A box of half a metre, 25 cm above the floor; faces of it outside, or inside.
fn lamp(is_inward: bool) -> Vec<Shape> {
    let mut shapes = inward_box([0.5; 3], LAMP);
    for shape in &mut shapes {
        shape.positions.iter_mut().for_each(|at| *at = [at[0] + 1.0, at[1] + 1.0, at[2] + 0.25]);
        if !is_inward {
            shape.triangles.iter_mut().for_each(|[_, b, c]| std::mem::swap(b, c));
        }
    }
    shapes
}

/// That in a room, or alone, with luminaires.
fn with(lamp: Vec<Shape>, has_room: bool, is_two_sided: bool, others: Vec<Luminaire>) -> Scene {
    let finish = Finish { luminance_cd_m2: Rgb::grey(1000.0), ..Finish::diffuse(Rgb::grey(0.5)) };
    let glow = match is_two_sided {
        true => Material::two_sided("glow", finish),
        false => Material::one_sided("glow", finish),
    };
    let mut shapes = if has_room { inward_box([3.0, 3.0, 2.5], ROOM) } else { Vec::new() };
    shapes.extend(lamp);
    scene(shapes, vec![painted(Rgb::grey(0.5)), glow], others)
}

fn sides(scene: &Scene) -> [usize; 2] {
    [false, true].map(|back| scene.area_luminaires().iter().filter(|a| a.back == back).count())
}

#[test]
fn closed_boxes_do_not_shine_inside() {
    assert_eq!(sides(&with(lamp(false), true, true, vec![])), [6, 0]);
    // Whichever way they face.
    assert_eq!(sides(&with(lamp(true), true, true, vec![])), [0, 6]);
    // Those that shine inside alone are meant to.
    assert_eq!(sides(&with(lamp(true), true, false, vec![])), [6, 0]);
}

#[test]
fn boxes_that_are_open_or_hold_something_shine_from_both_sides() {
    let mut open = lamp(false);
    open.pop();
    assert_eq!(sides(&with(open, true, true, vec![])), [5, 5]);
    assert_eq!(sides(&with(lamp(false), false, true, vec![])), [6, 6]);
    let inside = isotropic([1.25, 1.25, 0.5], 1.0);
    assert_eq!(sides(&with(lamp(false), true, true, vec![inside])), [6, 6]);
    let beside = isotropic([1.25, 1.25, 0.2], 1.0);
    assert_eq!(sides(&with(lamp(false), true, true, vec![beside])), [6, 0]);
    let mut pierced = lamp(false);
    pierced.push(rectangle([0.9, 1.2, 0.5], [0.7, 0.0, 0.0], [0.0, 0.1, 0.0], ROOM));
    assert_eq!(sides(&with(pierced, true, true, vec![])), [6, 6]);
}

#[test]
fn the_inside_of_a_lamp_is_no_part_of_the_accuracy() {
    let reference = |is_two_sided: bool| {
        let scene = with(lamp(false), true, is_two_sided, vec![]);
        let request = SolveRequest { accuracy: Some(0.02), ..SolveRequest::default() };
        let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
        crate::engine::reference_lx(&map)
    };
    let [two, one] = [true, false].map(reference);
    // Each is good to 2 %.
    assert!((two / one - 1.0).abs() < 0.04, "{two} for {one}");
}

/// Rounding puts half of the places on an inclined surface before its plane.
#[test]
fn surfaces_that_shine_from_one_side_do_not_light_their_other() {
    let glow = Finish { luminance_cd_m2: Rgb::grey(1000.0), ..Finish::diffuse(Rgb::grey(0.5)) };
    let inclined = rectangle([0.3, 0.1, 0.7], [0.9, 0.2, 0.4], [-0.1, 0.8, 0.3], 0);
    let scene = scene(vec![inclined], vec![Material::one_sided("glow", glow)], vec![]);
    let lighting = Lighting::new(&scene);
    let key = Key::new(7);
    for k in 0..500 {
        let [u, v] = [0, 1].map(|n| 0.5 * key.with(2 * k + n).uniform());
        let mut at = SurfacePoint::new(&scene, 0, true, u, v);
        // Normals between vertices are not those of triangles.
        at.shading = (at.shading.to_vector() + Vector::new(0.05, 0.0, 0.0)).normal().unwrap();
        // The other half of the rectangle may stand out by a rounding of its corners.
        let lx = lighting.illuminance(&at, &mut dice(k)).luminance();
        assert!(lx < 1e-6, "{lx} lx at {u} {v}");
    }
}
