//! From the unit square to directions; each warp with its density and its inverse.

use isolux_geometry::{Direction, Point, Vector};
use std::f64::consts::PI;

/// Directions about +z with density `cos(theta) / pi` per steradian.
#[derive(Clone, Copy, Debug)]
pub struct CosineHemisphere;

impl CosineHemisphere {
    /// The direction of a point of the unit square: the concentric map to the disc (Shirley and
    /// Chiu 1997), lifted to the hemisphere. Continuous, so that nets stay nets.
    #[inline]
    pub fn sample([a, b]: [f64; 2]) -> Vector {
        let (x, y) = (2.0 * a - 1.0, 2.0 * b - 1.0);
        // By an angle within 45 degrees of the nearest axis. Nobody can foretell which axis that is: no branches.
        let is_x = x.abs() > y.abs();
        let (along, across) = if is_x { (x, y) } else { (y, x) };
        let divisor = if along == 0.0 { 1.0 } else { along };
        let (s, c) = sine_and_cosine(PI / 4.0 * (across / divisor));
        let (along_c, along_s) = (along * c, along * s);
        let (x, y) = if is_x { (along_c, along_s) } else { (along_s, along_c) };
        Vector::new(x, y, (1.0 - along * along).sqrt())
    }

    /// Density per steradian of a direction in the local frame.
    pub fn density(local: Vector) -> f64 {
        local.z.max(0.0) / PI
    }

    /// The point of the unit square that [`CosineHemisphere::sample`] maps to a direction.
    pub fn inverse(local: Vector) -> [f64; 2] {
        let radius = libm::hypot(local.x, local.y);
        let angle = libm::atan2(local.y, local.x);
        let angle = if angle < -PI / 4.0 { angle + 2.0 * PI } else { angle };
        let (x, y) = if angle < PI / 4.0 {
            (radius, angle * radius / (PI / 4.0))
        } else if angle < 3.0 * PI / 4.0 {
            (-(angle - PI / 2.0) * radius / (PI / 4.0), radius)
        } else if angle < 5.0 * PI / 4.0 {
            (-radius, (angle - PI) * -radius / (PI / 4.0))
        } else {
            ((angle - 3.0 * PI / 2.0) * radius / (PI / 4.0), -radius)
        };
        [0.5 * (x + 1.0), 0.5 * (y + 1.0)]
    }
}

/// Sine and cosine of an angle within 45 degrees, by their series: what those leave out is less than is rounded.
#[inline]
fn sine_and_cosine(angle: f64) -> (f64, f64) {
    const SINE: [f64; 8] = series(1);
    const COSINE: [f64; 9] = series(0);
    let squared = angle * angle;
    let sum = |terms: &[f64]| terms.iter().rev().fold(0.0, |sum, term| sum * squared + term);
    (angle * sum(&SINE), sum(&COSINE))
}

/// The terms `(-1)^k / (2 k + first)!`.
const fn series<const N: usize>(first: usize) -> [f64; N] {
    let mut terms = [1.0; N];
    let mut k = 1;
    while k < N {
        let n = 2 * k + first;
        terms[k] = -terms[k - 1] / (n * (n - 1)) as f64;
        k += 1;
    }
    terms
}

/// Visible normals of the GGX distribution of width alpha (Heitz 2018, "Sampling the GGX
/// distribution of visible normals"), in the local frame of the surface (+z).
#[derive(Clone, Copy, Debug)]
pub struct Ggx {
    /// Width, (0, 1].
    pub alpha: f64,
}

impl Ggx {
    /// A facet normal seen from `view` (z >= 0), density [`Ggx::density`].
    pub fn sample(self, view: Vector, [a, b]: [f64; 2]) -> Vector {
        // Stretch to the hemisphere, sample its projection, stretch back.
        let up = Vector::new(0.0, 0.0, 1.0);
        let stretched = Vector::new(self.alpha * view.x, self.alpha * view.y, view.z);
        let axis = stretched.direction().map_or(up, Direction::to_vector);
        let across = Vector::new(-axis.y, axis.x, 0.0);
        let t1 = across.direction().map_or(Vector::new(1.0, 0.0, 0.0), Direction::to_vector);
        let t2 = axis.cross(t1);
        let (s, c) = libm::sincos(2.0 * PI * b);
        let radius = a.sqrt();
        let (x, tilt) = (radius * c, 0.5 * (1.0 + axis.z));
        let y = (1.0 - tilt) * (1.0 - x * x).max(0.0).sqrt() + tilt * radius * s;
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let hemisphere = t1 * x + t2 * y + axis * z;
        let facet = Vector::new(
            self.alpha * hemisphere.x,
            self.alpha * hemisphere.y,
            hemisphere.z.max(0.0),
        );
        facet.direction().map_or(up, Direction::to_vector)
    }

    /// Density of visible normals per steradian of facet normals.
    pub fn density(self, view: Vector, facet: Vector) -> f64 {
        self.masking(view) * facet.dot(view).max(0.0) * self.distribution(facet) / view.z.max(1e-12)
    }

    /// Smith's masking function G1, the share of facets seen from a direction.
    pub fn masking(self, view: Vector) -> f64 {
        let tan2 = (view.x * view.x + view.y * view.y) / (view.z * view.z).max(1e-24);
        2.0 / (1.0 + (1.0 + self.alpha * self.alpha * tan2).sqrt())
    }

    /// Density of facet normals per steradian and unit of projected area.
    pub fn distribution(self, facet: Vector) -> f64 {
        if facet.z <= 0.0 {
            return 0.0;
        }
        let a2 = self.alpha * self.alpha;
        let q = facet.z * facet.z * (a2 - 1.0) + 1.0;
        a2 / (PI * q * q)
    }
}

/// Triple product of unit vectors in one plane, by rounding.
const IN_PLANE: f64 = 8.0 * f64::EPSILON;

/// Directions from a point to a triangle, uniform in solid angle (Arvo 1995, "Stratified sampling
/// of spherical triangles").
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle {
    corners: [Vector; 3],
    /// Solid angle, sr.
    pub solid_angle_sr: f64,
    angle_a: f64,
    sin_a: f64,
    cos_a: f64,
    cos_c: f64,
}

impl SphericalTriangle {
    /// The triangle as seen from a point; `None` where it is seen edge-on or from inside itself.
    pub fn new(from: Point, triangle: [Point; 3]) -> Option<Self> {
        let corners = triangle.map(|p| (p - from).direction().map(Direction::to_vector));
        let [Some(a), Some(b), Some(c)] = corners else { return None };
        // Solid angle after van Oosterom and Strackee (1983), stable for small triangles.
        let numerator = a.dot(b.cross(c)).abs();
        let denominator = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
        // From inside the triangle both its sides would be seen, each as a hemisphere.
        if numerator <= IN_PLANE && denominator <= IN_PLANE {
            return None;
        }
        let solid_angle_sr = 2.0 * libm::atan2(numerator, denominator);
        let (ab, ac) = (a.cross(b).direction()?, a.cross(c).direction()?);
        let angle_a = libm::acos(ab.dot(ac).clamp(-1.0, 1.0));
        let (sin_a, cos_a) = libm::sincos(angle_a);
        (solid_angle_sr > 0.0 && angle_a > 0.0).then_some(Self {
            corners: [a, b, c],
            solid_angle_sr,
            angle_a,
            sin_a,
            cos_a,
            cos_c: a.dot(b),
        })
    }

    /// Directions to the corners.
    pub const fn corners(&self) -> [Vector; 3] {
        self.corners
    }

    /// The direction of a point of the unit square; density is one over the solid angle.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Option<Direction> {
        let [a, b, c] = self.corners;
        // The sub-triangle a, b, c' that holds the share u of the area; c' lies on the arc a c.
        let (s, t) = libm::sincos(u * self.solid_angle_sr - self.angle_a);
        let x = t - self.cos_a;
        let y = s + self.sin_a * self.cos_c;
        let q_numerator = (y * t - x * s) * self.cos_a - y;
        let q_denominator = (y * s + x * t) * self.sin_a;
        let q = if q_denominator == 0.0 { 1.0 } else { q_numerator / q_denominator };
        let on_arc = arc(a, c, q.clamp(-1.0, 1.0))?;
        // Then along the arc from b to c', uniform in the height over b.
        let z = 1.0 - v * (1.0 - on_arc.dot(b));
        arc(b, on_arc, z)?.direction()
    }
}

/// The unit vector in the plane of `from` and `to` at the angle of the given cosine from `from`.
fn arc(from: Vector, to: Vector, cosine: f64) -> Option<Vector> {
    let away = to - from * to.dot(from);
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    match away.direction() {
        Some(away) => Some(from * cosine + away * sine),
        None => Some(from),
    }
}
