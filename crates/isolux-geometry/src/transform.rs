//! Affine maps, named `a_from_b`.

use crate::{Normal, Point, Vector};
use serde::{Deserialize, Serialize};

/// An affine map: `p -> matrix p + translation`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transform {
    /// The images of the three unit vectors (columns of the linear part).
    pub columns: [Vector; 3],
    /// The image of the origin.
    pub translation: Vector,
}

impl Transform {
    /// The map that changes nothing.
    pub const IDENTITY: Self = Self {
        columns: [
            Vector::new(1.0, 0.0, 0.0),
            Vector::new(0.0, 1.0, 0.0),
            Vector::new(0.0, 0.0, 1.0),
        ],
        translation: Vector::ZERO,
    };

    /// Moves by a vector.
    pub const fn translation(by: Vector) -> Self {
        Self { translation: by, ..Self::IDENTITY }
    }

    /// Scales each axis.
    pub const fn scale(x: f64, y: f64, z: f64) -> Self {
        Self {
            columns: [Vector::new(x, 0.0, 0.0), Vector::new(0.0, y, 0.0), Vector::new(0.0, 0.0, z)],
            translation: Vector::ZERO,
        }
    }

    /// Rotates by a unit quaternion `(x, y, z, w)`.
    pub fn rotation([x, y, z, w]: [f64; 4]) -> Self {
        let row = |a: f64, b: f64, c: f64| Vector::new(a, b, c);
        Self {
            columns: [
                row(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)),
                row(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)),
                row(2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)),
            ],
            translation: Vector::ZERO,
        }
    }

    /// Rotates about an axis through the origin by an angle in radians, right-handed.
    pub fn rotation_about(axis: crate::Direction, angle_rad: f64) -> Self {
        let (s, c) = libm::sincos(0.5 * angle_rad);
        let v = axis.to_vector();
        Self::rotation([v.x * s, v.y * s, v.z * s, c])
    }

    /// `a_from_c = a_from_b.then_from(b_from_c)`.
    pub fn then_from(&self, b_from_c: &Self) -> Self {
        Self {
            columns: b_from_c.columns.map(|column| self.vector(column)),
            translation: self.vector(b_from_c.translation) + self.translation,
        }
    }

    /// The image of a point.
    pub fn point(&self, p: Point) -> Point {
        Point::ORIGIN + self.vector(p.to_vector()) + self.translation
    }

    /// The image of a free vector.
    pub fn vector(&self, v: Vector) -> Vector {
        self.columns[0] * v.x + self.columns[1] * v.y + self.columns[2] * v.z
    }

    /// The image of a normal, by the inverse transpose; `None` for a singular map.
    pub fn normal(&self, n: Normal) -> Option<Normal> {
        let [a, b, c] = self.columns;
        // The cofactor matrix is the inverse transpose times the determinant.
        let v = n.to_vector();
        let image = b.cross(c) * v.x + c.cross(a) * v.y + a.cross(b) * v.z;
        (image * 1.0_f64.copysign(self.determinant())).normal()
    }

    /// Determinant of the linear part: negative where the map turns triangles inside out.
    pub const fn determinant(&self) -> f64 {
        self.columns[0].dot(self.columns[1].cross(self.columns[2]))
    }

    /// The inverse map; `None` where the linear part is singular.
    pub fn inverse(&self) -> Option<Self> {
        let [a, b, c] = self.columns;
        let determinant = self.determinant();
        if !(determinant.abs() > 0.0 && determinant.is_finite()) {
            return None;
        }
        let rows = [b.cross(c) / determinant, c.cross(a) / determinant, a.cross(b) / determinant];
        let column = |k: usize| {
            Vector::new(rows[0].component(k), rows[1].component(k), rows[2].component(k))
        };
        let linear = Self { columns: [column(0), column(1), column(2)], translation: Vector::ZERO };
        Some(Self { translation: -linear.vector(self.translation), ..linear })
    }
}

#[cfg(test)]
mod tests {
    use super::Transform;
    use crate::{Direction, Normal, Point, Vector};
    use std::f64::consts::{FRAC_PI_2, PI};

    /// A few roundings of numbers of the order of ten.
    const ROUNDING: f64 = 1e-13;

    #[track_caller]
    fn check_vector(actual: Vector, expected: Vector) {
        assert!((actual - expected).length() < ROUNDING, "{actual:?} is not {expected:?}");
    }

    /// Nothing special: turned, stretched, mirrored, moved.
    fn general() -> Transform {
        let turn = Direction::Y.from_local(Vector::new(0.6, 0.0, 0.8));
        Transform::translation(Vector::new(1.0, -2.0, 3.0))
            .then_from(&Transform::rotation_about(turn, 0.7))
            .then_from(&Transform::scale(2.0, -0.5, 4.0))
    }

    #[test]
    fn rotation_is_right_handed() {
        let quarter = Transform::rotation_about(Direction::Z, FRAC_PI_2);
        check_vector(quarter.vector(Direction::X.to_vector()), Direction::Y.to_vector());
        check_vector(quarter.vector(Direction::Y.to_vector()), -Direction::X.to_vector());
        let half = Transform::rotation_about(Direction::X, PI);
        check_vector(half.vector(Vector::new(1.0, 2.0, 3.0)), Vector::new(1.0, -2.0, -3.0));
    }

    #[test]
    fn composition_applies_the_inner_map_first() {
        let a_from_b = general();
        let b_from_c = Transform::translation(Vector::new(5.0, 6.0, 7.0));
        let p = Point::new(0.1, 0.2, 0.3);
        let at_once = a_from_b.then_from(&b_from_c).point(p);
        check_vector(at_once.to_vector(), a_from_b.point(b_from_c.point(p)).to_vector());
        assert_eq!(Transform::IDENTITY.then_from(&a_from_b), a_from_b);
    }

    #[test]
    fn inverse_undoes() {
        let there_and_back = general().inverse().unwrap().then_from(&general());
        let p = Point::new(0.1, 0.2, 0.3);
        check_vector(there_and_back.point(p).to_vector(), p.to_vector());
        assert_eq!(Transform::scale(1.0, 0.0, 1.0).inverse(), None);
        assert_eq!(Transform::scale(1.0, f64::NAN, 1.0).inverse(), None);
    }

    #[test]
    fn determinant_is_the_volume_with_the_sign_of_the_orientation() {
        assert!((general().determinant() + 4.0).abs() < ROUNDING);
        assert_eq!(Transform::IDENTITY.determinant(), 1.0);
    }

    /// Also where the map stretches unevenly and mirrors.
    #[test]
    fn normals_stay_perpendicular_and_on_their_side() {
        let (map, normal) = (general(), Vector::new(1.0, 2.0, -1.0).normal().unwrap());
        let image = map.normal(normal).unwrap().to_vector();
        let (u, v) = normal.to_direction().frame();
        for tangent in [u, v] {
            assert!(image.dot(map.vector(tangent.to_vector())).abs() < ROUNDING);
        }
        assert!(image.dot(map.vector(normal.to_vector())) > 0.0);
        assert_eq!(Transform::scale(1.0, 0.0, 0.0).normal(Normal::Z), None);
    }
}
