//! What readings of a map may be off by.
//!
//! Three standard errors, the bound of the case (triangles for a sphere), rounding of positions, and,
//! for light read from vertices, a multiple of the discretization and bias that the map reports of
//! itself.

use super::row::Reading;
use crate::expectation::{Expectation, Quantity};
use crate::tolerance::{
    DIRECT_FREEDOM, PLACE_OVER_SCENE, RAY_KERNEL_POSITION, ROUNDING, STANDARD_ERRORS,
};
use isolux::map::{Illuminance, IlluminationMap};
use isolux::units::Rgb;

/// What readings of one map may be off by.
pub(super) struct Allowance {
    /// Of direct light, a floor for places in the dark, lx.
    rounding_lx: f64,
    /// Of light read from vertices: discretization and bias as reported, lx.
    interpolation_lx: f64,
    /// Independent replicates less one.
    freedom: f64,
}

impl Allowance {
    pub(super) fn of(map: &IlluminationMap) -> Self {
        let freedom = map.provenance.increments.saturating_sub(1).max(1) as f64;
        let rms_lx = root_mean_square_lx(map);
        let reported = map.provenance.accuracy.map_or(0.0, |a| a.discretization.hypot(a.bias));
        Self {
            rounding_lx: ROUNDING * rms_lx,
            interpolation_lx: PLACE_OVER_SCENE * reported * rms_lx,
            freedom,
        }
    }

    pub(super) fn reading(&self, expectation: &Expectation, found: &Illuminance) -> Reading {
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
            degrees_of_freedom: self.degrees_of_freedom(expectation.quantity, found),
            bound_lx,
            ratio: if measured.is_finite() {
                channels.fold(photometric, f64::max)
            } else {
                f64::INFINITY
            },
        }
    }

    fn degrees_of_freedom(&self, quantity: Quantity, found: &Illuminance) -> f64 {
        if quantity != Quantity::Indirect && sampled_direct_variance(found) > 0.0 {
            self.freedom.min(DIRECT_FREEDOM)
        } else {
            self.freedom
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

fn standard_error_lx(quantity: Quantity, found: &Illuminance) -> f64 {
    let (whole, read) = (found.standard_error_lx, found.indirect_standard_error_lx);
    match quantity {
        Quantity::Total => whole,
        Quantity::Indirect => read,
        Quantity::Direct if is_read_from_vertices(quantity, found) || !read.is_finite() => whole,
        Quantity::Direct => sampled_direct_variance(found).sqrt(),
    }
}

/// The map knows the error of the whole and of what is read from vertices; they are independent.
fn sampled_direct_variance(found: &Illuminance) -> f64 {
    let (whole, read) = (found.standard_error_lx, found.indirect_standard_error_lx);
    let difference = whole * whole - read * read;
    // What the subtraction of equal squares leaves is rounding.
    if difference > ROUNDING * whole * whole { difference } else { 0.0 }
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
    use isolux::map::Standing;

    const ALLOWANCE: Allowance =
        Allowance { rounding_lx: 1e-10, interpolation_lx: 2.0, freedom: 15.0 };

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
            common_error_lx: 0.0,
            interpolation_error_lx: 0.0,
            bias_lx: 0.0,
            standing: Standing::Open,
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
