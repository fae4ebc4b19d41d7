//! 5.3, an area light source: a luminous square in the ceiling, seen from floor and walls.
//!
//! Nothing reflects, so the illuminance is the luminance times the projected solid angle, Lambert's formula
//! ([`crate::lambert`], tested there against quadrature and against known configuration factors). The
//! square lies above the plane of every wall's foot and in front of every wall: all of it is seen.

use super::panel::Panel;
use super::room::{HEIGHT_M, Room, black, direct, luminous};
use super::visible::lambert_lx;
use crate::expectation::{Case, Expectation};
use isolux::engine::ProbePoint;
use isolux::scene::SceneParts;

const NAME: &str = "cie171_5_3";
const LUMINANCE_CD_M2: f64 = 3000.0;

pub(super) fn case() -> Case {
    Case {
        name: NAME,
        notes: "CIE 171 5.3: a luminous square in the ceiling of a black room",
        parts,
        expectations,
    }
}

/// One square metre off the middle of the ceiling.
fn square() -> Panel {
    Panel { axis: 2, level_m: HEIGHT_M, looks_up: false, b: [1.2, 2.2], c: [1.5, 2.5] }
}

fn parts() -> SceneParts {
    let mut shapes = Room::from_x(0.0).shapes(Some(square()));
    shapes.push(square().shape("luminous", 1));
    SceneParts {
        name: NAME.into(),
        shapes,
        materials: vec![black(), luminous(LUMINANCE_CD_M2)],
        ..SceneParts::default()
    }
}

fn places() -> Vec<ProbePoint> {
    let room = Room::from_x(0.0);
    let floor = [0.2, 0.9, 1.7, 2.3, 3.0, 3.8].map(|x| room.floor.place(x, x));
    let west = [0.2, 1.0, 1.8, 2.5, 2.9].map(|z| room.west.place(2.0, z));
    let north = [(0.5, 3.5), (1.5, 1.5), (2.8, 0.4)].map(|(z, x)| room.north.place(z, x));
    [floor.as_slice(), &west, &north].concat()
}

fn expectations() -> Vec<Expectation> {
    let lx = |at| lambert_lx(LUMINANCE_CD_M2, &square().corners(), at);
    places().into_iter().flat_map(|at| direct(at, lx(at))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::visible::gathered_lx;
    use super::*;
    use crate::tolerance::QUADRATURE;

    #[test]
    fn lambert_agrees_with_quadrature_at_every_place() {
        for at in places() {
            let expected = lambert_lx(LUMINANCE_CD_M2, &square().corners(), at);
            let found = gathered_lx(&square().corners(), at, 48, |_| LUMINANCE_CD_M2);
            assert!((found / expected - 1.0).abs() < QUADRATURE, "{at:?}: {found} {expected}");
        }
    }
}
