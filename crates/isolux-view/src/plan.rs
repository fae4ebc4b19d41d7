//! A plan of illuminance: the values of a grid of places as a view from above.

use crate::error::ViewError;
use crate::image::{LuminanceImage, Middle, Reading, Seen, Sight, Size, Surface};
use isolux::geometry::{Point, Vector};
use isolux::map::Illuminance;

/// Values at the middles of equal cells, `counts[0]` of them a row, rows from the bottom; `sides_m` long
/// together. Values between are linear; half a cell at the edges is that of the outermost; cells of which nothing
/// is known stay without. Of such a view only charts are of use: it has no luminance.
pub fn plan(
    values: &[Option<Illuminance>],
    counts: [u32; 2],
    sides_m: [f64; 2],
    longest_pixels: u32,
) -> Result<LuminanceImage, ViewError> {
    let longest_m = sides_m[0].max(sides_m[1]);
    let pixels = |side_m: f64| (f64::from(longest_pixels) * side_m / longest_m).round().max(2.0);
    let [width, height] = sides_m.map(|side_m| pixels(side_m) as u32);
    let size = Size::new(width, height)?;
    let grid = Grid { values, counts };
    let mut samples = Vec::with_capacity(size.pixels());
    let mut middles = Vec::with_capacity(size.pixels());
    let facing = Vector::new(0.0, 0.0, 1.0).normal().ok_or(ViewError::Size { width, height })?;
    for y in 0..height {
        for x in 0..width {
            let across = (f64::from(x) + 0.5) / f64::from(width);
            let along = 1.0 - (f64::from(y) + 0.5) / f64::from(height);
            let reading = grid.at([across, along]);
            let sight = if reading.is_some() { Sight::Surface } else { Sight::Unknown };
            samples.push(Seen { luminance_cd_m2: [0.0; 3], reading, sight });
            let position = Point::new(across * sides_m[0], along * sides_m[1], 0.0);
            let surface = Surface { shape: 0, back: false, path: 0, position, normal: facing };
            middles.push(Some(Middle { surface, reading, noise_lx: 0.0 }));
        }
    }
    Ok(LuminanceImage::new(size, samples, middles, false))
}

struct Grid<'a> {
    values: &'a [Option<Illuminance>],
    counts: [u32; 2],
}

impl Grid<'_> {
    /// Between the four values about a place, given as shares of the sides; over those that are known,
    /// if the nearest is.
    fn at(&self, shares: [f64; 2]) -> Option<Reading> {
        let place = [0, 1].map(|axis| {
            let count = f64::from(self.counts[axis]);
            (shares[axis] * count - 0.5).clamp(0.0, count - 1.0)
        });
        let low = place.map(|p| p.floor());
        let value = |step: [u32; 2]| -> Option<&Illuminance> {
            let index = [0, 1].map(|a| (low[a] as u32 + step[a]).min(self.counts[a] - 1) as usize);
            self.values.get(index[1] * self.counts[0] as usize + index[0])?.as_ref()
        };
        let part = [0, 1].map(|axis| place[axis] - low[axis]);
        value(part.map(|p| u32::from(p >= 0.5)))?;
        let (mut sum, mut lux, mut error) = (0.0, 0.0, 0.0);
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let share = |part: f64, far: u32| if far == 1 { part } else { 1.0 - part };
            let weight = share(part[0], i) * share(part[1], j);
            if let Some(value) = value([i, j]) {
                sum += weight;
                lux += weight * value.illuminance_lx();
                error += weight * value.standard_error_lx;
            }
        }
        Some(Reading {
            illuminance_lx: (lux / sum) as f32,
            standard_error_lx: (error / sum) as f32,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::units::Rgb;

    fn lux(value: f64) -> Option<Illuminance> {
        Some(Illuminance { direct_lx: Rgb::grey(value), ..Illuminance::NOTHING })
    }

    #[test]
    fn rows_go_up_and_values_between_are_linear() {
        let values = [lux(100.0), lux(300.0), lux(500.0), lux(700.0)];
        let view = plan(&values, [2, 2], [1.0, 1.0], 4).unwrap();
        let at = |x: usize, y: usize| view.reading(y * 4 + x).unwrap().illuminance_lx;
        // The bottom left quarter of the outermost cell has its value.
        assert_eq!(at(0, 3), 100.0);
        assert_eq!(at(3, 0), 700.0);
        // A quarter of the way from 100 to 300, as pixels are a quarter of the side.
        assert_eq!(at(1, 3), 150.0);
    }

    #[test]
    fn what_is_not_known_stays_so() {
        let values = [lux(100.0), None];
        let view = plan(&values, [2, 1], [2.0, 1.0], 8).unwrap();
        assert_eq!(view.size().height(), 4);
        assert_eq!(view.reading(3).unwrap().illuminance_lx, 100.0);
        assert!(view.reading(4).is_none() && view.reading(7).is_none());
        assert_eq!(view.samples(7)[0].sight, Sight::Unknown);
    }
}
