//! Triangles and indexed triangle meshes.

use crate::{Normal, Point, Vector};

/// One triangle by its corners; the front is where they turn counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Corners, metres.
    pub corners: [Point; 3],
}

impl Triangle {
    /// Twice the area times the normal.
    pub fn area_vector(&self) -> Vector {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Area, m2.
    pub fn area(&self) -> f64 {
        0.5 * self.area_vector().length()
    }

    /// The normal of the front; `None` where the triangle has no area.
    pub fn normal(&self) -> Option<Normal> {
        self.area_vector().normal()
    }

    /// The point with barycentric weights `(1 - u - v, u, v)`.
    pub fn point(&self, u: f64, v: f64) -> Point {
        let [a, b, c] = self.corners;
        a + (b - a) * u + (c - a) * v
    }

    /// The weights `(u, v)` of [`Triangle::point`] for the foot of a point on the plane of the
    /// triangle; zero where the triangle has no area.
    pub fn barycentric(&self, point: Point) -> [f64; 2] {
        let [a, b, c] = self.corners;
        let normal = self.area_vector();
        let squared = normal.length_squared();
        if squared <= 0.0 {
            return [0.0; 2];
        }
        let from_a = point - a;
        let u = from_a.cross(c - a).dot(normal) / squared;
        let v = (b - a).cross(from_a).dot(normal) / squared;
        [u, v]
    }

    /// The centroid.
    pub fn centroid(&self) -> Point {
        self.point(1.0 / 3.0, 1.0 / 3.0)
    }
}

/// Triangles over shared vertices, as the ray kernel reads them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Where the coordinates of positions count from: near them, `f32` tells places apart that it does not where they are
    /// counted from afar.
    pub origin: Point,
    /// Positions, metres from `origin`.
    pub positions: Vec<[f32; 3]>,
    /// Three indices into `positions` a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The corners of triangle `index`.
    ///
    /// # Panics
    /// If `index` or one of its vertex indices is out of range.
    pub fn triangle(&self, index: u32) -> Triangle {
        Triangle { corners: self.local_corners(index).map(|corner| self.world_from_local(corner)) }
    }

    /// The largest coordinate of a corner of triangle `index`, counted from the origin of the mesh and without its sign,
    /// metres: what is computed of the triangle is rounded in proportion to it, wherever on the triangle it lies.
    ///
    /// # Panics
    /// If `index` or one of its vertex indices is out of range.
    pub fn largest_coordinate_m(&self, index: u32) -> f64 {
        let coordinates = self.local_corners(index).into_iter().flatten();
        coordinates.fold(0.0, |largest: f64, x| largest.max(f64::from(x.abs())))
    }

    /// The place of a position.
    #[inline]
    pub fn world_from_local(&self, position: [f32; 3]) -> Point {
        // A difference, so that zeros keep their sign where the origin is that of the world.
        Point::from(position) - (Point::ORIGIN - self.origin)
    }

    /// The position of a place, rounded.
    #[inline]
    pub fn local_from_world(&self, place: Point) -> [f32; 3] {
        (place - self.origin).to_f32()
    }

    /// The place that a position has instead of another: where the kernel has rays start that start there.
    #[inline]
    pub fn rounded(&self, place: Point) -> Point {
        self.world_from_local(self.local_from_world(place))
    }

    /// The smallest axis-parallel box around all positions, `None` for an empty mesh.
    pub fn bounds(&self) -> Option<(Point, Point)> {
        let first = self.world_from_local(*self.positions.first()?);
        Some(self.positions.iter().fold((first, first), |(low, high), &p| {
            let p = self.world_from_local(p);
            (low.lesser(p), high.greater(p))
        }))
    }

    #[inline]
    fn local_corners(&self, index: u32) -> [[f32; 3]; 3] {
        self.triangles[index as usize].map(|v| self.positions[v as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::{Triangle, TriangleMesh};
    use crate::{Normal, Point, Vector};

    fn right_angled() -> Triangle {
        let corner = |x, y| Point::new(x, y, 5.0);
        Triangle { corners: [corner(0.0, 0.0), corner(3.0, 0.0), corner(0.0, 4.0)] }
    }

    #[test]
    fn measures() {
        let triangle = right_angled();
        assert_eq!(triangle.area(), 6.0);
        assert_eq!(triangle.normal(), Some(Normal::Z));
        assert_eq!(triangle.point(0.0, 0.0), triangle.corners[0]);
        assert_eq!(triangle.point(1.0, 0.0), triangle.corners[1]);
        assert_eq!(triangle.point(0.0, 1.0), triangle.corners[2]);
        let Point { x, y, z } = triangle.centroid();
        // One rounding of a third, times four.
        assert!((x - 1.0).abs() + (y - 4.0 / 3.0).abs() + (z - 5.0).abs() < 1e-15);
    }

    #[test]
    fn without_area_there_is_no_normal() {
        let point = Triangle { corners: [Point::new(1.0, 2.0, 3.0); 3] };
        assert_eq!((point.area(), point.normal()), (0.0, None));
        let [a, b, _] = right_angled().corners;
        assert_eq!(Triangle { corners: [a, b, b] }.normal(), None);
    }

    #[test]
    fn bounds_contain_all_positions() {
        assert_eq!(TriangleMesh::default().bounds(), None);
        let positions = vec![[0.0, 5.0, -1.0], [2.0, 1.0, 0.0]];
        let mesh = TriangleMesh { positions, ..TriangleMesh::default() };
        let corners = (Point::new(0.0, 1.0, -1.0), Point::new(2.0, 5.0, 0.0));
        assert_eq!(mesh.bounds(), Some(corners));
        assert!(mesh.is_empty());
    }

    #[test]
    fn coordinates_count_from_the_origin_of_the_mesh() {
        let positions = vec![[0.5, 1.0, -2.0], [-3.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
        let (origin, triangles) = (Point::new(4096.0, -64.0, 0.0), vec![[0, 1, 2]]);
        let mesh = TriangleMesh { origin, positions, triangles };
        let corners = mesh.triangle(0).corners;
        assert_eq!(corners[0], Point::new(4096.5, -63.0, -2.0));
        assert_eq!(corners.map(|corner| mesh.local_from_world(corner)), mesh.positions[..]);
        assert_eq!(mesh.rounded(corners[0] + Vector::new(1e-9, 0.0, 0.0)), corners[0]);
        assert_eq!(mesh.bounds().unwrap().0, Point::new(4093.0, -64.0, -2.0));
        assert_eq!(mesh.largest_coordinate_m(0), 3.0);
    }

    #[test]
    fn zeros_keep_their_sign() {
        let mesh = TriangleMesh { positions: vec![[0.0, -0.0, 1.0]], ..TriangleMesh::default() };
        let place = mesh.world_from_local(mesh.positions[0]);
        let signs = [place.x, place.y].map(f64::is_sign_negative);
        assert_eq!(signs, [false, true]);
        assert!(mesh.local_from_world(place)[1].is_sign_negative());
    }
}
