//! How skies stand in scenes.

use super::UpAxis;
use crate::units::sincos_deg;
use isolux_geometry::{Transform, Vector};

/// Takes the frame of skies (x east, y north, z to the zenith) to that of a scene. At 0 degrees north is +y where z is up and -z
/// where y is up, so that +x is east in both; the angle turns it clockwise in plan, by east.
pub fn world_from_sky(up: UpAxis, north_deg: f64) -> Transform {
    let (sin, cos) = sincos_deg(north_deg);
    // East, north, zenith in a scene where z is up.
    let level = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
    let columns = match up {
        UpAxis::Z => level,
        UpAxis::Y => level.map(|[x, y, z]| [x, z, -y]),
    };
    // Without the sign of a zero.
    let columns = columns.map(|column| Vector::from(column.map(|c| c + 0.0)));
    Transform { columns, translation: Vector::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(up: UpAxis, north_deg: f64, sky: [f64; 3]) -> [f64; 3] {
        world_from_sky(up, north_deg).vector(Vector::from(sky)).into()
    }

    #[test]
    fn north_lies_in_plan() {
        let [east, north, zenith] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (up, north_deg, sky, expected) in [
            (UpAxis::Z, 0.0, north, [0.0, 1.0, 0.0]),
            (UpAxis::Z, 90.0, north, [1.0, 0.0, 0.0]),
            (UpAxis::Z, 90.0, east, [0.0, -1.0, 0.0]),
            (UpAxis::Y, 0.0, north, [0.0, 0.0, -1.0]),
            (UpAxis::Y, 0.0, zenith, [0.0, 1.0, 0.0]),
            (UpAxis::Y, 90.0, north, [1.0, 0.0, 0.0]),
            (UpAxis::Y, 90.0, east, [0.0, 0.0, 1.0]),
        ] {
            assert_eq!(of(up, north_deg, sky), expected, "{up:?} {north_deg} {sky:?}");
            assert_eq!(world_from_sky(up, north_deg).determinant(), 1.0);
        }
    }
}
