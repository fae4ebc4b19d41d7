//! Points, vectors, directions and normals: four types, so that meaningless sums do not compile.

use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// A place in space, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Point {
    /// Metres along x.
    pub x: f64,
    /// Metres along y.
    pub y: f64,
    /// Metres along z.
    pub z: f64,
}

/// A displacement, metres (or any other free vector).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Vector {
    /// Component along x.
    pub x: f64,
    /// Component along y.
    pub y: f64,
    /// Component along z.
    pub z: f64,
}

/// A vector of length one: where a ray goes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vector", into = "Vector")]
pub struct Direction(Vector);

/// A vector of length one perpendicular to a surface; transforms by the inverse transpose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vector", into = "Vector")]
pub struct Normal(Vector);

/// How far from one the squared length of a normalized vector may be computed to be: the roundings
/// of [`Vector::direction`] and of the squared length itself make up less than 12 half units.
const UNIT_ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Point {
    /// The origin.
    pub const ORIGIN: Self = Self::new(0.0, 0.0, 0.0);

    /// The point at the given coordinates, metres.
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The vector from the origin to this point.
    pub const fn to_vector(self) -> Vector {
        Vector::new(self.x, self.y, self.z)
    }

    /// Component by component the lesser.
    pub fn lesser(self, other: Self) -> Self {
        Self::new(self.x.min(other.x), self.y.min(other.y), self.z.min(other.z))
    }

    /// Component by component the greater.
    pub fn greater(self, other: Self) -> Self {
        Self::new(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }

    /// The point `weight` of the way from here to `other`.
    pub fn lerp(self, other: Self, weight: f64) -> Self {
        self + (other - self) * weight
    }

    /// Coordinates as the ray kernel stores them.
    pub const fn to_f32(self) -> [f32; 3] {
        [self.x as f32, self.y as f32, self.z as f32]
    }

    /// Whether no coordinate is infinite or NaN.
    pub const fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

impl Vector {
    /// The zero vector.
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    /// The vector with the given components.
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// Scalar product.
    pub const fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product.
    pub const fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Square of the length.
    pub const fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    pub fn length(self) -> f64 {
        self.length_squared().sqrt()
    }

    /// The direction of this vector; `None` where it has none (zero, overflow or not a number). A
    /// vector of length one, up to rounding, is its own direction, bit for bit: what was normalized
    /// once does not change when it is written to a file and read again.
    pub fn direction(self) -> Option<Direction> {
        let squared = self.length_squared();
        if (squared - 1.0).abs() <= UNIT_ROUNDING {
            Some(Direction(self))
        } else if (1e-200..=1e200).contains(&squared) {
            // What underflows in such a sum is nothing beside it.
            Some(Direction(self * (1.0 / squared.sqrt())))
        } else {
            self.direction_by_scaling()
        }
    }

    /// The same for tiny and huge vectors, whose squares underflow or overflow.
    #[cold]
    fn direction_by_scaling(self) -> Option<Direction> {
        let largest = self.x.abs().max(self.y.abs()).max(self.z.abs());
        // The maximum passes over a NaN.
        let is_finite = self.x.is_finite() && self.y.is_finite() && self.z.is_finite();
        if !(largest > 0.0 && is_finite) {
            return None;
        }
        let scaled = self * (1.0 / largest);
        let scaled = if scaled.x.is_finite() && scaled.y.is_finite() && scaled.z.is_finite() {
            scaled
        } else {
            self / largest
        };
        Some(Direction(scaled * (1.0 / scaled.length())))
    }

    /// The normal along this vector; `None` where it has no direction.
    pub fn normal(self) -> Option<Normal> {
        self.direction().map(Direction::to_normal)
    }

    /// Components as the ray kernel stores them.
    pub const fn to_f32(self) -> [f32; 3] {
        [self.x as f32, self.y as f32, self.z as f32]
    }

    /// Component by index 0, 1, 2.
    pub const fn component(self, axis: usize) -> f64 {
        match axis {
            0 => self.x,
            1 => self.y,
            _ => self.z,
        }
    }
}

impl Direction {
    /// Along +x.
    pub const X: Self = Self(Vector::new(1.0, 0.0, 0.0));
    /// Along +y.
    pub const Y: Self = Self(Vector::new(0.0, 1.0, 0.0));
    /// Along +z.
    pub const Z: Self = Self(Vector::new(0.0, 0.0, 1.0));

    /// As a plain vector of length one.
    pub const fn to_vector(self) -> Vector {
        self.0
    }

    /// The normal that points this way.
    pub const fn to_normal(self) -> Normal {
        Normal(self.0)
    }

    /// Cosine of the angle to a normal.
    pub const fn cos(self, normal: Normal) -> f64 {
        self.0.dot(normal.0)
    }

    /// Cosine of the angle to another direction.
    pub const fn dot(self, other: Self) -> f64 {
        self.0.dot(other.0)
    }

    /// The mirror direction of a ray that arrives this way at a surface with the given normal.
    pub fn reflect(self, normal: Normal) -> Self {
        Self(self.0 - normal.0 * (2.0 * self.cos(normal)))
    }

    /// Components as the ray kernel reads them.
    pub const fn to_f32(self) -> [f32; 3] {
        [self.0.x as f32, self.0.y as f32, self.0.z as f32]
    }

    /// Two directions that make a right-handed orthonormal frame `(u, v, self)` with this one
    /// (Duff et al. 2017, "Building an orthonormal basis, revisited").
    pub fn frame(self) -> (Self, Self) {
        let Vector { x, y, z } = self.0;
        let sign = 1.0_f64.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        let u = Vector::new(1.0 + sign * x * x * a, sign * b, -sign * x);
        let v = Vector::new(b, sign + y * y * a, -y);
        (Self(u), Self(v))
    }

    /// The world direction of local coordinates in the frame of this direction (local z is this
    /// direction). The local vector must have length one.
    pub fn from_local(self, local: Vector) -> Self {
        let (u, v) = self.frame();
        Self(u.0 * local.x + v.0 * local.y + self.0 * local.z)
    }
}

impl Normal {
    /// Along +z.
    pub const Z: Self = Self(Vector::new(0.0, 0.0, 1.0));

    /// As a plain vector of length one.
    pub const fn to_vector(self) -> Vector {
        self.0
    }

    /// The direction away from the surface.
    pub const fn to_direction(self) -> Direction {
        Direction(self.0)
    }

    /// Cosine of the angle to another normal.
    pub const fn dot(self, other: Self) -> f64 {
        self.0.dot(other.0)
    }
}

impl TryFrom<Vector> for Direction {
    type Error = &'static str;
    fn try_from(vector: Vector) -> Result<Self, Self::Error> {
        vector.direction().ok_or("a vector without direction")
    }
}

impl TryFrom<Vector> for Normal {
    type Error = &'static str;
    fn try_from(vector: Vector) -> Result<Self, Self::Error> {
        vector.normal().ok_or("a normal without direction")
    }
}

impl From<Direction> for Vector {
    fn from(direction: Direction) -> Self {
        direction.0
    }
}

impl From<Normal> for Vector {
    fn from(normal: Normal) -> Self {
        normal.0
    }
}

impl Add<Vector> for Point {
    type Output = Self;
    fn add(self, v: Vector) -> Self {
        Self::new(self.x + v.x, self.y + v.y, self.z + v.z)
    }
}

impl Sub<Vector> for Point {
    type Output = Self;
    fn sub(self, v: Vector) -> Self {
        Self::new(self.x - v.x, self.y - v.y, self.z - v.z)
    }
}

impl Sub for Point {
    type Output = Vector;
    fn sub(self, other: Self) -> Vector {
        Vector::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Add for Vector {
    type Output = Self;
    fn add(self, v: Self) -> Self {
        Self::new(self.x + v.x, self.y + v.y, self.z + v.z)
    }
}

impl AddAssign for Vector {
    fn add_assign(&mut self, v: Self) {
        *self = *self + v;
    }
}

impl Sub for Vector {
    type Output = Self;
    fn sub(self, v: Self) -> Self {
        Self::new(self.x - v.x, self.y - v.y, self.z - v.z)
    }
}

impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl Mul<f64> for Vector {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self::new(self.x * s, self.y * s, self.z * s)
    }
}

impl Div<f64> for Vector {
    type Output = Self;
    fn div(self, s: f64) -> Self {
        Self::new(self.x / s, self.y / s, self.z / s)
    }
}

impl Mul<f64> for Direction {
    type Output = Vector;
    fn mul(self, s: f64) -> Vector {
        self.0 * s
    }
}

impl Mul<f64> for Normal {
    type Output = Vector;
    fn mul(self, s: f64) -> Vector {
        self.0 * s
    }
}

impl Neg for Direction {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Neg for Normal {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl From<[f64; 3]> for Point {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl From<[f32; 3]> for Point {
    fn from([x, y, z]: [f32; 3]) -> Self {
        Self::new(f64::from(x), f64::from(y), f64::from(z))
    }
}

impl From<Point> for [f64; 3] {
    fn from(p: Point) -> Self {
        [p.x, p.y, p.z]
    }
}

impl From<[f64; 3]> for Vector {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl From<[f32; 3]> for Vector {
    fn from([x, y, z]: [f32; 3]) -> Self {
        Self::new(f64::from(x), f64::from(y), f64::from(z))
    }
}

impl From<Vector> for [f64; 3] {
    fn from(v: Vector) -> Self {
        [v.x, v.y, v.z]
    }
}

#[cfg(test)]
mod tests {
    use super::{Direction, Point, Vector};
    use proptest::prelude::*;

    /// A few roundings of numbers of the order of one.
    const ROUNDING: f64 = 1e-15 * 4.0;

    fn direction() -> impl Strategy<Value = Direction> {
        [-1.0..1.0, -1.0..1.0, -1.0..1.0]
            .prop_filter_map("has a direction", |v| Vector::from(v).direction())
    }

    proptest! {
        #[test]
        fn frame_is_right_handed_and_orthonormal(w in direction()) {
            let (u, v) = w.frame();
            prop_assert!((u.to_vector().length() - 1.0).abs() < ROUNDING);
            prop_assert!((v.to_vector().length() - 1.0).abs() < ROUNDING);
            prop_assert!((u.to_vector().cross(v.to_vector()) - w.to_vector()).length() < ROUNDING);
        }

        #[test]
        fn reflection_turns_back_to_itself_and_keeps_the_angle(d in direction(), n in direction()) {
            let n = n.to_normal();
            let reflected = d.reflect(n);
            prop_assert!((reflected.cos(n) + d.cos(n)).abs() < ROUNDING);
            let twice = reflected.reflect(n);
            prop_assert!((twice.to_vector() - d.to_vector()).length() < ROUNDING);
        }

        #[test]
        fn local_z_is_the_direction(w in direction()) {
            prop_assert_eq!(w.from_local(Vector::new(0.0, 0.0, 1.0)), w);
        }
    }

    #[test]
    fn frames_at_the_poles() {
        for w in [Direction::Z, -Direction::Z] {
            let (u, v) = w.frame();
            assert_eq!(u.to_vector().cross(v.to_vector()), w.to_vector());
        }
    }

    #[test]
    fn directions_of_all_lengths() {
        let expected = Vector::new(0.6, -0.8, 0.0);
        for scale in [1.0, 1e-320, 1e-200, 1e200, 1e308] {
            let direction = Vector::new(0.6 * scale, -0.8 * scale, 0.0).direction().unwrap();
            // Subnormal numbers have few digits: 1e-320 has eleven bits.
            let tolerance = if scale < 1e-300 { 1e-3 } else { ROUNDING };
            assert!((direction.to_vector() - expected).length() < tolerance, "{scale}");
        }
        for bad in [0.0, -0.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Vector::new(0.0, bad, 0.0).direction(), None, "{bad}");
            assert_eq!(Vector::new(bad, 0.0, 0.0).normal(), None, "{bad}");
        }
        assert_eq!(Vector::new(1.0, f64::NAN, 0.0).direction(), None);
    }

    #[test]
    fn what_was_normalized_once_stays_the_same() {
        // Uneven directions, of lengths from the smallest to the largest.
        let steps = || (-9..=9).map(|k| f64::from(k) / 7.0);
        for x in steps() {
            for y in steps() {
                for scale in [1e-200, 1e-3, 1.0, 3.7, 1e200] {
                    let once = (Vector::new(x, y, 0.3) * scale).direction().unwrap();
                    let twice = once.to_vector().direction().unwrap();
                    assert_eq!(once, twice, "{x} {y} {scale}");
                }
            }
        }
    }

    #[test]
    fn interpolation_meets_its_start() {
        let (a, b) = (Point::new(1.0, 2.0, 3.0), Point::new(3.0, 2.0, -1.0));
        assert_eq!(a.lerp(b, 0.0), a);
        assert_eq!(a.lerp(b, 0.5), Point::new(2.0, 2.0, 1.0));
    }
}
