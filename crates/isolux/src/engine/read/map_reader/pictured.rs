//! Readings for pictures, which show few per cent of light only.

use super::state::{Gathered, times_rays};
use super::{Allowance, IndirectReading, MapReader};
use crate::elements::PlaceOnSide;
use crate::engine::gather::Gatherer;
use crate::engine::light::{Measured, ShadowRays};
use crate::engine::ray::{SurfacePoint, place_key};
use crate::map::Illuminance;
use crate::sampling::Sequence;
use crate::units::Rgb;

/// The replicates that gather light for a picture: as few as tell their noise.
const REPLICATES: u32 = 4;
/// The fewest and the most rays of such a replicate.
const RAYS: [u32; 2] = [16, 128];

/// Light at a place that is known already.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureLight {
    /// Direct light without caustics, lx.
    pub direct_lx: Option<Rgb>,
    /// Indirect light.
    pub indirect: Option<IndirectReading>,
}

impl MapReader<'_> {
    /// Direct light without caustics at a place by a few shadow rays, with its noise in lux (best effort).
    /// `number` tells readings of one place apart.
    pub fn direct_for_picture(
        &self,
        place: PlaceOnSide,
        number: u64,
        rays: ShadowRays,
    ) -> (Rgb, f64) {
        let at = self.places.pulled_in(SurfacePoint::on_side(self.scene, place));
        let sequence = Sequence::new(place_key(at.point).with(number));
        let Measured { lx, variance } = self.lighting.pictured(&self.patches, &at, rays, sequence);
        (lx, variance.sqrt())
    }

    /// The illuminance at a place for pictures, which average over many places. Direct light that is not
    /// known is evaluated by a few shadow rays; the standard error leaves that noise out. Indirect light
    /// that is not known is interpolated.
    pub fn glance(
        &self,
        place: PlaceOnSide,
        (number, rays): (u64, ShadowRays),
        known: PictureLight,
    ) -> Option<Illuminance> {
        let stored = self.map.interpolate(place.triangle, place.back, place.uv[0], place.uv[1])?;
        let stored = known.indirect.map_or(stored, |known| Illuminance {
            indirect_lx: known.lx,
            indirect_standard_error_lx: known.noise_lx,
            ..stored
        });
        let direct =
            known.direct_lx.unwrap_or_else(|| self.direct_for_picture(place, number, rays).0);
        Some(Illuminance {
            direct_lx: direct + stored.caustic_lx,
            standard_error_lx: stored.indirect_standard_error_lx,
            ..stored
        })
    }

    /// Indirect light gathered over the map, until its noise is about the allowed share of all light. (A
    /// picture stops at a small variance; its bias by that is small beside the noise.)
    pub(super) fn gathered_for_picture(
        &self,
        stored: Illuminance,
        (trial, allowance): (Gatherer, Allowance),
        lookup_lx: f64,
    ) -> Illuminance {
        let key = self.gathering_key(&trial);
        let trial = self.before_walls(trial);
        let gather = |rays: u32, key| {
            self.gather(trial.with_rays(rays), self.direct_at_ends(), (REPLICATES, key))
        };
        let [fewest, most] = RAYS;
        let first = gather(fewest, key.with(2 * allowance.number));
        let goal = allowance.noise * (stored.direct_lx + first.lx).luminance();
        let more = times_rays(first.variance, goal).min(f64::from(most / fewest));
        let Gathered { lx, variance, close, common_lx } = match more > 1.0 {
            true => gather((f64::from(fewest) * more) as u32, key.with(2 * allowance.number + 1)),
            false => first,
        };
        Illuminance {
            indirect_lx: lx,
            indirect_standard_error_lx: libm::hypot(variance.sqrt(), common_lx),
            common_error_lx: common_lx,
            interpolation_error_lx: close * lookup_lx,
            ..stored
        }
    }
}
