//! 5.9 and 5.10, the sky component under an unglazed and a glazed opening in the roof.
//!
//! Of a uniform sky the unglazed opening gives the illuminance of a luminous polygon in its place (Lambert),
//! whatever the sky is made of; behind a clear pane every direction is weighted with the
//! transmittance at its incidence, an integral over the opening. The uniform sky is a luminous box upon the roof. The
//! overcast and the clear sky are infinitely far away ([`super::sky`]). The sun of the clear sky is itself left out; no
//! place sees the part of the sky about it, where luminance has a cusp. All surfaces are black: what glass
//! reflects goes back to the sky.

use super::super::glass::{pane, pane_material};
use super::flux::sky_on_roof;
use super::panel::Panel;
use super::room::{HEIGHT_M, Room, black, direct, luminous};
use super::sky::{CieSky, Skylight};
use super::visible::{gathered_lx, lambert_lx};
use crate::expectation::{Case, Expectation};
use isolux::engine::ProbePoint;
use isolux::geometry::Vector;
use isolux::scene::{SceneParts, Shape};
use isolux::units::Rgb;

const LUMINANCE_CD_M2: f64 = 4000.0;
/// Nodes over the opening of a uniform sky.
const NODES: usize = 40;
/// Number of the material of panes in scenes that have one.
const PANE: u32 = 1;

pub(super) fn cases() -> [Case; 5] {
    [
        Case {
            name: "cie171_5_9_uniform",
            notes: "CIE 171 5.9: a uniform sky through an unglazed roof opening",
            parts: || under_uniform("cie171_5_9_uniform", false),
            expectations: || uniform(|_| 1.0),
        },
        Case {
            name: "cie171_5_9_overcast",
            notes: "CIE 171 5.9: the CIE overcast sky (type 1) through an unglazed roof opening",
            parts: || under_sky("cie171_5_9_overcast", &overcast(), false),
            expectations: || through(&overcast(), None),
        },
        Case {
            name: "cie171_5_9_clear",
            notes: "CIE 171 5.9: the CIE clear sky (type 12) through an unglazed roof opening",
            parts: || under_sky("cie171_5_9_clear", &clear(), false),
            expectations: || through(&clear(), None),
        },
        Case {
            name: "cie171_5_10_uniform",
            notes: "CIE 171 5.10: a uniform sky through a clear pane in the roof",
            parts: || under_uniform("cie171_5_10_uniform", true),
            expectations: || uniform(through_glass),
        },
        Case {
            name: "cie171_5_10_overcast",
            notes: "CIE 171 5.10: the CIE overcast sky (type 1) through a clear pane in the roof",
            parts: || under_sky("cie171_5_10_overcast", &overcast(), true),
            expectations: || through(&overcast(), Some(through_glass)),
        },
    ]
}

/// The share of light that a clear pane lets through.
pub(super) fn through_glass(cos_incidence: f64) -> f64 {
    pane(cos_incidence, 1.0).transmitted
}

/// Two metres square, in the middle.
fn opening() -> Panel {
    Panel { axis: 2, level_m: HEIGHT_M, looks_up: false, b: [1.0, 3.0], c: [1.0, 3.0] }
}

fn overcast() -> CieSky {
    CieSky::overcast(LUMINANCE_CD_M2)
}

/// The sun stands low in the east, where no place looks.
fn clear() -> CieSky {
    CieSky::clear(LUMINANCE_CD_M2, Vector::new(0.9, 0.0, 0.4))
}

/// The room with its opening, and the pane in it, if any.
fn room_shapes(is_glazed: bool) -> Vec<Shape> {
    let mut shapes = Room::from_x(0.0).shapes(Some(opening()));
    if is_glazed {
        shapes.push(opening().shape("pane", PANE));
    }
    shapes
}

fn under_uniform(name: &str, is_glazed: bool) -> SceneParts {
    let mut shapes = room_shapes(is_glazed);
    shapes.extend(sky_on_roof(PANE + 1));
    let materials = vec![black(), pane_material(Rgb::WHITE), luminous(LUMINANCE_CD_M2)];
    SceneParts { name: name.into(), shapes, materials, ..SceneParts::default() }
}

fn under_sky(name: &str, sky: &CieSky, is_glazed: bool) -> SceneParts {
    let (shapes, luminaires) = (room_shapes(is_glazed), vec![sky.luminaire()]);
    let materials = vec![black(), pane_material(Rgb::WHITE)];
    SceneParts { name: name.into(), shapes, materials, luminaires, ..SceneParts::default() }
}

/// The diagonal of the floor, and heights of the walls that do not look west.
fn places() -> Vec<ProbePoint> {
    let room = Room::from_x(0.0);
    let floor = [0.3, 1.1, 2.0, 2.7, 3.6].map(|x| room.floor.place(x, x));
    let east = [0.4, 1.3, 2.1].map(|z| room.east.place(2.0, z));
    let south = [(0.8, 0.7), (1.7, 2.6)].map(|(z, x)| room.south.place(z, x));
    [floor.as_slice(), &east, &south].concat()
}

fn uniform(transmitted: fn(f64) -> f64) -> Vec<Expectation> {
    let corners = opening().corners();
    let lx = |at: ProbePoint| {
        gathered_lx(&corners, at, NODES, |p| {
            let way = p - at.position;
            LUMINANCE_CD_M2 * transmitted(way.z / way.length())
        })
    };
    let open = |at| lambert_lx(LUMINANCE_CD_M2, &corners, at);
    let is_open = transmitted(0.5) == 1.0;
    places()
        .into_iter()
        .flat_map(|at| direct(at, if is_open { open(at) } else { lx(at) }))
        .collect()
}

fn through(sky: &CieSky, transmitted: Option<fn(f64) -> f64>) -> Vec<Expectation> {
    let corners = opening().corners();
    let skylight = Skylight { sky, opening: &corners, transmitted };
    places().into_iter().flat_map(|at| skylight.expected(at)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::flux::sky_panels;
    use super::super::visible::within;
    use super::*;
    use crate::tolerance::QUADRATURE;

    #[test]
    fn the_box_upon_the_roof_is_a_uniform_sky() {
        for at in places() {
            let seen = |p: &Panel| within(&p.corners(), &opening().corners(), at.position);
            let by_box: f64 = sky_panels().iter().map(|p| lambert_lx(1.0, &seen(p), at)).sum();
            let by_opening = lambert_lx(1.0, &opening().corners(), at);
            assert!((by_box / by_opening - 1.0).abs() < QUADRATURE, "{by_box} {by_opening}");
        }
    }

    #[test]
    fn no_place_sees_the_sun_of_the_clear_sky() {
        let sun = Vector::new(0.9, 0.0, 0.4);
        for at in places() {
            let met = at.position + sun * ((HEIGHT_M - at.position.z) / sun.z);
            let [b, c] = [opening().b, opening().c];
            let is_seen = (b[0]..=b[1]).contains(&met.x) && (c[0]..=c[1]).contains(&met.y);
            assert!(!is_seen, "{at:?}");
        }
    }

    #[test]
    fn glass_takes_from_eight_per_cent_on() {
        let (open, glazed) = (uniform(|_| 1.0), uniform(through_glass));
        for (open, glazed) in open.iter().zip(&glazed) {
            let share = glazed.expected_lx.luminance() / open.expected_lx.luminance();
            assert!(share > 0.3 && share < 12.0 / 13.0, "{share} at {:?}", open.at);
        }
    }
}
