//! What glares in daylight.

/// Luminance from which on a pixel is a source of glare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Threshold {
    /// A luminance, cd/m2.
    Luminance(f64),
    /// A multiple of the mean luminance of the view.
    OfMean(f64),
}

/// As `2000`, or as `5x` for five times the mean.
pub(crate) fn glare_threshold(text: &str) -> Result<Threshold, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    let text = text.trim();
    match text.strip_suffix('x') {
        Some(factor) => match number(factor) {
            Some(factor) if (1.0..=100.0).contains(&factor) => Ok(Threshold::OfMean(factor)),
            _ => Err("must be 1x to 100x of the mean luminance; 5x is usual".into()),
        },
        None => match number(text) {
            Some(cd_m2) if (100.0..=1e6).contains(&cd_m2) => Ok(Threshold::Luminance(cd_m2)),
            Some(_) => Err(
                "must be from 100 to 1000000 cd/m2; 2000 is usual, and 5x is five times the mean"
                    .into(),
            ),
            None => Err("not a luminance; write 2000, or 5x for five times the mean".into()),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn luminances_and_factors() {
        assert_eq!(glare_threshold("2000"), Ok(Threshold::Luminance(2000.0)));
        assert_eq!(glare_threshold(" 5x "), Ok(Threshold::OfMean(5.0)));
        for bad in ["", "x", "5", "0x", "1000x", "nan", "inf", "-3", "5y"] {
            assert!(glare_threshold(bad).is_err(), "{bad}");
        }
    }
}
