//! Adaptation to a white: which colour looks white.

use crate::colorimetry::{D65_XYZ, REC709_FROM_XYZ, XYZ_FROM_REC709, adaptation};
use crate::error::ViewError;
use crate::image::{LuminanceImage, Seen, Sight};
use crate::matrix::Matrix3;
use isolux::units::Rgb;

/// Which colour of the scene the display shows as its white. Eyes adapt to the light about them; a display that is looked at in
/// other light has to show colours as they look, not as they are. Each of the cones is given a factor (von Kries
/// 1902, in the space of Bradford); the luminance of the white stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum WhiteAdaptation {
    /// Colours as they are: the white of Rec. 709, D65, looks white, and warm light looks warm.
    #[default]
    None,
    /// Light of this colour, linear Rec. 709 of any luminance, looks white.
    To(Rgb),
    /// The mean colour of the surfaces seen looks white, each counting by its luminance; luminaires themselves are left out.
    /// It takes the world for grey (Buchsbaum 1980, "A spatial processor model for object colour perception"): right for
    /// rooms of whites and greys, and too cold where all walls are of one warm colour.
    Scene,
}

impl WhiteAdaptation {
    /// What takes the colours of a view, linear Rec. 709, to those shown; `None` where they stay.
    pub(crate) fn matrix(self, image: &LuminanceImage) -> Result<Option<Matrix3>, ViewError> {
        let white = match self {
            Self::None => return Ok(None),
            Self::To(white) => white,
            // A view in which no surface is lit is black under any white.
            Self::Scene => mean_of_surfaces(image).unwrap_or(Rgb::WHITE),
        };
        to_white(white).map(Some).ok_or(ViewError::White)
    }
}

fn to_white(white: Rgb) -> Option<Matrix3> {
    let is_light = white.min_channel() >= 0.0 && white.is_finite() && !white.is_black();
    let xyz = XYZ_FROM_REC709.apply(white.chromaticity().0);
    let matrix = REC709_FROM_XYZ.after(&adaptation(xyz, D65_XYZ)).after(&XYZ_FROM_REC709);
    (is_light && matrix.is_finite()).then_some(matrix)
}

fn mean_of_surfaces(image: &LuminanceImage) -> Option<Rgb> {
    let is_surface = |seen: &&Seen| seen.sight == Sight::Surface;
    let samples = (0..image.size().pixels()).flat_map(|pixel| image.samples(pixel));
    let sum: Rgb = samples.filter(is_surface).map(Seen::luminance).sum();
    (sum.luminance() > 0.0 && sum.is_finite()).then(|| sum.chromaticity())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Light of 2700 K.
    const WARM: Rgb = Rgb::new(1.8, 0.86, 0.19);

    #[test]
    fn the_chosen_white_is_shown_white_at_its_luminance() {
        for white in [WARM, WARM * 0.01, Rgb::WHITE, Rgb::new(0.0, 0.0, 1.0)] {
            let shown = to_white(white).unwrap().apply(white.0);
            for channel in shown {
                // Rec. 709 prints its luminance weights to four digits.
                assert!((channel / white.luminance() - 1.0).abs() < 1e-3, "{shown:?}");
            }
        }
    }

    #[test]
    fn what_is_no_light_is_no_white() {
        for white in [Rgb::BLACK, Rgb::new(f64::NAN, 1.0, 1.0), Rgb::new(1.0, -1.0, 1.0)] {
            assert_eq!(to_white(white), None, "{white:?}");
        }
        assert!(to_white(Rgb::new(f64::INFINITY, 1.0, 1.0)).is_none());
    }
}
