//! Triangles of emitting surfaces, clipped at the horizon of a receiver, and places on them drawn by direction.

use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::SphericalTriangle;
use isolux_geometry::{Point, Vector};
use std::cell::OnceCell;

/// The most directions drawn until one is accepted; the last is always taken. Over a triangle above the
/// horizon the mean cosine is above a quarter of the highest, so this happens once in a hundred million cases.
const MOST_TRIES: usize = 64;

/// Rounding of the height of a point above a triangle, as a share of its distance and of its coordinates.
const HEIGHT_ROUNDING: f64 = 1e-14;

/// A part of an emitter's triangle above the horizon of a receiver.
#[derive(Clone)]
pub(crate) struct Piece {
    /// Corners relative to the receiver, m.
    pub(crate) corners: [Vector; 3],
    /// Index of the emitter's triangle that it belongs to.
    pub(crate) triangle: usize,
    /// Projected solid angle: the integral of the cosine at the receiver, sr.
    pub(crate) steradians: f64,
    /// The spherical triangle of its directions and the highest cosine over them, computed on demand.
    /// `None` where the piece is too small, or too near its plane, to be sampled by direction.
    directions: OnceCell<Option<(SphericalTriangle, f64)>>,
}

/// A sampled place on an emitter.
pub(crate) struct Place {
    pub(crate) triangle: usize,
    pub(crate) point: Point,
    /// The projected solid angle that it stands for, as a share of the whole.
    pub(crate) share: f64,
}

impl Place {
    /// A place with the values given; `None` where the surface of the receiver hides it.
    pub(crate) fn seen(
        at: &SurfacePoint,
        triangle: usize,
        point: Point,
        share: f64,
    ) -> Option<Self> {
        let is_seen = (point - at.point).dot(at.geometric.to_vector()) > 0.0;
        is_seen.then_some(Self { triangle, point, share })
    }
}

impl Piece {
    fn directions(&self, at: &SurfacePoint) -> Option<(SphericalTriangle, f64)> {
        *self.directions.get_or_init(|| {
            let spherical = SphericalTriangle::new(at.point, self.corners.map(|c| at.point + c))?;
            let highest = highest_cos(spherical.corners(), at.shading.to_vector());
            Some((spherical, highest))
        })
    }
}

/// The piece at a running sum of projected solid angles.
pub(crate) fn drawn(pieces: &[Piece], mut sum: f64) -> Option<&Piece> {
    let found = pieces.iter().find(|piece| {
        sum -= piece.steradians;
        sum < 0.0
    });
    // Rounding may leave a remainder past the last piece.
    found.or(pieces.last())
}

/// A point of a piece, with a density by direction in proportion to the cosine at the receiver. Directions
/// are drawn uniformly by solid angle, and accepted with the probability of their cosine over the highest.
pub(crate) fn target(
    piece: &Piece,
    corners: [Point; 3],
    at: &SurfacePoint,
    mut accept: f64,
    dice: &mut Dice,
) -> Point {
    let middle = || at.point + (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
    let Some((spherical, highest)) = piece.directions(at) else { return middle() };
    let mut direction = None;
    for _ in 0..MOST_TRIES {
        direction = spherical.sample(dice.pair());
        if direction.is_none_or(|d| accept * highest < d.cos(at.shading)) {
            break;
        }
        [accept, _] = dice.pair();
    }
    direction.and_then(|d| on_plane(at.point, d.to_vector(), corners)).unwrap_or_else(middle)
}

/// The highest cosine with `up` over a spherical triangle above the horizon.
fn highest_cos(corners: [Vector; 3], up: Vector) -> f64 {
    let heights = corners.map(|c| c.dot(up));
    let mut highest = heights.into_iter().fold(0.0, f64::max);
    let mut sides = [0.0; 3];
    for k in 0..3 {
        let next = (k + 1) % 3;
        let across = corners[k].cross(corners[next]);
        sides[k] = across.dot(up);
        let cos = corners[k].dot(corners[next]);
        // An arc that rises from both its ends has its highest point between them.
        if heights[next] > cos * heights[k] && heights[k] > cos * heights[next] {
            let sine2 = sides[k] * sides[k] / across.length_squared();
            highest = highest.max((1.0 - sine2).max(0.0).sqrt());
        }
    }
    let has_zenith = sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0);
    if has_zenith { 1.0 } else { highest }
}

/// The point where a ray meets the plane of a triangle.
fn on_plane(from: Point, direction: Vector, [a, b, c]: [Point; 3]) -> Option<Point> {
    let normal = (b - a).cross(c - a);
    let t = (a - from).dot(normal) / direction.dot(normal);
    (t > 0.0 && t.is_finite()).then(|| from + direction * t)
}

/// The parts that a receiver sees of triangles that emit from their counter-clockwise side, each with its number.
pub(crate) fn pieces(
    at: &SurfacePoint,
    triangles: impl Iterator<Item = (usize, [Point; 3])>,
) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(triangles.size_hint().0 + 1);
    for (triangle, corners) in triangles {
        visit((at.point, at.shading.to_vector()), corners, |corners, steradians| {
            let directions = OnceCell::new();
            pieces.push(Piece { corners, triangle, steradians, directions });
        });
    }
    pieces
}

/// Projected solid angle of the part of a triangle that a receiver sees, sr.
pub(crate) fn steradians(at: &SurfacePoint, triangle: [Point; 3]) -> f64 {
    steradians_from((at.point, at.shading.to_vector()), triangle)
}

/// Projected solid angle of the part of a triangle seen from a point with a normal, sr.
pub(crate) fn steradians_from(from: (Point, Vector), triangle: [Point; 3]) -> f64 {
    let mut whole = 0.0;
    visit(from, triangle, |_, steradians| whole += steradians);
    whole
}

/// Calls `part` for the parts of a triangle above the horizon: their corners relative to the
/// receiver, and projected solid angles.
fn visit(
    (point, normal): (Point, Vector),
    [a, b, c]: [Point; 3],
    mut part: impl FnMut([Vector; 3], f64),
) {
    if !is_before(point, [a, b, c]) {
        return;
    }
    let (polygon, count) = above_horizon([a, b, c].map(|p| p - point), normal);
    for k in 2..count {
        let corners = [polygon[0], polygon[k - 1], polygon[k]];
        let steradians = projected_solid_angle(&corners, normal);
        if steradians > 0.0 {
            part(corners, steradians);
        }
    }
}

/// Whether a point lies on the emitting side of a triangle by more than rounding. A point on its back does not.
fn is_before(point: Point, [a, b, c]: [Point; 3]) -> bool {
    let normal = (b - a).cross(c - a);
    let height = normal.dot(point - a);
    let lengths = (point - a).length_squared() + point.to_vector().length_squared();
    height > 0.0
        && height * height > HEIGHT_ROUNDING * HEIGHT_ROUNDING * normal.length_squared() * lengths
}

/// Projected solid angle of a triangle above the horizon that turns clockwise as seen from the
/// receiver: Lambert's formula (Lambert 1760; in Arvo's notation, "The irradiance Jacobian for
/// partially occluded polyhedral sources", 1994).
fn projected_solid_angle(corners: &[Vector; 3], normal: Vector) -> f64 {
    let mut sum = 0.0;
    for k in 0..3 {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let edge = from.cross(to);
        let length = edge.length();
        if length > 0.0 {
            sum += libm::atan2(length, from.dot(to)) * edge.dot(normal) / length;
        }
    }
    -0.5 * sum
}

/// Clip of a triangle at the horizon by Sutherland and Hodgman: the corners and their number.
fn above_horizon(corners: [Vector; 3], normal: Vector) -> ([Vector; 4], usize) {
    let heights = corners.map(|c| c.dot(normal));
    let (mut kept, mut count) = ([Vector::ZERO; 4], 0);
    let mut keep = |v: Vector| {
        kept[count] = v;
        count += 1;
    };
    for k in 0..3 {
        let next = (k + 1) % 3;
        let (h0, h1) = (heights[k], heights[next]);
        if h0 >= 0.0 {
            keep(corners[k]);
        }
        if (h0 > 0.0 && h1 < 0.0) || (h0 < 0.0 && h1 > 0.0) {
            keep(corners[k] + (corners[next] - corners[k]) * (h0 / (h0 - h1)));
        }
    }
    (kept, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Key, Sequence};
    use isolux_geometry::Normal;

    /// Pieces of random triangles all around a receiver.
    fn random_pieces(count: u64) -> Vec<Piece> {
        let floor = Point::new(0.0, 0.0, 0.0);
        let at = SurfacePoint::in_space(floor, Normal::Z, 0.0);
        let triangle = |k: u64| {
            let key = Key::new(5).with(k);
            // The three shapes take turns: any, flat, thin.
            let flat = [1.0, 0.05, 1.0][(k % 3) as usize];
            let thin = [1.0, 1.0, 0.05][(k % 3) as usize];
            let c = |n: u64| 2.0 * key.with(n).uniform() - 1.0;
            let first = Point::new(c(0), c(1), flat * c(2));
            let second = Point::new(c(3), c(4), flat * c(5));
            [first, second, first + Vector::new(c(6), c(7), flat * c(8)) * thin]
        };
        pieces(&at, (0..count).map(|k| (k as usize, triangle(k))))
    }

    #[test]
    fn no_direction_is_higher_than_the_highest_and_a_quarter_is_taken() {
        let pieces = random_pieces(3000);
        assert!(pieces.len() > 1000, "{}", pieces.len());
        for (index, piece) in pieces.iter().enumerate() {
            let corners = piece.corners.map(|c| Point::ORIGIN + c);
            let Some(spherical) = SphericalTriangle::new(Point::ORIGIN, corners) else { continue };
            let highest = highest_cos(spherical.corners(), Vector::new(0.0, 0.0, 1.0));
            let taken = piece.steradians / (spherical.solid_angle_sr * highest);
            assert!(taken > 0.25 && taken <= 1.0 + 1e-9, "{corners:?}: {taken}");
            let sequence = Sequence::new(Key::new(6).with(index as u64));
            for k in 0..64 {
                let z = spherical.sample(sequence.pair(k, 0)).unwrap().to_vector().z;
                // Thin triangles lose half the digits of the arcs.
                assert!(z > -1e-7 && z <= highest + 1e-7, "{corners:?}: {z} above {highest}");
            }
        }
    }
}
