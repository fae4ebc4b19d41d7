//! Three channels in 32 bits with one exponent: VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, as the Vulkan specification and
//! EXT_texture_shared_exponent define it.

const MANTISSA_BITS: i32 = 9;
const BIAS: i32 = 15;
const LARGEST_EXPONENT: i32 = 31;
/// The largest number: 511/512 times 2 to the 16th.
pub(super) const LARGEST: f64 = 65_408.0;

/// The nearest that can be had, channels cut between nothing and [`LARGEST`].
pub(crate) fn encode(rgb: [f64; 3]) -> u32 {
    // NaN is nothing.
    let rgb = rgb.map(|c| if c > 0.0 { c.min(LARGEST) } else { 0.0 });
    let largest = rgb[0].max(rgb[1]).max(rgb[2]);
    let preliminary = libm::frexp(largest).1.max(-BIAS) + BIAS;
    let scale = |exponent: i32| libm::exp2(f64::from(exponent - BIAS - MANTISSA_BITS));
    // Rounding up may need one bit more.
    let rounds_up = (largest / scale(preliminary) + 0.5).floor() >= f64::from(1 << MANTISSA_BITS);
    let exponent = (preliminary + i32::from(rounds_up)).min(LARGEST_EXPONENT);
    let [r, g, b] = rgb.map(|c| (c / scale(exponent) + 0.5).floor() as u32);
    r | g << 9 | b << 18 | (exponent as u32) << 27
}

#[cfg(test)]
pub(super) fn decode(bits: u32) -> [f64; 3] {
    let exponent = (bits >> 27) as i32;
    let scale = (f64::from(exponent - BIAS - MANTISSA_BITS)).exp2();
    [0, 9, 18].map(|shift| f64::from(bits >> shift & 0x1ff) * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_channel_keeps_nine_bits() {
        for value in [1e-6, 0.01, 0.7, 1.0, 1.999, 255.75, 500.0, 12_345.0, 65_408.0] {
            let [r, g, b] = decode(encode([value, 0.5 * value, 0.0]));
            // Half a step of 256 or more, but for the smallest numbers, whose exponent cannot fall further.
            let step = value.max(2_f64.powi(-16)) / 256.0;
            assert!((r - value).abs() <= 0.5 * step, "{value}: {r}");
            assert!((g - 0.5 * value).abs() <= 0.5 * step && b == 0.0);
        }
        assert_eq!(decode(encode([f64::NAN, -1.0, 1e9])), [0.0, 0.0, LARGEST]);
    }
}
