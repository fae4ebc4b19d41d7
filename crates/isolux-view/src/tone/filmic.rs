//! A straight line with a shoulder: the look of a well exposed photograph of a room.

/// Exposure before the curve: 1.3 stops above middle grey. Photographers expose rooms so that white walls are white in the picture and
/// not grey. Walls of an office with a reflectance of 0.6 have 1.5 to 2 times the log-average, and are shown with codes of sRGB from 209
/// to 221.
const BIAS: f64 = 2.5;
/// Up to here what is shown is proportional to luminance.
const KNEE: f64 = 0.5;
/// What is shown as white, after the bias: 5 stops above the log-average, where luminaires are.
const WHITE: f64 = 16.0;

/// One channel. Above the knee the curve goes on as equation 4 of Reinhard, Stark, Shirley, Ferwerda 2002 does from nought, without a
/// kink.
pub(super) fn show(exposed: f64) -> f64 {
    let x = BIAS * exposed;
    if x <= KNEE {
        return x;
    }
    let left = 1.0 - KNEE;
    let (above, white) = ((x - KNEE) / left, (WHITE - KNEE) / left);
    if above >= white {
        // Past its white the curve goes on above 1.
        return above / white;
    }
    KNEE + left * above * (1.0 + above / (white * white)) / (1.0 + above)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(exposed: f64, expected: f64) {
        // Expected values have five digits.
        assert!((show(exposed) - expected).abs() < 1e-5, "{} for {expected}", show(exposed));
    }

    #[test]
    fn proportional_to_the_knee_and_white_at_white() {
        check(0.18, 0.45);
        check(KNEE / BIAS, KNEE);
        // x = 1: above = 1, white = 31, 0.5 + 0.5 (1 + 1 / 31^2) / 2.
        check(1.0 / BIAS, 0.750_26);
        check(WHITE / BIAS, 1.0);
    }

    #[test]
    fn there_is_no_kink_at_the_knee() {
        let (at, step) = (KNEE / BIAS, 1e-6);
        let slopes = [at - step, at].map(|x| (show(x + step) - show(x)) / step);
        // The second derivative after the knee is 2 BIAS^2 / (1 - KNEE), here 25, a step of it 2.5e-5.
        assert!((slopes[0] - slopes[1]).abs() < 1e-4, "{slopes:?}");
    }
}
