//! Luminance that comes from infinitely far away: skies, and pictures of surroundings.
//!
//! Directions are those of the sky's own frame: **+x** is east, **+y** north, **+z** the zenith.

mod general;
mod patches;
mod perez;
mod picture;
#[cfg(test)]
mod tests;

use crate::units::Rgb;
pub use general::{CIE_TYPES, GeneralSky};
use isolux_geometry::{Direction, Vector};
pub use patches::SkyPatches;
pub use perez::{AllWeather, SkyWeather};
pub use picture::SkyPicture;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::sync::Arc;

/// Places along each side of a cell from which its mean luminance is found.
const PLACES: usize = 4;

/// Cells for the mean: the mean over each is that of sixteen places, two degrees apart.
const OF_MEAN: [usize; 2] = [32, 64];

/// The direction with this sine of elevation and this share of a turn from +x by +y.
fn cylindrical(up: f64, turn: f64) -> Direction {
    let flat = (1.0 - up * up).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(2.0 * PI * turn);
    Vector::new(flat * cos, flat * sin, up).direction().unwrap_or(Direction::Z)
}

/// The luminance of the sky, and of the ground below the horizon, as a function of direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sky {
    /// A sky by formula, above a ground of one luminance.
    General {
        /// The sky.
        sky: GeneralSky,
        /// Luminance of the ground, cd/m2.
        ground_cd_m2: f64,
    },
    /// A picture all around.
    Picture(Arc<SkyPicture>),
}

impl Sky {
    /// Luminance in a direction away from the scene, cd/m2.
    pub fn luminance_cd_m2(&self, towards: Direction) -> Rgb {
        match self {
            Self::General { ground_cd_m2, .. } if towards.to_vector().z < 0.0 => {
                Rgb::grey(*ground_cd_m2)
            }
            Self::General { sky, .. } => Rgb::grey(sky.luminance_cd_m2(towards)),
            Self::Picture(picture) => picture.luminance_cd_m2(towards),
        }
    }

    /// Mean luminances, photometric, of cells of equal solid angle, cd/m2: rows from the nadir up, even in the sine of elevation,
    /// columns around from +x by +y. By a few places of each cell; what pictures show counts with all their pixels.
    pub fn cells_cd_m2(&self, [rows, columns]: [usize; 2]) -> Vec<f64> {
        let at = |row: f64, column: f64| {
            cylindrical(2.0 * row / rows as f64 - 1.0, column / columns as f64)
        };
        let of_places = |cell: usize| {
            let (row, column) = ((cell / columns) as f64, (cell % columns) as f64);
            let place = |k: usize| (k as f64 + 0.5) / PLACES as f64;
            let all = (0..PLACES).flat_map(|i| (0..PLACES).map(move |k| [place(i), place(k)]));
            let seen = all.map(|[i, k]| self.luminance_cd_m2(at(row + i, column + k)).luminance());
            seen.sum::<f64>() / (PLACES * PLACES) as f64
        };
        let mut cells: Vec<f64> = (0..rows * columns).map(of_places).collect();
        if let Self::Picture(picture) = self {
            picture.put_means(&mut cells, [rows, columns]);
        }
        cells
    }

    /// Mean luminance of all directions, photometric, cd/m2.
    pub fn mean_cd_m2(&self) -> f64 {
        let cells = self.cells_cd_m2(OF_MEAN);
        cells.iter().sum::<f64>() / cells.len() as f64
    }

    /// Illuminance of a horizontal surface below the open sky, without the sun, lx.
    pub fn horizontal_lx(&self) -> f64 {
        match self {
            Self::General { sky, .. } => sky.horizontal_lx(),
            Self::Picture(picture) => picture.horizontal_lx(),
        }
    }

    /// The highest luminance, photometric, cd/m2; of a formula, the highest towards zenith, horizon and sun.
    pub fn most_cd_m2(&self) -> f64 {
        match self {
            Self::General { sky, ground_cd_m2 } => {
                let horizon = Direction::X;
                let seen = [Direction::Z, horizon, -horizon, sky.sun];
                seen.map(|towards| sky.luminance_cd_m2(towards))
                    .into_iter()
                    .fold(*ground_cd_m2, f64::max)
            }
            Self::Picture(picture) => picture.most_cd_m2(),
        }
    }

    /// The same sky, brighter by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::General { sky, ground_cd_m2 } => {
                Self::General { sky: sky.scaled(factor), ground_cd_m2: ground_cd_m2 * factor }
            }
            Self::Picture(picture) => Self::Picture(Arc::new(picture.scaled(factor))),
        }
    }

    /// Whether luminances are numbers of zero or more.
    pub fn is_sound(&self) -> bool {
        match self {
            Self::General { sky, ground_cd_m2 } => {
                sky.is_sound() && ground_cd_m2.is_finite() && *ground_cd_m2 >= 0.0
            }
            Self::Picture(picture) => picture.is_sound(),
        }
    }
}
