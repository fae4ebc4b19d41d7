//! Planar polygons into triangles.

use isolux::geometry::{Point, Vector};

/// The largest polygon that is cut: the time grows with the square of the number of corners.
pub(crate) const MOST_CORNERS: usize = 4096;

/// A wrong turn of less than this share of the polygon's area is rounding: corners that should
/// coincide, in files of six digits.
const ROUNDING_SHARE: f64 = 1e-5;

/// A polygon cut into triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Triangulation {
    /// Corners of the triangles, by index into the polygon, turning the same way as it does.
    pub(crate) triangles: Vec<[usize; 3]>,
    /// Whether the outline crosses itself, so that no cut is right.
    pub(crate) crosses_itself: bool,
}

/// Twice the area times the normal (Newell's sum; of a bent polygon, the mean).
pub(crate) fn area_vector(corners: &[Point]) -> Vector {
    let Some(&origin) = corners.first() else { return Vector::ZERO };
    let arms = corners.iter().map(|&p| p - origin);
    let next = arms.clone().cycle().skip(1);
    arms.zip(next).fold(Vector::ZERO, |sum, (a, b)| sum + a.cross(b))
}

/// Cuts a simple polygon, convex or not, by clipping ears (Meisters 1975): an ear is a convex
/// corner whose triangle holds no other part of the outline. Corners on a straight line are kept
/// where they can be. Nothing comes of a polygon without area.
pub(crate) fn triangulate(corners: &[Point]) -> Triangulation {
    if corners.len() < 3 {
        return Triangulation::default();
    }
    let outline = flatten(corners);
    if is_convex(&outline) {
        let triangles = (2..corners.len()).map(|k| [0, k - 1, k]).collect();
        return Triangulation { triangles, crosses_itself: false };
    }
    Clipping::new(outline).run()
}

/// The polygon seen along the largest component of its normal, turning counter-clockwise.
fn flatten(corners: &[Point]) -> Vec<[f64; 2]> {
    let normal = area_vector(corners);
    let (x, y, z) = (normal.x, normal.y, normal.z);
    let (u, v, facing) = if z.abs() >= x.abs() && z.abs() >= y.abs() {
        (0, 1, z)
    } else if x.abs() >= y.abs() {
        (1, 2, x)
    } else {
        (2, 0, y)
    };
    let sign = 1.0_f64.copysign(facing);
    corners
        .iter()
        .map(|p| [p.to_vector().component(u), sign * p.to_vector().component(v)])
        .collect()
}

/// Twice the signed area of a triangle.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether every corner turns left, once around: then a fan is right.
fn is_convex(outline: &[[f64; 2]]) -> bool {
    let n = outline.len();
    let all_left =
        (0..n).all(|k| turn(outline[k], outline[(k + 1) % n], outline[(k + 2) % n]) > 0.0);
    let fan_left = (2..n).all(|k| turn(outline[0], outline[k - 1], outline[k]) > 0.0);
    all_left && fan_left
}

/// The outline while ears are cut off, as a ring of links.
struct Clipping {
    outline: Vec<[f64; 2]>,
    next: Vec<usize>,
    previous: Vec<usize>,
    is_ear: Vec<bool>,
}

impl Clipping {
    fn new(outline: Vec<[f64; 2]>) -> Self {
        let n = outline.len();
        let next = (0..n).map(|k| (k + 1) % n).collect();
        let previous = (0..n).map(|k| (k + n - 1) % n).collect();
        let mut ring = Self { outline, next, previous, is_ear: vec![false; n] };
        for corner in 0..n {
            ring.is_ear[corner] = ring.test_ear(corner);
        }
        ring
    }

    fn run(mut self) -> Triangulation {
        let mut cut = Triangulation::default();
        let rounding = ROUNDING_SHARE * self.twice_area();
        let mut left = self.outline.len();
        let mut at = 0;
        while left > 3 {
            let Some(corner) = self.best_corner(at, left) else { break };
            let turn = self.turn_at(corner);
            if turn != 0.0 {
                cut.triangles.push([self.previous[corner], corner, self.next[corner]]);
                cut.crosses_itself |= !self.is_ear[corner] && turn > rounding;
            }
            at = self.next[corner];
            self.unlink(corner);
            left -= 1;
        }
        let last = self.turn_at(at);
        if last != 0.0 {
            cut.triangles.push([self.previous[at], at, self.next[at]]);
            cut.crosses_itself |= last < -rounding;
        }
        cut.crosses_itself |= left > 3;
        cut
    }

    fn twice_area(&self) -> f64 {
        let origin = self.outline[0];
        (1..self.outline.len()).map(|k| turn(origin, self.outline[k - 1], self.outline[k])).sum()
    }

    /// An ear; failing that a corner on a straight line; failing that any left turn.
    fn best_corner(&self, from: usize, left: usize) -> Option<usize> {
        let ring = || std::iter::successors(Some(from), |&k| Some(self.next[k])).take(left);
        ring()
            .find(|&k| self.is_ear[k])
            .or_else(|| ring().find(|&k| self.turn_at(k) == 0.0))
            .or_else(|| ring().find(|&k| self.turn_at(k) > 0.0))
    }

    fn unlink(&mut self, corner: usize) {
        let (before, after) = (self.previous[corner], self.next[corner]);
        self.next[before] = after;
        self.previous[after] = before;
        for corner in [before, after] {
            self.is_ear[corner] = self.test_ear(corner);
        }
    }

    fn turn_at(&self, corner: usize) -> f64 {
        let [a, b, c] = self.triangle(corner);
        turn(a, b, c)
    }

    fn triangle(&self, corner: usize) -> [[f64; 2]; 3] {
        [self.previous[corner], corner, self.next[corner]].map(|k| self.outline[k])
    }

    fn test_ear(&self, corner: usize) -> bool {
        let triangle = self.triangle(corner);
        let [a, b, c] = triangle;
        if turn(a, b, c) <= 0.0 {
            return false;
        }
        let mut k = self.next[corner];
        while k != self.previous[corner] {
            let (p, q) = (self.outline[k], self.outline[self.next[k]]);
            let inside = !triangle.contains(&p) && holds(triangle, p);
            if inside || cross(a, c, p, q) {
                return false;
            }
            k = self.next[k];
        }
        true
    }
}

/// Whether a triangle that turns left holds a point, border included.
fn holds([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> bool {
    turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
}

/// Whether two segments cross at a point inside both.
fn cross(a: [f64; 2], b: [f64; 2], p: [f64; 2], q: [f64; 2]) -> bool {
    turn(a, b, p) * turn(a, b, q) < 0.0 && turn(p, q, a) * turn(p, q, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(flat: &[[f64; 2]]) -> Vec<Point> {
        flat.iter().map(|&[x, y]| Point::new(x, y, 1.0)).collect()
    }

    /// The triangles cover the polygon once: none is turned, and the areas sum to its area.
    fn check(corners: &[Point]) -> Triangulation {
        let cut = triangulate(corners);
        let whole = area_vector(corners);
        let normal = whole.normal().unwrap();
        let mut sum = 0.0;
        for triangle in &cut.triangles {
            let part = area_vector(&triangle.map(|k| corners[k])).dot(normal.to_vector());
            assert!(part > 0.0, "{triangle:?} is turned");
            sum += part;
        }
        // Rounding of a few dozen products of numbers of order one.
        assert!((sum - whole.length()).abs() < 1e-12 * whole.length(), "{sum} {whole:?}");
        assert!(!cut.crosses_itself);
        cut
    }

    #[test]
    fn concave_polygons_are_covered_once() {
        let arrow = [[0.0, 0.0], [2.0, -1.0], [0.5, 0.0], [2.0, 1.0]];
        let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let comb: Vec<[f64; 2]> = (0..20)
            .map(|k| [f64::from(k), if k % 2 == 0 { 5.0 } else { 1.0 + 0.01 * f64::from(k) }])
            .chain([[19.0, 0.0], [0.0, 0.0]])
            .rev()
            .collect();
        let spiral: Vec<[f64; 2]> = (0..60)
            .map(|k| (k, 1.0 + 0.2 * f64::from(k)))
            .chain((0..60).rev().map(|k| (k, 1.5 + 0.2 * f64::from(k))))
            .map(|(k, r)| [r * libm::cos(0.3 * f64::from(k)), r * libm::sin(0.3 * f64::from(k))])
            .collect();
        for flat in [&arrow[..], &l, &comb, &spiral] {
            let cut = check(&points(flat));
            assert_eq!(cut.triangles.len(), flat.len() - 2);
            let turned: Vec<Point> = points(flat).into_iter().rev().collect();
            check(&turned);
        }
    }

    #[test]
    fn every_orientation_in_space() {
        let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        for at in [
            |[x, y]: [f64; 2]| Point::new(x, y, 0.0),
            |[x, y]: [f64; 2]| Point::new(0.0, x, y),
            |[x, y]: [f64; 2]| Point::new(y, 0.0, x),
            |[x, y]: [f64; 2]| Point::new(-x, y, 2.0 * x + y),
        ] {
            check(&l.map(at));
        }
    }

    #[test]
    fn a_hole_joined_by_a_slit() {
        let flat = [
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [3.0, 3.0],
            [3.0, 1.0],
            [1.0, 1.0],
        ];
        check(&points(&flat));
    }

    #[test]
    fn corners_on_a_straight_line() {
        let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
        assert_eq!(check(&points(&flat)).triangles.len(), 4);
    }

    #[test]
    fn degenerate_outlines() {
        let point = [1.0, 2.0];
        assert!(triangulate(&points(&[])).triangles.is_empty());
        assert!(triangulate(&points(&[point, point])).triangles.is_empty());
        assert!(triangulate(&points(&[point; 5])).triangles.is_empty());
        let line: Vec<_> = (0..9).map(|k| [f64::from(k), 0.0]).collect();
        assert!(triangulate(&points(&line)).triangles.is_empty());
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 3.0]];
        assert!(triangulate(&points(&bow)).crosses_itself);
        let nan = [[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]];
        triangulate(&points(&nan));
        let twice: Vec<_> =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]].into_iter().flat_map(|p| [p; 2]).collect();
        check(&points(&twice));
    }
}
