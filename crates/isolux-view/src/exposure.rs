//! Which luminance is shown how bright.

use crate::error::ViewError;
use crate::image::{LuminanceImage, Seen, Sight};

/// The share of light that a middle grey reflects, and that the mean of a picture is shown as.
pub(crate) const MIDDLE_GREY: f64 = 0.18;

/// What saturates at an exposure value of nought, cd/m2: 78 / (100 x 0.65) lx s over the s of that value (ISO 12232).
const SATURATION_CD_M2: f64 = 1.2;

/// How the luminance that the tone curve counts as 1 is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// The log-average luminance of all lit pixels is shown as middle grey, 0.18 (Reinhard, Stark,
    /// Shirley, Ferwerda 2002, "Photographic tone reproduction for digital images", eq. 1 and 2).
    /// Black and unknown pixels are left out, where the paper adds a small number to them, and so are luminaires: eyes in a room
    /// are adapted to its surfaces. A view of nothing but luminaires counts them.
    #[default]
    Automatic,
    /// This share of the lit pixels, 0 to 1, is shown no brighter than 1.
    Percentile(f64),
    /// Exposure value at ISO 100: luminances up to 1.2 x 2^EV cd/m2 do not saturate (ISO 12232
    /// saturation speed 78 lx s / S, with q = 0.65 of ISO 2720).
    Ev100(f64),
    /// The luminance shown as 1, cd/m2.
    WhiteCdM2(f64),
    /// The luminance shown as middle grey, cd/m2: the one that eyes in the scene are adapted to.
    GreyCdM2(f64),
}

impl Exposure {
    /// The luminance that the tone curve counts as 1, cd/m2. A view without light gets 1 cd/m2: it is
    /// black at any exposure.
    pub fn white_cd_m2(self, image: &LuminanceImage) -> Result<f64, ViewError> {
        let (given, white) = match self {
            Self::Automatic => (MIDDLE_GREY, log_average(image) / MIDDLE_GREY),
            Self::Percentile(share) if !(0.0..=1.0).contains(&share) => (share, f64::NAN),
            Self::Percentile(share) => (share, percentile(image, share)),
            Self::Ev100(ev) => (ev, SATURATION_CD_M2 * libm::exp2(ev)),
            Self::WhiteCdM2(white) => (white, white),
            Self::GreyCdM2(grey) => (grey, grey / MIDDLE_GREY),
        };
        let usable = white > 0.0 && white.is_finite();
        usable.then_some(white).ok_or(ViewError::Exposure(given))
    }

    /// The exposure value of [`Exposure::Ev100`] that shows a luminance as 1.
    pub fn ev100_of(white_cd_m2: f64) -> f64 {
        libm::log2(white_cd_m2 / SATURATION_CD_M2)
    }
}

/// Luminances, and whether a luminaire is seen in the pixel.
fn lit_pixels(image: &LuminanceImage) -> impl Iterator<Item = (f64, bool)> {
    let is_luminaire = |seen: &Seen| seen.sight == Sight::Emitter;
    let pixel = move |pixel| {
        let luminance = image.luminance_cd_m2(pixel).luminance();
        (luminance, image.samples(pixel).iter().any(is_luminaire))
    };
    (0..image.size().pixels()).map(pixel).filter(|(l, _)| *l > 0.0 && l.is_finite())
}

fn log_average(image: &LuminanceImage) -> f64 {
    let (mut sum, mut count) = ([0.0; 2], [0.0; 2]);
    for (luminance, is_luminaire) in lit_pixels(image) {
        sum[usize::from(is_luminaire)] += libm::log(luminance);
        count[usize::from(is_luminaire)] += 1.0;
    }
    match count {
        [0.0, 0.0] => MIDDLE_GREY,
        [0.0, luminaires] => libm::exp(sum[1] / luminaires),
        [surfaces, _] => libm::exp(sum[0] / surfaces),
    }
}

fn percentile(image: &LuminanceImage, share: f64) -> f64 {
    let mut lit: Vec<f64> = lit_pixels(image).map(|(luminance, _)| luminance).collect();
    lit.sort_by(f64::total_cmp);
    let index = (share * lit.len().saturating_sub(1) as f64).ceil() as usize;
    lit.get(index).copied().unwrap_or(1.0)
}
