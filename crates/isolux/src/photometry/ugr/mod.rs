//! The table of unified glare ratings of a luminaire, by the tabular method of CIE 190:2010.
//!
//! Rooms of standard sizes have luminaires all over the ceiling; the observer stands in the middle of a wall and looks straight across.
//! The rating is `8 lg (0.25 / Lb sum L^2 omega / p^2)` of CIE 117:1995. `Lb` is the mean illuminance of the walls by reflected light,
//! over pi. The height of the luminaires above the eye cancels but for the solid angle of the largest source.

mod direct;
mod position;
mod room;
mod sources;
#[cfg(test)]
mod tests;

pub use room::{UGR_REFLECTANCES, UGR_ROOMS, UgrReflectances, UgrRoom};

use super::PhotometricWeb;
use direct::Zones;
use isolux_geometry::Direction;
use room::HEIGHT_M;
use sources::Seen;
use std::f64::consts::PI;

/// Views from opposite sides that differ by more are no table: one is the least difference that is noticed (CIE 117:1995).
const MOST_ASYMMETRY: f64 = 1.0;

/// How the luminaires hang.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UgrLayout {
    /// Their distance in heights above the eye: one over a whole number.
    pub spacing_to_height: f64,
    /// Whether whoever looks crosswise looks along the plane C0-C180; else along C90-C270.
    pub crosswise_is_c0: bool,
}

/// Ratings by room, and in each by reflectances.
#[derive(Clone, Debug, PartialEq)]
pub struct UgrTable {
    /// In the order of [`UGR_ROOMS`]. `None` where no luminaire counts.
    pub crosswise: Vec<[Option<f64>; 5]>,
    /// As that, the luminaire turned by a quarter.
    pub endwise: Vec<[Option<f64>; 5]>,
    /// The greatest difference between views from opposite sides; the greater one is in the table.
    pub asymmetry: f64,
    /// The greatest solid angle of a luminaire that counts, sr.
    pub largest_sr: f64,
}

/// Why a luminaire has no table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoUgrTable {
    /// Its angles are those of a floodlight, which has no nadir.
    Floodlight,
    /// It sends nothing down.
    Dark,
    /// Views from opposite sides differ by so much.
    Asymmetric(f64),
}

impl UgrTable {
    /// Of a luminaire whose luminous area, as seen along a direction in its frame, is given in m2.
    pub fn of(
        web: &PhotometricWeb,
        seen_m2: impl Fn(Direction) -> f64,
        layout: UgrLayout,
    ) -> Result<Self, NoUgrTable> {
        if !web.system().is_c() {
            return Err(NoUgrTable::Floodlight);
        }
        let zones = Zones::of(web);
        if zones.down_lm() <= 0.0 {
            return Err(NoUgrTable::Dark);
        }
        let mut table =
            Self { crosswise: Vec::new(), endwise: Vec::new(), asymmetry: 0.0, largest_sr: 0.0 };
        for room in UGR_ROOMS {
            let backgrounds = backgrounds_cd_m2(&zones, room, layout.spacing_to_height);
            let quarters = [0, 1, 2, 3].map(|quarter| {
                let seen = Seen::from(web, &seen_m2, (room, layout.spacing_to_height, quarter));
                table.largest_sr = table.largest_sr.max(seen.largest_sr);
                seen.sum
            });
            let [along_c0, along_c90] = [0, 1].map(|k| (quarters[k], quarters[k + 2]));
            for (one, other) in [along_c0, along_c90] {
                table.asymmetry = table.asymmetry.max(difference(one, other));
            }
            let [c0, c90] = [along_c0, along_c90]
                .map(|(one, other)| backgrounds.map(|lb| rating(one.max(other), lb)));
            let (crosswise, endwise) = if layout.crosswise_is_c0 { (c0, c90) } else { (c90, c0) };
            table.crosswise.push(crosswise);
            table.endwise.push(endwise);
        }
        if table.asymmetry > MOST_ASYMMETRY {
            return Err(NoUgrTable::Asymmetric(table.asymmetry));
        }
        Ok(table)
    }

    /// What the table of 1000 lm differs by: `8 lg (F / 1000)`.
    pub fn flux_correction(flux_lm: f64) -> f64 {
        8.0 * libm::log10(flux_lm / 1000.0)
    }
}

/// Mean luminance of the walls by reflected light, cd/m2, for each of the standard reflectances.
fn backgrounds_cd_m2(zones: &Zones, room: UgrRoom, spacing: f64) -> [f64; 5] {
    let one = zones.arriving(room, spacing);
    let luminaires = f64::from(room.across * room.along) / (spacing * spacing);
    let walls_m2 = room.wall_area() * HEIGHT_M * HEIGHT_M;
    UGR_REFLECTANCES.map(|of| luminaires * room.reflected_onto_walls(of, one) / (walls_m2 * PI))
}

fn rating(sum: f64, background: f64) -> Option<f64> {
    let rating = 8.0 * libm::log10(0.25 * sum / background);
    rating.is_finite().then_some(rating)
}

/// Of two ratings with one background; one without any source beside one with some is as different as can be.
fn difference(one: f64, other: f64) -> f64 {
    if one == other { 0.0 } else { (8.0 * libm::log10(one / other)).abs() }
}
