//! Distances between what is and what should be: of values, of colours, of pictures and of maps.

mod ciede2000;
mod delta_e;
mod lab;
mod landing;
mod map;
mod picture;

pub use ciede2000::ciede2000;
pub use delta_e::{DeltaE, delta_e_1976, delta_e_1994};
pub use lab::{Lab, White, Xyz};
pub use landing::landed_over_emitted;
pub use map::{MapDifference, MapDifferenceError, MapPlace, figure_of_merit, map_difference};
pub use picture::{
    ColourDifference, PictureDistance, PictureError, colour_difference, colour_differences,
    picture_distance,
};

/// A value beside its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// What it should be.
    pub reference: f64,
    /// What it is.
    pub measured: f64,
}

impl Pair {
    fn relative_difference(self) -> f64 {
        (self.measured - self.reference) / self.reference
    }
}

/// The relative L2 distance of Kopylov, Khodulev, Volevich (1998, 3.3): root mean square difference
/// over root mean square reference. `None` of nothing, or where the reference is zero.
pub fn relative_l2_distance(pairs: &[Pair]) -> Option<f64> {
    let difference: f64 = pairs.iter().map(|p| (p.reference - p.measured).powi(2)).sum();
    let norm: f64 = pairs.iter().map(|p| p.reference * p.reference).sum();
    (norm > 0.0).then(|| (difference / norm).sqrt())
}

/// Weighted root mean square of relative differences, the error of CUBE in the same paper (2.1).
/// `None` of nothing.
pub fn weighted_rms_relative_difference(pairs: &[(Pair, f64)]) -> Option<f64> {
    let sum: f64 = pairs.iter().map(|(p, w)| w * p.relative_difference().powi(2)).sum();
    let weight: f64 = pairs.iter().map(|(_, w)| w).sum();
    (weight > 0.0).then(|| (sum / weight).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::ROUNDING;

    fn pairs(error: f64) -> Vec<Pair> {
        [1.0, 20.0, 300.0].map(|r| Pair { reference: r, measured: r * (1.0 + error) }).to_vec()
    }

    #[test]
    fn a_common_factor_is_the_distance() {
        for error in [0.0, 0.01, -0.2] {
            let l2 = relative_l2_distance(&pairs(error)).unwrap();
            assert!((l2 - f64::abs(error)).abs() < ROUNDING);
            let weighted: Vec<_> = pairs(error).into_iter().zip([1.0, 4.0, 8.0]).collect();
            let rms = weighted_rms_relative_difference(&weighted).unwrap();
            assert!((rms - f64::abs(error)).abs() < ROUNDING);
        }
    }

    #[test]
    fn the_distance_of_nothing_is_unknown() {
        assert_eq!(relative_l2_distance(&[]), None);
        assert_eq!(relative_l2_distance(&[Pair { reference: 0.0, measured: 1.0 }]), None);
        assert_eq!(weighted_rms_relative_difference(&[]), None);
    }
}
