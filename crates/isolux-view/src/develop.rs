//! From luminance to a picture as the eye or a camera would show it.

use crate::error::ViewError;
use crate::exposure::Exposure;
use crate::image::{LuminanceImage, Seen};
use crate::matrix::Matrix3;
use crate::picture::Picture;
use crate::profile::MonitorProfile;
use crate::tone::{Levels, ToneMap, ToneOperator};
use crate::white::WhiteAdaptation;
use isolux::units::Rgb;
use rayon::prelude::*;

/// How luminances become colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Development {
    /// Which colour is shown as white.
    pub white: WhiteAdaptation,
    /// Which luminance is shown how bright.
    pub exposure: Exposure,
    /// How the rest is fitted to the display.
    pub tone: ToneOperator,
    /// The luminance of the white of the display, cd/m2, for tone operators that ask for it.
    pub display_white_cd_m2: f64,
    /// What the codes of the picture mean.
    pub profile: MonitorProfile,
}

impl Default for Development {
    /// Colours as they are, exposed by their log-average, by the filmic operator, for an sRGB display of 100 cd/m2.
    fn default() -> Self {
        Self {
            white: WhiteAdaptation::default(),
            exposure: Exposure::default(),
            tone: ToneOperator::default(),
            display_white_cd_m2: 100.0,
            profile: MonitorProfile::srgb(),
        }
    }
}

impl Development {
    /// The tone operator, worked out for a view.
    fn tone_map(&self, white_cd_m2: f64) -> Result<ToneMap, ViewError> {
        let display_white_cd_m2 = self.display_white_cd_m2;
        self.tone.at(Levels { white_cd_m2, display_white_cd_m2 })
    }
}

/// A development, worked out for a view.
pub(crate) struct Shown {
    white_cd_m2: f64,
    tone: ToneMap,
    adaptation: Option<Matrix3>,
}

impl Shown {
    pub(crate) fn of(image: &LuminanceImage, how: &Development) -> Result<Self, ViewError> {
        let white_cd_m2 = how.exposure.white_cd_m2(image)?;
        let tone = how.tone_map(white_cd_m2)?;
        Ok(Self { white_cd_m2, tone, adaptation: how.white.matrix(image)? })
    }

    /// The display-linear colour of a luminance, Rec. 709.
    pub(crate) fn linear(&self, luminance_cd_m2: Rgb) -> Rgb {
        let adapted =
            self.adaptation.map_or(luminance_cd_m2, |matrix| Rgb(matrix.apply(luminance_cd_m2.0)));
        self.tone.apply(adapted / self.white_cd_m2)
    }
}

/// Exposes and tone maps a view. Samples are mapped one by one and averaged as the display emits
/// them, so that the outlines of luminaires stay smooth. Where there is no surface the picture is black; where the map has
/// no value it shows what is emitted and mirrored alone: no light is known to reach the place.
pub fn develop(image: &LuminanceImage, how: &Development) -> Result<Picture, ViewError> {
    let shown = Shown::of(image, how)?;
    let rgb = (0..image.size().pixels())
        .into_par_iter()
        .map(|pixel| {
            let seen = image.samples(pixel).iter().map(Seen::luminance);
            let sum: Rgb = seen.map(|luminance| shown.linear(luminance)).sum();
            how.profile.code_from_linear(sum / f64::from(image.samples_per_pixel()))
        })
        .collect();
    let (width, height) = (image.size().width(), image.size().height());
    Ok(Picture { width, height, rgb, icc: how.profile.icc() })
}
