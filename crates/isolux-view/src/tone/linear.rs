//! Brightness and contrast.

use crate::srgb::{linear_from_signal, signal_from_linear};

/// The signal that contrast leaves as it is.
const MIDDLE: f64 = 0.5;

/// The two knobs of a monitor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knobs {
    pub(super) brightness: f64,
    pub(super) contrast: f64,
}

impl Knobs {
    pub(super) fn do_nothing(self) -> bool {
        self.brightness == 0.0 && self.contrast == 1.0
    }

    /// A channel, display-linear, with the knobs turned. What is brighter than white comes down to white where contrast is
    /// low, so it is not cut off before.
    pub(super) fn turn(self, value: f64) -> f64 {
        let signal = signal_from_linear(value);
        let turned = MIDDLE + self.contrast * (signal - MIDDLE) + self.brightness;
        linear_from_signal(turned.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(knobs: Knobs, signal: f64, expected: f64) {
        let got = signal_from_linear(knobs.turn(linear_from_signal(signal)));
        // The two branches of the transfer function meet to within 3e-8 of each other (IEC 61966-2-1 prints four digits).
        assert!((got - expected).abs() < 1e-7, "{got} for {expected}");
    }

    #[test]
    fn contrast_turns_about_the_middle_and_brightness_adds() {
        let contrast = Knobs { brightness: 0.0, contrast: 1.5 };
        check(contrast, 0.5, 0.5);
        check(contrast, 0.7, 0.8);
        check(contrast, 0.3, 0.2);
        check(contrast, 0.1, 0.0);
        check(Knobs { brightness: 0.2, contrast: 1.0 }, 0.3, 0.5);
        check(Knobs { brightness: -0.2, contrast: 0.5 }, 1.0, 0.55);
    }

    #[test]
    fn low_contrast_brings_highlights_back() {
        check(Knobs { brightness: 0.0, contrast: 0.5 }, 1.4, 0.95);
    }
}
