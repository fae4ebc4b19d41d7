//! How a luminaire hangs in the scene.

use super::UpAxis;
use crate::units::sincos_deg;
use isolux_geometry::{Direction, Transform, Vector};

/// The rotation of a luminaire that aims along a direction.
///
/// Aiming straight down, C0 points along the scene's +x, and `rotate_deg` turns it counter-clockwise
/// as seen from above. From there the luminaire is tilted to its direction by the smallest rotation;
/// where that is not unique, straight up, by half a turn about the scene's +x.
pub fn world_from_luminaire(up: UpAxis, aim: Direction, rotate_deg: f64) -> Transform {
    let (s, c) = sincos_deg(rotate_deg);
    let turned = Transform {
        columns: [Vector::new(c, s, 0.0), Vector::new(-s, c, 0.0), Vector::new(0.0, 0.0, 1.0)],
        translation: Vector::ZERO,
    };
    tilt(-up.direction(), aim).then_from(&scene_from_hanging(up)).then_from(&turned)
}

/// The luminaire's axes in the scene while it hangs straight: its z is up, its x the scene's x.
fn scene_from_hanging(up: UpAxis) -> Transform {
    let x = Direction::X.to_vector();
    let z = up.direction().to_vector();
    Transform { columns: [x, z.cross(x), z], translation: Vector::ZERO }
}

/// The smallest rotation that takes one direction to another.
fn tilt(from: Direction, to: Direction) -> Transform {
    let axis = from.to_vector().cross(to.to_vector());
    let w = 1.0 + from.dot(to);
    let length = (axis.length_squared() + w * w).sqrt();
    // Nearer to opposite than this, rounding alone would choose the axis.
    if length < 1e-9 {
        return Transform::scale(1.0, -1.0, -1.0);
    }
    let Vector { x, y, z } = axis / length;
    Transform::rotation([x, y, z, w / length])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(x: f64, y: f64, z: f64) -> Direction {
        Vector::new(x, y, z).direction().unwrap()
    }

    /// Nadir and C0 of a luminaire in the scene.
    #[track_caller]
    fn check(up: UpAxis, aim: Direction, rotate_deg: f64, c0: Direction) {
        let map = world_from_luminaire(up, aim, rotate_deg);
        // A few roundings of numbers up to one.
        let near = |v: Vector, d: Direction| (v - d.to_vector()).length() < 1e-14;
        let nadir = map.vector(Vector::new(0.0, 0.0, -1.0));
        assert!(near(nadir, aim), "nadir {nadir:?}, aim {aim:?}");
        assert!(near(map.columns[0], c0), "C0 {:?}, not {c0:?}", map.columns[0]);
        assert!((map.determinant() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn z_up() {
        let (x, y, z) = (Direction::X, Direction::Y, Direction::Z);
        check(UpAxis::Z, -z, 0.0, x);
        check(UpAxis::Z, -z, 90.0, y);
        check(UpAxis::Z, -z, -30.0, along(3.0_f64.sqrt(), -1.0, 0.0));
        check(UpAxis::Z, y, 0.0, x);
        check(UpAxis::Z, x, 0.0, z);
        check(UpAxis::Z, along(0.0, 1.0, -1.0), 90.0, along(0.0, 1.0, 1.0));
        check(UpAxis::Z, z, 0.0, x);
        check(UpAxis::Z, z, 90.0, -y);
    }

    #[test]
    fn y_up() {
        let (x, y, z) = (Direction::X, Direction::Y, Direction::Z);
        check(UpAxis::Y, -y, 0.0, x);
        check(UpAxis::Y, -y, 90.0, -z);
        check(UpAxis::Y, x, 0.0, y);
        check(UpAxis::Y, z, 0.0, x);
        check(UpAxis::Y, y, 0.0, x);
    }

    /// Hanging straight, the matrix is exact, whatever multiple of a quarter turn.
    #[test]
    fn straight_down_is_exact() {
        let map = world_from_luminaire(UpAxis::Z, -Direction::Z, 270.0);
        assert_eq!(map.columns[0], Vector::new(0.0, -1.0, 0.0));
        assert_eq!(map.columns[2], Vector::new(0.0, 0.0, 1.0));
    }

    #[test]
    fn almost_straight_up_still_aims() {
        for tiny in [1e-3, 1e-6, 1e-8] {
            let aim = along(tiny, tiny, 1.0);
            let nadir =
                world_from_luminaire(UpAxis::Z, aim, 0.0).vector(Vector::new(0.0, 0.0, -1.0));
            // Rounding of 1 + cos against the angle itself.
            assert!((nadir - aim.to_vector()).length() < 1e-6, "{tiny}: {nadir:?}");
        }
    }
}
