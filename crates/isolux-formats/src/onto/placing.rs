//! Where a scene stands in another: turned, moved and scaled, as a `scene.toml` may place a file.

use isolux::geometry::{Point, Transform, Vector};

/// Sides of one scale and right angles may be off by so much: places are `f32`, and those of a map may lie far from its origin.
const DISTORTION: f64 = 1e-3;
/// Heights below this share of the length are none.
const FLAT: f64 = 1e-5;

/// Which of the points hold the others: far from each other, and from their line and plane where there are such.
pub(super) struct Frame {
    corners: [usize; 3],
    /// Off their plane, if a point is.
    off: Option<usize>,
    a_from_frame: Transform,
}

impl Frame {
    /// Of points that do not all lie on one line.
    pub(super) fn of(points: &[Point]) -> Option<Self> {
        let first = *points.first()?;
        let farthest = |distance: &dyn Fn(Vector) -> f64| {
            let all = points.iter().map(|&point| distance(point - first)).enumerate();
            all.max_by(|a, b| a.1.total_cmp(&b.1))
        };
        let (second, length) = farthest(&|v| v.length())?;
        let along = points[second] - first;
        let (third, area) = farthest(&|v| along.cross(v).length())?;
        let across = along.cross(points[third] - first);
        let (fourth, volume) = farthest(&|v| across.dot(v).abs())?;
        let off = (volume > FLAT * length * area).then_some(fourth);
        let mut frame =
            Self { corners: [0, second, third], off, a_from_frame: Transform::IDENTITY };
        frame.a_from_frame = frame.world_from_frame(&|k| points[k]);
        frame.a_from_frame.inverse().map(|_| frame)
    }

    /// From these points to the same ones elsewhere, if that is a similarity.
    pub(super) fn similarity(&self, elsewhere: &dyn Fn(usize) -> Point) -> Option<Transform> {
        let inverse = self.a_from_frame.inverse()?;
        let map = self.world_from_frame(elsewhere).then_from(&inverse);
        let [a, b, c] = map.columns;
        let scale = (a.length_squared() + b.length_squared() + c.length_squared()) / 3.0;
        let is_even =
            [a, b, c].iter().all(|v| (v.length_squared() - scale).abs() <= DISTORTION * scale);
        let is_square =
            [a.dot(b), b.dot(c), c.dot(a)].iter().all(|d| d.abs() <= DISTORTION * scale);
        (scale > 0.0 && is_even && is_square).then_some(map)
    }

    fn world_from_frame(&self, point: &dyn Fn(usize) -> Point) -> Transform {
        let [a, b, c] = self.corners.map(point);
        let (u, v) = (b - a, c - a);
        let w = match self.off {
            Some(off) => point(off) - a,
            // Of the scale of the others, so that it goes with them.
            None => {
                let normal = u.cross(v);
                normal / normal.length().sqrt()
            }
        };
        Transform { columns: [u, v, w], translation: a - Point::ORIGIN }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Direction;

    /// Of a cube and of a square: turned, scaled and moved they are found again, stretched ones are not.
    #[test]
    fn similarities_are_found_and_others_are_not() {
        let cube: Vec<Point> = (0..8)
            .map(|k| Point::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)))
            .collect();
        let turned = Transform::translation(Vector::new(3.0, -2.0, 7.0))
            .then_from(&Transform::rotation_about(Direction::Y, 0.7))
            .then_from(&Transform::scale(0.01, 0.01, 0.01));
        let stretched = Transform::scale(1.0, 1.1, 1.0);
        for points in [&cube[..], &cube[..4]] {
            let frame = Frame::of(points).unwrap();
            let found = frame.similarity(&|k| turned.point(points[k])).unwrap();
            for &point in points {
                assert!((found.point(point) - turned.point(point)).length() < 1e-14);
            }
            assert!(frame.similarity(&|k| stretched.point(points[k])).is_none());
        }
        for points in [&cube[..0], &cube[..1], &cube[..2]] {
            assert!(Frame::of(points).is_none());
        }
    }
}
