//! Differences of two pictures of the same size, pixel by pixel.

use super::delta_e::DeltaE;
use super::lab::{Lab, White, Xyz};
use super::{Pair, relative_l2_distance};
use serde::{Deserialize, Serialize};

/// Why two pictures have no difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// There is no pixel.
    #[error("the pictures have no pixels")]
    Empty,
    /// The numbers of pixels differ.
    #[error("the reference has {reference} pixels, the picture {measured}")]
    Sizes {
        /// Pixels of the reference.
        reference: usize,
        /// Pixels of the picture.
        measured: usize,
    },
    /// A difference is not a finite number.
    #[error("the colour of pixel {pixel} is not a number")]
    NotFinite {
        /// Index of the first such pixel, from 0.
        pixel: usize,
    },
}

/// How far a picture is from its reference, as a share of the reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureDistance {
    /// Of red, green and blue. A component of which the reference has nothing has none.
    pub components: [Option<f64>; 3],
    /// Mean of those that there are; none of a black reference.
    pub mean: Option<f64>,
}

/// The distance d_rel of Kopylov, Khodulev, Volevich (1998, 3.3), without unit: in each component of the codes of
/// a frame buffer, whatever they encode, sqrt(1/N sum (f - g)^2) over sqrt(1/N sum f^2), f of the reference.
/// The paper takes the mean of the three components.
pub fn picture_distance(
    reference: &[[u8; 3]],
    measured: &[[u8; 3]],
) -> Result<PictureDistance, PictureError> {
    check_sizes(reference.len(), measured.len())?;
    let components = [0, 1, 2].map(|component| {
        let code = |pixel: &[u8; 3]| f64::from(pixel[component]);
        let pairs = reference.iter().zip(measured);
        let pairs = pairs.map(|(f, g)| Pair { reference: code(f), measured: code(g) });
        relative_l2_distance(&pairs.collect::<Vec<_>>())
    });
    let known: Vec<f64> = components.into_iter().flatten().collect();
    let mean = (!known.is_empty()).then(|| mean(&known));
    Ok(PictureDistance { components, mean })
}

/// The distribution of differences of colour over the pixels of a picture, in units of the formula. Quantiles are
/// those of the nearest rank: the least difference that so many hundredths of the pixels do not exceed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColourDifference {
    /// Arithmetic mean.
    pub mean: f64,
    /// Half of the pixels do not exceed it; of an even number it is the lower of the two in the middle.
    pub median: f64,
    /// 95 % of the pixels do not exceed it.
    pub p95: f64,
    /// The greatest of all.
    pub greatest: f64,
}

impl ColourDifference {
    /// The distribution of these differences.
    pub fn of(differences: &[f64]) -> Result<Self, PictureError> {
        if let Some(pixel) = differences.iter().position(|d| !d.is_finite()) {
            return Err(PictureError::NotFinite { pixel });
        }
        let mut sorted = differences.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let &greatest = sorted.last().ok_or(PictureError::Empty)?;
        let [median, p95] = [50, 95].map(|percent| nearest_rank(&sorted, percent));
        Ok(Self { mean: mean(differences), median, p95, greatest })
    }
}

/// The distribution of the differences of two pictures by a formula, under one white.
pub fn colour_difference(
    formula: DeltaE,
    reference: &[Xyz],
    measured: &[Xyz],
    white: White,
) -> Result<ColourDifference, PictureError> {
    ColourDifference::of(&colour_differences(formula, reference, measured, white)?)
}

/// The differences of two pictures by a formula, pixel by pixel, under one white.
pub fn colour_differences(
    formula: DeltaE,
    reference: &[Xyz],
    measured: &[Xyz],
    white: White,
) -> Result<Vec<f64>, PictureError> {
    check_sizes(reference.len(), measured.len())?;
    let lab = |&xyz: &Xyz| Lab::from_xyz(xyz, white);
    let pairs = reference.iter().zip(measured);
    Ok(pairs.map(|(f, g)| formula.between(lab(f), lab(g))).collect())
}

fn check_sizes(reference: usize, measured: usize) -> Result<(), PictureError> {
    match (reference, measured) {
        (0, 0) => Err(PictureError::Empty),
        _ if reference != measured => Err(PictureError::Sizes { reference, measured }),
        _ => Ok(()),
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The value of rank ceil(percent n / 100), counted from 1, of values that are sorted and not empty.
fn nearest_rank(sorted: &[f64], percent: usize) -> f64 {
    sorted[(sorted.len() * percent).div_ceil(100) - 1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::ROUNDING;

    const WHITE: Xyz = Xyz { x: 0.95, y: 1.0, z: 1.09 };

    fn grey(share: f64) -> Xyz {
        [WHITE.x, WHITE.y, WHITE.z].map(|v| v * share).into()
    }

    fn check_distance(reference: &[[u8; 3]], measured: &[[u8; 3]], expected: [Option<f64>; 3]) {
        let found = picture_distance(reference, measured).unwrap();
        for (found, expected) in found.components.into_iter().zip(expected) {
            match (found, expected) {
                (Some(found), Some(expected)) => assert!((found - expected).abs() < ROUNDING),
                _ => assert_eq!(found, expected),
            }
        }
    }

    #[test]
    fn distances_are_shares_of_each_component() {
        let reference = [[100, 200, 30], [100, 0, 40]];
        check_distance(&reference, &reference, [Some(0.0); 3]);
        // Red: sqrt((10^2 + 10^2) / 2) / 100; green: sqrt(20^2) / sqrt(200^2); blue: sqrt(25^2) / sqrt(50^2).
        let measured = [[110, 180, 30], [90, 0, 15]];
        check_distance(&reference, &measured, [Some(0.1), Some(0.1), Some(0.5)]);
        let mean = picture_distance(&reference, &measured).unwrap().mean.unwrap();
        assert!((mean - 0.7 / 3.0).abs() < ROUNDING);
    }

    #[test]
    fn a_component_that_the_reference_lacks_is_left_out_of_the_mean() {
        let found = picture_distance(&[[10, 0, 0]], &[[5, 7, 0]]).unwrap();
        assert_eq!(found.components, [Some(0.5), None, None]);
        assert_eq!(found.mean, Some(0.5));
        assert_eq!(picture_distance(&[[0; 3]], &[[9; 3]]).unwrap().mean, None);
    }

    #[test]
    fn quantiles_are_of_the_nearest_rank() {
        let hundred: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        let found = ColourDifference::of(&hundred).unwrap();
        let expected = ColourDifference { mean: 50.5, median: 50.0, p95: 95.0, greatest: 100.0 };
        assert_eq!(found, expected);
        let one = ColourDifference::of(&[3.0]).unwrap();
        assert_eq!(one, ColourDifference { mean: 3.0, median: 3.0, p95: 3.0, greatest: 3.0 });
        assert_eq!(ColourDifference::of(&[1.0, 2.0]).unwrap().median, 1.0);
    }

    #[test]
    fn greys_differ_by_their_lightness() {
        let white = White::new(WHITE).unwrap();
        let found = |formula| {
            colour_difference(formula, &[grey(1.0), grey(1.0)], &[grey(1.0), grey(0.125)], white)
        };
        // Lightness of an eighth is 116 / 2 - 16 = 42, 58 below that of white.
        for formula in [DeltaE::Cie1976, DeltaE::Cie1994] {
            let found = found(formula).unwrap();
            assert_eq!(found.median, 0.0);
            assert!(
                (found.greatest - 58.0).abs() < 58.0 * ROUNDING
                    && (found.mean - 29.0).abs() < 29.0 * ROUNDING
            );
        }
        let seen = found(DeltaE::Ciede2000).unwrap();
        assert!(seen.greatest < 58.0, "lightness far from the middle counts less: {seen:?}");
    }

    #[test]
    fn pictures_that_cannot_be_compared_are_errors() {
        let white = White::new(WHITE).unwrap();
        assert_eq!(picture_distance(&[], &[]), Err(PictureError::Empty));
        assert_eq!(ColourDifference::of(&[]), Err(PictureError::Empty));
        let sizes = PictureError::Sizes { reference: 1, measured: 0 };
        assert_eq!(picture_distance(&[[1; 3]], &[]), Err(sizes));
        assert_eq!(colour_difference(DeltaE::Cie1976, &[WHITE], &[], white), Err(sizes));
        let broken = [WHITE, Xyz { y: f64::NAN, ..WHITE }];
        let found = colour_difference(DeltaE::Ciede2000, &[WHITE; 2], &broken, white);
        assert_eq!(found, Err(PictureError::NotFinite { pixel: 1 }));
    }
}
