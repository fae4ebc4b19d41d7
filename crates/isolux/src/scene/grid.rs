//! Calculation grids: points at which a lighting designer asks for illuminance.

use super::requirement::{EmergencyArea, Requirement};
use isolux_geometry::{Normal, Point, Vector};
use serde::{Deserialize, Serialize};

/// Points that a grid has at most along either side.
const MOST_POINTS: f64 = 4096.0;

/// A rectangle of points in the middles of equal cells, that face the way of `u` cross `v`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CalculationGrid {
    /// Name, as written in the scene.
    pub name: String,
    /// A corner of the rectangle.
    pub corner: Point,
    /// One of its sides, m.
    pub u: Vector,
    /// The other, at right angles to it, m.
    pub v: Vector,
    /// Distance of points, m; `None` for that of EN 12464-1.
    pub spacing_m: Option<f64>,
    /// Width of the band along the sides that is left out, m.
    pub border_m: f64,
    /// The share of the initial light that is left when the installation is maintained; values of the
    /// grid are maintained illuminance.
    pub maintenance_factor: f64,
    /// What has to hold on it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub requirements: Vec<Requirement>,
    /// What it is an area of, if it is one of emergency lighting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub emergency: Option<EmergencyArea>,
}

impl CalculationGrid {
    /// The greatest spacing of points that EN 12464-1 allows on an area of such sides, m:
    /// `0.2 * 5^(log10 d)`, at most 10, where `d` is the longer side, or the shorter one if the longer
    /// is at least twice as long.
    pub fn standard_spacing_m(sides_m: [f64; 2]) -> f64 {
        let [short, long] = [sides_m[0].min(sides_m[1]), sides_m[0].max(sides_m[1])];
        let d = if long >= 2.0 * short { short } else { long };
        (0.2 * libm::pow(5.0, libm::log10(d))).min(10.0)
    }

    /// The border that is usually left out of an area of such sides, m: half a metre, or 15 % of the
    /// shorter side where that is less.
    pub fn usual_border_m(sides_m: [f64; 2]) -> f64 {
        (0.15 * sides_m[0].min(sides_m[1])).min(0.5)
    }

    /// Lengths of the sides without the border, m.
    pub fn sides_m(&self) -> [f64; 2] {
        [self.u, self.v].map(|side| side.length() - 2.0 * self.border_m)
    }

    /// Numbers of points along the two sides: of the side that decides, its length over the spacing
    /// to the nearest whole number; of the other so many that cells are as square as can be.
    pub fn counts(&self) -> [u32; 2] {
        let sides_m = self.sides_m();
        let spacing_m = self.spacing_m.unwrap_or_else(|| Self::standard_spacing_m(sides_m));
        let [short, long] = if sides_m[0] <= sides_m[1] { [0, 1] } else { [1, 0] };
        let leads = if sides_m[long] >= 2.0 * sides_m[short] { short } else { long };
        let whole = |count: f64| libm::round(count).clamp(1.0, MOST_POINTS);
        let mut counts = [1.0; 2];
        counts[leads] = whole(sides_m[leads] / spacing_m);
        let cell_m = sides_m[leads] / counts[leads];
        counts[1 - leads] = whole(sides_m[1 - leads] / cell_m);
        counts.map(|count| count as u32)
    }

    /// The points, along `u` first.
    pub fn points(&self) -> Vec<Point> {
        let [across, along] = self.counts();
        let at = |side: Vector, k: u32, count: u32| {
            let share = (f64::from(k) + 0.5) / f64::from(count);
            let length_m = side.length();
            side * ((self.border_m + share * (length_m - 2.0 * self.border_m)) / length_m)
        };
        let row = |j: u32| {
            (0..across).map(move |i| self.corner + at(self.u, i, across) + at(self.v, j, along))
        };
        (0..along).flat_map(row).collect()
    }

    /// The way the points face; `None` if the sides are parallel.
    pub fn normal(&self) -> Option<Normal> {
        self.u.cross(self.v).normal()
    }

    /// What is wrong with it and how to mend that, if anything.
    pub fn problem(&self) -> Option<(String, &'static str)> {
        let numbers = [self.border_m, self.maintenance_factor, self.spacing_m.unwrap_or(1.0)];
        let vectors = [self.u, self.v].iter().all(|side| side.length().is_finite());
        if !(self.corner.is_finite() && vectors && numbers.iter().all(|n| n.is_finite())) {
            return Some(("is not finite".into(), "give it numbers in metres"));
        }
        let (u_m, v_m) = (self.u.length(), self.v.length());
        if let Some((name, _)) = [("u", u_m), ("v", v_m)].iter().find(|(_, m)| *m == 0.0) {
            let what = format!("has a side `{name}` without length");
            return Some((what, "give both sides a direction and a length in metres"));
        }
        if self.normal().is_none() || self.u.dot(self.v).abs() > 1e-6 * u_m * v_m {
            return Some((
                "has sides that are not at right angles".into(),
                "give `u` and `v` so that they meet at 90 degrees",
            ));
        }
        if self.border_m < 0.0 {
            let what = format!("has a border of {} m", self.border_m);
            return Some((what, "give 0 or more"));
        }
        if self.sides_m().iter().any(|&side_m| side_m <= 0.0) {
            let what = format!("leaves nothing within a border of {} m", self.border_m);
            return Some((what, "make the border narrower than half the shorter side"));
        }
        if !(self.maintenance_factor > 0.0 && self.maintenance_factor <= 1.0) {
            let what = format!("has a maintenance factor of {}", self.maintenance_factor);
            return Some((what, "give a share above 0 and up to 1"));
        }
        let longest_m = u_m.max(v_m);
        let spacing_m = self.spacing_m.unwrap_or(longest_m);
        if spacing_m <= 0.0 {
            let what = format!("has a spacing of {spacing_m} m");
            return Some((what, "give the distance of points in metres, above zero"));
        }
        if longest_m / spacing_m > MOST_POINTS {
            let what = format!("has points every {spacing_m} m along {longest_m} m");
            return Some((what, "choose a spacing of at least a 4096th of the longer side"));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floor(width_m: f64, length_m: f64) -> CalculationGrid {
        CalculationGrid {
            name: "floor".into(),
            corner: Point::new(1.0, 2.0, 0.75),
            u: Vector::new(width_m, 0.0, 0.0),
            v: Vector::new(0.0, length_m, 0.0),
            spacing_m: None,
            border_m: 0.0,
            maintenance_factor: 0.8,
            requirements: Vec::new(),
            emergency: None,
        }
    }

    #[test]
    fn spacings_are_those_of_the_table_of_the_standard() {
        // EN 12464-1, table A.1: length, spacing, number of points; its spacings are rounded.
        for (length_m, spacing_m, points) in
            [(1.0, 0.2, 5), (2.0, 0.3, 6), (5.0, 0.6, 8), (10.0, 1.0, 10)]
        {
            let found = CalculationGrid::standard_spacing_m([length_m, length_m]);
            assert!((found - spacing_m).abs() < 0.05 + 1e-9, "{length_m} m: {found}");
            assert_eq!(floor(length_m, length_m).counts(), [points; 2]);
        }
        assert_eq!(CalculationGrid::standard_spacing_m([1e4, 1e4]), 10.0);
    }

    #[test]
    fn long_areas_take_the_spacing_of_their_shorter_side() {
        let grid = floor(2.0, 12.0);
        // 0.2 * 5^log10(2) = 0.325 m: six cells of a third of a metre, and 36 along.
        assert_eq!(grid.counts(), [6, 36]);
    }

    #[test]
    fn points_lie_in_the_middles_of_cells() {
        let grid = CalculationGrid { spacing_m: Some(1.0), border_m: 0.5, ..floor(5.0, 3.0) };
        let points = grid.points();
        assert_eq!(grid.counts(), [4, 2]);
        assert_eq!(points[0], Point::new(2.0, 3.0, 0.75));
        assert_eq!(points[7], Point::new(5.0, 4.0, 0.75));
        assert_eq!(grid.normal().unwrap().to_vector(), Vector::new(0.0, 0.0, 1.0));
    }

    #[test]
    fn what_is_no_grid_is_told() {
        let good = floor(5.0, 3.0);
        assert_eq!(good.problem(), None);
        let bad = [
            CalculationGrid { v: Vector::new(3.0, 1.0, 0.0), ..good.clone() },
            CalculationGrid { border_m: 1.5, ..good.clone() },
            CalculationGrid { maintenance_factor: 1.5, ..good.clone() },
            CalculationGrid { spacing_m: Some(1e-9), ..good.clone() },
            CalculationGrid { corner: Point::new(f64::NAN, 0.0, 0.0), ..good.clone() },
            CalculationGrid { u: Vector::new(0.0, 0.0, 0.0), ..good },
        ];
        for grid in bad {
            assert!(grid.problem().is_some(), "{grid:?}");
        }
    }
}
