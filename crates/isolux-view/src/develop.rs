//! From luminance to a picture as the eye or a camera would show it.

use crate::error::ViewError;
use crate::exposure::Exposure;
use crate::image::{LuminanceImage, Seen};
use crate::picture::Picture;
use crate::srgb::codes_from_linear;
use crate::tone::ToneCurve;
use isolux::units::Rgb;
use rayon::prelude::*;

/// How luminances become colours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Development {
    /// Which luminance is shown how bright.
    pub exposure: Exposure,
    /// How the rest is fitted to the display.
    pub tone: ToneCurve,
}

/// Exposes and tone maps a view. Samples are mapped one by one and averaged as the display emits
/// them, so that the outlines of luminaires stay smooth. Where there is no surface the picture is black; where the map has
/// no value it shows what is emitted and mirrored alone: no light is known to reach the place.
pub fn develop(image: &LuminanceImage, how: &Development) -> Result<Picture, ViewError> {
    how.tone.check()?;
    let white_cd_m2 = how.exposure.white_cd_m2(image)?;
    let shown = |seen: &Seen| how.tone.apply(seen.luminance() / white_cd_m2);
    let rgb = (0..image.size().pixels())
        .into_par_iter()
        .map(|pixel| {
            let sum: Rgb = image.samples(pixel).iter().map(shown).sum();
            codes_from_linear(sum / f64::from(image.samples_per_pixel()))
        })
        .collect();
    Ok(Picture { width: image.size().width(), height: image.size().height(), rgb })
}
