//! Where the standard looks at illuminance.

use crate::shown::name;
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::scene::CalculationGrid;

/// The band along the sides of an open area that does not count, m (4.3.1).
pub(super) const OUTER_M: f64 = 0.5;
/// The greatest width of an escape route, m; wider ones are strips of that, or open areas (4.2.1).
const WIDEST_M: f64 = 2.0;
/// Lengths up to rounding, m.
const ROUNDING_M: f64 = 1e-6;
/// The distance of points along a route, m. Luminaires hang higher than that, so little changes between.
const ALONG_M: f64 = 0.5;
/// Across the middle half, in widths of the route from its centre line.
const ACROSS: [f64; 5] = [-0.25, -0.125, 0.0, 0.125, 0.25];

/// An escape route.
pub(super) struct Strip {
    /// Along its centre line.
    pub(super) centre: Vec<ProbePoint>,
    /// Of its middle half, with both borders of that.
    pub(super) middle: Vec<ProbePoint>,
}

impl Strip {
    /// The longer side of a grid is along the route.
    pub(super) fn of(grid: &CalculationGrid) -> Result<Self, String> {
        let is_along_u = grid.u.length() >= grid.v.length();
        let (along, across) = if is_along_u { (grid.u, grid.v) } else { (grid.v, grid.u) };
        let wide_m = across.length();
        if wide_m > WIDEST_M + ROUNDING_M {
            return Err(format!(
                "emergency lighting: grid `{}` is {wide_m} m wide, and an escape route is at most 2 m; divide it into strips, or make it an \
                 open area",
                name(&grid.name)
            ));
        }
        let spacing_m = grid.spacing_m.unwrap_or(ALONG_M);
        let count = (along.length() / spacing_m).ceil().max(1.0) as u32;
        let line = |share: f64| {
            let from = grid.corner + across * (0.5 + share);
            // With both ends.
            (0..=count).map(move |k| from + along * (f64::from(k) / f64::from(count)))
        };
        let faced = |points: Vec<Point>| facing(grid, points);
        let middle = ACROSS.into_iter().flat_map(line).collect();
        Ok(Self { centre: faced(line(0.0).collect()), middle: faced(middle) })
    }
}

/// The points of an open area without its outer band.
pub(super) fn open_area(grid: &CalculationGrid) -> Result<Vec<ProbePoint>, String> {
    let grid = CalculationGrid { border_m: grid.border_m.max(OUTER_M), ..grid.clone() };
    match grid.problem() {
        None => Ok(all(&grid)),
        Some((what, _)) => Err(format!(
            "emergency lighting: grid `{}` {what} without its outer half metre; take a larger one, or make it an escape route",
            name(&grid.name)
        )),
    }
}

/// The points of a grid.
pub(super) fn all(grid: &CalculationGrid) -> Vec<ProbePoint> {
    facing(grid, grid.points())
}

fn facing(grid: &CalculationGrid, points: Vec<Point>) -> Vec<ProbePoint> {
    // Grids without a normal are refused when they are read.
    let normal = grid.normal().or_else(|| Vector::new(0.0, 0.0, 1.0).normal());
    let at = |position| Some(ProbePoint { position, normal: normal? });
    points.into_iter().filter_map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn route(u: [f64; 3], v: [f64; 3]) -> CalculationGrid {
        CalculationGrid {
            name: "route".into(),
            corner: Point::new(1.0, 2.0, 0.0),
            u: Vector::from(u),
            v: Vector::from(v),
            spacing_m: None,
            border_m: 0.0,
            maintenance_factor: 1.0,
            requirements: Vec::new(),
            emergency: None,
        }
    }

    #[test]
    fn routes_run_along_their_longer_side() {
        for (grid, middle) in [
            (route([10.0, 0.0, 0.0], [0.0, 2.0, 0.0]), |k: f64| Point::new(1.0 + k, 3.0, 0.0)),
            (route([2.0, 0.0, 0.0], [0.0, 10.0, 0.0]), |k: f64| Point::new(2.0, 2.0 + k, 0.0)),
        ] as [(CalculationGrid, fn(f64) -> Point); 2]
        {
            let strip = Strip::of(&grid).unwrap();
            assert_eq!((strip.centre.len(), strip.middle.len()), (21, 105));
            for (at, k) in strip.centre.iter().zip(0..) {
                assert!((at.position - middle(0.5 * f64::from(k))).length() < 1e-12, "{at:?}");
            }
            let off = |at: &ProbePoint| {
                let nearest = strip.centre.iter().map(|c| (c.position - at.position).length());
                nearest.fold(f64::INFINITY, f64::min)
            };
            let widest = strip.middle.iter().map(off).fold(0.0, f64::max);
            assert!((widest - 0.5).abs() < 1e-12, "a quarter of 2 m: {widest}");
        }
        assert!(Strip::of(&route([10.0, 0.0, 0.0], [0.0, 2.1, 0.0])).is_err());
        let coarse =
            CalculationGrid { spacing_m: Some(5.0), ..route([10.0, 0.0, 0.0], [0.0, 1.0, 0.0]) };
        assert_eq!(Strip::of(&coarse).unwrap().centre.len(), 3);
    }

    #[test]
    fn open_areas_lack_their_outer_half_metre() {
        let all = open_area(&route([4.0, 0.0, 0.0], [0.0, 4.0, 0.0])).unwrap();
        let is_inside = |at: &ProbePoint| at.position.x > 1.5 && at.position.x < 4.5;
        assert!(all.iter().all(is_inside) && !all.is_empty());
        assert!(open_area(&route([4.0, 0.0, 0.0], [0.0, 1.0, 0.0])).is_err());
    }
}
