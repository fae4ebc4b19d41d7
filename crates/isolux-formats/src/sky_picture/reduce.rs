//! Fewer pixels of the same light.

use isolux::photometry::SkyPicture;
use std::f64::consts::PI;

/// Parts of a row of pixels, or of a column, that a pixel of the result is made of: the first and their weights.
struct Span {
    first: usize,
    weights: Vec<f64>,
}

/// The picture with at most so many pixels. Each is the mean of what it covers by solid angle.
pub(super) fn reduced(picture: SkyPicture, [most_wide, most_high]: [u32; 2]) -> SkyPicture {
    let (width, height) = (picture.width.min(most_wide), picture.height.min(most_high));
    if (width, height) == (picture.width, picture.height) {
        return picture;
    }
    let columns = spans(picture.width, width, |at| at);
    // The solid angle between two rows is the difference of their heights.
    let rows = spans(picture.height, height, |at| -libm::cos(PI * at));
    let stride = picture.width as usize;
    let mut rgb_cd_m2 = Vec::with_capacity(width as usize * height as usize);
    for row in &rows {
        for column in &columns {
            let mut sum = [0.0; 3];
            for (y, of_row) in (row.first..).zip(&row.weights) {
                for (x, of_column) in (column.first..).zip(&column.weights) {
                    let pixel = picture.rgb_cd_m2[y * stride + x];
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += of_row * of_column * f64::from(value);
                    }
                }
            }
            rgb_cd_m2.push(sum.map(|value| value as f32));
        }
    }
    SkyPicture { width, height, rgb_cd_m2 }
}

/// For each of `to` pixels the parts of `from` pixels under it; the weights of one add up to 1. `measure` rises with the share of the way.
fn spans(from: u32, to: u32, measure: fn(f64) -> f64) -> Vec<Span> {
    let (from_count, to_count) = (f64::from(from), f64::from(to));
    let of = |index: u32| {
        let (begin, end) = (f64::from(index) / to_count, f64::from(index + 1) / to_count);
        let first = (begin * from_count) as usize;
        let last = ((end * from_count).ceil() as usize).min(from as usize);
        let whole = measure(end) - measure(begin);
        let part = |k: usize| {
            let low = (k as f64 / from_count).max(begin);
            let high = ((k + 1) as f64 / from_count).min(end);
            (measure(high.max(low)) - measure(low)) / whole
        };
        Span { first, weights: (first..last).map(part).collect() }
    };
    (0..to).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32) -> SkyPicture {
        let value = |k: u32| {
            let noise = f64::from(k.wrapping_mul(2_654_435_761) >> 16) / 65_536.0;
            [noise as f32, (noise * noise) as f32, 1.0]
        };
        SkyPicture { width, height, rgb_cd_m2: (0..width * height).map(value).collect() }
    }

    fn light(picture: &SkyPicture) -> [f64; 3] {
        let of_row = |(y, row): (u32, &[[f32; 3]])| {
            let [top, below] =
                [y, y + 1].map(|k| libm::cos(PI * f64::from(k) / f64::from(picture.height)));
            let sum =
                row.iter().fold([0.0; 3], |sum, rgb| [0, 1, 2].map(|c| sum[c] + f64::from(rgb[c])));
            sum.map(|c| c * (top - below) * 2.0 * PI / f64::from(picture.width))
        };
        let rows = (0..picture.height).zip(picture.rgb_cd_m2.chunks(picture.width as usize));
        rows.map(of_row).fold([0.0; 3], |sum, row| [0, 1, 2].map(|c| sum[c] + row[c]))
    }

    /// Pixels are in single precision.
    #[test]
    fn all_light_is_kept() {
        for [width, height] in [[40, 20], [64, 32], [33, 17], [31, 50]] {
            let whole = picture(width, height);
            let small = reduced(whole.clone(), [16, 8]);
            assert_eq!((small.width, small.height, small.rgb_cd_m2.len()), (16, 8, 128));
            for (found, expected) in light(&small).into_iter().zip(light(&whole)) {
                assert!(
                    (found / expected - 1.0).abs() < 1e-6,
                    "{width} {height}: {found} {expected}"
                );
            }
        }
        let small = picture(8, 4);
        assert_eq!(reduced(small.clone(), [16, 8]), small);
    }
}
