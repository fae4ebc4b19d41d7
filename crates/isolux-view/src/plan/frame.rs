//! From the scene to the plane of a grid, and from there to the sheet.

use crate::drawing::At;
use isolux::geometry::{Point, Vector};
use isolux::scene::CalculationGrid;

/// A place on the plane of a grid: metres along its sides from its corner.
pub(super) type Place = [f64; 2];

/// The plane of a grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    corner: Point,
    sides: [Vector; 2],
    normal: Vector,
    /// Lengths of the whole sides, m.
    pub(super) lengths_m: [f64; 2],
    /// The band along the sides that has no points, m.
    pub(super) border_m: f64,
    /// Points along the sides.
    pub(super) counts: [u32; 2],
}

impl Plane {
    /// `None` of a grid that has no area.
    pub(super) fn of(grid: &CalculationGrid) -> Option<Self> {
        let lengths_m = [grid.u.length(), grid.v.length()];
        Some(Self {
            corner: grid.corner,
            sides: [grid.u / lengths_m[0], grid.v / lengths_m[1]],
            normal: grid.normal()?.to_vector(),
            lengths_m,
            border_m: grid.border_m,
            counts: grid.counts(),
        })
    }

    /// The foot of a point.
    pub(super) fn foot(&self, point: Point) -> Place {
        self.sides.map(|side| (point - self.corner).dot(side))
    }

    /// How far a point lies before the plane, on the side that its points face, m.
    pub(super) fn height_m(&self, point: Point) -> f64 {
        (point - self.corner).dot(self.normal)
    }

    /// The foot of a direction.
    pub(super) fn along(&self, vector: Vector) -> [f64; 2] {
        self.sides.map(|side| vector.dot(side))
    }

    /// What of a direction goes the way of the normal.
    pub(super) fn facing(&self, vector: Vector) -> f64 {
        vector.dot(self.normal)
    }

    /// The point of the scene at a place, so far before the plane.
    pub(super) fn point(&self, [s, t]: Place, height_m: f64) -> Point {
        self.corner + self.sides[0] * s + self.sides[1] * t + self.normal * height_m
    }

    /// Distances of points along the sides, m.
    pub(super) fn cells_m(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.lengths_m[k] - 2.0 * self.border_m) / f64::from(self.counts[k]))
    }

    /// Where a point of the grid lies, counted along both sides; between them for fractions.
    pub(super) fn at_index(&self, index: [f64; 2]) -> Place {
        let cells_m = self.cells_m();
        [0, 1].map(|k| self.border_m + (index[k] + 0.5) * cells_m[k])
    }

    /// The same the other way.
    pub(super) fn index_at(&self, place: Place) -> [f64; 2] {
        let cells_m = self.cells_m();
        [0, 1].map(|k| (place[k] - self.border_m) / cells_m[k] - 0.5)
    }

    /// The axis of the scene that a side runs along, the coordinate at its start and its sense; `None` for a side askew.
    pub(super) fn axis_along(&self, side: usize) -> Option<(char, f64, f64)> {
        /// Directions that differ by less are one but for rounding.
        const ROUNDING: f64 = 1e-9;
        let (along, start) = (<[f64; 3]>::from(self.sides[side]), <[f64; 3]>::from(self.corner));
        let axis = (0..3).find(|&axis| along[axis].abs() > 1.0 - ROUNDING)?;
        Some((['x', 'y', 'z'][axis], start[axis], along[axis].signum()))
    }
}

/// The part of a plane that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) low: Place,
    pub(super) high: Place,
}

impl Window {
    /// Around a grid, and as far as the nearest pieces on each side that are no farther from it than `reach_m`.
    pub(super) fn around(plane: &Plane, reach_m: f64, pieces: &[[Place; 2]]) -> Self {
        let grid = Self { low: [0.0; 2], high: plane.lengths_m };
        let reach = Self {
            low: grid.low.map(|low| low - reach_m),
            high: grid.high.map(|high| high + reach_m),
        };
        let mut window = grid;
        for [a, b] in pieces.iter().filter_map(|piece| reach.clipped(*piece)) {
            for k in 0..2 {
                // A piece along the grid lies beside it on one axis alone.
                window.low[k] = window.low[k].min(a[k].max(b[k]));
                window.high[k] = window.high[k].max(a[k].min(b[k]));
            }
        }
        window
    }

    /// Lengths of its sides, m.
    pub(super) fn sides_m(&self) -> [f64; 2] {
        [0, 1].map(|k| self.high[k] - self.low[k])
    }

    pub(super) fn holds(&self, place: Place) -> bool {
        (0..2).all(|k| (self.low[k]..=self.high[k]).contains(&place[k]))
    }

    /// The part of a segment that lies inside (Liang and Barsky 1984).
    pub(super) fn clipped(&self, [a, b]: [Place; 2]) -> Option<[Place; 2]> {
        let along = [b[0] - a[0], b[1] - a[1]];
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for k in 0..2 {
            for (towards, room) in
                [(-along[k], a[k] - self.low[k]), (along[k], self.high[k] - a[k])]
            {
                if towards == 0.0 && room < 0.0 {
                    return None;
                }
                let share = room / towards;
                match towards {
                    t if t < 0.0 => from = from.max(share),
                    t if t > 0.0 => to = to.min(share),
                    _ => {}
                }
            }
        }
        let at = |share: f64| [0, 1].map(|k| a[k] + share * along[k]);
        (from <= to).then(|| [at(from), at(to)])
    }

    /// The part of a ring that lies inside, by one side after another (Sutherland and Hodgman 1974).
    pub(super) fn clipped_ring(&self, ring: &[Place]) -> Vec<Place> {
        let mut kept = ring.to_vec();
        for (axis, bound, sign) in [
            (0, self.low[0], 1.0),
            (0, self.high[0], -1.0),
            (1, self.low[1], 1.0),
            (1, self.high[1], -1.0),
        ] {
            let room = |place: &Place| sign * (place[axis] - bound);
            let next = kept.iter().cycle().skip(1);
            let mut inside = Vec::with_capacity(kept.len() + 2);
            for (a, b) in kept.iter().zip(next) {
                let (of_a, of_b) = (room(a), room(b));
                if of_a >= 0.0 {
                    inside.push(*a);
                }
                if (of_a >= 0.0) != (of_b >= 0.0) {
                    let share = of_a / (of_a - of_b);
                    inside.push([0, 1].map(|k| a[k] + share * (b[k] - a[k])));
                }
            }
            kept = inside;
        }
        kept
    }
}

/// Where a window lies on the sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) window: Window,
    /// Pixels a metre.
    pub(super) scale: f64,
    /// The upper left corner.
    pub(super) corner: At,
}

impl Frame {
    pub(super) fn at(&self, [s, t]: Place) -> At {
        [
            self.corner[0] + (s - self.window.low[0]) * self.scale,
            self.corner[1] + (self.window.high[1] - t) * self.scale,
        ]
    }

    pub(super) fn place(&self, [x, y]: At) -> Place {
        [
            self.window.low[0] + (x - self.corner[0]) / self.scale,
            self.window.high[1] - (y - self.corner[1]) / self.scale,
        ]
    }

    /// Width and height, pixels.
    pub(super) fn size(&self) -> [f64; 2] {
        self.window.sides_m().map(|side_m| side_m * self.scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Window = Window { low: [0.0, 0.0], high: [4.0, 2.0] };

    #[test]
    fn segments_end_at_the_window() {
        for (segment, inside) in [
            ([[1.0, 1.0], [3.0, 1.0]], Some([[1.0, 1.0], [3.0, 1.0]])),
            ([[-1.0, 1.0], [5.0, 1.0]], Some([[0.0, 1.0], [4.0, 1.0]])),
            ([[2.0, -2.0], [2.0, 1.0]], Some([[2.0, 0.0], [2.0, 1.0]])),
            ([[-2.0, 1.0], [-1.0, 1.0]], None),
            ([[0.0, 5.0], [4.0, 5.0]], None),
        ] {
            assert_eq!(WINDOW.clipped(segment), inside, "{segment:?}");
        }
    }

    #[test]
    fn rings_end_at_the_window() {
        let ring = [[2.0, 1.0], [6.0, 1.0], [6.0, 5.0], [2.0, 5.0]];
        assert_eq!(WINDOW.clipped_ring(&ring), [[2.0, 1.0], [4.0, 1.0], [4.0, 2.0], [2.0, 2.0]]);
        assert!(WINDOW.clipped_ring(&[[5.0, 3.0], [6.0, 3.0], [6.0, 4.0]]).is_empty());
    }

    #[test]
    fn a_window_reaches_only_so_far_from_the_grid() {
        let grid = CalculationGrid {
            name: String::new(),
            corner: Point::new(1.0, 1.0, 0.75),
            u: Vector::new(0.0, 2.0, 0.0),
            v: Vector::new(-1.0, 0.0, 0.0),
            spacing_m: Some(0.5),
            border_m: 0.0,
            maintenance_factor: 1.0,
            requirements: Vec::new(),
            emergency: None,
        };
        let plane = Plane::of(&grid).unwrap();
        // A wall on the left, one askew above, one too far below.
        let walls =
            [[[-0.2, -9.0], [-0.2, 9.0]], [[0.0, 1.3], [2.0, 1.4]], [[0.0, -0.6], [2.0, -0.6]]];
        let window = Window::around(&plane, 0.5, &walls);
        assert_eq!((window.low, window.high), ([-0.2, 0.0], [2.0, 1.3]));
        assert_eq!(plane.axis_along(0), Some(('y', 1.0, 1.0)));
        assert_eq!(plane.axis_along(1), Some(('x', 1.0, -1.0)));
        assert_eq!(plane.foot(Point::new(0.5, 2.0, 7.0)), [1.0, 0.5]);
        assert_eq!(plane.index_at(plane.at_index([1.25, 0.5])), [1.25, 0.5]);
    }
}
