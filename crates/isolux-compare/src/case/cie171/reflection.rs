//! 5.6 and 5.7, light reflected by a diffuse surface in collimated light, without and with an obstruction.
//!
//! Parallel light through an opening in the roof lands on a floor that is black but for a diffuse patch
//! within the light. The patch has the illuminance `E_0 cos(theta)` everywhere and so the luminance
//! `rho E_0 cos(theta) / pi`; all else is black, the first reflection is the last, and Lambert's formula gives what
//! arrives on walls and ceiling. In 5.7 a black screen stands before the west wall. It hides of the patch the
//! polygon that is seen through its outline: what arrives is that of the patch less that of the hidden
//! part. The light does not touch the screen.

use super::panel::Panel;
use super::room::{BLACK, HEIGHT_M, Room, black, diffuse, split};
use super::visible::{lambert_lx, within};
use crate::expectation::{Case, Expectation};
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Vector};
use isolux::scene::{Finish, Luminaire, LuminaireKind, Material, SceneParts};
use isolux::units::Rgb;
use std::f64::consts::PI;

const SUN_LX: f64 = 50_000.0;
/// Angle of incidence on the floor, degrees.
const INCIDENCE_DEG: f64 = 35.0;
const REFLECTANCE: f64 = 0.7;

pub(super) fn cases() -> [Case; 2] {
    [
        Case {
            name: "cie171_5_6",
            notes: "CIE 171 5.6: a diffuse patch in collimated light, seen from black surfaces",
            parts: || parts("cie171_5_6", false),
            expectations: || expectations(false),
        },
        Case {
            name: "cie171_5_7",
            notes: "CIE 171 5.7: the diffuse patch behind a black screen",
            parts: || parts("cie171_5_7", true),
            expectations: || expectations(true),
        },
    ]
}

fn opening() -> Panel {
    Panel { axis: 2, level_m: HEIGHT_M, looks_up: false, b: [0.2, 1.7], c: [1.0, 3.0] }
}

fn patch() -> Panel {
    Panel { axis: 2, level_m: 0.0, looks_up: true, b: [2.5, 3.6], c: [1.2, 2.8] }
}

/// Between the west wall and the light.
fn screen() -> Panel {
    Panel { axis: 0, level_m: 1.5, looks_up: true, b: [0.8, 3.2], c: [0.0, 1.0] }
}

fn cos_incidence() -> f64 {
    libm::cos(INCIDENCE_DEG.to_radians())
}

fn sun() -> Luminaire {
    let (sin, cos) = libm::sincos(INCIDENCE_DEG.to_radians());
    let direction = Vector::new(sin, 0.0, -cos).direction().unwrap_or(-Direction::Z);
    let kind =
        LuminaireKind::Directional { direction, illuminance_lx: SUN_LX, half_angle_rad: 0.0 };
    Luminaire { name: "sun".into(), group: 0, colour: Rgb::WHITE, kind }
}

fn parts(name: &str, has_screen: bool) -> SceneParts {
    let room = Room::from_x(0.0);
    let mut shapes = room.shapes(Some(opening()));
    shapes.retain(|shape| shape.name != "floor");
    shapes.extend(room.floor.around(patch()).map(|part| part.shape("floor", BLACK)));
    shapes.push(patch().shape("patch", 1));
    let mut materials = vec![black(), diffuse(REFLECTANCE)];
    if has_screen {
        materials.push(Material::two_sided("screen", Finish::BLACK));
        shapes.push(screen().shape("screen", 2));
    }
    SceneParts {
        name: name.into(),
        shapes,
        materials,
        luminaires: vec![sun()],
        ..SceneParts::default()
    }
}

/// None of them in the light.
fn places() -> Vec<ProbePoint> {
    let room = Room::from_x(0.0);
    let west = [0.3, 0.7, 1.1, 1.5, 1.9, 2.4].map(|z| room.west.place(2.0, z));
    let aside = [(0.6, 0.8), (3.6, 2.0)].map(|(y, z)| room.west.place(y, z));
    let north = [(0.5, 3.0), (1.5, 2.0), (0.6, 0.8)].map(|(z, x)| room.north.place(z, x));
    let ceiling = [(3.0, 2.0), (3.7, 0.5)].map(|(x, y)| room.ceiling.place(x, y));
    [west.as_slice(), &aside, &north, &ceiling].concat()
}

fn luminance_cd_m2() -> f64 {
    REFLECTANCE * SUN_LX * cos_incidence() / PI
}

fn indirect_lx(at: ProbePoint, has_screen: bool) -> f64 {
    let whole = patch().corners();
    let lx = |polygon: &[_]| lambert_lx(luminance_cd_m2(), polygon, at);
    let hides = has_screen && at.position.x < screen().level_m;
    let hidden = if hides { lx(&within(&whole, &screen().corners(), at.position)) } else { 0.0 };
    // Of two equal numbers the difference may come out below zero.
    (lx(&whole) - hidden).max(0.0)
}

fn expectations(has_screen: bool) -> Vec<Expectation> {
    places().into_iter().flat_map(|at| split(at, 0.0, indirect_lx(at, has_screen))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::QUADRATURE;
    use isolux::geometry::Point;
    use isolux::quadrature::GaussRule;

    /// How far light goes aside on its way down by a metre.
    fn slope() -> f64 {
        libm::tan(INCIDENCE_DEG.to_radians())
    }

    #[test]
    fn the_patch_is_in_the_light_and_the_screen_is_not() {
        let [from, to] = opening().b.map(|x| x + slope() * HEIGHT_M);
        assert!(from < patch().b[0] && patch().b[1] < to);
        assert!(opening().c[0] < patch().c[0] && patch().c[1] < opening().c[1]);
        let nearest = opening().b[0] + slope() * (HEIGHT_M - screen().c[1]);
        assert!(screen().level_m < nearest, "{nearest}");
        assert!(to < 4.0, "the light must not reach the east wall: {to}");
    }

    /// The same integral over the patch, row by row, each from where the screen lets it be seen.
    fn by_quadrature(at: ProbePoint) -> f64 {
        let rule = GaussRule::new(64);
        let kernel = |x: f64, y: f64| {
            let way = Point::new(x, y, 0.0) - at.position;
            let r2 = way.length_squared();
            luminance_cd_m2() * way.dot(at.normal.to_vector()) * -way.z / (r2 * r2)
        };
        // The line over the top of the screen meets the floor here, if the screen is wide enough.
        let share = screen().level_m / (at.position.z - screen().c[1]);
        let from = if share > 0.0 { at.position.z * share } else { f64::INFINITY };
        let [low, high] = patch().b;
        rule.integrate(from.clamp(low, high), high, |x| {
            rule.integrate(patch().c[0], patch().c[1], |y| kernel(x, y))
        })
    }

    #[test]
    fn what_is_left_of_the_patch_agrees_with_quadrature() {
        let room = Room::from_x(0.0);
        for z in [0.5, 1.1, 1.5, 1.6, 2.0, 2.9] {
            let at = room.west.place(2.0, z);
            let (found, expected) = (indirect_lx(at, true), by_quadrature(at));
            let whole = indirect_lx(at, false);
            assert!((found - expected).abs() < QUADRATURE * whole, "{z}: {found} {expected}");
        }
        let lit = |at: &ProbePoint| indirect_lx(*at, true) / indirect_lx(*at, false);
        let shares: Vec<f64> = places().iter().map(lit).collect();
        assert!(shares.contains(&0.0) && shares.contains(&1.0), "{shares:?}");
        assert!(shares.iter().any(|s| (0.2..0.8).contains(s)), "{shares:?}");
    }
}
