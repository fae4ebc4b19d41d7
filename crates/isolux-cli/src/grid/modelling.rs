//! Modelling: cylindrical over horizontal illuminance at the same point (EN 12464-1:2021, 4.6).

use crate::grid_values::GridValues;
use isolux::map::{Figure, Illuminance, NORMAL_95};
use isolux::units::to_error;
use serde::Serialize;

/// Between these the standard calls modelling good where luminaires are spread evenly.
const GOOD: [f64; 2] = [0.3, 0.6];

/// Modelling at the points of a grid. Maintenance factors cancel.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Modelling {
    /// Over all points that have it. Intervals are as wide as if all points erred together.
    pub(super) mean: Option<Figure>,
    pub(super) least: Option<Figure>,
    pub(super) greatest: Option<Figure>,
    pub(super) values: Vec<Point>,
}

/// Modelling at a point; nothing where either illuminance is not known, or nothing falls on the horizontal plane.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Point {
    pub(super) modelling: Option<f64>,
    pub(super) standard_error: Option<f64>,
    pub(super) horizontal_lx: Option<f64>,
}

impl Modelling {
    pub(super) fn of(cylindrical: &GridValues, horizontal: &GridValues) -> Self {
        let pairs = cylindrical.values.iter().zip(&horizontal.values);
        let factor = cylindrical.grid.maintenance_factor;
        Self::over(pairs.map(|(ez, eh)| Point::of(ez.as_ref(), eh.as_ref(), factor)).collect())
    }

    fn over(values: Vec<Point>) -> Self {
        let known: Vec<Figure> = values.iter().filter_map(Point::interval).collect();
        let over = |of: &dyn Fn(&mut dyn Iterator<Item = f64>) -> Option<f64>| {
            let [value, low, high] =
                [|of: &Figure| of.value, |of: &Figure| of.low, |of: &Figure| of.high]
                    .map(|end: fn(&Figure) -> f64| of(&mut known.iter().map(end)));
            Some(Figure { value: value?, low: low?, high: high? })
        };
        let count = known.len() as f64;
        let mean = over(&|all| Some(all.sum::<f64>() / count));
        Self {
            mean: mean.filter(|_| !known.is_empty()),
            least: over(&|all| all.reduce(f64::min)),
            greatest: over(&|all| all.reduce(f64::max)),
            values,
        }
    }

    /// The words for it.
    pub(super) fn text(&self) -> String {
        let written = |of: Option<Figure>| of.map_or_else(|| "-".to_owned(), with_ends);
        let [mean, least, greatest] = [self.mean, self.least, self.greatest].map(written);
        format!("modelling Ez/Eh {mean}, least {least}, greatest {greatest}")
    }

    /// How many points lie in the range that the standard calls good, of how many.
    pub(super) fn good(&self) -> [usize; 2] {
        let known = || self.values.iter().filter_map(|point| point.modelling);
        let is_good = |value: &f64| (GOOD[0]..=GOOD[1]).contains(value);
        [known().filter(is_good).count(), known().count()]
    }
}

impl Point {
    /// Errors of both readings are taken to be independent. Those of one map are shared in part, which the ratio has less of.
    fn of(ez: Option<&Illuminance>, eh: Option<&Illuminance>, factor: f64) -> Self {
        let horizontal_lx = eh.map(|eh| factor * eh.illuminance_lx());
        let both = ez.zip(eh).filter(|(_, eh)| eh.illuminance_lx() > 0.0);
        let ratio = both.map(|(ez, eh)| {
            let (z, h) = (ez.illuminance_lx(), eh.illuminance_lx());
            let value = z / h;
            (value, libm::hypot(ez.standard_error_lx, value * eh.standard_error_lx) / h)
        });
        let (modelling, standard_error) = ratio.unzip();
        Self { modelling, standard_error, horizontal_lx }
    }

    fn interval(&self) -> Option<Figure> {
        let (value, error) = self.modelling.zip(self.standard_error)?;
        let half = NORMAL_95 * error;
        Some(Figure { value, low: (value - half).max(0.0), high: value + half })
    }
}

fn with_ends(Figure { value, low, high }: Figure) -> String {
    // Two digits behind the point, as the standard writes its range.
    let written = |number: f64| to_error(number, (0.5 * (high - low)).max(0.02));
    let [value, low, high] = [value, low, high].map(written);
    if low == value && high == value { value } else { format!("{value} ({low} to {high})") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::units::Rgb;

    fn reading(lx: f64, standard_error_lx: f64) -> Illuminance {
        Illuminance { direct_lx: Rgb::grey(lx), standard_error_lx, ..Illuminance::NOTHING }
    }

    #[test]
    fn ratios_by_hand() {
        let point = Point::of(Some(&reading(120.0, 3.0)), Some(&reading(300.0, 10.0)), 0.8);
        assert!((point.modelling.unwrap() - 0.4).abs() < 1e-12);
        // 2.5 % and 3.3 % together: 4.17 % of 0.4.
        assert!((point.standard_error.unwrap() - 5.0 / 300.0).abs() < 1e-12, "{point:?}");
        assert!((point.horizontal_lx.unwrap() - 240.0).abs() < 1e-9);
        let dark = Point::of(Some(&reading(5.0, 1.0)), Some(&reading(0.0, 0.0)), 1.0);
        assert_eq!((dark.modelling, dark.horizontal_lx), (None, Some(0.0)));
        let bright = Point::of(Some(&reading(300.0, 0.0)), Some(&reading(300.0, 0.0)), 1.0);
        let all = Modelling::over(vec![point, dark, bright]);
        assert!((all.mean.unwrap().value - 0.7).abs() < 1e-12 && all.good() == [1, 2], "{all:?}");
        assert_eq!((all.least.unwrap().value, all.greatest.unwrap().value), (0.4, 1.0));
        assert!(Modelling::over(vec![dark]).mean.is_none());
    }
}
