//! Radiance's HDR pictures (`.hdr`, `.pic`): RGBE in rows from the top, run by run or as they are.
//!
//! The format is that of G. Ward, "Real pixels", Graphics Gems II (1991), and of Radiance's "File Formats". A mantissa `m` and the exponent `e` stand
//! for `(m + 1/2) 2^(e - 136)`.

use super::pixels::{Pixels, check_size};

/// Bytes of a header.
const MOST_HEAD: usize = 1 << 16;
/// Widths whose rows may be coded channel by channel.
const CHANNEL_WIDTHS: std::ops::RangeInclusive<u32> = 8..=0x7fff;
const ENDS: &str = "ends within its pixels";

/// Pixels, divided by what the header says they were multiplied by. The file does not say what they are measured in.
pub(super) fn decode(bytes: &[u8]) -> Result<(Pixels, Option<f64>), String> {
    let mut rest = bytes;
    let mut exposure = 1.0;
    let first = line(&mut rest)?;
    if !first.starts_with("#?") {
        return Err("is neither OpenEXR nor Radiance HDR".to_owned());
    }
    loop {
        let line = line(&mut rest)?;
        if line.is_empty() {
            break;
        }
        if let Some(format) = line.strip_prefix("FORMAT=")
            && format.trim() != "32-bit_rle_rgbe"
        {
            return Err(format!("is of the format `{}`, not 32-bit_rle_rgbe", shown(format)));
        }
        if let Some(value) = line.strip_prefix("EXPOSURE=") {
            let value = value.trim().parse().ok().filter(|v: &f64| *v > 0.0 && v.is_finite());
            exposure *= value.ok_or("has an exposure that is no number")?;
        }
    }
    let size = line(&mut rest)?;
    let words: Vec<&str> = size.split_whitespace().collect();
    let ["-Y", height, "+X", width] = words[..] else {
        return Err(format!("has rows in the order `{}`, not `-Y HEIGHT +X WIDTH`", shown(&size)));
    };
    let side = |word: &str| word.parse().map_err(|_| format!("has a side of `{}`", shown(word)));
    let (width, height) = check_size(side(width)?, side(height)?)?;
    let scale = 1.0 / exposure;
    let mut rgb = Vec::new();
    for _ in 0..height {
        let row = row(&mut rest, width)?;
        rgb.extend(row.into_iter().map(|code| value(code).map(|c| (c * scale) as f32)));
    }
    Ok((Pixels { width, height, rgb }, None))
}

fn shown(text: &str) -> String {
    text.trim().chars().take(40).collect()
}

/// A line of the header without its end.
fn line(rest: &mut &[u8]) -> Result<String, String> {
    let end = rest.iter().take(MOST_HEAD).position(|&b| b == b'\n');
    let end = end.ok_or("has no header of a Radiance picture")?;
    let text = String::from_utf8_lossy(&rest[..end]).trim_end_matches('\r').to_owned();
    *rest = &rest[end + 1..];
    Ok(text)
}

fn take<'a>(rest: &mut &'a [u8], count: usize) -> Result<&'a [u8], String> {
    let (taken, left) = rest.split_at_checked(count).ok_or(ENDS)?;
    *rest = left;
    Ok(taken)
}

fn row(rest: &mut &[u8], width: u32) -> Result<Vec<[u8; 4]>, String> {
    let is_by_channel = CHANNEL_WIDTHS.contains(&width)
        && rest.len() >= 4
        && rest[..2] == [2, 2]
        && u32::from(rest[2]) << 8 | u32::from(rest[3]) == width;
    if is_by_channel { by_channel(rest, width as usize) } else { by_pixel(rest, width as usize) }
}

fn by_channel(rest: &mut &[u8], width: usize) -> Result<Vec<[u8; 4]>, String> {
    take(rest, 4)?;
    let mut codes = vec![[0; 4]; width];
    for channel in 0..4 {
        let mut x = 0;
        while x < width {
            let count = usize::from(take(rest, 1)?[0]);
            let (length, is_run) = if count > 128 { (count - 128, true) } else { (count, false) };
            if length == 0 || x + length > width {
                return Err("has a run beyond its row".to_owned());
            }
            let values = take(rest, if is_run { 1 } else { length })?;
            for (k, code) in codes[x..x + length].iter_mut().enumerate() {
                code[channel] = values[if is_run { 0 } else { k }];
            }
            x += length;
        }
    }
    Ok(codes)
}

/// Pixels one by one; mantissas of 1, 1, 1 repeat the pixel before as often as the exponent says.
fn by_pixel(rest: &mut &[u8], width: usize) -> Result<Vec<[u8; 4]>, String> {
    let mut codes: Vec<[u8; 4]> = Vec::new();
    let mut shift = 0;
    while codes.len() < width {
        let taken = take(rest, 4)?;
        let code = [taken[0], taken[1], taken[2], taken[3]];
        if code[..3] != [1, 1, 1] {
            codes.push(code);
            shift = 0;
            continue;
        }
        let last = *codes.last().ok_or("repeats a pixel that is not there")?;
        let count = usize::from(code[3]).checked_shl(shift).unwrap_or(usize::MAX);
        if count > width - codes.len() {
            return Err("has a run beyond its row".to_owned());
        }
        codes.extend(std::iter::repeat_n(last, count));
        // A run of nothing would go on without end.
        shift = (shift + 8).min(usize::BITS);
    }
    Ok(codes)
}

fn value([r, g, b, e]: [u8; 4]) -> [f64; 3] {
    if e == 0 {
        return [0.0; 3];
    }
    [r, g, b].map(|m| libm::ldexp(f64::from(m) + 0.5, i32::from(e) - 136))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::luminance::{Luminances, encode_radiance};

    /// A mantissa has eight bits.
    #[test]
    fn what_is_written_is_read() {
        for width in [3, 9, 300] {
            let pixel = |k: u32| [1.0 + k as f32, 0.5 * k as f32, 1e-3];
            let rgb: Vec<[f32; 3]> = (0..2 * width).map(pixel).collect();
            let bytes = encode_radiance(&Luminances { width, height: 2, rgb_cd_m2: &rgb }).unwrap();
            let (read, unit) = decode(&bytes).unwrap();
            assert_eq!((read.width, read.height, unit), (width, 2, None));
            for (found, expected) in read.rgb.iter().zip(&rgb) {
                for (found, wanted) in found.iter().zip(expected) {
                    // The exposure of 179 says that watts are meant.
                    assert!(
                        (found * 179.0 - wanted).abs() <= expected[0] / 250.0,
                        "{found} {wanted}"
                    );
                }
            }
            for cut in [bytes.len() - 1, bytes.len() / 2, 20, 0] {
                assert!(decode(&bytes[..cut]).is_err());
            }
        }
    }

    #[test]
    fn runs_of_both_kinds() {
        let head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
        let old = [&head[..], b"-Y 1 +X 4\n", &[128, 64, 32, 129], &[1, 1, 1, 3]].concat();
        let (read, _) = decode(&old).unwrap();
        assert_eq!(read.rgb, [[1.003_906_3, 0.503_906_25, 0.253_906_25]; 4]);
        let runs = [2, 2, 0, 8, 136, 128, 136, 64, 136, 32, 136, 129];
        let new = [&head[..], b"-Y 1 +X 8\n", &runs].concat();
        assert_eq!(decode(&new).unwrap().0.rgb, [[1.003_906_3, 0.503_906_25, 0.253_906_25]; 8]);
        for bad in [&b"-Y 1 +X 2\n\x01\x01\x01\x02"[..], b"-Y 1 +X 1\n\x80\x80", b"+Y 1 +X 1\nabcd"]
        {
            assert!(decode(&[&head[..], bad].concat()).is_err());
        }
        let many = [&head[..], b"-Y 4000000000 +X 4000000000\n"].concat();
        assert!(decode(&many).is_err_and(|what| what.contains("pixels")));
    }
}
