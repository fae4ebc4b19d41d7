//! 5.2, point light sources: inverse squares and cosines on floor and walls.
//!
//! `E = I(C, gamma) cos(theta) / d^2` (Lambert 1760). The second luminaire has a table of intensities,
//! linear in both angles between its entries, so that the table is the distribution itself. The
//! room is black and every place sees the luminaire; the geometry is exact.

use super::room::{HEIGHT_M, Room, black, direct};
use crate::expectation::{Case, Expectation};
use crate::model::{aimed, isotropic};
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Point, Vector};
use isolux::photometry::{IntensityDistribution, PhotometricWeb};
use isolux::scene::{Luminaire, LuminaireKind, SceneParts};
use std::sync::Arc;

const LUMINAIRE_M: [f64; 3] = [2.0, 2.0, 2.8];
const INTENSITY_CD: f64 = 1000.0;
/// Intensities at nadir and, below the horizontal, at the planes C0, C90, C180 and C270, cd.
const NADIR_CD: f64 = 1200.0;
const LEVEL_CD: [f64; 4] = [300.0, 100.0, 200.0, 500.0];

pub(super) fn cases() -> [Case; 2] {
    [
        Case {
            name: "cie171_5_2_isotropic",
            notes: "CIE 171 5.2: an isotropic point luminaire in a black room",
            parts: || parts("cie171_5_2_isotropic", isotropic_luminaire()),
            expectations: || lit_by(|_| INTENSITY_CD),
        },
        Case {
            name: "cie171_5_2_web",
            notes: "CIE 171 5.2: a point luminaire with a table of intensities in a black room",
            parts: || parts("cie171_5_2_web", web_luminaire()),
            expectations: || lit_by(web_cd),
        },
    ]
}

fn isotropic_luminaire() -> Luminaire {
    isotropic("luminaire", LUMINAIRE_M.into(), INTENSITY_CD)
}

/// With its own axes along those of the world.
fn web_luminaire() -> Luminaire {
    let planes = vec![0.0, 90.0, 180.0, 270.0];
    let candela = LEVEL_CD.iter().flat_map(|&level| [NADIR_CD, level]).collect();
    // Four planes and two angles are a web.
    let intensity = PhotometricWeb::new(planes, vec![0.0, 90.0], candela)
        .map_or(IntensityDistribution::Isotropic { intensity_cd: 0.0 }, |web| {
            IntensityDistribution::Web(Arc::new(web))
        });
    let mut luminaire = aimed("luminaire", LUMINAIRE_M.into(), -Direction::Z, intensity);
    if let LuminaireKind::Point { world_from_luminaire, .. } = &mut luminaire.kind {
        world_from_luminaire.columns =
            [Direction::X, Direction::Y, Direction::Z].map(Direction::to_vector);
    }
    luminaire
}

fn parts(name: &str, luminaire: Luminaire) -> SceneParts {
    SceneParts {
        name: name.into(),
        shapes: Room::from_x(0.0).shapes(None),
        materials: vec![black()],
        luminaires: vec![luminaire],
        ..SceneParts::default()
    }
}

/// The intensity of the table in a direction: linear in gamma from nadir to the horizontal, linear in C
/// from plane to plane.
fn web_cd(towards: Vector) -> f64 {
    let gamma = libm::acos(-towards.z / towards.length()).to_degrees() / 90.0;
    if gamma > 1.0 {
        return 0.0;
    }
    let quarters = libm::atan2(towards.y, towards.x).to_degrees().rem_euclid(360.0) / 90.0;
    let plane = (quarters as usize).min(3);
    let share = quarters - plane as f64;
    let level = LEVEL_CD[plane] * (1.0 - share) + LEVEL_CD[(plane + 1) % 4] * share;
    NADIR_CD * (1.0 - gamma) + level * gamma
}

/// The diagonal of the floor, and heights of three walls below the luminaire and aside of it.
fn places() -> Vec<ProbePoint> {
    let room = Room::from_x(0.0);
    let floor = [0.2, 0.8, 1.4, 2.0, 2.9, 3.7].map(|x| room.floor.place(x, x));
    let west = [(2.0, 0.3), (2.0, 1.5), (2.0, 2.6), (0.6, 1.1)].map(|(y, z)| room.west.place(y, z));
    let north = [(0.4, 3.4), (2.2, 1.1)].map(|(z, x)| room.north.place(z, x));
    let south = [(HEIGHT_M - 0.5, 0.7), (0.9, 2.4)].map(|(z, x)| room.south.place(z, x));
    [floor.as_slice(), &west, &north, &south].concat()
}

fn lit_by(intensity_cd: impl Fn(Vector) -> f64) -> Vec<Expectation> {
    places()
        .into_iter()
        .flat_map(|at| {
            let way = Point::from(LUMINAIRE_M) - at.position;
            let r2 = way.length_squared();
            let cos = way.dot(at.normal.to_vector()) / r2.sqrt();
            direct(at, intensity_cd(-way) * cos / r2)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{QUADRATURE, ROUNDING};
    use isolux::quadrature::GaussRule;

    #[test]
    fn the_table_is_the_formula() {
        let LuminaireKind::Point { intensity, .. } = web_luminaire().kind else { unreachable!() };
        for at in places() {
            let towards = at.position - Point::from(LUMINAIRE_M);
            let (found, expected) =
                (intensity.intensity_cd(towards.direction().unwrap()), web_cd(towards));
            assert!((found / expected - 1.0).abs() < 100.0 * ROUNDING, "{found} {expected}");
        }
    }

    /// All light of the isotropic luminaire lands in the closed room.
    #[test]
    fn faces_receive_the_flux_of_the_luminaire() {
        let rule = GaussRule::new(64);
        let on = |face: super::super::panel::Panel| {
            rule.integrate(face.b[0], face.b[1], |b| {
                rule.integrate(face.c[0], face.c[1], |c| {
                    let at = face.place(b, c);
                    let way = Point::from(LUMINAIRE_M) - at.position;
                    way.dot(at.normal.to_vector()) / way.length().powi(3)
                })
            })
        };
        // Nearest to the ceiling, 0.2 m, the integrand is steep: there the rule is not exact.
        let room = Room::from_x(0.0);
        let flux: f64 = room.faces().into_iter().filter(|f| *f != room.ceiling).map(on).sum();
        // The ceiling is a square seen from below its middle, four quarters.
        let (a, h) = (2.0_f64, HEIGHT_M - LUMINAIRE_M[2]);
        let quarter = libm::atan(a * a / (h * (2.0 * a * a + h * h).sqrt()));
        let whole = 4.0 * std::f64::consts::PI;
        assert!((flux + 4.0 * quarter - whole).abs() < QUADRATURE * whole, "{flux}");
    }
}
