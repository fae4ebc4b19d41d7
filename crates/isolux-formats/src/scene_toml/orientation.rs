//! How a luminaire stands in the scene.

use isolux::geometry::{Direction, Transform, Vector};
use isolux::scene::UpAxis;

/// The sine and cosine of an angle in degrees, exact at quarter turns.
pub(super) fn sincos_deg(angle_deg: f64) -> (f64, f64) {
    let turned = angle_deg % 360.0;
    let quarters = turned / 90.0;
    if quarters == quarters.trunc() {
        return match quarters as i32 {
            0 => (0.0, 1.0),
            1 | -3 => (1.0, 0.0),
            2 | -2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
    }
    libm::sincos(turned.to_radians())
}

/// The direction that points up.
pub(super) fn up_direction(up: UpAxis) -> Direction {
    match up {
        UpAxis::Y => Direction::Y,
        UpAxis::Z => Direction::Z,
    }
}

/// The rotation of a luminaire that aims along a direction.
///
/// Aiming straight down, C0 points along the scene's +x, and `rotate_deg` turns it counter-clockwise
/// as seen from above. From there the luminaire is tilted to its direction by the smallest rotation;
/// where that is not unique, straight up, by half a turn about the scene's +x.
pub(super) fn world_from_luminaire(up: UpAxis, aim: Direction, rotate_deg: f64) -> Transform {
    let (s, c) = sincos_deg(rotate_deg);
    let turned = Transform {
        columns: [Vector::new(c, s, 0.0), Vector::new(-s, c, 0.0), Vector::new(0.0, 0.0, 1.0)],
        translation: Vector::ZERO,
    };
    tilt(-up_direction(up), aim).then_from(&scene_from_hanging(up)).then_from(&turned)
}

/// The luminaire's axes in the scene while it hangs straight: its z is up, its x the scene's x.
fn scene_from_hanging(up: UpAxis) -> Transform {
    let x = Direction::X.to_vector();
    let z = up_direction(up).to_vector();
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

/// The rotation (or reflection) in an affine map, without its scale: its axes made orthonormal in
/// order. `None` for a singular map.
pub(super) fn without_scale(map: &Transform) -> Option<Transform> {
    let [a, b, _] = map.columns;
    let x = a.direction()?;
    let y = (b - x * b.dot(x.to_vector())).direction()?;
    let z = x.to_vector().cross(y.to_vector()) * 1.0_f64.copysign(map.determinant());
    Some(Transform { columns: [x.to_vector(), y.to_vector(), z], translation: Vector::ZERO })
}

/// What a matrix written in four decimals may be off a turn.
const ROUNDED: f64 = 1e-3;

/// Whether a map is more than a turn, a mirror image and a scale, the same for all axes.
pub(super) fn is_distorting(map: &Transform) -> bool {
    let [a, b, c] = map.columns;
    let scale = a.dot(a).max(b.dot(b)).max(c.dot(c));
    let uneven = [a, b, c].iter().any(|v| (v.dot(*v) / scale - 1.0).abs() > ROUNDED);
    let oblique = [a.dot(b), b.dot(c), c.dot(a)].iter().any(|d| d.abs() > ROUNDED * scale);
    uneven || oblique
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

    #[test]
    fn sines_of_quarter_turns() {
        for (deg, expected) in [
            (0.0, (0.0, 1.0)),
            (90.0, (1.0, 0.0)),
            (180.0, (0.0, -1.0)),
            (270.0, (-1.0, 0.0)),
            (-90.0, (-1.0, 0.0)),
            (-270.0, (1.0, 0.0)),
            (720.0, (0.0, 1.0)),
            (450.0, (1.0, 0.0)),
        ] {
            assert_eq!(sincos_deg(deg), expected, "{deg}");
        }
        assert!((sincos_deg(30.0).0 - 0.5).abs() < 1e-15);
    }

    #[test]
    fn scale_is_taken_out() {
        let turn = world_from_luminaire(UpAxis::Z, along(1.0, 2.0, 3.0), 20.0);
        let scaled = turn.then_from(&Transform::scale(2.0, 3.0, -4.0));
        let rigid = without_scale(&scaled).unwrap();
        assert!((rigid.determinant() + 1.0).abs() < 1e-14);
        assert!((rigid.columns[0] - turn.columns[0]).length() < 1e-14);
        assert_eq!(without_scale(&Transform::scale(0.0, 1.0, 1.0)), None);
        assert!(is_distorting(&scaled) && !is_distorting(&turn));
        assert!(!is_distorting(&Transform::scale(-2.0, 2.0, 2.0).then_from(&turn)));
    }
}
