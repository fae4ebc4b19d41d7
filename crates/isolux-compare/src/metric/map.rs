//! Differences of two maps at the same places, and what they cost.

use super::{Pair, relative_l2_distance, weighted_rms_relative_difference};
use serde::Serialize;

/// What a map says of a place, and what it should say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapPlace {
    /// The surface that it stands for, m^2.
    pub area_m2: f64,
    /// What the illuminance should be, lx.
    pub reference_lx: f64,
    /// What it is, lx.
    pub measured_lx: f64,
}

impl MapPlace {
    fn is_valid(&self) -> bool {
        let finite =
            [self.area_m2, self.reference_lx, self.measured_lx].iter().all(|v| v.is_finite());
        finite && self.area_m2 >= 0.0
    }

    fn pair(&self) -> Pair {
        Pair { reference: self.reference_lx, measured: self.measured_lx }
    }

    /// Both values times the root of the area: plain sums of their squares are sums weighted by area.
    fn weighted_pair(&self) -> Pair {
        let root = self.area_m2.sqrt();
        Pair { reference: root * self.reference_lx, measured: root * self.measured_lx }
    }
}

/// Why two maps have no difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MapDifferenceError {
    /// There are no places, or none has an area.
    #[error("there is no surface to compare")]
    Empty,
    /// A value is not finite, or an area is below zero.
    #[error("place {place} has a value that is not a number, or a negative area")]
    Invalid {
        /// Index of the first such place, from 0.
        place: usize,
    },
}

/// How far a map is from its reference, weighted by area.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MapDifference {
    /// Number of places.
    pub places: usize,
    /// Surface that they stand for, m^2.
    pub area_m2: f64,
    /// Root mean square difference sqrt(sum A (m - r)^2 / sum A), lx.
    pub rms_lx: f64,
    /// It over the root mean square of the reference, sqrt(sum A (m - r)^2 / sum A r^2), a share: the relative L2
    /// distance weighted by area. A dark reference has none.
    pub relative_l2: Option<f64>,
    /// Root mean square of relative differences, sqrt(sum A ((m - r) / r)^2 / sum A), a share. There is none where
    /// the reference is dark at a place.
    pub rms_relative: Option<f64>,
}

/// The difference of a map from its reference.
pub fn map_difference(places: &[MapPlace]) -> Result<MapDifference, MapDifferenceError> {
    if let Some(place) = places.iter().position(|p| !p.is_valid()) {
        return Err(MapDifferenceError::Invalid { place });
    }
    let area_m2: f64 = places.iter().map(|p| p.area_m2).sum();
    if area_m2 <= 0.0 {
        return Err(MapDifferenceError::Empty);
    }
    let squares: f64 =
        places.iter().map(|p| p.area_m2 * (p.measured_lx - p.reference_lx).powi(2)).sum();
    let weighted: Vec<Pair> = places.iter().map(MapPlace::weighted_pair).collect();
    let relative: Vec<(Pair, f64)> = places.iter().map(|p| (p.pair(), p.area_m2)).collect();
    Ok(MapDifference {
        places: places.len(),
        area_m2,
        rms_lx: (squares / area_m2).sqrt(),
        relative_l2: relative_l2_distance(&weighted),
        rms_relative: weighted_rms_relative_difference(&relative).filter(|share| share.is_finite()),
    })
}

/// The figure of merit of a run, 1 / (error^2 time) in 1/s: where errors fall like one over the root of time, as those of
/// Monte Carlo methods do, it does not depend on how long the run is. It is the measure of the MCNP manual (LA-13709-M,
/// 2000, chapter 2). There is none of no error or of no time.
pub fn figure_of_merit(error_relative: f64, time_s: f64) -> Option<f64> {
    let merit_per_s = 1.0 / (error_relative * error_relative * time_s);
    Some(merit_per_s).filter(|merit| merit.is_finite() && *merit > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::ROUNDING;

    fn place(area_m2: f64, reference_lx: f64, measured_lx: f64) -> MapPlace {
        MapPlace { area_m2, reference_lx, measured_lx }
    }

    fn check(found: Option<f64>, expected: f64) {
        let found = found.unwrap();
        assert!((found / expected - 1.0).abs() < ROUNDING, "{found} {expected}");
    }

    #[test]
    fn places_count_by_their_area() {
        let found = map_difference(&[place(3.0, 10.0, 11.0), place(1.0, 20.0, 14.0)]).unwrap();
        assert_eq!((found.places, found.area_m2), (2, 4.0));
        // 3 x 1 + 1 x 36 = 39 lx^2 m^2 over 4 m^2, the reference 3 x 100 + 1 x 400 = 700.
        check(Some(found.rms_lx), (39.0_f64 / 4.0).sqrt());
        check(found.relative_l2, (39.0_f64 / 700.0).sqrt());
        check(found.rms_relative, ((3.0 * 0.01 + 0.09) / 4.0_f64).sqrt());
    }

    #[test]
    fn halves_of_a_place_are_the_place() {
        let rest = place(2.0, 5.0, 6.0);
        let whole = map_difference(&[place(2.0, 30.0, 33.0), rest]).unwrap();
        let half = place(1.0, 30.0, 33.0);
        let halves = map_difference(&[half, half, rest]).unwrap();
        check(Some(halves.rms_lx), whole.rms_lx);
        check(halves.relative_l2, whole.relative_l2.unwrap());
        check(halves.rms_relative, whole.rms_relative.unwrap());
    }

    #[test]
    fn dark_references_have_no_relative_differences() {
        let partly = map_difference(&[place(1.0, 0.0, 1.0), place(1.0, 2.0, 2.0)]).unwrap();
        check(partly.relative_l2, 0.5);
        assert_eq!(partly.rms_relative, None);
        let black = [place(1.0, 0.0, 0.0)];
        let dark = map_difference(&black).unwrap();
        assert_eq!((dark.rms_lx, dark.relative_l2, dark.rms_relative), (0.0, None, None));
    }

    #[test]
    fn what_is_no_map_is_an_error() {
        assert_eq!(map_difference(&[]), Err(MapDifferenceError::Empty));
        assert_eq!(map_difference(&[place(0.0, 1.0, 1.0)]), Err(MapDifferenceError::Empty));
        let fine = place(1.0, 1.0, 1.0);
        for broken in
            [place(-1.0, 1.0, 1.0), place(1.0, f64::NAN, 1.0), place(1.0, 1.0, f64::INFINITY)]
        {
            let error = MapDifferenceError::Invalid { place: 1 };
            assert_eq!(map_difference(&[fine, broken]), Err(error));
        }
    }

    #[test]
    fn four_times_the_time_for_half_of_the_error_is_the_same_merit() {
        check(figure_of_merit(0.1, 4.0), 25.0);
        check(figure_of_merit(0.05, 16.0), 25.0);
        for (error_relative, time_s) in
            [(0.0, 1.0), (0.1, 0.0), (0.1, -1.0), (f64::NAN, 1.0), (0.1, f64::INFINITY)]
        {
            assert_eq!(figure_of_merit(error_relative, time_s), None);
        }
    }
}
