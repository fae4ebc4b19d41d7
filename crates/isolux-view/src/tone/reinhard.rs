//! The photographic operator of Reinhard et al. 2002.

use isolux::units::Rgb;

/// Equation 4 on luminance.
pub(super) fn show(exposed: Rgb, white: f64) -> Rgb {
    let luminance = exposed.luminance();
    if luminance >= white {
        // Past its white the curve goes on above 1; the hue is then all that is left to keep.
        return exposed * (1.0 / luminance);
    }
    exposed * ((1.0 + luminance / (white * white)) / (1.0 + luminance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equation_4() {
        let at = |x: f64| show(Rgb::grey(x), 4.0).0[0];
        for (exposed, expected) in [(1.0, (1.0 + 1.0 / 16.0) / 2.0), (4.0, 1.0), (0.18, 0.154258)] {
            // The last expected value is rounded to six places.
            assert!((at(exposed) - expected).abs() < 1e-6, "{exposed}");
        }
    }
}
