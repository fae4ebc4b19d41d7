//! Single parts of a reading, for means over a surface.

use super::effort::{FRESH_REPLICATES, Needed, TRIAL_RAYS};
use super::state::MapReader;
use super::told::{Allowance, IndirectReading, Told};
use crate::elements::PlaceOnSide;
use crate::engine::gather::Gatherer;
use crate::engine::occlusion::nearby;
use crate::engine::ray::{Dice, SurfacePoint, mean_and_variance};
use crate::map::Illuminance;
use crate::sampling::Sequence;
use crate::units::Rgb;

/// The number of places that the variation of light within a surface counts as. For the mean over the surface
/// it overestimates the error; for the middle it is about right.
const AS_OF_PLACES: f64 = 4.0;
/// The error of indirect light that is interpolated without a test whether the map is trusted there, as a
/// share of it.
const OF_UNLOOKED: f64 = 0.1;

impl MapReader<'_> {
    /// One estimate of the direct light at a place by about `rays` shadow rays, with the caustics of the map.
    /// It has no error of its own: its noise is part of the variation between places. Points of one sequence
    /// are spread evenly. `None` where the map knows nothing.
    pub fn direct_once(
        &self,
        place: PlaceOnSide,
        rays: usize,
        (sequence, index): (Sequence, u32),
    ) -> Option<Rgb> {
        let surface = SurfacePoint::on_side(self.scene, place);
        let stored = self.stored_at(&surface)?;
        let at = self.places.pulled_in(surface);
        let dice = &mut Dice::new(sequence, index);
        let direct = self.lighting.by_rays_on(&self.patches, &at, rays, dice);
        Some(direct + stored.caustic_lx)
    }

    /// Direct light as the map interpolates it, caustics included; no ray is traced. `None` where the map knows nothing.
    pub fn interpolated_direct_at(&self, place: PlaceOnSide) -> Option<Rgb> {
        let stored = self.map.interpolate(place.triangle, place.back, place.uv[0], place.uv[1])?;
        Some(stored.direct_lx)
    }

    /// Indirect light as the map gives it without gathering. `None` where the map knows nothing.
    pub fn told_at(&self, place: PlaceOnSide, allowance: Allowance) -> Option<Told> {
        let surface = SurfacePoint::on_side(self.scene, place);
        let stored = self.stored_at(&surface)?;
        let at = self.places.pulled_in(surface);
        if self.map.provenance.fresh.is_none() {
            return Some(Told::Light(Self::reading(&stored, 0.0)));
        }
        Some(match self.trial(&stored, &at, allowance) {
            None => {
                let told = self.with_interpolation_error(stored, self.part_at(&surface));
                Told::Light(Self::reading(&told, 0.0))
            }
            Some(trial) => Told::Little { in_gap: trial.in_gap },
        })
    }

    /// Indirect light as the map interpolates it, trusted there or not; no ray is traced. Its error is that
    /// of a map trusted everywhere, and a share of the light for obstacles before the place that elements do
    /// not know. `None` where the map knows nothing.
    pub fn interpolated_at(&self, place: PlaceOnSide) -> Option<IndirectReading> {
        let stored = self.map.interpolate(place.triangle, place.back, place.uv[0], place.uv[1])?;
        let part = self.part_at(&SurfacePoint::on_side(self.scene, place));
        let bias_lx = part * self.unseen.bias_lx;
        let interpolation_error_lx = libm::hypot(
            (part * self.unseen.discretization_lx).max(stored.interpolation_error_lx),
            OF_UNLOOKED * stored.indirect_lx.luminance(),
        );
        Some(Self::reading(&Illuminance { interpolation_error_lx, bias_lx, ..stored }, 0.0))
    }

    /// Indirect light as [`MapReader::at`] reads it, but gathered also where the expected interpolation error
    /// is larger than allowed.
    pub fn indirect_at(&self, place: PlaceOnSide, allowance: Allowance) -> Option<IndirectReading> {
        let surface = SurfacePoint::on_side(self.scene, place);
        let (read, _) = self.indirect(surface, allowance)?;
        Some(Self::gathered_reading(&read))
    }

    /// The number of places for the indirect light of a surface in [`MapReader::indirect_over`]: as many as a
    /// reading has replicates.
    pub const PLACES: u32 = FRESH_REPLICATES;

    /// The mean indirect light of a surface, from places spread evenly over it. At each place it is read from
    /// the map, or gathered with the rays of one replicate of a reading. The error counts the variation
    /// between places as if four of them had been drawn at random, so that it also holds for the middle of
    /// the surface. `None` where the map knows none of the places.
    pub fn indirect_over(
        &self,
        places: impl Iterator<Item = PlaceOnSide>,
    ) -> Option<IndirectReading> {
        let surfaces: Vec<SurfacePoint> =
            places.map(|place| SurfacePoint::on_side(self.scene, place)).collect();
        let (mut told, mut trials, mut beside) = (Vec::new(), Vec::new(), [0.0; 2]);
        for surface in &surfaces {
            let Some(stored) = self.stored_at(surface) else { continue };
            match self.trial(&stored, &self.places.pulled_in(*surface), Allowance::ANY) {
                None => {
                    told.push(self.with_interpolation_error(stored, self.part_at(surface)));
                }
                Some(trial) => {
                    beside[0] += stored.common_error_lx;
                    beside[1] += stored.bias_lx;
                    trials.push((*surface, trial));
                }
            }
        }
        if let ([], [(surface, _)]) = (&told[..], &trials[..]) {
            // A single place gives no estimate of its own noise.
            return self
                .indirect(*surface, Allowance::ANY)
                .map(|(read, _)| Self::gathered_reading(&read));
        }
        let trials: Vec<Gatherer> = trials.into_iter().map(|(_, trial)| trial).collect();
        let (gathered, replicate_variance) = self.one_of_each(&trials);
        let lookup_lx = self.map.provenance.fresh.map_or(0.0, |fresh| fresh.lookup_lx);
        let n = (told.len() + gathered.len()) as f64;
        let values: Vec<Rgb> =
            told.iter().map(|t| t.indirect_lx).chain(gathered.iter().map(|g| g.0)).collect();
        let common = |of: fn(&Illuminance) -> f64| told.iter().map(of).sum::<f64>() / n;
        let close_lx = gathered.iter().map(|(_, close)| close * lookup_lx).sum::<f64>() / n;
        let [shared_lx, bias_lx] = beside.map(|lx| lx / n);
        let (lx, variance) = match &values[..] {
            [] => return None,
            [only] => (*only, 0.0),
            all => mean_and_variance(all),
        };
        let of_map = Illuminance {
            indirect_standard_error_lx: common(|t| t.indirect_standard_error_lx) + shared_lx,
            interpolation_error_lx: common(|t| t.interpolation_error_lx) + close_lx,
            bias_lx: common(|t| t.bias_lx) + bias_lx,
            ..Illuminance::NOTHING
        };
        // The variance beyond the noise of rays is the variation of light within the surface.
        let noise = (replicate_variance * gathered.len() as f64 / (n * n)).min(variance);
        let spread = noise + (variance - noise) * n / AS_OF_PLACES.min(n);
        let error_lx = libm::hypot(Self::indirect_error_lx(&of_map), spread.sqrt());
        Some(IndirectReading { lx, error_lx, noise_lx: variance.sqrt() })
    }

    /// The gatherer of a place; `None` where the map is trusted.
    fn trial(
        &self,
        stored: &Illuminance,
        at: &SurfacePoint,
        allowance: Allowance,
    ) -> Option<Gatherer> {
        let fresh = self.map.provenance.fresh?;
        let edge_m = nearby::edge_at_m(&self.map.elements, at);
        let is_trusted = self.is_trusted((fresh, allowance), stored, (at, edge_m));
        (!is_trusted).then(|| {
            let in_gap = nearby::is_closed_in(self.scene, at, edge_m);
            Gatherer::on_surface(*at, TRIAL_RAYS).in_gap(in_gap)
        })
    }

    /// The light that one replicate at each of many places gathers, and the local part of the share of light
    /// read close by. The second value is the expected noise variance of one replicate. The number of rays is
    /// determined at the first place.
    fn one_of_each(&self, trials: &[Gatherer]) -> (Vec<(Rgb, f64)>, f64) {
        let Some(first) = trials.first() else { return (Vec::new(), 0.0) };
        let key = self.gathering_key(first);
        let goal_lx = self.noise_goal_lx(self.part_at(&first.surface));
        let Needed { rays, variance } = self.rays_needed(*first, goal_lx, key);
        let rows: Vec<Gatherer> = trials.iter().map(|trial| trial.with_rays(rays)).collect();
        let operator =
            self.gathering(self.direct_at_ends()).operator(&rows, |k| key.with(1).with(k as u64));
        let parts = trials.iter().map(|trial| self.part_at(&trial.surface));
        let close = operator.close().zip(parts).map(|(close, part)| close * part);
        let gathered = operator.apply(&self.light).into_iter().zip(close).collect();
        (gathered, f64::from(FRESH_REPLICATES) * variance)
    }

    fn gathered_reading(read: &Illuminance) -> IndirectReading {
        Self::reading(read, read.indirect_standard_error_lx)
    }

    fn reading(read: &Illuminance, noise_lx: f64) -> IndirectReading {
        IndirectReading { lx: read.indirect_lx, error_lx: Self::indirect_error_lx(read), noise_lx }
    }
}
