//! The parts of a reading apart, for means over a surface.

use super::MapReader;
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::engine::trust;
use crate::map::Illuminance;
use crate::sampling::Sequence;
use crate::units::Rgb;

/// Indirect light of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndirectReading {
    /// The light, lx.
    pub lx: Rgb,
    /// Standard error of its photometric value and of the caustics, as [`MapReader::at`] counts it, lx.
    pub error_lx: f64,
    /// What of that is the noise of its own rays, which no other reading shares, lx.
    pub noise_lx: f64,
}

/// What a map tells of the indirect light of a place without further rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Told {
    /// The light.
    Light(IndirectReading),
    /// Nothing to be trusted: it is to be gathered ([`MapReader::indirect_at`]).
    Little {
        /// Whether something stands so close before the place that it lies in a gap.
        in_gap: bool,
    },
}

impl MapReader<'_> {
    /// One estimate of the direct light of a place, caustics of the map included, by about `rays` shadow rays: it
    /// has no error of its own, noise is part of what places differ by. Points of one sequence are spread evenly.
    /// `None` where the map knows nothing.
    pub fn direct_once(
        &self,
        (triangle, back, [u, v]): (u32, bool, [f64; 2]),
        rays: usize,
        (sequence, index): (Sequence, u32),
    ) -> Option<Rgb> {
        let stored = self.map.interpolate(triangle, back, u, v)?;
        let at = self.places.pulled_in(SurfacePoint::new(self.scene, triangle, back, u, v));
        let direct = self.lighting.by_rays(&at, rays, &mut Dice::new(sequence, index));
        Some(direct + stored.caustic_lx)
    }

    /// Indirect light as the map tells it. `None` where the map knows nothing.
    pub fn told_at(&self, (triangle, back, [u, v]): (u32, bool, [f64; 2])) -> Option<Told> {
        let stored = self.map.interpolate(triangle, back, u, v)?;
        let at = self.places.pulled_in(SurfacePoint::new(self.scene, triangle, back, u, v));
        if self.map.provenance.fresh.is_none() {
            return Some(Told::Light(self.reading(&stored, 0.0)));
        }
        let edge_m = trust::edge_at_m(&self.map.elements, &at);
        Some(match self.is_trusted(&stored, &at, edge_m) {
            true => Told::Light(self.reading(&self.with_interpolation_error(stored), 0.0)),
            false => Told::Little { in_gap: trust::is_closed_in(self.scene, &at, edge_m) },
        })
    }

    /// Indirect light as [`MapReader::at`] reads it: gathered where the map is not trusted.
    pub fn indirect_at(
        &self,
        (triangle, back, [u, v]): (u32, bool, [f64; 2]),
    ) -> Option<IndirectReading> {
        let (read, _) = self.indirect(SurfacePoint::new(self.scene, triangle, back, u, v))?;
        Some(self.reading(&read, read.indirect_standard_error_lx))
    }

    fn reading(&self, read: &Illuminance, noise_lx: f64) -> IndirectReading {
        IndirectReading { lx: read.indirect_lx, error_lx: self.indirect_error_lx(read), noise_lx }
    }
}
