//! Rectangles, boxes and polygons.

use isolux::geometry::{Point, Vector};
use isolux::scene::Shape;

/// A rectangle `corner + s u + t v`, 0 <= s, t <= 1; the front is where `u x v` points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// One corner, m.
    pub corner: Point,
    /// One edge, m.
    pub u: Vector,
    /// The other edge, m, perpendicular to the first.
    pub v: Vector,
}

impl Rectangle {
    /// From coordinates.
    pub fn new(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Self {
        Self { corner: corner.into(), u: u.into(), v: v.into() }
    }

    /// As a shape of two triangles.
    pub fn shape(&self, name: &str, material: u32) -> Shape {
        let corners = [
            self.corner,
            self.corner + self.u,
            self.corner + self.u + self.v,
            self.corner + self.v,
        ];
        polygon(name, &corners, material)
    }

    /// Where the line through two points meets its plane: `(s, t)` and the share of the way.
    /// `None` where the line is parallel to it.
    pub fn meet(&self, from: Point, to: Point) -> Option<[f64; 3]> {
        let normal = self.u.cross(self.v);
        let (height, slope) = ((self.corner - from).dot(normal), (to - from).dot(normal));
        if slope == 0.0 {
            return None;
        }
        let way = height / slope;
        let inside = from + (to - from) * way - self.corner;
        let along = |edge: Vector| inside.dot(edge) / edge.length_squared();
        Some([along(self.u), along(self.v), way])
    }

    /// Whether the open segment between two points crosses it.
    pub fn blocks(&self, from: Point, to: Point) -> bool {
        let open = |x: f64| x > 0.0 && x < 1.0;
        self.meet(from, to).is_some_and(|meeting| meeting.into_iter().all(open))
    }

    /// Whether the line through two points passes its border closer than a share of its edges.
    pub fn is_grazed(&self, from: Point, to: Point, margin: f64) -> bool {
        let near = |x: f64| x.abs() < margin || (x - 1.0).abs() < margin;
        let within = |x: f64| x > -margin && x < 1.0 + margin;
        self.meet(from, to)
            .is_some_and(|[s, t, _]| (near(s) && within(t)) || (near(t) && within(s)))
    }
}

/// A convex polygon, counter-clockwise seen from its front.
pub fn polygon(name: &str, corners: &[Point], material: u32) -> Shape {
    Shape {
        name: name.into(),
        positions: corners.iter().map(|&p| p.into()).collect(),
        triangles: (2..corners.len() as u32).map(|k| [0, k - 1, k]).collect(),
        material,
        ..Shape::default()
    }
}

/// The six faces of a box between two corners, fronts inside. Faces share no vertices: their edges
/// are creases.
pub fn inward_box(name: &str, low: [f64; 3], high: [f64; 3], material: u32) -> Shape {
    let mut shape = outward_box(name, low, high, material);
    shape.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    shape
}

/// The six faces of a box between two corners, fronts outside.
pub fn outward_box(name: &str, low: [f64; 3], high: [f64; 3], material: u32) -> Shape {
    let mut shape = Shape { name: name.into(), material, ..Shape::default() };
    for axis in 0..3 {
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        for (side, level) in [(-1.0, low[axis]), (1.0, high[axis])] {
            let first = shape.positions.len() as u32;
            for (at_b, at_c) in [(low, low), (high, low), (high, high), (low, high)] {
                let mut corner = [level; 3];
                (corner[b], corner[c]) = (at_b[b], at_c[c]);
                shape.positions.push(corner);
            }
            for [k, l, m] in [[0, 1, 2], [0, 2, 3]] {
                let (l, m) = if side > 0.0 { (l, m) } else { (m, l) };
                shape.triangles.push([first + k, first + l, first + m]);
            }
        }
    }
    shape
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Triangle;

    fn enclosed_volume_m3(shape: &Shape) -> f64 {
        let corner = |v: u32| Point::from(shape.positions[v as usize]);
        let triangles = shape.triangles.iter().map(|t| Triangle { corners: t.map(corner) });
        triangles.map(|t| t.area_vector().dot(t.centroid().to_vector()) / 6.0).sum()
    }

    #[test]
    fn boxes_face_the_way_they_say() {
        let (low, high) = ([-1.0, 0.0, 2.0], [1.0, 3.0, 4.0]);
        assert_eq!(enclosed_volume_m3(&outward_box("out", low, high, 0)), 12.0);
        assert_eq!(enclosed_volume_m3(&inward_box("in", low, high, 0)), -12.0);
    }

    #[test]
    fn a_rectangle_blocks_what_crosses_it() {
        let r = Rectangle::new([0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let (above, below) = (Point::new(1.0, 0.5, 1.0), Point::new(1.0, 0.5, -1.0));
        assert!(r.blocks(above, below));
        assert!(!r.blocks(above, Point::new(1.0, 0.5, 0.5)));
        assert!(!r.blocks(above, Point::new(5.0, 0.5, -1.0)));
        assert!(r.is_grazed(Point::new(2.01, 0.5, 1.0), Point::new(2.01, 0.5, -1.0), 0.01));
        assert!(!r.is_grazed(above, below, 0.01));
    }
}
