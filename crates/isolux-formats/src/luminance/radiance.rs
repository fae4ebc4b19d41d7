//! Radiance's HDR pictures (`.hdr`): RGBE, three mantissas of eight bits with one exponent.

use super::{LuminanceError, Luminances, MEANING};

/// The luminous efficacy by which Radiance makes luminance of radiance, lm/W (`WHTEFFICACY`).
const RADIANCE_LM_W: f64 = 179.0;
/// Widths that Radiance codes run by run (`MINELEN`, `MAXELEN` of its `color.c`).
const RUN_CODED: std::ops::RangeInclusive<u32> = 8..=0x7fff;
/// The most pixels in one piece of a row that is written as it is.
const LITERAL: usize = 128;

/// The bytes of a Radiance picture. Its values are in cd/m2, and `EXPOSURE=179` says so to Radiance, whose tools divide by it and
/// multiply by 179 lm/W: they tell the same cd/m2. Values have a precision of 1 %. Rows are coded in the form of Radiance's own
/// files, without runs.
pub fn encode(picture: &Luminances<'_>) -> Result<Vec<u8>, LuminanceError> {
    picture.check()?;
    let Luminances { width, height, rgb_cd_m2 } = *picture;
    let head = format!(
        "#?RADIANCE\nSOFTWARE=isolux {}\n# {MEANING}\nFORMAT=32-bit_rle_rgbe\nEXPOSURE={RADIANCE_LM_W}\n\
         PRIMARIES=0.6400 0.3300 0.3000 0.6000 0.1500 0.0600 0.3127 0.3290\n\n-Y {height} +X {width}\n",
        env!("CARGO_PKG_VERSION")
    );
    let mut bytes = head.into_bytes();
    for row in rgb_cd_m2.chunks(width as usize) {
        let codes: Vec<[u8; 4]> = row.iter().map(|&rgb| rgbe(rgb)).collect();
        if !RUN_CODED.contains(&width) {
            bytes.extend(codes.iter().flatten());
            continue;
        }
        bytes.extend([2, 2, (width >> 8) as u8, (width & 0xff) as u8]);
        for channel in 0..4 {
            for piece in codes.chunks(LITERAL) {
                bytes.push(piece.len() as u8);
                bytes.extend(piece.iter().map(|code| code[channel]));
            }
        }
    }
    Ok(bytes)
}

/// Mantissas and exponent of a pixel: a mantissa `m` and the exponent `e` stand for `(m + 1/2) 2^(e - 136)`. Mantissas are cut off, as
/// the reader adds the half.
fn rgbe(rgb: [f32; 3]) -> [u8; 4] {
    let [r, g, b] = rgb.map(|value| f64::from(value).max(0.0));
    let most = r.max(g).max(b);
    // Less than that, and what is no number, is black.
    if !(most > 1e-32 && most.is_finite()) {
        return [0; 4];
    }
    let (_, exponent) = libm::frexp(most);
    if exponent > 127 {
        return [255; 4];
    }
    let mantissa = |value: f64| libm::ldexp(value, 8 - exponent) as u8;
    [mantissa(r), mantissa(g), mantissa(b), (exponent + 128) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value([r, g, b, e]: [u8; 4]) -> [f64; 3] {
        [r, g, b].map(|m| libm::ldexp(f64::from(m) + 0.5, i32::from(e) - 136))
    }

    #[test]
    fn pixels_keep_one_per_cent() {
        for rgb in [[1.0, 0.5, 0.25], [123.4, 119.0, 99.9], [3e-5, 2e-5, 2.5e-5], [7e9, 7e9, 7e9]] {
            let found = value(rgbe(rgb));
            for (found, wanted) in found.into_iter().zip(rgb) {
                let most = f64::from(rgb[0]);
                // Half a step of a mantissa from 128 on.
                assert!((found - f64::from(wanted)).abs() <= most / 255.0, "{found} for {wanted}");
            }
        }
        for black in [[0.0; 3], [f32::NAN; 3], [-1.0; 3]] {
            assert_eq!(rgbe(black), [0; 4]);
        }
    }

    #[test]
    fn rows_are_as_long_as_they_say() {
        for width in [1, 7, 8, 300] {
            let rgb_cd_m2 = &vec![[2.0, 1.0, 0.5]; 2 * width as usize];
            let bytes = encode(&Luminances { width, height: 2, rgb_cd_m2 }).unwrap();
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let head = format!("\n\n-Y 2 +X {width}\n");
            assert!(text.starts_with("#?RADIANCE\n") && text.contains(&head), "{text}");
            let start = bytes.windows(head.len()).position(|w| w == head.as_bytes()).unwrap();
            let body = &bytes[start + head.len()..];
            let pieces = (width as usize).div_ceil(LITERAL);
            let row =
                if width < 8 { 4 * width as usize } else { 4 + 4 * (width as usize + pieces) };
            assert_eq!(body.len(), 2 * row, "{width}");
        }
    }
}
