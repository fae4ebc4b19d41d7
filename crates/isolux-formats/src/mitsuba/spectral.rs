//! Colours of spectra that are given by wavelength.

use isolux::units::Rgb;

/// Standard illuminant D65 from 380 to 780 nm in steps of 10 nm (CIE 15:2004, table T.1).
const D65: [f64; 41] = [
    49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861,
    115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342,
    95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778,
    78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054,
    63.3828,
];
const D65_FIRST_NM: f64 = 380.0;
const D65_STEP_NM: f64 = 10.0;
/// What the eye sees, nm.
const VISIBLE_NM: std::ops::Range<u32> = 380..781;

/// A lobe of a colour matching function: its height, middle, and widths below and above.
type Lobe = [f64; 4];

/// The colour matching functions of 1931 as sums of lobes (Wyman, Sloan, Shirley 2013, "Simple analytic approximations to the
/// CIE XYZ color matching functions", JCGT 2(2), section 2.2).
const MATCHING: [&[Lobe]; 3] = [
    &[[1.056, 599.8, 37.9, 31.0], [0.362, 442.0, 16.0, 26.7], [-0.065, 501.1, 20.4, 26.2]],
    &[[0.821, 568.8, 46.9, 40.5], [0.286, 530.9, 16.3, 31.1]],
    &[[1.217, 437.0, 11.8, 36.0], [0.681, 459.0, 26.0, 13.8]],
];

/// Linear Rec. 709 of XYZ (IEC 61966-2-1).
const RGB_FROM_XYZ: [[f64; 3]; 3] =
    [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]];

/// What a spectrum is the spectrum of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A share of light.
    Surface,
    /// Light.
    Light,
}

/// A value at each of some wavelengths, nm, which increase; linear between them and zero beyond.
pub(super) struct Spectrum(Vec<[f64; 2]>);

impl Spectrum {
    /// Values at wavelengths; `None` if these do not increase.
    pub(super) fn new(samples: Vec<[f64; 2]>) -> Option<Self> {
        let is_increasing = samples.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        (samples.len() >= 2 && is_increasing).then_some(Self(samples))
    }

    /// Values at so many wavelengths in even steps from the first to the last.
    pub(super) fn even(first_nm: f64, last_nm: f64, values: &[f64]) -> Option<Self> {
        let step_nm = (last_nm - first_nm) / (values.len().max(2) - 1) as f64;
        let sample = |(k, &value): (usize, &f64)| [first_nm + k as f64 * step_nm, value];
        Self::new(values.iter().enumerate().map(sample).collect())
    }

    fn at(&self, nm: f64) -> f64 {
        let next = self.0.partition_point(|sample| sample[0] <= nm);
        match (next.checked_sub(1).map(|k| self.0[k]), self.0.get(next)) {
            (Some([a, low]), Some([b, high])) => low + (high - low) * (nm - a) / (b - a),
            (Some([last, value]), None) if last == nm => value,
            _ => 0.0,
        }
    }

    /// Its colour, which has no negative channel. Light of value one at all wavelengths has the luminance one; a surface of
    /// value one is white, seen in daylight.
    pub(super) fn colour(&self, of: Of) -> Rgb {
        match of {
            Of::Light => {
                let [x, y, z] = integral(|nm| self.at(nm));
                let whole = integral(|_| 1.0)[1];
                let shown = Rgb(rgb([x, y, z])).map(|c| c.max(0.0));
                shown.chromaticity() * (y / whole)
            }
            Of::Surface => {
                let seen = rgb(integral(|nm| self.at(nm) * daylight(nm)));
                let white = rgb(integral(daylight));
                Rgb(std::array::from_fn(|k| (seen[k] / white[k]).max(0.0)))
            }
        }
    }
}

fn daylight(nm: f64) -> f64 {
    let at = (nm - D65_FIRST_NM) / D65_STEP_NM;
    let low = (at as usize).min(D65.len() - 2);
    D65[low] + (D65[low + 1] - D65[low]) * (at - low as f64)
}

/// XYZ of a spectrum, in steps of a nanometre.
fn integral(value: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for nm in VISIBLE_NM.map(f64::from) {
        let value = value(nm);
        for (sum, lobes) in sum.iter_mut().zip(MATCHING) {
            *sum += value * lobes.iter().map(|lobe| at(lobe, nm)).sum::<f64>();
        }
    }
    sum
}

fn at([height, middle, below, above]: &Lobe, nm: f64) -> f64 {
    let t = (nm - middle) / if nm < *middle { below } else { above };
    height * libm::exp(-0.5 * t * t)
}

fn rgb(xyz: [f64; 3]) -> [f64; 3] {
    RGB_FROM_XYZ.map(|row| row.iter().zip(xyz).map(|(a, b)| a * b).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lobes follow the functions to a hundredth of their height (their paper's figure 3).
    const FIT: f64 = 0.01;

    #[test]
    fn daylight_is_white() {
        let [x, y, z] = integral(daylight);
        // CIE 15:2004, table T.3: x 0.3127, y 0.3290.
        assert!((x / (x + y + z) - 0.3127).abs() < FIT && (y / (x + y + z) - 0.3290).abs() < FIT);
    }

    #[test]
    fn even_spectra_are_grey_and_of_their_level() {
        let flat = Spectrum::even(380.0, 780.0, &[0.5; 9]).unwrap();
        for channel in flat.colour(Of::Surface).0 {
            assert!((channel - 0.5).abs() < 1e-12, "{channel}");
        }
        let light = flat.colour(Of::Light);
        assert!((light.luminance() - 0.5).abs() < 1e-12);
        // What Mitsuba makes of equal energy.
        for (found, due) in light.0.iter().zip([1.2048, 0.9483, 0.9089]) {
            assert!((found / 0.5 - due).abs() < 2.0 * FIT, "{light:?}");
        }
    }

    #[test]
    fn red_is_red() {
        let red = Spectrum::new(vec![[600.0, 0.0], [601.0, 0.8], [780.0, 0.8]]).unwrap();
        let Rgb([r, g, b]) = red.colour(Of::Surface);
        assert!(r > 0.5 && g < 0.1 && b < 0.01, "{r} {g} {b}");
        assert!(Spectrum::new(vec![[500.0, 1.0], [400.0, 1.0]]).is_none());
        assert!(Spectrum::even(400.0, 700.0, &[]).is_none());
    }
}
