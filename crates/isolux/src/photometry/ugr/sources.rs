//! The luminaires that an observer sees.

use super::position::tabulated_position_index;
use super::room::{HEIGHT_M, UgrRoom};
use crate::photometry::PhotometricWeb;
use isolux_geometry::{Direction, Vector};

/// Luminaires farther from nadir, as they see the eye, do not count (CIE 117:1995): the tangent of 85 degrees.
const FARTHEST: f64 = 11.430_052_302_761_343;

/// What an observer sees.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seen {
    /// The sum of L^2 omega / p^2, cd2 sr/m4.
    pub(super) sum: f64,
    /// The largest omega, sr.
    pub(super) largest_sr: f64,
}

impl Seen {
    /// In a room with luminaires so many heights apart, from where they see the observer in C = 0, 90, 180 or 270 degrees when straight
    /// ahead.
    pub(super) fn from(
        web: &PhotometricWeb,
        seen_m2: &impl Fn(Direction) -> f64,
        (room, spacing, quarter): (UgrRoom, f64, usize),
    ) -> Self {
        let mut seen = Self::default();
        let half_width = 0.5 * f64::from(room.across);
        for along in row(room.along, spacing) {
            for aside in row(room.across, spacing).map(|place| place - half_width) {
                if let Some((glare, steradians)) = one(web, seen_m2, (along, aside, quarter)) {
                    seen.sum += glare;
                    seen.largest_sr = seen.largest_sr.max(steradians);
                }
            }
        }
        seen
    }
}

/// Places along a side, half a spacing from both walls.
fn row(side: u32, spacing: f64) -> impl Iterator<Item = f64> {
    let count = (f64::from(side) / spacing).round() as u32;
    (0..count).map(move |k| (f64::from(k) + 0.5) * spacing)
}

/// L^2 omega / p^2 and omega of one luminaire; `None` where it does not count.
fn one(
    web: &PhotometricWeb,
    seen_m2: &impl Fn(Direction) -> f64,
    (along, aside, quarter): (f64, f64, usize),
) -> Option<(f64, f64)> {
    if libm::hypot(along, aside) > FARTHEST {
        return None;
    }
    let index = tabulated_position_index(aside / along, 1.0 / along)?;
    let [x, y] = turned([along, aside], quarter);
    let to_eye = Vector::new(x, y, -1.0);
    let towards = to_eye.direction()?;
    let (candela, area_m2) = (web.intensity_cd(towards), seen_m2(towards));
    let distance_2_m2 = to_eye.length_squared() * HEIGHT_M * HEIGHT_M;
    let glare = if candela > 0.0 {
        candela * candela / (area_m2 * distance_2_m2 * index * index)
    } else {
        0.0
    };
    Some((glare, area_m2 / distance_2_m2))
}

/// A vector turned by quarters.
fn turned([x, y]: [f64; 2], quarters: usize) -> [f64; 2] {
    match quarters {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}
