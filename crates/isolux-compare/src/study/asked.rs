//! What runs are asked for.

use super::record::Point;
use super::system::System;
use isolux::map::Method;

/// What the shortest run of a system is asked for.
const FIRST_ACCURACY: f64 = 0.1;

/// How fast errors fall with time: as one over the root of it with independent samples; with light between all pairs of elements, whose number grows
/// as one over the square of their size, time grows as the fourth power of one over the size, in which the error is linear.
const ORDER: f64 = 0.5;
const ORDER_OF_RADIOSITY: f64 = 0.25;

/// The accuracy that a run of about so much time is asked for, after shorter runs of its system: what time makes of the least error told. Elements are made for the accuracy asked for, so that what is far out of reach would
/// leave no time for light: where a longer run has told no less since, the next is asked for something between the two.
pub fn accuracy_for(system: System, shorter: &[Point], within_s: f64) -> f64 {
    let is_radiosity = system.method() == Some(Method::Radiosity);
    let order = if is_radiosity { ORDER_OF_RADIOSITY } else { ORDER };
    let told = shorter.iter().enumerate().filter_map(|(k, of)| Some((k, of.reported.error?)));
    let Some((best, error)) = told.min_by(|a, b| a.1.total_cmp(&b.1)) else {
        return FIRST_ACCURACY;
    };
    let fits = error * libm::pow(shorter[best].time_s / within_s, order).min(1.0);
    let too_much = shorter[best + 1..].iter().filter_map(|of| of.accuracy).max_by(f64::total_cmp);
    too_much.map_or(fits, |asked| libm::sqrt(error * asked).max(fits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Reported;

    fn told(asked: f64, error: Option<f64>, time_s: f64) -> Point {
        Point {
            accuracy: Some(asked),
            time_s,
            reported: Reported { error, ..Reported::default() },
            ..Point::default()
        }
    }

    #[test]
    fn runs_are_asked_for_what_they_have_time_for() {
        let first = told(FIRST_ACCURACY, Some(0.04), 0.5);
        let in_vain = told(0.01, None, 4.0);
        // Independent samples; nothing told yet; the middle of what was told and what was out of reach.
        let asked = |shorter: &[Point], s| accuracy_for(System::Hybrid, shorter, s);
        assert_eq!(asked(std::slice::from_ref(&first), 2.0), 0.02);
        assert_eq!(asked(std::slice::from_ref(&in_vain), 8.0), FIRST_ACCURACY);
        assert_eq!(asked(&[first.clone(), in_vain], 8.0), 0.02);
        // There is never less time than there was.
        assert_eq!(asked(std::slice::from_ref(&first), 0.1), 0.04);
        assert_eq!(accuracy_for(System::Radiosity, &[first], 8.0), 0.02);
    }
}
