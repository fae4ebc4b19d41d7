//! Pictures that scale a reflectance.

use crate::units::Rgb;
use serde::{Deserialize, Serialize};

/// A picture of sRGB bytes, read as linear reflectance, repeated beyond its borders.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Texture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Three bytes a pixel, sRGB transfer function (IEC 61966-2-1), rows from the top.
    pub srgb: Vec<u8>,
}

impl Texture {
    /// Bilinear value at texture coordinates: `u` to the right, `v` downwards, both repeating.
    pub fn value(&self, u: f64, v: f64) -> Rgb {
        let x = (u - u.floor()) * f64::from(self.width) - 0.5;
        let y = (v - v.floor()) * f64::from(self.height) - 0.5;
        let (x0, y0) = (x.floor(), y.floor());
        let (fx, fy) = (x - x0, y - y0);
        let at = |dx: i64, dy: i64| self.pixel(x0 as i64 + dx, y0 as i64 + dy);
        (at(0, 0) * (1.0 - fx) + at(1, 0) * fx) * (1.0 - fy)
            + (at(0, 1) * (1.0 - fx) + at(1, 1) * fx) * fy
    }

    /// The mean over all pixels.
    pub fn mean(&self) -> Rgb {
        let count = self.srgb.len() / 3;
        let sum: Rgb = (0..count).map(|k| self.linear(k)).sum();
        sum / count.max(1) as f64
    }

    /// The greatest value that any pixel has, channel by channel.
    pub fn brightest(&self) -> Rgb {
        let mut codes = [0; 3];
        for pixel in self.srgb.chunks_exact(3) {
            codes.iter_mut().zip(pixel).for_each(|(most, &code)| *most = code.max(*most));
        }
        Rgb(codes.map(linear_from_srgb))
    }

    fn pixel(&self, x: i64, y: i64) -> Rgb {
        let x = x.rem_euclid(i64::from(self.width)) as usize;
        let y = y.rem_euclid(i64::from(self.height)) as usize;
        self.linear(y * self.width as usize + x)
    }

    fn linear(&self, pixel: usize) -> Rgb {
        let channel = |k: usize| linear_from_srgb(self.srgb[3 * pixel + k]);
        Rgb::new(channel(0), channel(1), channel(2))
    }
}

/// IEC 61966-2-1, through a table of the 256 codes.
fn linear_from_srgb(code: u8) -> f64 {
    static TABLE: std::sync::LazyLock<[f64; 256]> = std::sync::LazyLock::new(|| {
        std::array::from_fn(|code| {
            let c = code as f64 / 255.0;
            if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
        })
    });
    TABLE[usize::from(code)]
}
