//! The quantity shown, pixel by pixel.

use super::smooth;
use crate::image::{LuminanceImage, Reading, Seen, Sight};

/// What a chart shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// Illuminance of the surface seen, lx.
    #[default]
    Illuminance,
    /// Standard error of the illuminance in per cent of it: where the map can be trusted.
    StandardError,
    /// Luminance, cd/m2.
    Luminance,
}

impl Quantity {
    /// Whether it is read from the map rather than seen.
    pub(super) fn is_of_the_map(self) -> bool {
        self != Self::Luminance
    }

    /// The value of a reading; `None` for luminance, for the relative error of darkness, and for an
    /// error that is not known yet.
    fn read(self, reading: Reading) -> Option<f64> {
        let lux = f64::from(reading.illuminance_lx);
        let value = match self {
            Self::Illuminance => lux,
            Self::StandardError => 100.0 * f64::from(reading.standard_error_lx) / lux,
            Self::Luminance => return None,
        };
        Some(value).filter(|v| v.is_finite())
    }

    /// The value of a sample, where it has one.
    pub(super) fn of(self, seen: &Seen) -> Option<f64> {
        match (self, seen.sight) {
            (_, Sight::Background) | (Self::Luminance, Sight::Unknown) => None,
            (Self::Luminance, _) => Some(seen.luminance().luminance()),
            _ => seen.reading.and_then(|reading| self.read(reading)),
        }
    }

    /// Its name and unit.
    pub(super) fn heading(self) -> &'static str {
        match self {
            Self::Illuminance => "Illuminance, lx",
            Self::StandardError => "Std. error, %",
            Self::Luminance => "Luminance, cd/m\u{b2}",
        }
    }
}

/// The value in the middle of every pixel, lux without the noise of shadow rays. Luminaires have none of what a map holds: they are drawn
/// white.
pub(super) fn values(image: &LuminanceImage, quantity: Quantity) -> Vec<Option<f64>> {
    let smooth = match quantity {
        Quantity::Illuminance => smooth::illuminances_lx(image),
        _ => Vec::new(),
    };
    let read = |pixel| {
        let emits = |seen: &Seen| seen.sight == Sight::Emitter;
        let shown = !image.samples(pixel).iter().any(emits);
        let value = || match quantity {
            Quantity::Illuminance => smooth[pixel],
            _ => image.reading(pixel).and_then(|reading| quantity.read(reading)),
        };
        shown.then(value).flatten()
    };
    let bright = |pixel| {
        let known = image.samples(pixel).iter().any(|s| quantity.of(s).is_some());
        known.then(|| image.luminance_cd_m2(pixel).luminance())
    };
    (0..image.size().pixels())
        .map(|pixel| if quantity.is_of_the_map() { read(pixel) } else { bright(pixel) })
        .map(|value| value.filter(|v| v.is_finite()))
        .collect()
}

/// Things in a view that have no colour of the scale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Marks {
    /// Surfaces without a value.
    pub(super) unknown: bool,
    /// Luminaires drawn white.
    pub(super) emitters: bool,
}

/// Which of them a view shows.
pub(super) fn marks(image: &LuminanceImage, quantity: Quantity) -> Marks {
    let mut marks = Marks::default();
    for seen in (0..image.size().pixels()).flat_map(|pixel| image.samples(pixel)) {
        let emitter = quantity.is_of_the_map() && seen.sight == Sight::Emitter;
        marks.emitters |= emitter;
        let shown = emitter || seen.sight == Sight::Background;
        marks.unknown |= !shown && quantity.of(seen).is_none();
    }
    marks
}
