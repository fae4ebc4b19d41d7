//! Surroundings as a picture in equidistant cylindrical projection.

use crate::units::Rgb;
use isolux_geometry::{Direction, Vector};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A picture of everything around. Its first row is at the zenith, its last at the nadir. Columns go from north (the
/// left border) by east, south and west.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SkyPicture {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Luminances row by row from the top, linear Rec. 709, cd/m2.
    pub rgb_cd_m2: Vec<[f32; 3]>,
}

impl SkyPicture {
    /// Luminance in a direction: that of the pixel there, cd/m2.
    pub fn luminance_cd_m2(&self, towards: Direction) -> Rgb {
        let (x, y) = self.pixel(towards);
        let [r, g, b] = self.rgb_cd_m2[y * self.width as usize + x].map(f64::from);
        Rgb::new(r, g, b)
    }

    /// The direction of a place, counted in pixels from the left and from the top.
    pub fn direction(&self, [x, y]: [f64; 2]) -> Direction {
        let (flat, up) = libm::sincos(PI * y / f64::from(self.height));
        let (east, north) = libm::sincos(2.0 * PI * x / f64::from(self.width));
        Vector::new(flat * east, flat * north, up).direction().unwrap_or(Direction::Z)
    }

    /// Illuminance of a horizontal surface by what is above the horizon, lx: exactly that of its pixels.
    pub fn horizontal_lx(&self) -> f64 {
        let of_row = |(y, row): (u32, &[[f32; 3]])| {
            let (top, below) = (self.up(y).max(0.0), self.up(y + 1).max(0.0));
            let sum: f64 = row.iter().map(photometric).sum();
            sum * 0.5 * (top * top - below * below)
        };
        let rows = (0..self.height).zip(self.rgb_cd_m2.chunks(self.width as usize));
        rows.map(of_row).sum::<f64>() * 2.0 * PI / f64::from(self.width)
    }

    fn pixel(&self, towards: Direction) -> (usize, usize) {
        let v = towards.to_vector();
        let from_zenith = libm::acos(v.z.clamp(-1.0, 1.0)) / PI;
        // From north by east: 0 to 1.
        let turn = libm::atan2(v.x, v.y) / (2.0 * PI);
        let turn = if turn < 0.0 { turn + 1.0 } else { turn };
        let at =
            |share: f64, count: u32| ((share * f64::from(count)) as usize).min(count as usize - 1);
        (at(turn, self.width), at(from_zenith, self.height))
    }

    /// Puts in the mean luminance of the pixels whose middles lie in each cell; cells without any stay as they are.
    pub(super) fn put_means(&self, cells: &mut [f64], [rows, columns]: [usize; 2]) {
        let mut sums = vec![[0.0; 2]; cells.len()];
        for y in 0..self.height {
            // Pixels of a row have the same solid angle.
            let (top, below) = (self.up(y), self.up(y + 1));
            let middle = libm::cos(PI * (f64::from(y) + 0.5) / f64::from(self.height));
            let row = (((middle + 1.0) / 2.0 * rows as f64) as usize).min(rows - 1);
            for x in 0..self.width {
                let from_north = (f64::from(x) + 0.5) / f64::from(self.width);
                let from_east = (1.25 - from_north).fract();
                let column = ((from_east * columns as f64) as usize).min(columns - 1);
                let [r, g, b] = self.rgb_cd_m2[(y * self.width + x) as usize].map(f64::from);
                let sum = &mut sums[row * columns + column];
                sum[0] += (top - below) * Rgb::new(r, g, b).luminance();
                sum[1] += top - below;
            }
        }
        for (cell, [sum, weight]) in cells.iter_mut().zip(sums) {
            if weight > 0.0 {
                *cell = sum / weight;
            }
        }
    }

    /// Sine of the elevation of the upper border of a row.
    fn up(&self, row: u32) -> f64 {
        libm::cos(PI * f64::from(row) / f64::from(self.height))
    }

    pub(super) fn most_cd_m2(&self) -> f64 {
        self.rgb_cd_m2.iter().map(photometric).fold(0.0, f64::max)
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        let scaled = |pixel: &[f32; 3]| pixel.map(|channel| (f64::from(channel) * factor) as f32);
        Self { rgb_cd_m2: self.rgb_cd_m2.iter().map(scaled).collect(), ..*self }
    }

    pub(super) fn is_sound(&self) -> bool {
        let count = self.width as usize * self.height as usize;
        let is_number = |channel: &f32| channel.is_finite() && *channel >= 0.0;
        count > 0 && self.rgb_cd_m2.len() == count && self.rgb_cd_m2.iter().flatten().all(is_number)
    }
}

fn photometric(&[r, g, b]: &[f32; 3]) -> f64 {
    Rgb::new(f64::from(r), f64::from(g), f64::from(b)).luminance()
}
