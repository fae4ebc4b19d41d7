//! Adaptation to a white: which colour looks white.

use crate::colorimetry::{D65_XYZ, REC709_FROM_XYZ, XYZ_FROM_REC709, adaptation};
use crate::error::ViewError;
use crate::image::{LuminanceImage, Seen, Sight};
use crate::light::degree_of_eyes;
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
    /// Light of this colour looks nearly white, as to eyes in it: they adapt by the degree of CIECAM02 (CIE 159:2004), and less
    /// to light of a colour that no black body and no daylight has.
    Nearly(Rgb),
    /// The mean colour of the surfaces seen looks white, each counting by its luminance; luminaires themselves are left out.
    /// It takes the world for grey (Buchsbaum 1980, "A spatial processor model for object colour perception"): right for
    /// rooms of whites and greys, and too cold where all walls are of one warm colour.
    Scene,
}

impl WhiteAdaptation {
    /// What takes the colours of a view, linear Rec. 709, to those shown; `None` where they stay.
    pub(crate) fn matrix(self, image: &LuminanceImage) -> Result<Option<Matrix3>, ViewError> {
        let (white, degree) = match self {
            Self::None => return Ok(None),
            Self::To(white) => (white, 1.0),
            Self::Nearly(white) => (white, degree_of_eyes(white)),
            // A view in which no surface is lit is black under any white.
            Self::Scene => (mean_of_surfaces(image).unwrap_or(Rgb::WHITE), 1.0),
        };
        to_white(white, degree).map(Some).ok_or(ViewError::White)
    }
}

/// The adaptation to a white, of which `degree` takes place: 1 shows it white, 0 as it is.
fn to_white(white: Rgb, degree: f64) -> Option<Matrix3> {
    let is_light = white.min_channel() >= 0.0 && white.is_finite() && !white.is_black();
    let xyz = XYZ_FROM_REC709.apply(white.chromaticity().0);
    let whole = REC709_FROM_XYZ.after(&adaptation(xyz, D65_XYZ)).after(&XYZ_FROM_REC709);
    // A cone's factor f becomes 1 + degree (f - 1), which mixes the whole matrix with that of no change.
    let matrix = whole.mixed_with_identity(degree);
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
            let shown = to_white(white, 1.0).unwrap().apply(white.0);
            for channel in shown {
                // Rec. 709 prints its luminance weights to four digits.
                assert!((channel / white.luminance() - 1.0).abs() < 1e-3, "{shown:?}");
            }
        }
    }

    #[test]
    fn eyes_leave_a_rest_of_warm_light_and_all_of_coloured_light() {
        let shown =
            |light: Rgb| Rgb(to_white(light, degree_of_eyes(light)).unwrap().apply(light.0));
        let warmth = |colour: Rgb| colour.0[0] / colour.0[2];
        let warm = shown(WARM);
        assert!(warmth(warm) > 1.05 && warmth(warm) < 1.6, "{warm:?}");
        assert!((warm.luminance() / WARM.luminance() - 1.0).abs() < 1e-3);
        for coloured in [Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.0, 1.0, 0.1), Rgb::new(0.0, 0.0, 1.0)]
        {
            for (got, wanted) in shown(coloured).0.into_iter().zip(coloured.0) {
                // A few roundings of numbers up to 4.
                assert!((got - wanted).abs() < 1e-14, "{coloured:?}");
            }
        }
    }

    #[test]
    fn what_is_no_light_is_no_white() {
        for white in [Rgb::BLACK, Rgb::new(f64::NAN, 1.0, 1.0), Rgb::new(1.0, -1.0, 1.0)] {
            assert_eq!(to_white(white, 1.0), None, "{white:?}");
        }
        assert!(to_white(Rgb::new(f64::INFINITY, 1.0, 1.0), 1.0).is_none());
    }
}
