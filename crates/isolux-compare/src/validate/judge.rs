//! Readings against expectations, and what chance allows.
//!
//! A reading may be off by three standard errors, the bound of the case (triangles for a sphere),
//! rounding of positions, and, for indirect light, a multiple of the discretization and bias that the
//! map reports of itself. With `n` replicates the error over its estimate follows Student's
//! distribution with `n - 1` degrees of freedom, so the number of outliers among independent
//! readings is binomial, and so many are accepted as chance exceeds only once in ten thousand rows.
//! Readings of one map share part of their noise; that spreads their number, which is why calibration
//! is judged over many seeds.

use super::ValidateRow;
use crate::expectation::{Expectation, Quantity};
use crate::statistics::{accepted_outliers, student_quantile, student_two_sided};
use crate::tolerance::{
    COVERAGE, PLACE_OVER_SCENE, RAY_KERNEL_POSITION, ROUNDING, SIGNIFICANCE, STANDARD_ERRORS,
};
use isolux::engine::MapReader;
use isolux::map::{Illuminance, IlluminationMap, Method};
use isolux::scene::Scene;
use isolux::units::Rgb;
use serde::Serialize;

/// A reading beside what it should be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// Where, m.
    pub position: [f64; 3],
    /// Which part of the light.
    pub quantity: Quantity,
    /// What it should be, lx.
    pub expected_lx: f64,
    /// What it is, lx.
    pub measured_lx: f64,
    /// Its standard error, lx.
    pub standard_error_lx: f64,
    /// What else it may be off by, lx.
    pub bound_lx: f64,
    /// Error over three standard errors and the bound, the largest of photometric value and
    /// channels.
    pub ratio: f64,
}

impl Reading {
    fn is_statistical(&self) -> bool {
        self.standard_error_lx > 0.0
    }

    fn is_off(&self) -> bool {
        self.ratio > 1.0
    }
}

/// Whether an engine is right.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase", tag = "verdict")]
pub enum Verdict {
    /// It is.
    Pass,
    /// It is not, or gave no answer.
    Fail {
        /// What is wrong.
        reason: String,
    },
}

/// How often intervals of 95 % held the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Calibration {
    /// Engine.
    pub method: Method,
    /// Readings with a statistical error, over all its rows.
    pub readings: u64,
    /// Of them, outside their interval.
    pub outside: u64,
    /// Share inside; `None` of nothing.
    pub coverage: Option<f64>,
    /// Outside readings that chance allows.
    pub accepted_outside: u64,
}

/// What was counted in one map.
pub(super) struct Count {
    pub(super) readings: u64,
    pub(super) statistical: u64,
    pub(super) outliers: u64,
    pub(super) accepted_outliers: u64,
    pub(super) outside_interval: u64,
    pub(super) worst: Option<Reading>,
    pub(super) verdict: Verdict,
}

impl Calibration {
    pub(super) fn of(method: Method, rows: &[ValidateRow]) -> Self {
        let rows = || rows.iter().filter(|row| row.method == method);
        let readings: u64 = rows().map(|row| row.statistical).sum();
        let outside: u64 = rows().map(|row| row.outside_interval).sum();
        Self {
            method,
            readings,
            outside,
            coverage: (readings > 0).then(|| 1.0 - outside as f64 / readings as f64),
            accepted_outside: accepted_outliers(readings, 1.0 - COVERAGE, SIGNIFICANCE),
        }
    }
}

/// Compares a map with all that is expected of it.
pub(super) fn count(scene: &Scene, map: &IlluminationMap, expected: &[Expectation]) -> Count {
    let allowance = Allowance::of(map);
    let reader = MapReader::new(scene, map);
    let found: Vec<Option<Reading>> =
        expected.iter().map(|e| Some(allowance.reading(e, &reader.probe(e.at)?))).collect();
    let readings = || found.iter().flatten();
    let statistical = || readings().filter(|r| r.is_statistical());
    let outside = |r: &&Reading| {
        let allowed_lx = allowance.interval * r.standard_error_lx + r.bound_lx;
        (r.measured_lx - r.expected_lx).abs() > allowed_lx
    };
    let mut count = Count {
        readings: readings().count() as u64,
        statistical: statistical().count() as u64,
        outliers: statistical().filter(|r| r.is_off()).count() as u64,
        accepted_outliers: accepted_outliers(
            statistical().count() as u64,
            allowance.chance,
            SIGNIFICANCE,
        ),
        outside_interval: statistical().filter(outside).count() as u64,
        worst: readings().copied().max_by(|a, b| a.ratio.total_cmp(&b.ratio)),
        verdict: Verdict::Pass,
    };
    if let Some(reason) = complaint(&count, &found, map) {
        count.verdict = Verdict::Fail { reason };
    }
    count
}

fn complaint(count: &Count, found: &[Option<Reading>], map: &IlluminationMap) -> Option<String> {
    let unknown = found.iter().filter(|r| r.is_none()).count();
    if unknown > 0 {
        return Some(format!("{unknown} of {} places have no value", found.len()));
    }
    if map.provenance.accuracy.is_none() {
        return Some("too few increments to believe the error".into());
    }
    let certain = found.iter().flatten().filter(|r| !r.is_statistical() && r.is_off()).count();
    if certain > 0 {
        return Some(format!("{certain} values without statistical error are wrong"));
    }
    (count.outliers > count.accepted_outliers).then(|| {
        format!("{} outliers where chance allows {}", count.outliers, count.accepted_outliers)
    })
}

/// What readings of one map may be off by.
struct Allowance {
    /// Of direct light, a floor for places in the dark, lx.
    rounding_lx: f64,
    /// Of light read from vertices: discretization and bias as reported, lx.
    interpolation_lx: f64,
    /// Half width of the interval of 95 % in standard errors.
    interval: f64,
    /// Probability of an outlier.
    chance: f64,
}

impl Allowance {
    fn of(map: &IlluminationMap) -> Self {
        let freedom = map.provenance.increments.saturating_sub(1).max(1) as f64;
        let rms_lx = root_mean_square_lx(map);
        let reported = map.provenance.accuracy.map_or(0.0, |a| a.discretization.hypot(a.bias));
        Self {
            rounding_lx: ROUNDING * rms_lx,
            interpolation_lx: PLACE_OVER_SCENE * reported * rms_lx,
            interval: student_quantile(0.5 + 0.5 * COVERAGE, freedom),
            chance: student_two_sided(STANDARD_ERRORS, freedom),
        }
    }

    fn reading(&self, expectation: &Expectation, found: &Illuminance) -> Reading {
        let measured = part(expectation.quantity, found);
        let standard_error_lx = standard_error_lx(expectation.quantity, found);
        let expected = expectation.expected_lx;
        let bound_lx = expectation.bound.lx
            + RAY_KERNEL_POSITION * expected.luminance()
            + self.rounding_lx
            + if is_read_from_vertices(expectation.quantity, found) {
                self.interpolation_lx
            } else {
                0.0
            };
        let allowed_lx = STANDARD_ERRORS * standard_error_lx + bound_lx;
        let photometric = (measured - expected).luminance().abs() / allowed_lx;
        // The noise of a channel is at most that of the sum over its weight, since channels
        // err together (they share their rays).
        let channels = (0..3).map(|k| {
            let weighted_lx = Rgb::LUMINANCE_WEIGHTS[k] * (measured.0[k] - expected.0[k]).abs();
            weighted_lx / allowed_lx
        });
        Reading {
            position: expectation.at.position.into(),
            quantity: expectation.quantity,
            expected_lx: expected.luminance(),
            measured_lx: measured.luminance(),
            standard_error_lx,
            bound_lx,
            ratio: if measured.is_finite() {
                channels.fold(photometric, f64::max)
            } else {
                f64::INFINITY
            },
        }
    }
}

fn part(quantity: Quantity, found: &Illuminance) -> Rgb {
    match quantity {
        Quantity::Total => found.total_lx(),
        Quantity::Direct => found.direct_lx,
        Quantity::Indirect => found.indirect_lx,
    }
}

fn is_read_from_vertices(quantity: Quantity, found: &Illuminance) -> bool {
    quantity != Quantity::Direct || !found.caustic_lx.is_black()
}

/// The map knows the error of the whole and of what is read from vertices; they are independent.
fn standard_error_lx(quantity: Quantity, found: &Illuminance) -> f64 {
    let (whole, read) = (found.standard_error_lx, found.indirect_standard_error_lx);
    match quantity {
        Quantity::Total => whole,
        Quantity::Indirect => read,
        Quantity::Direct if is_read_from_vertices(quantity, found) => whole,
        Quantity::Direct => (whole * whole - read * read).max(0.0).sqrt(),
    }
}

fn root_mean_square_lx(map: &IlluminationMap) -> f64 {
    let known = map.elements.vertices().iter().zip(&map.values);
    let (sum, area) = known.fold((0.0, 0.0), |(sum, area), (vertex, value)| {
        value.as_ref().map_or((sum, area), |value| {
            let lx = value.illuminance_lx();
            (sum + vertex.area_m2 * lx * lx, area + vertex.area_m2)
        })
    });
    if area > 0.0 { (sum / area).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expectation::Bound;
    use isolux::engine::ProbePoint;
    use isolux::geometry::{Normal, Point};

    const ALLOWANCE: Allowance =
        Allowance { rounding_lx: 1e-10, interpolation_lx: 2.0, interval: 2.0, chance: 0.01 };

    fn expectation(quantity: Quantity, lx: f64) -> Expectation {
        let at = ProbePoint { position: Point::ORIGIN, normal: Normal::Z };
        Expectation { at, quantity, expected_lx: Rgb::grey(lx), bound: Bound::EXACT_GEOMETRY }
    }

    fn found(direct: Rgb, indirect: f64) -> Illuminance {
        Illuminance {
            direct_lx: direct,
            caustic_lx: Rgb::BLACK,
            indirect_lx: Rgb::grey(indirect),
            standard_error_lx: 5.0,
            indirect_standard_error_lx: 5.0,
            samples: 100,
        }
    }

    #[test]
    fn direct_light_has_no_excuse_and_indirect_light_has_its_errors() {
        let reading = |quantity, lx: f64, off: f64| {
            let light = found(Rgb::grey(100.0 + off), 50.0 + off);
            ALLOWANCE.reading(&expectation(quantity, lx), &light)
        };
        assert!(!reading(Quantity::Direct, 100.0, 0.0).is_off());
        assert!(!reading(Quantity::Direct, 100.0, 0.0).is_statistical());
        assert!(reading(Quantity::Direct, 100.0, 0.1).is_off());
        // Three standard errors and the interpolation are 17 lx.
        assert!(!reading(Quantity::Indirect, 50.0, 16.9).is_off());
        assert!(reading(Quantity::Indirect, 50.0, 17.1).is_off());
        assert!(reading(Quantity::Total, 150.0, 8.6).is_off());
    }

    #[test]
    fn a_wrong_colour_of_the_right_luminance_is_wrong() {
        let [red, green, _] = Rgb::LUMINANCE_WEIGHTS;
        let light = found(Rgb::new(100.0 + green, 100.0 - red, 100.0), 0.0);
        let reading = ALLOWANCE.reading(&expectation(Quantity::Direct, 100.0), &light);
        assert!((reading.measured_lx - 100.0).abs() < 1e-9 && reading.is_off());
    }

    #[test]
    fn what_is_not_a_number_is_off() {
        let light = found(Rgb::new(f64::NAN, 100.0, 100.0), 0.0);
        assert!(ALLOWANCE.reading(&expectation(Quantity::Direct, 100.0), &light).is_off());
    }

    #[test]
    fn caustics_make_direct_light_statistical() {
        let light = Illuminance { caustic_lx: Rgb::grey(1.0), ..found(Rgb::grey(110.0), 0.0) };
        let reading = ALLOWANCE.reading(&expectation(Quantity::Direct, 100.0), &light);
        assert!(reading.is_statistical() && !reading.is_off());
    }
}
