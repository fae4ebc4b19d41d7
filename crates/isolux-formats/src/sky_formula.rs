//! Skies by formulas of other forms than that of the CIE standard general sky, as pictures.

use isolux::geometry::Direction;
use isolux::photometry::SkyPicture;

/// Half a degree a pixel.
const WIDTH: u32 = 720;
const HEIGHT: u32 = 360;
/// Places along each side of a pixel whose mean it is.
const PLACES: u32 = 2;

/// A picture of a luminance in every direction of the frame of skies, cd/m2.
pub(crate) fn sampled(luminance_cd_m2: impl Fn(Direction) -> f64) -> SkyPicture {
    sampled_in_colour(|towards| [luminance_cd_m2(towards); 3])
}

/// The same of three channels.
pub(crate) fn sampled_in_colour(rgb_cd_m2: impl Fn(Direction) -> [f64; 3]) -> SkyPicture {
    let mut picture = SkyPicture { width: WIDTH, height: HEIGHT, rgb_cd_m2: Vec::new() };
    let place = |pixel: u32, k: u32| f64::from(pixel) + (f64::from(k) + 0.5) / f64::from(PLACES);
    let mut pixels = Vec::with_capacity((WIDTH * HEIGHT) as usize);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let mut sum = [0.0; 3];
            for k in 0..PLACES * PLACES {
                let towards = picture.direction([place(x, k % PLACES), place(y, k / PLACES)]);
                let seen = rgb_cd_m2(towards);
                for (sum, channel) in sum.iter_mut().zip(seen) {
                    *sum += channel;
                }
            }
            pixels.push(sum.map(|channel| (channel / f64::from(PLACES * PLACES)) as f32));
        }
    }
    picture.rgb_cd_m2 = pixels;
    picture
}

/// The traditional overcast sky over its luminance in the zenith: P. Moon and D. E. Spencer, "Illumination from a non-uniform sky", Illuminating
/// Engineering 37 (1942) 707-726.
pub(crate) fn traditional_overcast(towards: Direction) -> f64 {
    (1.0 + 2.0 * towards.to_vector().z.max(0.0)) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// 7/9 of pi times the luminance in the zenith, in closed form. A pixel of half a degree errs by the square of it.
    #[test]
    fn the_traditional_sky_gives_its_illuminance() {
        let picture = sampled(traditional_overcast);
        let found = picture.horizontal_lx();
        assert!((found / (7.0 / 9.0 * PI) - 1.0).abs() < 2e-5, "{found}");
    }
}
