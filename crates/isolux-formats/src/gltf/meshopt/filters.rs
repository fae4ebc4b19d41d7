//! What is done to attributes after decompression (appendix B of KHR_meshopt_compression).

/// Elements of four signed numbers of 8 or 16 bits (`stride` 4 or 8), each replaced.
fn map_elements(bytes: &mut [u8], stride: usize, change: impl Fn([i32; 4], i32) -> [i32; 4]) {
    if stride == 4 {
        for element in bytes.as_chunks_mut::<4>().0 {
            let new = change(element.map(|byte| i32::from(byte as i8)), i32::from(i8::MAX));
            *element = new.map(|c| c as u8);
        }
    } else {
        for element in bytes.as_chunks_mut::<8>().0 {
            let words = *element.as_chunks::<2>().0.first_chunk::<4>().unwrap_or(&[[0; 2]; 4]);
            let old = words.map(|word| i32::from(i16::from_le_bytes(word)));
            let new = change(old, i32::from(i16::MAX)).map(|c| (c as u16).to_le_bytes());
            element.copy_from_slice(new.as_flattened());
        }
    }
}

/// Halves away from zero; what is no number becomes 0, as the result of invalid input may be anything.
fn rounded(value: f64) -> i32 {
    libm::round(value) as i32
}

/// Unit vectors from the faces of an octahedron; the third number is 1 in the precision of the first two.
pub(super) fn octahedral(bytes: &mut [u8], stride: usize) {
    map_elements(bytes, stride, |[x, y, one, rest], full| {
        let (x, y) = (f64::from(x) / f64::from(one), f64::from(y) / f64::from(one));
        let z = 1.0 - x.abs() - y.abs();
        // The lower half is folded out.
        let fold = z.min(0.0);
        let (x, y) = (x - libm::copysign(fold, x), y - libm::copysign(fold, y));
        let scale = f64::from(full) / (x * x + y * y + z * z).sqrt();
        [rounded(x * scale), rounded(y * scale), rounded(z * scale), rest]
    });
}

/// Unit quaternions from their three smaller components; the lowest two bits of the fourth number name
/// the largest one.
pub(super) fn quaternion(bytes: &mut [u8]) {
    map_elements(bytes, 8, |[x, y, z, last], full| {
        let range = std::f64::consts::FRAC_1_SQRT_2 / f64::from(last | 3);
        let [x, y, z] = [x, y, z].map(|c| f64::from(c) * range);
        let largest = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
        let mut new = [0; 4];
        let at = (last & 3) as usize;
        for (step, component) in [largest, x, y, z].into_iter().enumerate() {
            new[(at + step) % 4] = rounded(component * f64::from(full));
        }
        new
    });
}

/// Floats from 24 bits of mantissa and 8 of exponent.
pub(super) fn exponential(bytes: &mut [u8]) {
    for word in bytes.as_chunks_mut::<4>().0 {
        let packed = i32::from_le_bytes(*word);
        let (exponent, mantissa) = (packed >> 24, packed << 8 >> 8);
        *word = (libm::ldexp(f64::from(mantissa), exponent) as f32).to_le_bytes();
    }
}

/// Red, green, blue and alpha from luma and chroma; the highest bit of alpha tells the precision.
pub(super) fn colour(bytes: &mut [u8], stride: usize) {
    let bits = 2 * stride as u32;
    let full = (1_u32 << bits) - 1;
    map_elements(bytes, stride, |[y, co, cg, alpha], _| {
        let (y, alpha) = (y as u32 & full, alpha as u32 & full);
        // All bits up to the highest one of alpha, which is never 0 in a sound file.
        let one = (1_u32 << (32 - alpha.max(1).leading_zeros())) - 1;
        let y = y as i32;
        // One bit is the mark; the lowest of the others is doubled in its place.
        let share = alpha & (one >> 1);
        let alpha = ((share << 1) | (share & 1)) as i32;
        let scale = f64::from(full) / f64::from(one);
        [y + co - cg, y + cg, y - co - cg, alpha].map(|c| rounded(f64::from(c) * scale))
    });
}
