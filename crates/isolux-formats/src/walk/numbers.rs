//! Numbers in few bits: what is shown needs no more.

use isolux::units::Rgb;

/// Bits of a channel of a colour with a shared exponent.
const MANTISSA_BITS: i32 = 9;
/// What is added to exponents.
const BIAS: i32 = 15;
/// The largest value of a channel: 511 / 512 x 2^16.
const LARGEST: f64 = 65_408.0;

/// Three channels of 9 bits with an exponent of 5 bits in common (`EXT_texture_shared_exponent` of OpenGL), from 0 to
/// 65,408: the largest channel is known to 0.2 %. What is negative is zero here.
pub(super) fn shared_exponent(colour: Rgb) -> u32 {
    let channels = colour.0.map(|c| if c > 0.0 { c.min(LARGEST) } else { 0.0 });
    let largest = channels.iter().fold(0.0, |a: f64, b| a.max(*b));
    if largest == 0.0 {
        return 0;
    }
    let floor = (libm::floor(libm::log2(largest)) as i32).max(-BIAS - 1) + 1 + BIAS;
    let step = |exponent: i32| libm::exp2(f64::from(exponent - BIAS - MANTISSA_BITS));
    let is_full = libm::round(largest / step(floor)) >= f64::from(1 << MANTISSA_BITS);
    let exponent = if is_full { floor + 1 } else { floor };
    let [r, g, b] = channels.map(|c| libm::round(c / step(exponent)) as u32);
    r | g << 9 | b << 18 | (exponent as u32) << 27
}

/// A half float (IEEE 754 binary16), to the nearest; infinite beyond 65,504.
pub(super) fn half(value: f64) -> u16 {
    const INFINITE: u16 = 0x7C00;
    if value.is_nan() {
        return 0x7E00;
    }
    let sign = if value.is_sign_negative() { 0x8000 } else { 0 };
    let size = value.abs();
    if size >= 65_520.0 {
        return sign | INFINITE;
    }
    // Below the normal numbers steps are even.
    let exponent = if size > 0.0 { (libm::floor(libm::log2(size)) as i32).max(-14) } else { -14 };
    let steps = libm::rint(size / libm::exp2(f64::from(exponent - 10))) as u16;
    // A mantissa that is rounded up to the next power carries into the exponent by itself.
    let bits = if steps < 1024 { steps } else { ((exponent + 14) as u16) * 1024 + steps };
    sign | bits
}

/// An octahedral normal (Meyer et al. 2010, "On floating-point normal vectors"; Cigolle et al. 2014): two bytes.
pub(super) fn octahedral(normal: [f64; 3]) -> [i8; 2] {
    let sum: f64 = normal.iter().map(|c| c.abs()).sum();
    if sum == 0.0 || !sum.is_finite() {
        return [0, 0];
    }
    let [x, y, z] = normal.map(|c| c / sum);
    let signed = |value: f64, like: f64| if like >= 0.0 { value } else { -value };
    let [u, v] =
        if z >= 0.0 { [x, y] } else { [signed(1.0 - y.abs(), x), signed(1.0 - x.abs(), y)] };
    [u, v].map(|c| libm::round(c * 127.0) as i8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unpacked(bits: u32) -> [f64; 3] {
        let scale = libm::exp2(f64::from((bits >> 27) as i32 - BIAS - MANTISSA_BITS));
        [0, 9, 18].map(|shift| f64::from(bits >> shift & 511) * scale)
    }

    #[test]
    fn colours_keep_their_largest_channel() {
        let scales = (-14..16).map(|e| libm::exp2(f64::from(e)));
        for scale in scales.flat_map(|s| [s, s * 1.37, s * 1.999_9]) {
            let got = unpacked(shared_exponent(Rgb::new(scale, 0.5 * scale, 0.01 * scale)));
            // Half a step of 9 bits, of the largest channel.
            let allowed = scale.min(LARGEST) / 511.0;
            for (got, wanted) in got.iter().zip([1.0, 0.5, 0.01]) {
                assert!((got - (wanted * scale).min(LARGEST)).abs() <= allowed, "{scale}: {got}");
            }
        }
        assert_eq!(shared_exponent(Rgb::new(-1.0, 0.0, f64::NAN)), 0);
        assert_eq!(unpacked(shared_exponent(Rgb::grey(1e9))), [LARGEST; 3]);
    }

    #[test]
    fn halves_are_those_of_the_standard() {
        let known = [
            (0.0, 0x0000),
            (1.0, 0x3C00),
            (1.5, 0x3E00),
            (-2.0, 0xC000),
            (65_504.0, 0x7BFF),
            (65_520.0, 0x7C00),
            (f64::INFINITY, 0x7C00),
            (6.103_515_625e-5, 0x0400),
            (5.960_464_477_539_063e-8, 0x0001),
            (1.0 / 3.0, 0x3555),
            (0.999_9, 0x3C00),
        ];
        for (value, bits) in known {
            assert_eq!(half(value), bits, "{value}");
        }
        assert!(half(f64::NAN) & 0x7C00 == 0x7C00 && half(f64::NAN) & 0x3FF != 0);
    }

    #[test]
    fn normals_come_back() {
        for normal in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, -0.8, 0.0], [-0.48, 0.6, -0.64]] {
            let [u, v] = octahedral(normal).map(|c| f64::from(c) / 127.0);
            let z = 1.0 - u.abs() - v.abs();
            let fold = (-z).max(0.0);
            let back = [u, v].map(|c| c - c.signum() * fold);
            let length = (back[0] * back[0] + back[1] * back[1] + z * z).sqrt();
            let cos = (back[0] * normal[0] + back[1] * normal[1] + z * normal[2]) / length;
            // A step is a 127th: a degree.
            assert!(cos > 0.9998, "{normal:?}: {cos}");
        }
    }
}
