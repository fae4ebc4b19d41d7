//! Wide sources: all of them together are one sky.

use super::limits;
use super::sky_function::SkyFunction;
use crate::sky_formula::sampled_in_colour;
use isolux::geometry::{Direction, Transform};
use isolux::photometry::{GeneralSky, Sky};
use isolux::scene::{Luminaire, LuminaireKind};
use isolux::units::Rgb;
use std::sync::Arc;

/// A cone of light from infinitely far away.
pub(super) struct Wide {
    pub(super) name: String,
    /// To its middle.
    pub(super) towards: Direction,
    /// Its full angle.
    pub(super) angle_deg: f64,
    /// Of its material.
    pub(super) luminance_cd_m2: Rgb,
    /// What its brightness varies by.
    pub(super) function: Option<SkyFunction>,
}

/// All wide sources of a scene.
#[derive(Default)]
pub(super) struct Skies {
    list: Vec<Wide>,
}

impl Wide {
    fn holds(&self, towards: Direction) -> bool {
        let half_rad = 0.5 * self.angle_deg.to_radians();
        self.angle_deg >= 360.0 || self.towards.dot(towards) >= libm::cos(half_rad)
    }

    fn luminance_cd_m2(&self, towards: Direction) -> Rgb {
        self.luminance_cd_m2 * self.function.as_ref().map_or(1.0, |function| function.at(towards))
    }

    /// Whether it is the half-space above (or below), evenly.
    fn is_half(&self, up: f64) -> bool {
        let is_plain = self.function.is_none() && self.angle_deg == 180.0;
        is_plain && self.towards.to_vector().z * up == 1.0
    }

    fn is_all(&self) -> bool {
        self.function.is_none() && self.angle_deg == 360.0
    }
}

/// Whether colours are the same, up to the rounding of their channels.
fn is_near(one: Rgb, other: Rgb) -> bool {
    one.0.iter().zip(other.0).all(|(a, b)| (a - b).abs() <= ROUNDING)
}

/// A few roundings of numbers about one.
const ROUNDING: f64 = 1e-14;

impl Skies {
    /// Adds a source; whether there was room.
    pub(super) fn add(&mut self, wide: Wide) -> bool {
        self.list.push(wide);
        self.list.len() <= limits::SKIES
    }

    /// What they are together. Where two lie one above the other the first counts, as Radiance takes it.
    pub(super) fn luminaire(&self) -> Option<Luminaire> {
        let name = self.list.first()?.name.clone();
        let (sky, colour) = self.even().unwrap_or_else(|| (self.picture(), Rgb::WHITE));
        let kind = LuminaireKind::Sky { world_from_sky: Transform::IDENTITY, sky };
        Some(Luminaire { name, group: 0, colour, kind })
    }

    fn picture(&self) -> Sky {
        let seen = |towards: Direction| {
            let first = self.list.iter().find(|wide| wide.holds(towards));
            first.map_or([0.0; 3], |wide| wide.luminance_cd_m2(towards).0)
        };
        Sky::Picture(Arc::new(sampled_in_colour(seen)))
    }

    /// An even sky above an even ground, of one colour.
    fn even(&self) -> Option<(Sky, Rgb)> {
        let half = |up: f64| {
            let found = self.list.iter().find(|wide| wide.is_half(up) || wide.is_all());
            found.map_or(Rgb::BLACK, |wide| wide.luminance_cd_m2)
        };
        let is_even = |wide: &Wide| wide.is_half(1.0) || wide.is_half(-1.0) || wide.is_all();
        let (above, below) = (half(1.0), half(-1.0));
        let colour = if above.is_black() { below } else { above }.chromaticity();
        let is_one_colour = below.is_black() || is_near(below.chromaticity(), colour);
        if !(self.list.iter().all(is_even) && is_one_colour) {
            return None;
        }
        let sky = GeneralSky::uniform(above.luminance());
        Some((Sky::General { sky, ground_cd_m2: below.luminance() }, colour))
    }
}
