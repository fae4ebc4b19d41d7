//! Tone curves: from exposed luminance to what the display emits.

use crate::error::ViewError;
use isolux::units::Rgb;

/// The closed set of tone curves. All map 0 to 0, never decrease, and end at or before 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToneCurve {
    /// Proportional, cut off at 1: the picture can be measured.
    Linear,
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
}

impl Default for ToneCurve {
    /// Reinhard's operator with white 22 times (4.5 stops) above middle grey.
    fn default() -> Self {
        Self::Reinhard { white: 4.0 }
    }
}

impl ToneCurve {
    /// Refuses parameters that make no curve.
    pub(crate) fn check(self) -> Result<(), ViewError> {
        match self {
            Self::Reinhard { white } if !(white > 0.0 && white.is_finite()) => {
                Err(ViewError::ToneWhite(white))
            }
            _ => Ok(()),
        }
    }

    /// The display-linear colour, 0 to 1, of an exposed colour (luminance over the luminance of
    /// [`crate::Exposure`]).
    pub fn apply(self, exposed: Rgb) -> Rgb {
        let shown = match self {
            Self::Linear => exposed,
            Self::Reinhard { white } => reinhard(exposed, white),
            Self::Hable => exposed.map(|c| hable(2.0 * c) / hable(11.2)),
        };
        shown.map(|c| c.clamp(0.0, 1.0))
    }
}

fn reinhard(exposed: Rgb, white: f64) -> Rgb {
    let luminance = exposed.luminance();
    if luminance >= white {
        // Past its white the curve goes on above 1; the hue is then all that is left to keep.
        return exposed * (1.0 / luminance);
    }
    exposed * ((1.0 + luminance / (white * white)) / (1.0 + luminance))
}

fn hable(x: f64) -> f64 {
    const A_SHOULDER: f64 = 0.15;
    const B_LINEAR: f64 = 0.50;
    const C_ANGLE: f64 = 0.10;
    const D_TOE: f64 = 0.20;
    const E_TOE_NUMERATOR: f64 = 0.02;
    const F_TOE_DENOMINATOR: f64 = 0.30;
    let numerator = x * (A_SHOULDER * x + C_ANGLE * B_LINEAR) + D_TOE * E_TOE_NUMERATOR;
    let denominator = x * (A_SHOULDER * x + B_LINEAR) + D_TOE * F_TOE_DENOMINATOR;
    numerator / denominator - E_TOE_NUMERATOR / F_TOE_DENOMINATOR
}

#[cfg(test)]
mod tests {
    use super::*;

    const CURVES: [ToneCurve; 3] =
        [ToneCurve::Linear, ToneCurve::Reinhard { white: 4.0 }, ToneCurve::Hable];

    /// A few roundings of numbers up to 1.
    const ROUNDING: f64 = 4.0 * f64::EPSILON;

    #[test]
    fn curves_rise_from_black_to_white() {
        for curve in CURVES {
            let at = |x: f64| curve.apply(Rgb::grey(x)).0[1];
            // Hable's curve at zero is DE/DF - E/F, zero but for rounding.
            assert!(at(0.0).abs() <= ROUNDING, "{curve:?}");
            let steps: Vec<f64> = (0..=4000).map(|k| at(0.005 * f64::from(k))).collect();
            assert!(steps.windows(2).all(|w| w[0] <= w[1] + ROUNDING), "{curve:?} falls");
            assert!(at(1e6) >= 1.0 - ROUNDING, "{curve:?} ends below white");
        }
    }

    #[test]
    fn reinhard_follows_equation_4() {
        let at = |x: f64| ToneCurve::Reinhard { white: 4.0 }.apply(Rgb::grey(x)).0[0];
        for (exposed, expected) in [(1.0, (1.0 + 1.0 / 16.0) / 2.0), (4.0, 1.0), (0.18, 0.154258)] {
            // The last expected value is rounded to six places.
            assert!((at(exposed) - expected).abs() < 1e-6, "{exposed}");
        }
    }

    #[test]
    fn reinhard_keeps_the_hue() {
        let shown = ToneCurve::default().apply(Rgb::new(0.4, 0.2, 0.1));
        assert!((shown.0[0] / shown.0[1] - 2.0).abs() < 1e-12);
    }
}
