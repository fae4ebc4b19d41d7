//! 5.5, directional transmittance of clear glass: a point luminaire above a pane that is the roof of a
//! black room.
//!
//! Light goes straight on through a thin pane, so a place has the illuminance without it times the
//! transmittance at the angle of incidence: both polarizations by Fresnel, all reflections between the faces
//! summed ([`super::super::glass`], where the sums are tested bounce by bounce). The walls below the
//! luminaire see it at 31 to 80 degrees, the middle of the floor at none. The index is 1.5. The glass absorbs
//! a tenth of what goes straight through it, and more of what slants.

use super::super::glass::{pane, pane_material};
use super::room::{HEIGHT_M, Room, black, direct};
use crate::expectation::{Case, Expectation};
use crate::model::isotropic;
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::scene::SceneParts;
use isolux::units::Rgb;

const NAME: &str = "cie171_5_5";
const INTENSITY_CD: f64 = 1000.0;
/// Share left by one crossing of the pane at right angles.
const LEFT: f64 = 0.9;
const LUMINAIRE_M: [f64; 3] = [2.0, 2.0, HEIGHT_M + 0.3];

pub(super) fn case() -> Case {
    Case {
        name: NAME,
        notes: "CIE 171 5.5: light through a pane at angles of incidence from 0 to 80 degrees",
        parts,
        expectations,
    }
}

fn parts() -> SceneParts {
    let room = Room::from_x(0.0);
    let mut shapes = room.shapes(None);
    shapes.retain(|shape| shape.name != "ceiling");
    shapes.push(room.ceiling.shape("pane", 1));
    SceneParts {
        name: NAME.into(),
        shapes,
        materials: vec![black(), pane_material(Rgb::grey(LEFT))],
        luminaires: vec![isotropic("luminaire", LUMINAIRE_M.into(), INTENSITY_CD)],
        ..SceneParts::default()
    }
}

/// Down a wall and along the diagonal of the floor.
fn places() -> Vec<ProbePoint> {
    let room = Room::from_x(0.0);
    let west = [2.95, 2.8, 2.5, 2.1, 1.6, 1.0, 0.3].map(|z| room.west.place(2.0, z));
    let north = [(2.9, 0.8), (1.3, 3.3)].map(|(z, x)| room.north.place(z, x));
    let floor = [2.0, 2.6, 3.2, 3.8].map(|x| room.floor.place(x, x));
    [west.as_slice(), &north, &floor].concat()
}

/// The way to the luminaire and the cosine of its incidence on the pane.
fn way(at: ProbePoint) -> (Vector, f64) {
    let way = Point::from(LUMINAIRE_M) - at.position;
    (way, way.z / way.length())
}

fn expectations() -> Vec<Expectation> {
    let lx = |at: ProbePoint| {
        let (way, incidence) = way(at);
        let cos = way.dot(at.normal.to_vector()) / way.length();
        INTENSITY_CD * cos / way.length_squared() * pane(incidence, LEFT).transmitted
    };
    places().into_iter().flat_map(|at| direct(at, lx(at))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn incidence_is_from_none_to_eighty_degrees_within_the_pane() {
        let angles: Vec<f64> =
            places().into_iter().map(|at| libm::acos(way(at).1).to_degrees()).collect();
        assert!(angles.iter().any(|&a| a < 1.0) && angles.iter().any(|&a| a > 80.0), "{angles:?}");
        for at in places() {
            let (way, _) = way(at);
            let through = at.position + way * ((HEIGHT_M - at.position.z) / way.z);
            assert!((0.05..3.95).contains(&through.x) && (0.05..3.95).contains(&through.y));
        }
    }

    /// Of plain glass of index 1.5, from the formulae of Fresnel worked by hand at Brewster's angle: light
    /// polarized along the plane of incidence is not reflected, of the other a face reflects
    /// `((n^2 - 1) / (n^2 + 1))^2`.
    #[test]
    fn at_brewsters_angle_one_polarization_passes_whole() {
        let face = (1.25_f64 / 3.25).powi(2);
        let expected = 0.5 * (1.0 + (1.0 - face) / (1.0 + face));
        let cos = 1.0 / (1.0 + 1.5_f64 * 1.5).sqrt();
        let found = pane(cos, 1.0).transmitted;
        assert!((found - expected).abs() < crate::tolerance::ROUNDING, "{found} {expected}");
    }
}
