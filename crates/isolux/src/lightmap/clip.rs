//! Convex polygons in the plane of a page.

/// A triangle cut by four lines has seven corners at most.
const MOST: usize = 8;

/// A convex polygon, texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Polygon {
    corners: [[f64; 2]; MOST],
    len: usize,
}

impl Polygon {
    /// A triangle, turned counter-clockwise in the axes of the page.
    pub(super) fn triangle([a, b, c]: [[f64; 2]; 3]) -> Self {
        let [b, c] = if doubled_area([a, b, c]) < 0.0 { [c, b] } else { [b, c] };
        let mut corners = [[0.0; 2]; MOST];
        corners[..3].copy_from_slice(&[a, b, c]);
        Self { corners, len: 3 }
    }

    /// Its corners.
    pub(super) fn corners(&self) -> &[[f64; 2]] {
        &self.corners[..self.len]
    }

    /// The part with `low <= coordinate <= high` along an axis (Sutherland and Hodgman 1974).
    pub(super) fn within(&self, axis: usize, low: f64, high: f64) -> Self {
        self.beyond(axis, low, 1.0).beyond(axis, high, -1.0)
    }

    /// The part where `sign (coordinate - limit)` is not negative.
    fn beyond(&self, axis: usize, limit: f64, sign: f64) -> Self {
        let mut cut = Self { corners: [[0.0; 2]; MOST], len: 0 };
        let corners = self.corners();
        for (k, &here) in corners.iter().enumerate() {
            let next = corners[(k + 1) % corners.len()];
            let (a, b) = (sign * (here[axis] - limit), sign * (next[axis] - limit));
            if a >= 0.0 {
                cut.push(here);
            }
            if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
                let t = a / (a - b);
                let mut on = [0, 1].map(|k| here[k] + t * (next[k] - here[k]));
                on[axis] = limit;
                cut.push(on);
            }
        }
        cut
    }

    fn push(&mut self, corner: [f64; 2]) {
        // A sliver may cross a line twice by rounding; what it loses has no area.
        if self.len < MOST {
            self.corners[self.len] = corner;
            self.len += 1;
        }
    }

    /// Least and greatest coordinate along an axis; nothing where it is empty.
    pub(super) fn range(&self, axis: usize) -> Option<(f64, f64)> {
        let along = || self.corners().iter().map(|corner| corner[axis]);
        Some((along().reduce(f64::min)?, along().reduce(f64::max)?))
    }

    /// Area, texels.
    pub(super) fn area(&self) -> f64 {
        self.fan().map(|triangle| 0.5 * doubled_area(triangle)).sum()
    }

    /// The middle of its area; a corner where it has none.
    pub(super) fn centroid(&self) -> [f64; 2] {
        let (mut sum, mut area) = ([0.0; 2], 0.0);
        for triangle in self.fan() {
            let part = doubled_area(triangle);
            area += part;
            for k in 0..2 {
                sum[k] += part * (triangle[0][k] + triangle[1][k] + triangle[2][k]) / 3.0;
            }
        }
        if area > 0.0 { sum.map(|s| s / area) } else { self.corners[0] }
    }

    /// The point of the polygon for a point of the unit square, evenly over its area.
    pub(super) fn point(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        let mut left = a * self.area();
        let mut chosen = [self.corners[0]; 3];
        let mut along = 0.0;
        for triangle in self.fan() {
            let area = 0.5 * doubled_area(triangle);
            if area <= 0.0 {
                continue;
            }
            chosen = triangle;
            along = (left / area).clamp(0.0, 1.0);
            if left < area {
                break;
            }
            left -= area;
        }
        let root = along.sqrt();
        let [p, q, r] = chosen;
        let (u, v) = (root * (1.0 - b), root * b);
        [0, 1].map(|k| p[k] + u * (q[k] - p[k]) + v * (r[k] - p[k]))
    }

    fn fan(&self) -> impl Iterator<Item = [[f64; 2]; 3]> + '_ {
        let corners = self.corners();
        (2..corners.len()).map(move |k| [corners[0], corners[k - 1], corners[k]])
    }
}

fn doubled_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_of_a_triangle_make_up_its_area_and_its_centroid() {
        let triangle = Polygon::triangle([[0.3, 0.2], [5.7, 1.1], [2.2, 6.4]]);
        let (mut area, mut middle) = (0.0, [0.0; 2]);
        for y in 0..7 {
            let row = triangle.within(1, f64::from(y), f64::from(y + 1));
            for x in 0..6 {
                let cell = row.within(0, f64::from(x), f64::from(x + 1));
                area += cell.area();
                let at = cell.centroid();
                (0..2).for_each(|k| middle[k] += cell.area() * at[k]);
            }
        }
        // Some forty cells of a few roundings each.
        assert!((area - triangle.area()).abs() < 1e-12);
        let whole = triangle.centroid();
        (0..2).for_each(|k| assert!((middle[k] / area - whole[k]).abs() < 1e-12));
    }

    #[test]
    fn points_lie_inside_and_evenly() {
        let cell = Polygon::triangle([[0.0, 0.0], [3.0, 0.5], [0.5, 3.0]]).within(0, 0.0, 1.0);
        let n = 512;
        let mut mean = [0.0; 2];
        for i in 0..n {
            for j in 0..n {
                let unit = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(n));
                let at = cell.point(unit);
                assert!((0.0..=1.0).contains(&at[0]) && at[1] >= 0.0);
                (0..2).for_each(|k| mean[k] += at[k] / f64::from(n * n));
            }
        }
        let middle = cell.centroid();
        // The midpoint rule, with a jump from triangle to triangle of the fan: first order, by a size of 3 texels.
        let off = 3.0 / f64::from(n);
        (0..2).for_each(|k| assert!((mean[k] - middle[k]).abs() < off, "{mean:?} {middle:?}"));
    }

    #[test]
    fn nothing_is_left_beyond() {
        let triangle = Polygon::triangle([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(triangle.within(0, 2.0, 3.0).area(), 0.0);
        assert_eq!(Polygon::triangle([[1.0, 1.0]; 3]).within(0, 0.0, 2.0).area(), 0.0);
    }
}
