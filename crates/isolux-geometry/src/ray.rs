//! Rays, what they hit, and where they may start.

use crate::{Direction, Point, Vector};

/// A query of the ray kernel: what lies at `origin + t direction` for `0 < t < t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start, metres; the kernel rounds it to `f32` in coordinates of its own.
    pub origin: Point,
    /// Need not have length one; `t` counts in its length.
    pub direction: [f32; 3],
    /// Where the interval searched ends.
    pub end: End,
    /// A triangle that this ray never meets: the one it starts on.
    pub skip: Option<u32>,
}

/// The open end of the interval that a ray searches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// The interval ends at this `t`.
    At(f32),
    /// The interval ends before `t = 1` by a bound of the rounding errors there: see [`Ray::between`].
    Target,
}

impl Ray {
    /// A ray without end.
    pub fn new(origin: Point, direction: Direction) -> Self {
        Self { origin, direction: direction.to_f32(), end: End::At(f32::INFINITY), skip: None }
    }

    /// The segment between two points: `t` runs from 0 at `from` to 1 at `to`. The end is left out
    /// by a bound of the rounding errors of coordinates of that size in the kernel, so that what lies there
    /// is not met; for the start see
    /// [`Bvh::offset_origin`](crate::Bvh::offset_origin) and [`Ray::skipping`]. Points closer together
    /// than that bound have nothing between them.
    pub fn between(from: Point, to: Point) -> Self {
        Self { origin: from, direction: (to - from).to_f32(), end: End::Target, skip: None }
    }

    /// Where the interval searched ends by a kernel whose coordinates count from `kernel_origin`.
    #[inline]
    pub fn t_max(&self, kernel_origin: Point) -> f32 {
        match self.end {
            End::At(t_max) => t_max,
            End::Target => {
                let from = self.origin - kernel_origin;
                let d = Vector::from(self.direction);
                let size = largest(from).max(largest(from + d));
                let rounding = 8.0 * f64::from(f32::EPSILON) * (1.0 + size / largest(d));
                (1.0 - rounding) as f32
            }
        }
    }

    /// The same ray, which searches up to `t_max`.
    pub fn up_to(self, t_max: f32) -> Self {
        Self { end: End::At(t_max), ..self }
    }

    /// The same ray, blind to triangle `index`.
    pub fn skipping(self, index: u32) -> Self {
        Self { skip: Some(index), ..self }
    }
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Barycentric weight of the second corner.
    pub u: f32,
    /// Barycentric weight of the third corner.
    pub v: f32,
    /// Index of the triangle.
    pub triangle: u32,
    /// Whether the ray arrives at the back (corners turn clockwise as seen from its origin).
    pub back: bool,
}

/// The largest component without its sign.
fn largest(v: Vector) -> f64 {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

#[cfg(test)]
mod tests {
    use super::Ray;
    use crate::{Bvh, Direction, Point, Triangle, TriangleMesh, Vector};
    use proptest::prelude::*;

    /// A triangle of the size of metres, up to a kilometre away, with corners as the kernel stores
    /// them.
    fn triangle() -> impl Strategy<Value = Triangle> {
        let place = [-1e3..1e3, -1e3..1e3, -1e3..1e3];
        let corner = || [-3.0..3.0, -3.0..3.0, -3.0..3.0];
        (place, [corner(), corner(), corner()]).prop_map(|(place, corners)| {
            let stored = |v: [f64; 3]| (Point::from(place) + Vector::from(v)).to_f32();
            Triangle { corners: corners.map(|v| Point::from(stored(v))) }
        })
    }

    fn kernel(triangle: &Triangle) -> Bvh {
        let positions = triangle.corners.map(Point::to_f32).to_vec();
        let mesh =
            TriangleMesh { positions, triangles: vec![[0, 1, 2]], ..TriangleMesh::default() };
        Bvh::build(mesh, |_| false)
    }

    proptest! {
        /// From a point computed on a triangle, no ray back meets that triangle. A ray down does, farther from its edges than
        /// the kernel rounds.
        #[test]
        fn offset_origins_lie_on_the_side_of_the_normal(
            triangle in triangle(),
            (u, v) in (0.0..0.5, 0.0..0.5),
            local in [-1.0..1.0, -1.0..1.0, 0.05..1.0],
        ) {
            prop_assume!(triangle.area() > 0.01);
            let normal = triangle.normal().unwrap();
            let kernel = kernel(&triangle);
            let [a, b, c] = triangle.corners;
            let longest_m = (b - a).length().max((c - b).length()).max((a - c).length());
            let least_weight = [u, v, 1.0 - u - v].into_iter().fold(f64::INFINITY, f64::min);
            let from_edges_m = 2.0 * triangle.area() / longest_m * least_weight;
            let is_inside = from_edges_m > kernel.offset_m(triangle.point(u, v));
            for normal in [normal, -normal] {
                let origin = kernel.offset_origin(triangle.point(u, v), normal);
                let up = normal.to_direction();
                let direction = up.from_local(Vector::from(local).direction().unwrap().to_vector());
                prop_assert_eq!(kernel.closest_hit(&Ray::new(origin, direction)), None);
                let down = Ray::new(origin, -up);
                prop_assert!(!is_inside || kernel.any_hit(&down), "moved to the other side");
            }
        }

        /// Much closer to a triangle than its size allows `f32` to tell distances, a ray meets it if
        /// it goes there and only then.
        #[test]
        fn sides_count_however_close(
            corners in [[-3.0..3.0, -3.0..3.0, -3.0..3.0], [-3.0..3.0, -3.0..3.0, -3.0..3.0]],
            (u, v) in (0.1..0.4, 0.1..0.4),
            nearness in 1e-4..1.0,
            local in [-1.0..1.0, -1.0..1.0, 0.05..1.0],
        ) {
            // The third corner so that the point is this near to where coordinates are zero.
            let [a, b] = corners.map(|v| Vector::from(v) + Vector::new(1.0, 1.0, 1.0) * nearness);
            let c = (Vector::new(1.0, 1.0, 1.0) * nearness - a * (1.0 - u - v) - b * u) / v;
            let stored = |v: Vector| Point::from((Point::ORIGIN + v).to_f32());
            let triangle = Triangle { corners: [a, b, c].map(stored) };
            prop_assume!(triangle.area() > 0.01);
            let normal = triangle.normal().unwrap();
            let kernel = kernel(&triangle);
            for normal in [normal, -normal] {
                let up = normal.to_direction();
                // Some roundings of the point away.
                let origin = triangle.point(u, v) + normal * (1e-6 * nearness);
                let local = Vector::from(local).direction().unwrap().to_vector();
                let direction = up.from_local(local);
                prop_assert_eq!(kernel.closest_hit(&Ray::new(origin, direction)), None);
                prop_assert!(kernel.any_hit(&Ray::new(origin, -direction)));
            }
        }

        /// What lies at the end of a segment does not block it, what lies before it does.
        #[test]
        fn segments_leave_out_their_end(
            triangle in triangle(),
            (u, v) in (0.1..0.4, 0.1..0.4),
            distance in 0.01..100.0,
        ) {
            prop_assume!(triangle.area() > 0.01);
            let up = triangle.normal().unwrap().to_vector();
            let end = triangle.point(u, v);
            let segment = Ray::between(end + up * distance, end);
            prop_assert!(!kernel(&triangle).any_hit(&segment));
            let beyond = Ray::between(end + up * distance, end - up * 0.01);
            prop_assert!(kernel(&triangle).any_hit(&beyond));
        }
    }

    #[test]
    fn a_segment_between_equal_points_holds_nothing() {
        let p = Point::new(1.0, 2.0, 3.0);
        let ray = Ray::between(p, p);
        assert!(ray.t_max(Point::ORIGIN) <= 0.0);
        assert!(ray.t_max(p).is_nan());
        assert!(Ray::between(p, p + Direction::X * 1e-9).t_max(Point::ORIGIN) <= 0.0);
    }
}
