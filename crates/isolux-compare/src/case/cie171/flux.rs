//! 5.4, conservation of luminous flux: what enters a room by an opening lands on its surfaces.
//!
//! A sky of uniform luminance L sends `pi L A` through an opening of area A in the roof, whatever the sky
//! is made of. No reading is a sum, so the case asks for local values on a grid of each surface, exact by
//! Lambert's formula for the opening; their integral over floor and walls is that flux, which the tests
//! show (the ceiling, in the plane of the opening, receives nothing). The readings of an engine, each within its
//! error of such a value, then keep the flux as well. The sky is a luminous box upon the roof: seen through
//! the opening from below it is everywhere.

use super::panel::{Panel, inside_of};
use super::room::{EDGE_M, HEIGHT_M, Room, black, direct, luminous};
use super::visible::lambert_lx;
use crate::expectation::{Case, Expectation};
use isolux::engine::ProbePoint;
use isolux::quadrature::GaussRule;
use isolux::scene::{SceneParts, Shape};

const NAME: &str = "cie171_5_4";
const LUMINANCE_CD_M2: f64 = 4000.0;
/// Nodes each way on a surface.
const NODES: usize = 4;

pub(super) fn case() -> Case {
    Case {
        name: NAME,
        notes: "CIE 171 5.4: flux of a roof opening, as local values on a grid of all surfaces",
        parts,
        expectations,
    }
}

/// A square of 1 m in the middle of the roof.
pub(super) fn small_opening() -> Panel {
    Panel { axis: 2, level_m: HEIGHT_M, looks_up: false, b: [1.5, 2.5], c: [1.5, 2.5] }
}

/// The luminous faces of a box upon the roof.
pub(super) fn sky_on_roof(material: u32) -> Vec<Shape> {
    sky_panels().iter().map(|panel| panel.shape("sky", material)).collect()
}

/// The same, as rectangles.
pub(super) fn sky_panels() -> Vec<Panel> {
    let faces = inside_of([0.0, 0.0, HEIGHT_M], [EDGE_M, EDGE_M, HEIGHT_M + 1.0]);
    faces.into_iter().filter(|face| !(face.axis == 2 && face.looks_up)).collect()
}

fn parts() -> SceneParts {
    let mut shapes = Room::from_x(0.0).shapes(Some(small_opening()));
    shapes.extend(sky_on_roof(1));
    SceneParts {
        name: NAME.into(),
        shapes,
        materials: vec![black(), luminous(LUMINANCE_CD_M2)],
        ..SceneParts::default()
    }
}

fn lx(at: ProbePoint) -> f64 {
    lambert_lx(LUMINANCE_CD_M2, &small_opening().corners(), at)
}

fn lit_faces() -> Vec<Panel> {
    let room = Room::from_x(0.0);
    vec![room.floor, room.west, room.east, room.south, room.north]
}

/// Places of a Gauss rule over a face, and the area that each stands for, m2.
fn grid(face: Panel, nodes: usize) -> Vec<(ProbePoint, f64)> {
    let rule = GaussRule::new(nodes);
    let across = |range: [f64; 2]| -> Vec<(f64, f64)> { rule.over(range[0], range[1]).collect() };
    let (along_b, along_c) = (across(face.b), across(face.c));
    let row = |&(b, w): &(f64, f64)| {
        along_c.iter().map(|&(c, v)| (face.place(b, c), w * v)).collect::<Vec<_>>()
    };
    along_b.iter().flat_map(row).collect()
}

fn expectations() -> Vec<Expectation> {
    let places = lit_faces().into_iter().flat_map(|face| grid(face, NODES));
    places.flat_map(|(at, _)| direct(at, lx(at))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::visible::within;
    use super::*;
    use crate::tolerance::{FLUX_ON_GRID, QUADRATURE};
    use std::f64::consts::PI;

    fn flux_lm(nodes: usize) -> f64 {
        let places = lit_faces().into_iter().flat_map(|face| grid(face, nodes));
        places.map(|(at, area_m2)| area_m2 * lx(at)).sum()
    }

    #[test]
    fn values_on_surfaces_sum_to_the_flux_of_the_opening() {
        let entering_lm = PI * LUMINANCE_CD_M2 * small_opening().area_m2();
        let (finest, readings) = (flux_lm(48), flux_lm(NODES));
        assert!((finest / entering_lm - 1.0).abs() < QUADRATURE, "{finest} of {entering_lm}");
        assert!((readings / entering_lm - 1.0).abs() < FLUX_ON_GRID, "{readings}");
    }

    #[test]
    fn the_sky_fills_the_opening() {
        for (at, _) in lit_faces().into_iter().flat_map(|face| grid(face, NODES)) {
            let seen = |p: &Panel| within(&p.corners(), &small_opening().corners(), at.position);
            let faces = sky_panels();
            let by_faces: f64 =
                faces.iter().map(|p| lambert_lx(LUMINANCE_CD_M2, &seen(p), at)).sum();
            assert!((by_faces / lx(at) - 1.0).abs() < QUADRATURE, "{by_faces} {}", lx(at));
        }
    }
}
