//! Rectangles along the axes, which rooms, openings and skies are made of.

use crate::model::polygon;
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Normal, Point, Vector};
use isolux::scene::Shape;

/// A rectangle in a plane of one constant coordinate; `b` and `c` are the next two axes in turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Panel {
    /// The coordinate that is constant: 0 for x, 1 for y, 2 for z.
    pub(super) axis: usize,
    /// Its value, m.
    pub(super) level_m: f64,
    /// Whether the front looks along the axis, or against it.
    pub(super) looks_up: bool,
    /// The range along the axis after this one, m.
    pub(super) b: [f64; 2],
    /// The range along the axis after that, m.
    pub(super) c: [f64; 2],
}

impl Panel {
    /// The corners, counter-clockwise seen from the front.
    pub(super) fn corners(&self) -> Vec<Point> {
        let [b0, b1] = self.b;
        let [c0, c1] = self.c;
        let mut turn = vec![[b0, c0], [b1, c0], [b1, c1], [b0, c1]];
        if !self.looks_up {
            turn.reverse();
        }
        turn.into_iter().map(|[b, c]| self.point(b, c)).collect()
    }

    /// The place at two coordinates of its own.
    pub(super) fn point(&self, b: f64, c: f64) -> Point {
        let mut position = [0.0; 3];
        position[self.axis] = self.level_m;
        position[(self.axis + 1) % 3] = b;
        position[(self.axis + 2) % 3] = c;
        position.into()
    }

    /// A reading at two coordinates of its own, from the front.
    pub(super) fn place(&self, b: f64, c: f64) -> ProbePoint {
        ProbePoint { position: self.point(b, c), normal: self.normal() }
    }

    /// Where the front looks.
    pub(super) fn normal(&self) -> Normal {
        let axis = [Direction::X, Direction::Y, Direction::Z][self.axis].to_normal();
        if self.looks_up { axis } else { -axis }
    }

    /// Its area, m2.
    #[cfg(test)]
    pub(super) fn area_m2(&self) -> f64 {
        (self.b[1] - self.b[0]) * (self.c[1] - self.c[0])
    }

    /// As a shape of two triangles.
    pub(super) fn shape(&self, name: &str, material: u32) -> Shape {
        polygon(name, &self.corners(), material)
    }

    /// What is left of it around a rectangle in its plane.
    pub(super) fn around(self, hole: Self) -> [Self; 4] {
        let ([b0, b1], [c0, c1]) = (hole.b, hole.c);
        [
            Self { b: [self.b[0], b0], ..self },
            Self { b: [b1, self.b[1]], ..self },
            Self { b: hole.b, c: [self.c[0], c0], ..self },
            Self { b: hole.b, c: [c1, self.c[1]], ..self },
        ]
    }
}

/// The six faces of a box between two corners, fronts inside: x low and high, y low and high, z low and
/// high.
pub(super) fn inside_of(low: [f64; 3], high: [f64; 3]) -> [Panel; 6] {
    [0, 1, 2, 3, 4, 5].map(|k| {
        let (axis, is_high) = (k / 2, k % 2 == 1);
        let range = |turn: usize| {
            let other = (axis + turn) % 3;
            [low[other], high[other]]
        };
        Panel {
            axis,
            level_m: if is_high { high[axis] } else { low[axis] },
            looks_up: !is_high,
            b: range(1),
            c: range(2),
        }
    })
}

/// The direction between two places, of length one.
pub(super) fn unit(v: Vector) -> Vector {
    v / v.length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::ROUNDING;

    #[test]
    fn faces_of_a_box_look_inside() {
        let (low, high) = ([-1.0, 0.0, 2.0], [1.0, 3.0, 4.0]);
        let middle = Point::new(0.0, 1.5, 3.0);
        for panel in inside_of(low, high) {
            let corners = panel.corners();
            let turn = (corners[1] - corners[0]).cross(corners[2] - corners[1]);
            assert!(turn.dot(panel.normal().to_vector()) > 0.0, "{panel:?}");
            assert!((middle - corners[0]).dot(panel.normal().to_vector()) > 0.0, "{panel:?}");
        }
    }

    #[test]
    fn a_frame_and_its_hole_are_the_whole() {
        let wall = inside_of([0.0; 3], [4.0, 4.0, 3.0])[1];
        let hole = Panel { b: [1.0, 3.0], c: [1.5, 2.5], ..wall };
        let frame: f64 = wall.around(hole).iter().map(Panel::area_m2).sum();
        assert!((frame + hole.area_m2() - wall.area_m2()).abs() < ROUNDING * wall.area_m2());
    }
}
