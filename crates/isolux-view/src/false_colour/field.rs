//! The quantity shown, pixel by pixel.

use crate::image::{LuminanceImage, Seen, Sight};

/// What a chart shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// Illuminance of the surface seen, lx.
    #[default]
    Illuminance,
    /// Luminance, cd/m2.
    Luminance,
}

impl Quantity {
    /// The value of a sample, where it has one.
    pub(super) fn of(self, seen: &Seen) -> Option<f64> {
        match (self, seen.sight) {
            (_, Sight::Background) => None,
            (Self::Illuminance, _) => seen.illuminance_lx.map(f64::from),
            (Self::Luminance, Sight::Unknown) => None,
            (Self::Luminance, _) => Some(seen.luminance().luminance()),
        }
    }

    /// Its name.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Illuminance => "Illuminance",
            Self::Luminance => "Luminance",
        }
    }

    /// Its unit.
    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::Illuminance => "lx",
            Self::Luminance => "cd/m\u{b2}",
        }
    }
}

/// The value in the middle of every pixel. Of illuminance, luminaires have none: they are drawn
/// white.
pub(super) fn values(image: &LuminanceImage, quantity: Quantity) -> Vec<Option<f64>> {
    let lit = |pixel| {
        let emits = |seen: &Seen| seen.sight == Sight::Emitter;
        let shown = !image.samples(pixel).iter().any(emits);
        image.illuminance_lx(pixel).filter(|_| shown)
    };
    let bright = |pixel| {
        let known = image.samples(pixel).iter().any(|s| quantity.of(s).is_some());
        known.then(|| image.luminance_cd_m2(pixel).luminance())
    };
    let pixels = 0..image.size().pixels();
    let finite = |value: &f64| value.is_finite();
    match quantity {
        Quantity::Illuminance => pixels.map(|p| lit(p).filter(finite)).collect(),
        Quantity::Luminance => pixels.map(|p| bright(p).filter(finite)).collect(),
    }
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
        let emitter = quantity == Quantity::Illuminance && seen.sight == Sight::Emitter;
        marks.emitters |= emitter;
        let shown = emitter || seen.sight == Sight::Background;
        marks.unknown |= !shown && quantity.of(seen).is_none();
    }
    marks
}
