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

/// Values between points. Away from walls they are bicubic, with slopes at the points that are limited (after van Leer 1977), so that
/// values beside a steep step lie hardly beyond those of the points. Beside walls, and where points have no value, they follow the
/// slopes of the points that are seen from the place. In the outer half cell they go on straight. Nowhere do they lie beyond
/// the least and the greatest value.
pub(super) struct Field<'a> {
    plane: &'a Plane,
    scale: Scale,
    /// At the points, in the numbers of the scale.
    values: Vec<Option<f64>>,
    /// The slopes there, by cells, and how much one changes along the other side; nought without a value.
    slopes: Vec<Slopes>,
    /// Pieces of the section near each cell, whose corners are points; half cells at the edges are cells, too.
    near: Vec<Vec<Piece>>,
    range: (f64, f64),
}

/// Pieces of the section that are closer to the edge of a cell belong to both, in cells.
const BETWEEN: f64 = 1e-6;
/// Walls this close to the edge of the grid, in cells, end it: they keep nothing apart.
const BESIDE: f64 = 1e-3;

/// How values change at a point.
#[derive(Clone, Copy, Debug)]
struct Slopes {
    along: [f64; 2],
    /// Of the slope along the first side, along the second.
    twist: f64,
}

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
        let mut field = Self { plane, scale, values, slopes: Vec::new(), near, range };
        field.slopes = field.all_slopes();
        Some(field)
    }

    fn all_slopes(&self) -> Vec<Slopes> {
        let [across, along] = self.plane.counts.map(i64::from);
        let points = || (0..along).flat_map(|j| (0..across).map(move |i| [i, j]));
        let mut slopes: Vec<Slopes> = points()
            .map(|point| Slopes {
                along: [0, 1].map(|axis| self.slope_at(point, axis)),
                twist: 0.0,
            })
            .collect();
        let first = |[i, j]: [i64; 2]| slopes[(j * across + i) as usize].along[0];
        let twists: Vec<f64> = points()
            .map(|[i, j]| {
                let change =
                    |j: i64| self.step([i, j], 1).map(|_| first([i, j + 1]) - first([i, j]));
                either(change(j - 1), change(j))
            })
            .collect();
        slopes.iter_mut().zip(twists).for_each(|(slopes, twist)| slopes.twist = twist);
        slopes
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

    /// By the cubic of the four points around, the nearest four beyond the outermost; `None` if one has no value, or a wall is near.
    fn smooth(&self, [column, row]: [i64; 2], index: [f64; 2]) -> Option<f64> {
        let counts = self.plane.counts.map(i64::from);
        let first = [0, 1].map(|k| ([column, row][k] - 1).clamp(0, (counts[k] - 2).max(0)));
        if !self.is_free(first.map(|k| k + 1)) {
            return None;
        }
        let weights = [0, 1].map(|k| match counts[k] {
            1 => [Weights { value: 1.0, slope: 0.0 }; 2],
            _ => hermite(index[k] - first[k] as f64),
        });
        let mut sum = 0.0;
        for (dj, of_row) in weights[1].iter().enumerate().take(counts[1].min(2) as usize) {
            for (di, of_column) in weights[0].iter().enumerate().take(counts[0].min(2) as usize) {
                let point = [first[0] + di as i64, first[1] + dj as i64];
                let Slopes { along, twist } =
                    self.slopes[(point[1] * counts[0] + point[0]) as usize];
                sum += of_row.value
                    * (of_column.value * self.value(point)? + of_column.slope * along[0])
                    + of_row.slope * (of_column.value * along[1] + of_column.slope * twist);
            }
        }
        Some(sum)
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
                let slopes =
                    self.slopes[(corner[1] * i64::from(self.plane.counts[0]) + corner[0]) as usize];
                let weight = near(off[0], reach) * near(off[1], reach);
                sum += weight * (value + off[0] * slopes.along[0] + off[1] * slopes.along[1]);
                weights += weight;
            }
            (weights > 0.0).then(|| sum / weights)
        })
    }

    /// The slope at a point along an axis, from what is open around it.
    fn slope_at(&self, point: [i64; 2], axis: usize) -> f64 {
        let mut before = point;
        before[axis] -= 1;
        either(self.step(before, axis), self.step(point, axis))
    }
}

/// What a corner so far off counts, one at it and nearly nothing `reach` cells away; a corner seen alone counts however far it is.
fn near(off: f64, reach: i64) -> f64 {
    let t = (off.abs() / reach as f64).min(1.0);
    (1.0 - t * t * (3.0 - 2.0 * t)).max(1e-6)
}

/// What the value and the slope of a point count at a place between two.
#[derive(Clone, Copy, Debug)]
struct Weights {
    value: f64,
    slope: f64,
}

/// The weights of the first and the second of two points, so far on from the first to the second: cubics between them, and straight on
/// beyond either.
fn hermite(t: f64) -> [Weights; 2] {
    let weights = |value, slope| Weights { value, slope };
    match t {
        t if t < 0.0 => [weights(1.0, t), weights(0.0, 0.0)],
        t if t > 1.0 => [weights(0.0, 0.0), weights(1.0, t - 1.0)],
        t => {
            let (t2, t3) = (t * t, t * t * t);
            let second = 3.0 * t2 - 2.0 * t3;
            [weights(1.0 - second, t3 - 2.0 * t2 + t), weights(second, t3 - t2)]
        }
    }
}

/// The slope from the steps before and after a point, of which either may be unknown.
fn either(before: Step, after: Step) -> f64 {
    match (before, after) {
        (Some(a), Some(b)) => slope(a, b),
        (one, other) => one.or(other).unwrap_or(0.0),
    }
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
            requirements: Vec::new(),
            emergency: None,
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
