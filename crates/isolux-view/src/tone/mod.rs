//! Tone operators: from luminance to what the display emits.

mod filmic;
mod hable;
mod levels;
mod linear;
mod reinhard;
mod tumblin_rushmeier;
mod ward;

pub use levels::Levels;

use crate::error::ViewError;
use isolux::units::Rgb;
use linear::Knobs;
use std::ops::RangeInclusive;
use tumblin_rushmeier::Power;

/// Luminances of white that displays have, cd/m2: from paper by candlelight to the brightest screens.
const DISPLAY_WHITES_CD_M2: RangeInclusive<f64> = 1.0..=1e5;
/// Factors of contrast, from a flat grey to black and white alone.
const CONTRASTS: RangeInclusive<f64> = 0.0..=100.0;
/// Additions of brightness, from all black to all white.
const BRIGHTNESSES: RangeInclusive<f64> = -1.0..=1.0;

/// The closed set of tone operators. All of them are global: a luminance is shown alike wherever in the view it is. None
/// shows a brighter place darker, and what they would show brighter than white is cut off, channel by channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ToneOperator {
    /// Proportional, cut off at white, and then the knobs of a monitor, which act on its signal. For a channel of signal s, 0 for
    /// black and 1 for white, coded as sRGB codes it, they give 1/2 + `contrast` (s - 1/2) + `brightness`. With contrast 1
    /// and brightness 0 ([`ToneOperator::LINEAR`]) the picture can be measured.
    Linear {
        /// What is added to the signal, -1 to 1.
        brightness: f64,
        /// The factor on the distance of the signal from its middle, 0 to 100.
        contrast: f64,
    },
    /// Proportional up to half of white, and then a shoulder up to 36 times the log-average of [`crate::Exposure::Automatic`], on
    /// each channel, so that what is brighter loses its colour as on film. Exposed 1.3 stops brighter than middle grey, as rooms are
    /// photographed: white walls are white.
    #[default]
    Filmic,
    /// The global operator of Reinhard, Stark, Shirley, Ferwerda 2002, "Photographic tone
    /// reproduction for digital images", eq. 4: L (1 + L / w^2) / (1 + L) on luminance, colours kept
    /// until a channel is cut off at 1.
    Reinhard {
        /// The exposed luminance w from which on all is white.
        white: f64,
    },
    /// The filmic curve of Hable 2010, "Uncharted 2: HDR lighting" (Game Developers Conference), on each
    /// channel, with its printed constants, exposure bias 2 and linear white 11.2.
    Hable,
    /// The scale factor of Ward 1994, "A contrast-based scalefactor for luminance display" (Graphics Gems IV): the least
    /// difference that can be seen in the scene is the least that can be seen on the display. Proportional and cut off at
    /// white; the exposure decides through [`Levels::adaptation_cd_m2`] alone.
    Ward,
    /// The operator of Tumblin and Rushmeier 1993, "Tone reproduction for realistic images", in the revised form of Tumblin,
    /// Hodgins, Guenter 1999, "Two methods for display of high contrast images" (ACM Transactions on Graphics 18):
    /// a power of luminance that looks as bright on the display as the scene does, for eyes adapted to either.
    TumblinRushmeier,
}

impl ToneOperator {
    /// Reinhard's operator with white 22 times (4.5 stops) above middle grey.
    pub const REINHARD: Self = Self::Reinhard { white: 4.0 };
    /// Proportional: the picture can be measured.
    pub const LINEAR: Self = Self::Linear { brightness: 0.0, contrast: 1.0 };

    /// The operator for a view and a display. It refuses parameters that make no curve.
    pub fn at(self, levels: Levels) -> Result<ToneMap, ViewError> {
        let display_white_cd_m2 = levels.display_white_cd_m2;
        if !DISPLAY_WHITES_CD_M2.contains(&display_white_cd_m2) {
            return Err(ViewError::DisplayWhite(display_white_cd_m2));
        }
        let form = match self {
            Self::Linear { brightness, contrast } => linear(brightness, contrast)?,
            Self::Reinhard { white } if white > 0.0 && white.is_finite() => Form::Reinhard(white),
            Self::Reinhard { white } => return Err(ViewError::ToneWhite(white)),
            Self::Filmic => Form::Filmic,
            Self::Hable => Form::Hable,
            Self::Ward => Form::Scale(ward::factor(levels) * levels.white_cd_m2),
            Self::TumblinRushmeier => Form::Power(Power::of(levels)),
        };
        Ok(ToneMap(form))
    }
}

fn linear(brightness: f64, contrast: f64) -> Result<Form, ViewError> {
    if !BRIGHTNESSES.contains(&brightness) {
        return Err(ViewError::Brightness(brightness));
    }
    if !CONTRASTS.contains(&contrast) {
        return Err(ViewError::Contrast(contrast));
    }
    let knobs = Knobs { brightness, contrast };
    Ok(if knobs.do_nothing() { Form::Scale(1.0) } else { Form::Knobs(knobs) })
}

/// A tone operator with its constants worked out for one view and one display.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap(Form);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Scale(f64),
    Knobs(Knobs),
    Reinhard(f64),
    Filmic,
    Hable,
    Power(Power),
}

impl ToneMap {
    /// The display-linear colour, 0 to 1, of an exposed colour (luminance over the luminance of [`crate::Exposure`]).
    pub fn apply(&self, exposed: Rgb) -> Rgb {
        self.uncut(exposed).map(|channel| channel.clamp(0.0, 1.0))
    }

    /// The same before what is brighter than white is cut off.
    pub(crate) fn uncut(&self, exposed: Rgb) -> Rgb {
        match self.0 {
            Form::Scale(factor) => exposed * factor,
            Form::Knobs(knobs) => exposed.map(|channel| knobs.turn(channel)),
            Form::Reinhard(white) => reinhard::show(exposed, white),
            Form::Filmic => exposed.map(filmic::show),
            Form::Hable => exposed.map(hable::show),
            Form::Power(power) => power.show(exposed),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPERATORS: [ToneOperator; 7] = [
        ToneOperator::Filmic,
        ToneOperator::LINEAR,
        ToneOperator::Linear { brightness: 0.0, contrast: 1.3 },
        ToneOperator::REINHARD,
        ToneOperator::Hable,
        ToneOperator::Ward,
        ToneOperator::TumblinRushmeier,
    ];

    /// A few roundings of numbers up to 1.
    const ROUNDING: f64 = 4.0 * f64::EPSILON;

    fn levels(white_cd_m2: f64) -> Levels {
        Levels { white_cd_m2, display_white_cd_m2: 100.0 }
    }

    #[test]
    fn operators_rise_from_black_to_white() {
        for (operator, white_cd_m2) in
            OPERATORS.iter().flat_map(|o| [0.01, 1.0, 500.0, 1e5].map(|white| (o, white)))
        {
            let map = operator.at(levels(white_cd_m2)).unwrap();
            let at = |x: f64| map.apply(Rgb::grey(x)).0[1];
            // Hable's curve at zero is DE/DF - E/F, zero but for rounding.
            assert!(at(0.0).abs() <= ROUNDING, "{operator:?}");
            let steps: Vec<f64> = (0..=4000).map(|k| at(0.005 * f64::from(k))).collect();
            assert!(steps.windows(2).all(|w| w[0] <= w[1] + ROUNDING), "{operator:?} falls");
            assert!(at(1e12) >= 1.0 - ROUNDING, "{operator:?} ends below white");
        }
    }

    #[test]
    fn operators_on_luminance_keep_the_hue() {
        for operator in [ToneOperator::REINHARD, ToneOperator::Ward, ToneOperator::TumblinRushmeier]
        {
            let shown = operator.at(levels(500.0)).unwrap().apply(Rgb::new(0.2, 0.1, 0.05));
            assert!((shown.0[0] / shown.0[1] - 2.0).abs() < 1e-12, "{operator:?}");
        }
    }

    #[test]
    fn knobs_that_are_not_turned_change_nothing() {
        let map = ToneOperator::LINEAR.at(levels(500.0)).unwrap();
        for value in [0.0, 1e-9, 0.18, 0.999, 1.0] {
            assert_eq!(map.apply(Rgb::grey(value)), Rgb::grey(value));
        }
    }

    #[test]
    fn what_makes_no_curve_is_refused() {
        let linear = |brightness, contrast| ToneOperator::Linear { brightness, contrast };
        for operator in [
            linear(f64::NAN, 1.0),
            linear(1.5, 1.0),
            linear(0.0, -0.1),
            linear(0.0, f64::INFINITY),
            ToneOperator::Reinhard { white: 0.0 },
        ] {
            assert!(operator.at(levels(1.0)).is_err(), "{operator:?}");
        }
        for white in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let dark = Levels { white_cd_m2: 1.0, display_white_cd_m2: white };
            assert!(matches!(ToneOperator::Ward.at(dark), Err(ViewError::DisplayWhite(_))));
        }
    }
}
