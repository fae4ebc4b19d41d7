//! Patches of the sky: the subdivision of Tregenza (1987, "Subdivision of the sky hemisphere for luminance measurements"), and
//! that of Reinhart, which divides each of its patches into so many times so many.

use isolux_geometry::{Direction, Vector};
use std::f64::consts::{FRAC_PI_2, PI};

/// Patches in the rows of Tregenza from the horizon up, below the one at the zenith.
const COLUMNS: [u32; 7] = [30, 30, 24, 24, 18, 12, 6];

/// Patches that cover the sky: rows of equal height from the horizon up, and a cap at the zenith, which has the last number. In
/// each row they are counted from north by east, the first about the direction of north.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyPatches {
    /// Height of a row; half of it is the radius of the cap.
    row_rad: f64,
    columns: Vec<u32>,
    /// The number of the first patch of each row, and that of the cap.
    starts: Vec<u32>,
}

impl SkyPatches {
    /// The patches of Tregenza, each divided into `multiplier` rows of `multiplier` patches: 145 of 1, 577 of 2, 2305 of 4. `None` for
    /// none, and beyond 16.
    pub fn reinhart(multiplier: u32) -> Option<Self> {
        if !(1..=16).contains(&multiplier) {
            return None;
        }
        let rows = COLUMNS.iter().flat_map(|&of| vec![of * multiplier; multiplier as usize]);
        let columns: Vec<u32> = rows.collect();
        let mut starts = vec![0];
        for of in &columns {
            starts.push(starts[starts.len() - 1] + of);
        }
        Some(Self { row_rad: FRAC_PI_2 / (columns.len() as f64 + 0.5), columns, starts })
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.zenith() + 1
    }

    fn zenith(&self) -> usize {
        self.starts[self.columns.len()] as usize
    }

    /// The patch that a direction of the frame of skies points to; `None` below the horizon.
    pub fn of(&self, towards: Direction) -> Option<usize> {
        let v = towards.to_vector();
        if v.z < 0.0 {
            return None;
        }
        let row = (libm::asin(v.z.min(1.0)) / self.row_rad) as usize;
        let Some(&columns) = self.columns.get(row) else { return Some(self.zenith()) };
        let turn = libm::atan2(v.x, v.y) / (2.0 * PI);
        let turn = (turn + 1.0 + 0.5 / f64::from(columns)).fract();
        let column = ((turn * f64::from(columns)) as u32).min(columns - 1);
        Some((self.starts[row] + column) as usize)
    }

    /// The middle of a patch.
    pub fn middle(&self, patch: usize) -> Direction {
        let Some((row, column)) = self.place(patch) else { return Direction::Z };
        let (sin, cos) = libm::sincos((row as f64 + 0.5) * self.row_rad);
        let turn = f64::from(column) / f64::from(self.columns[row]);
        let (east, north) = libm::sincos(2.0 * PI * turn);
        Vector::new(cos * east, cos * north, sin).direction().unwrap_or(Direction::Z)
    }

    /// Solid angle of a patch, sr.
    pub fn steradians(&self, patch: usize) -> f64 {
        let up = |row: f64| libm::sin(row * self.row_rad);
        match self.place(patch) {
            Some((row, _)) => {
                let row_sr = 2.0 * PI * (up(row as f64 + 1.0) - up(row as f64));
                row_sr / f64::from(self.columns[row])
            }
            None => 2.0 * PI * (1.0 - up(self.columns.len() as f64)),
        }
    }

    /// Row and column; `None` for the cap.
    fn place(&self, patch: usize) -> Option<(usize, u32)> {
        let row = self.starts.partition_point(|&start| start as usize <= patch) - 1;
        (row < self.columns.len()).then(|| (row, patch as u32 - self.starts[row]))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests {
    use super::*;

    #[test]
    fn patches_cover_the_sky_once() {
        for (multiplier, count) in [(1, 145), (2, 577), (4, 2305)] {
            let patches = SkyPatches::reinhart(multiplier).unwrap();
            assert_eq!(patches.count(), count);
            let sr: f64 = (0..count).map(|patch| patches.steradians(patch)).sum();
            assert!((sr - 2.0 * PI).abs() < 1e-12 * count as f64, "{sr}");
            for patch in 0..count {
                assert_eq!(patches.of(patches.middle(patch)), Some(patch));
            }
        }
        assert_eq!(SkyPatches::reinhart(0), None);
        assert_eq!(SkyPatches::reinhart(1).unwrap().of(-Direction::Z), None);
    }

    /// The first row of Tregenza is centred at 6 degrees, and its patches are 12 degrees wide (CIE 108:1994).
    #[test]
    fn the_first_patch_is_about_north() {
        let patches = SkyPatches::reinhart(1).unwrap();
        let middle = patches.middle(0).to_vector();
        assert!(middle.x.abs() < 1e-15 && middle.y > 0.0);
        assert!((libm::asin(middle.z).to_degrees() - 6.0).abs() < 1e-9);
        let at = |azimuth_deg: f64| {
            let (east, north) = libm::sincos(azimuth_deg.to_radians());
            patches.of(Vector::new(east, north, 0.1).direction().unwrap())
        };
        assert_eq!([at(5.9), at(6.1), at(-5.9), at(-6.1)], [Some(0), Some(1), Some(0), Some(29)]);
    }
}
