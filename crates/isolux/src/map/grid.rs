//! What is known of the illuminance on a calculation grid.

use super::Illuminance;
use super::figure::{Figure, NORMAL_95};
use crate::scene::CalculationGrid;

/// The figures of EN 12464-1 for a grid: maintained illuminance, lx, and uniformities. Points without a
/// value, as those within furniture, are left out.
///
/// Errors of neighbouring points have much in common, of which a map does not tell how much: intervals are as if all erred
/// together, which is the widest they can be for the mean. The least and the greatest value are
/// those of the points, with all that each may err by: of many points with noise the
/// least is too low rather than too high.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridFigures {
    /// Points with a value.
    pub known: usize,
    /// Mean, lx.
    pub mean_lx: Figure,
    /// Least, lx.
    pub least_lx: Figure,
    /// Greatest, lx.
    pub greatest_lx: Figure,
    /// Uniformity, the least over the mean.
    pub uniformity: Figure,
    /// Diversity, the least over the greatest.
    pub diversity: Figure,
    /// Means of direct and of indirect light, lx.
    pub direct_lx: f64,
    /// See `direct_lx`.
    pub indirect_lx: f64,
}

impl GridFigures {
    /// Of the initial light at the points of a grid; `None` if nothing is known at any.
    pub fn of(grid: &CalculationGrid, values: &[Option<Illuminance>]) -> Option<Self> {
        let factor = grid.maintenance_factor;
        let known: Vec<&Illuminance> = values.iter().flatten().collect();
        let count = known.len() as f64;
        let mean = |read: &dyn Fn(&Illuminance) -> f64| {
            known.iter().map(|v| factor * read(v)).sum::<f64>() / count
        };
        let lower =
            |v: &Illuminance| (v.illuminance_lx() - NORMAL_95 * v.standard_error_lx).max(0.0);
        let upper = |v: &Illuminance| v.illuminance_lx() + NORMAL_95 * v.standard_error_lx;
        let outermost = |pick: fn(f64, f64) -> f64| -> Option<Figure> {
            let of = |read: &dyn Fn(&Illuminance) -> f64| {
                known.iter().map(|v| factor * read(v)).reduce(pick)
            };
            Some(Figure {
                value: of(&Illuminance::illuminance_lx)?,
                low: of(&lower)?,
                high: of(&upper)?,
            })
        };
        let (least_lx, greatest_lx) = (outermost(f64::min)?, outermost(f64::max)?);
        let mean_lx = Figure {
            value: mean(&Illuminance::illuminance_lx),
            low: mean(&lower),
            high: mean(&upper),
        };
        Some(Self {
            known: known.len(),
            mean_lx,
            least_lx,
            greatest_lx,
            uniformity: ratio(least_lx, mean_lx),
            diversity: ratio(least_lx, greatest_lx),
            direct_lx: mean(&|v| v.direct_lx.luminance()),
            indirect_lx: mean(&|v| v.indirect_lx.luminance()),
        })
    }
}

/// One over the other; at most one, as both are of the same points.
fn ratio(of: Figure, to: Figure) -> Figure {
    let share = |a: f64, b: f64, of_none: f64| if b > 0.0 { (a / b).min(1.0) } else { of_none };
    // What may be nought may be any part of what may be nought, too.
    let most = if of.high > 0.0 { 1.0 } else { 0.0 };
    Figure {
        value: share(of.value, to.value, 0.0),
        low: share(of.low, to.high, 0.0),
        high: share(of.high, to.low, most),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Standing;
    use crate::units::Rgb;
    use isolux_geometry::{Point, Vector};

    fn value(lx: f64, error_lx: f64) -> Option<Illuminance> {
        Some(Illuminance {
            direct_lx: Rgb::grey(0.75 * lx),
            caustic_lx: Rgb::BLACK,
            indirect_lx: Rgb::grey(0.25 * lx),
            standard_error_lx: error_lx,
            indirect_standard_error_lx: error_lx,
            common_error_lx: 0.0,
            interpolation_error_lx: 0.0,
            bias_lx: 0.0,
            standing: Standing::Open,
            samples: 1,
        })
    }

    fn grid(maintenance_factor: f64) -> CalculationGrid {
        CalculationGrid {
            name: "desk".into(),
            corner: Point::new(0.0, 0.0, 0.0),
            u: Vector::new(1.0, 0.0, 0.0),
            v: Vector::new(0.0, 1.0, 0.0),
            spacing_m: None,
            border_m: 0.0,
            maintenance_factor,
            requirements: Vec::new(),
            emergency: None,
        }
    }

    #[test]
    fn figures_by_hand() {
        let values = [value(400.0, 10.0), None, value(600.0, 0.0), value(500.0, 5.0)];
        let found = GridFigures::of(&grid(0.8), &values).unwrap();
        assert_eq!(found.known, 3);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(near(found.mean_lx.value, 400.0) && near(found.least_lx.value, 320.0));
        assert!(near(found.mean_lx.high - found.mean_lx.value, 0.8 * 1.96 * 5.0));
        assert!(near(found.least_lx.low, 0.8 * (400.0 - 19.6)));
        assert!(near(found.greatest_lx.value, 480.0) && near(found.greatest_lx.high, 480.0));
        assert!(near(found.uniformity.value, 0.8) && near(found.diversity.value, 400.0 / 600.0));
        assert!(found.uniformity.low < 0.8 && found.uniformity.high > 0.8);
        assert!(near(found.direct_lx, 300.0) && near(found.indirect_lx, 100.0));
    }

    #[test]
    fn nothing_is_said_of_nothing() {
        assert_eq!(GridFigures::of(&grid(1.0), &[None, None]), None);
    }

    #[test]
    fn darkness_has_no_uniformity() {
        let found = GridFigures::of(&grid(1.0), &[value(0.0, 0.0)]).unwrap();
        assert_eq!(found.uniformity, Figure { value: 0.0, low: 0.0, high: 0.0 });
        let unsure = GridFigures::of(&grid(1.0), &[value(400.0, f64::INFINITY)]).unwrap();
        assert_eq!(unsure.uniformity, Figure { value: 1.0, low: 0.0, high: 1.0 });
    }
}
