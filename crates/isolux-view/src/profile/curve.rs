//! Tone curves: one number from another, both 0 to 1.

use super::error::ProfileError;
use moxcms::ToneReprCurve;

/// Codes of a channel.
const CODES: usize = 256;

/// A curve as ICC files have it (ICC.1:2022, sections 10.6 and 10.18).
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Curve {
    /// The number itself.
    Identity,
    /// (a x + b)^g + e from d on, c x + f below.
    Parametric { g: f64, a: f64, b: f64, c: f64, d: f64, e: f64, f: f64 },
    /// Even steps, linear between, in parts of 65535.
    Sampled(Vec<u16>),
}

impl Curve {
    /// The transfer function of sRGB (IEC 61966-2-1), from the signal to light.
    pub(super) const SRGB: Self = Self::Parametric {
        g: 2.4,
        a: 1.0 / 1.055,
        b: 0.055 / 1.055,
        c: 1.0 / 12.92,
        d: 0.04045,
        e: 0.0,
        f: 0.0,
    };

    /// The curve of a file.
    pub(super) fn of(curve: &ToneReprCurve) -> Result<Self, ProfileError> {
        match curve {
            ToneReprCurve::Lut(steps) => Ok(Self::sampled(steps)),
            ToneReprCurve::Parametric(parameters) => {
                let parameters: Vec<f64> = parameters.iter().map(|p| f64::from(*p)).collect();
                parametric(&parameters).ok_or(ProfileError::Curve)
            }
        }
    }

    /// Of one number only, that is an exponent in parts of 256.
    pub(super) fn sampled(steps: &[u16]) -> Self {
        match steps {
            [] => Self::Identity,
            [exponent] => power(f64::from(*exponent) / 256.0),
            steps => Self::Sampled(steps.to_vec()),
        }
    }

    /// The value at a number, which is taken as the nearer end where it lies outside; 0 to 1 both.
    pub(super) fn at(&self, x: f64) -> f64 {
        let x = within(x);
        within(match *self {
            Self::Identity => x,
            Self::Parametric { c, d, f, .. } if x < d => c * x + f,
            Self::Parametric { g, a, b, e, .. } => libm::pow((a * x + b).max(0.0), g) + e,
            Self::Sampled(ref steps) => between(steps, x),
        })
    }
}

/// 0 to 1, and 0 for what is no number.
pub(super) fn within(x: f64) -> f64 {
    if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) }
}

fn power(g: f64) -> Curve {
    Curve::Parametric { g, a: 1.0, b: 0.0, c: 0.0, d: 0.0, e: 0.0, f: 0.0 }
}

fn parametric(parameters: &[f64]) -> Option<Curve> {
    Some(match *parameters {
        [g] => power(g),
        [g, a, b] => Curve::Parametric { g, a, b, c: 0.0, d: -b / a, e: 0.0, f: 0.0 },
        [g, a, b, e] => Curve::Parametric { g, a, b, c: 0.0, d: -b / a, e, f: e },
        [g, a, b, c, d] => Curve::Parametric { g, a, b, c, d, e: 0.0, f: 0.0 },
        [g, a, b, c, d, e, f] => Curve::Parametric { g, a, b, c, d, e, f },
        _ => return None,
    })
}

fn between(steps: &[u16], x: f64) -> f64 {
    let place = x * (steps.len() - 1) as f64;
    let low = (place as usize).min(steps.len().saturating_sub(2));
    let [from, to] = [low, low + 1].map(|k| f64::from(steps[k]) / f64::from(u16::MAX));
    from + (to - from) * (place - low as f64)
}

/// A curve at the codes of a channel, and the values from which on the next code is the nearer.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CodeCurve {
    values: Vec<f64>,
    thresholds: Vec<f64>,
}

impl CodeCurve {
    /// A curve that rises from its first code to its last.
    pub(super) fn of(curve: &Curve) -> Result<Self, ProfileError> {
        let tabulated = Self::tabulate(curve);
        let rises = tabulated.value(u8::MAX) > tabulated.value(0);
        rises.then_some(tabulated).ok_or(ProfileError::Curve)
    }

    /// That of sRGB.
    pub(super) fn srgb() -> Self {
        Self::tabulate(&Curve::SRGB)
    }

    /// Where the curve falls on the way, it is level for those who look for a code.
    fn tabulate(curve: &Curve) -> Self {
        let at = |code: f64| curve.at(code / (CODES - 1) as f64);
        let mut highest = f64::NEG_INFINITY;
        let rising = |code: usize| {
            highest = f64::max(highest, at(code as f64 + 0.5));
            highest
        };
        Self {
            thresholds: (0..CODES - 1).map(rising).collect(),
            values: (0..CODES).map(|code| at(code as f64)).collect(),
        }
    }

    /// The value of a code.
    pub(super) fn value(&self, code: u8) -> f64 {
        self.values[usize::from(code)]
    }

    /// The code nearest to a value, as a signal; 0 for black, however many codes show that, and for what is no number.
    pub(super) fn code(&self, value: f64) -> u8 {
        if value <= self.values[0] {
            return 0;
        }
        self.thresholds.partition_point(|threshold| *threshold <= value) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::srgb;

    #[test]
    fn srgb_is_that_of_charts() {
        let curve = CodeCurve::of(&Curve::SRGB).unwrap();
        for code in 0..=255 {
            let expected = srgb::linear_from_code(code);
            // Its constants are rounded once each here.
            assert!((curve.value(code) - expected).abs() < 4.0 * f64::EPSILON, "{code}");
        }
        for step in 0..=100_000 {
            // Steps of a prime part: none lies at a threshold but for rounding.
            let value = f64::from(step) / 99_991.0;
            assert_eq!(curve.code(value), srgb::code_from_linear(value), "{value}");
        }
        assert_eq!([f64::NAN, -1.0, f64::INFINITY].map(|v| curve.code(v)), [0, 0, 255]);
    }

    #[test]
    fn curves_of_files() {
        let lut = |steps: &[u16]| Curve::of(&ToneReprCurve::Lut(steps.to_vec())).unwrap();
        let parametric = |p: &[f32]| Curve::of(&ToneReprCurve::Parametric(p.to_vec()));
        for (curve, x, expected) in [
            (lut(&[]), 0.3, 0.3),
            (lut(&[2 * 256]), 0.5, 0.25),
            (lut(&[0, u16::MAX]), 0.25, 0.25),
            (lut(&[0, 0, u16::MAX]), 0.75, 0.5),
            (parametric(&[2.0]).unwrap(), 0.5, 0.25),
            (parametric(&[2.0, 2.0, -0.5]).unwrap(), 0.5, 0.25),
            (parametric(&[2.0, 2.0, -0.5]).unwrap(), 0.2, 0.0),
            (parametric(&[2.0, 0.5, 0.0, 0.25]).unwrap(), 1.0, 0.5),
            (parametric(&[2.0, 0.5, 0.0, 0.5, 0.5]).unwrap(), 0.25, 0.125),
            (parametric(&[2.0, 0.5, 0.0, 0.5, 0.5, 0.25, 0.125]).unwrap(), 0.25, 0.25),
            (parametric(&[2.0, 0.5, 0.0, 0.5, 0.5, 0.25, 0.125]).unwrap(), 1.0, 0.5),
        ] {
            // A rounding or two.
            assert!((curve.at(x) - expected).abs() < 4.0 * f64::EPSILON, "{curve:?} at {x}");
        }
        assert_eq!(parametric(&[1.0, 2.0]), Err(ProfileError::Curve));
    }

    #[test]
    fn black_is_the_first_code_and_white_the_last() {
        let level = Curve::Sampled(vec![0, 0, 0, u16::MAX, u16::MAX]);
        let curve = CodeCurve::of(&level).unwrap();
        assert_eq!([0.0, 0.5, 1.0].map(|value| curve.code(value)), [0, 159, 255]);
    }

    #[test]
    fn ends_and_nonsense_stay_within() {
        let nonsense =
            Curve::Parametric { g: -1.0, a: 0.0, b: 0.0, c: 0.0, d: 0.0, e: f64::NAN, f: 0.0 };
        for x in [-1.0, 0.0, 0.5, 1.0, 2.0, f64::NAN, f64::INFINITY] {
            for curve in [&nonsense, &Curve::SRGB, &Curve::Sampled(vec![7, 9])] {
                assert!((0.0..=1.0).contains(&curve.at(x)), "{curve:?} at {x}");
            }
        }
        assert_eq!(CodeCurve::of(&nonsense), Err(ProfileError::Curve));
        assert_eq!(CodeCurve::of(&Curve::Sampled(vec![9, 7])), Err(ProfileError::Curve));
    }
}
