//! Values between the points of a grid, which walls keep apart.

use super::frame::{Place, Plane};
use super::section::Piece;

/// What is interpolated of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scale {
    /// The values themselves.
    Even,
    /// Their logarithms; what lies below `least` counts as that.
    Ratios { least: f64 },
}

impl Scale {
    fn of(self, lx: f64) -> f64 {
        match self {
            Self::Even => lx,
            Self::Ratios { least } => libm::log(lx.max(least)),
        }
    }

    /// The value that such a number stands for.
    fn lx(self, number: f64) -> f64 {
        match self {
            Self::Even => number,
            Self::Ratios { .. } => libm::exp(number),
        }
    }
}

/// Values between points. Away from walls they are cubics along both sides, whose slopes are limited (after van Leer 1977), so that
/// values beside a steep step lie hardly beyond those of the points. Beside walls, and where points have no value, they follow the
/// slopes of the points that are seen from the place. In the outer half cell they go on straight. Nowhere do they lie beyond
/// the least and the greatest value.
pub(super) struct Field<'a> {
    plane: &'a Plane,
    scale: Scale,
    /// At the points, in the numbers of the scale.
    values: Vec<Option<f64>>,
    /// Pieces of the section near each cell, whose corners are points; half cells at the edges are cells, too.
    near: Vec<Vec<Piece>>,
    range: (f64, f64),
}

/// Pieces of the section that are closer to the edge of a cell belong to both, in cells.
const BETWEEN: f64 = 1e-6;
/// Walls this close to the edge of the grid, in cells, end it: they keep nothing apart.
const BESIDE: f64 = 1e-3;

/// From one point to the next, if both have a value and nothing stands between.
type Step = Option<f64>;

impl<'a> Field<'a> {
    /// `None` where no point has a value.
    pub(super) fn new(
        plane: &'a Plane,
        (lx, scale): (&[Option<f64>], Scale),
        pieces: &[Piece],
    ) -> Option<Self> {
        let values: Vec<Option<f64>> = lx.iter().map(|lx| lx.map(|lx| scale.of(lx))).collect();
        let known = || values.iter().flatten().copied();
        let range = (known().reduce(f64::min)?, known().reduce(f64::max)?);
        let cells = plane.counts.map(|count| count as usize + 1);
        let mut near = vec![Vec::new(); cells[0] * cells[1]];
        for piece in pieces {
            let ends = piece.map(|place| plane.index_at(place));
            let cells_of = |k: usize| {
                // A piece between two cells is near to both; one beyond the grid to none.
                let low = ends[0][k].min(ends[1][k]) - BETWEEN;
                let high = ends[0][k].max(ends[1][k]) + BETWEEN;
                let of = |at: f64| (at.floor() + 1.0).max(0.0) as usize;
                let is_beyond = high < BESIDE - 0.5 || low > cells[k] as f64 - 1.5 - BESIDE;
                if is_beyond { 0..0 } else { of(low)..(of(high) + 1).min(cells[k]) }
            };
            for row in cells_of(1) {
                for column in cells_of(0) {
                    near[row * cells[0] + column].push(*piece);
                }
            }
        }
        Some(Self { plane, scale, values, near, range })
    }

    /// At a place within the grid, where something is known.
    pub(super) fn at(&self, place: Place) -> Option<f64> {
        let index = self.plane.index_at(place);
        let counts = self.plane.counts.map(f64::from);
        // A rounding beyond is inside.
        if (0..2).any(|k| !(-0.5 - 1e-9..=counts[k] - 0.5 + 1e-9).contains(&index[k])) {
            return None;
        }
        let cell = [0, 1].map(|k| (index[k].floor() as i64 + 1).clamp(0, counts[k] as i64));
        let smooth = self.is_free(cell).then(|| self.smooth(cell, index)).flatten();
        let value = smooth.or_else(|| self.seen(cell, place, index))?;
        Some(self.scale.lx(value.clamp(self.range.0, self.range.1)))
    }

    fn value(&self, [i, j]: [i64; 2]) -> Option<f64> {
        let [across, along] = self.plane.counts.map(i64::from);
        let inside = (0..across).contains(&i) && (0..along).contains(&j);
        inside.then(|| self.values[(j * across + i) as usize]).flatten()
    }

    fn pieces_near(&self, [column, row]: [i64; 2]) -> &[Piece] {
        let [across, along] = self.plane.counts.map(|count| i64::from(count) + 1);
        let inside = (0..across).contains(&column) && (0..along).contains(&row);
        if inside { &self.near[(row * across + column) as usize] } else { &[] }
    }

    fn is_free(&self, cell: [i64; 2]) -> bool {
        self.pieces_near(cell).is_empty()
    }

    /// From a point to the next along one axis.
    fn step(&self, from: [i64; 2], axis: usize) -> Step {
        let mut to = from;
        to[axis] += 1;
        let step = self.value(to)? - self.value(from)?;
        let [a, b] = [from, to].map(|point| self.plane.at_index(point.map(|k| k as f64)));
        // The cells on both sides of the way.
        let mut cells = [[from[0] + 1, from[1] + 1]; 2];
        cells[1][1 - axis] -= 1;
        let is_open = cells
            .iter()
            .flat_map(|&cell| self.pieces_near(cell))
            .all(|piece| !crosses([a, b], *piece));
        is_open.then_some(step)
    }

    /// By cubics, first along the rows, then across them; `None` if a corner has no value.
    fn smooth(&self, [column, row]: [i64; 2], index: [f64; 2]) -> Option<f64> {
        let [across, along] = self.plane.counts.map(i64::from);
        let last = |count: i64| (count - 2).max(0);
        let (i, j) = ((column - 1).clamp(0, last(across)), (row - 1).clamp(0, last(along)));
        let in_row = |j: i64| -> Option<f64> {
            let from = self.value([i, j])?;
            if across == 1 {
                return Some(from);
            }
            let step = |i: i64| self.step([i, j], 0);
            Some(from + hermite([step(i - 1), step(i), step(i + 1)], index[0] - i as f64)?)
        };
        let from = in_row(j)?;
        if along == 1 {
            return Some(from);
        }
        let is_open = |j: i64| {
            let columns = [i, (i + 1).min(across - 1)];
            columns.iter().all(|&i| self.step([i, j], 1).is_some())
        };
        let step = |j: i64| is_open(j).then(|| Some(in_row(j + 1)? - in_row(j)?)).flatten();
        Some(from + hermite([step(j - 1), step(j), step(j + 1)], index[1] - j as f64)?)
    }

    /// By the slopes of the corners that are seen; if none is, of those around.
    fn seen(&self, cell: [i64; 2], place: Place, index: [f64; 2]) -> Option<f64> {
        [1, 2].iter().find_map(|&reach| {
            let around = |k: usize| (cell[k] - reach + 1)..(cell[k] + reach);
            let pieces: Vec<Piece> = around(1)
                .flat_map(|row| around(0).map(move |column| [column, row]))
                .flat_map(|cell| self.pieces_near(cell).iter().copied())
                .collect();
            let corners = |k: usize| (cell[k] - reach)..(cell[k] + reach);
            let (mut sum, mut weights) = (0.0, 0.0);
            for corner in corners(1).flat_map(|j| corners(0).map(move |i| [i, j])) {
                let Some(value) = self.value(corner) else { continue };
                let point = self.plane.at_index(corner.map(|k| k as f64));
                if pieces.iter().any(|piece| crosses([place, point], *piece)) {
                    continue;
                }
                let off = [0, 1].map(|k| index[k] - corner[k] as f64);
                let along = |k: usize| off[k] * self.slope_at(corner, k);
                let weight = near(off[0], reach) * near(off[1], reach);
                sum += weight * (value + along(0) + along(1));
                weights += weight;
            }
            (weights > 0.0).then(|| sum / weights)
        })
    }

    /// The slope at a point along an axis, from what is open around it.
    fn slope_at(&self, point: [i64; 2], axis: usize) -> f64 {
        let mut before = point;
        before[axis] -= 1;
        match (self.step(before, axis), self.step(point, axis)) {
            (Some(a), Some(b)) => slope(a, b),
            (one, other) => one.or(other).unwrap_or(0.0),
        }
    }
}

/// What a corner so far off counts, one at it and nearly nothing `reach` cells away; a corner seen alone counts however far it is.
fn near(off: f64, reach: i64) -> f64 {
    let t = (off.abs() / reach as f64).min(1.0);
    (1.0 - t * t * (3.0 - 2.0 * t)).max(1e-6)
}

/// What is added to the first of two points so far on to the other, by a cubic whose slopes at both follow from the steps before,
/// between and after them; straight on beyond either.
fn hermite([before, between, after]: [Step; 3], t: f64) -> Option<f64> {
    let step = between?;
    let [first, last] = [before, after].map(|other| other.map_or(step, |other| slope(other, step)));
    Some(match t {
        t if t < 0.0 => first * t,
        t if t > 1.0 => step + last * (t - 1.0),
        t => {
            let (t2, t3) = (t * t, t * t * t);
            step * (3.0 * t2 - 2.0 * t3) + first * (t3 - 2.0 * t2 + t) + last * (t3 - t2)
        }
    })
}

/// The slope between two steps: their mean, at most twice the smaller, or as much as the smaller where they turn.
fn slope(a: f64, b: f64) -> f64 {
    let most = a.abs().min(b.abs()) * if a * b > 0.0 { 2.0 } else { 1.0 };
    (0.5 * (a + b)).clamp(-most, most)
}

/// Whether two segments cross or touch.
fn crosses([a, b]: [Place; 2], [c, d]: Piece) -> bool {
    let side = |p: Place, q: Place, r: Place| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::{Point, Vector};
    use isolux::scene::CalculationGrid;

    fn plane(across: f64, along: f64) -> Plane {
        let grid = CalculationGrid {
            name: String::new(),
            corner: Point::new(0.0, 0.0, 0.0),
            u: Vector::new(across, 0.0, 0.0),
            v: Vector::new(0.0, along, 0.0),
            spacing_m: Some(1.0),
            border_m: 0.0,
            maintenance_factor: 1.0,
        };
        Plane::of(&grid).unwrap()
    }

    #[test]
    fn beside_a_step_nothing_is_higher_or_lower() {
        let plane = plane(4.0, 1.0);
        let values = [500.0, 500.0, 20.0, 20.0].map(Some);
        let field = Field::new(&plane, (&values, Scale::Even), &[]).unwrap();
        for k in 0..=40 {
            let value = field.at([0.1 * f64::from(k), 0.5]).unwrap();
            assert!((20.0..=500.0).contains(&value), "{k}: {value}");
        }
        assert_eq!(field.at([0.5, 0.2]), Some(500.0));
        // Half way from one to the other, by symmetry.
        assert!((field.at([2.0, 0.5]).unwrap() - 260.0).abs() < 1e-9);
        assert_eq!(field.at([4.2, 0.5]), None);
    }

    #[test]
    fn lines_around_a_bright_point_are_round() {
        let plane = plane(5.0, 5.0);
        // Logarithms that fall with the square of the distance: the slopes of cubics are those of the parabola.
        let at = |s: f64, t: f64| 800.0 * libm::exp(-(s - 2.5).powi(2) - (t - 2.5).powi(2));
        let mut values = Vec::new();
        for j in 0..5 {
            values.extend((0..5).map(|i| Some(at(f64::from(i) + 0.5, f64::from(j) + 0.5))));
        }
        let field = Field::new(&plane, (&values, Scale::Ratios { least: 1e-3 }), &[]).unwrap();
        let around = |degrees: i32| {
            let (sine, cosine) = libm::sincos(f64::from(degrees).to_radians());
            field.at([2.5 + 0.8 * cosine, 2.5 + 0.8 * sine]).unwrap()
        };
        let all: Vec<f64> = (0..360).step_by(15).map(around).collect();
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = all.iter().copied().fold(0.0, f64::max);
        assert!(greatest < 1.05 * least, "{least} to {greatest}");
    }

    #[test]
    fn a_plane_is_kept_to_its_edges() {
        let plane = plane(4.0, 3.0);
        let at = |s: f64, t: f64| 100.0 + 10.0 * s + 7.0 * t;
        let mut values = Vec::new();
        for j in 0..3 {
            values.extend((0..4).map(|i| Some(at(f64::from(i) + 0.5, f64::from(j) + 0.5))));
        }
        let field = Field::new(&plane, (&values, Scale::Even), &[]).unwrap();
        for place in [[0.7, 0.9], [2.0, 2.4], [3.3, 1.1], [2.0, 0.4]] {
            assert!((field.at(place).unwrap() - at(place[0], place[1])).abs() < 1e-9, "{place:?}");
        }
        // Beyond the outermost points it goes on, up to the least and the greatest value.
        assert!((field.at([0.1, 1.5]).unwrap() - at(0.1, 1.5)).abs() < 1e-9);
        assert_eq!(field.at([0.0, 0.0]), Some(at(0.5, 0.5)));
    }

    #[test]
    fn walls_keep_values_apart() {
        let plane = plane(4.0, 1.0);
        let values = [Some(100.0), Some(200.0), Some(900.0), None];
        let wall = [[2.2, -1.0], [2.2, 2.0]];
        let field = Field::new(&plane, (&values, Scale::Even), &[wall]).unwrap();
        // Up to the wall it goes on as between the points before it; behind there is one alone.
        assert!((field.at([2.1, 0.5]).unwrap() - 260.0).abs() < 1e-9);
        assert_eq!(field.at([2.3, 0.5]), Some(900.0));
        assert_eq!(field.at([2.9, 0.5]), Some(900.0));
        let walls = [wall, [[3.0, -1.0], [3.0, 2.0]]];
        let field = Field::new(&plane, (&values, Scale::Even), &walls).unwrap();
        assert_eq!(field.at([3.2, 0.5]), None);
    }

    #[test]
    fn a_grid_of_one_point_has_one_value() {
        let plane = plane(1.0, 1.0);
        let field = Field::new(&plane, (&[Some(7.0)], Scale::Even), &[]).unwrap();
        assert_eq!((field.at([0.1, 0.9]), field.at([0.5, 0.5])), (Some(7.0), Some(7.0)));
        assert!(Field::new(&plane, (&[None], Scale::Even), &[]).is_none());
    }
}
