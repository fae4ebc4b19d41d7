//! Direct light of sensors with a bent surface, which see all round.
//!
//! Light of points and of discs counts with the outline that a sensor has from there, so it has no noise but that of
//! half-shadows. Emitting surfaces and skies are sampled for planes that touch the sensor, at places spread evenly over it: the
//! mean of their illuminances is that of the sensor.

use super::super::lighting::Lighting;
use super::super::sources::{Source, SourceKind, Target, unoccluded_from};
use super::far::Disc;
use super::luminous::LuminousSource;
use super::measured::{Goal, Measured, REPLICATES, STUDENT_FACTOR, mean};
use crate::engine::ray::{Dice, Sensor, SurfacePoint, mean_and_variance};
use crate::sampling::Sequence;
use crate::units::Rgb;
use isolux_geometry::Point;

/// Planes, and places of discs and luminous areas, of one replicate: those of the trial, the fewest, and the most.
const PLANES: [u32; 2] = [16, 1024];
/// The order of convergence of planes spread evenly: noise falls like this power of 1/n where the cosine has a bend.
const ORDER: f64 = 0.75;

impl Lighting<'_> {
    /// The direct light of a sensor at a place in free space, to about the standard error asked for.
    pub(crate) fn all_round(
        &self,
        at: &SurfacePoint,
        sensor: &Sensor,
        goal: Goal,
        sequence: Sequence,
    ) -> Measured {
        let (extended, points): (Vec<&Source>, Vec<&Source>) =
            self.sources.iter().partition(|source| source.has_extent());
        let exact: Rgb = points.iter().map(|source| self.point_all_round(source, at, sensor)).sum();
        if extended.is_empty() {
            return Measured { lx: exact, variance: 0.0 };
        }
        let look = |planes: u32, number: u32| {
            let replicates: Vec<Rgb> = (0..REPLICATES)
                .map(|k| {
                    let dice = &mut Dice::new(sequence.fork(number, 0), k);
                    extended
                        .iter()
                        .map(|s| self.extent_all_round(s, (at, sensor), planes, dice))
                        .sum()
                })
                .collect();
            mean_and_variance(&replicates)
        };
        let [fewest, most] = PLANES;
        // The trial is discarded: to stop at a small variance would report too small ones.
        let (rough, variance) = look(fewest, 0);
        let goal_lx = goal.of((exact + rough).luminance()).max(f64::MIN_POSITIVE);
        let more = libm::pow(variance / (goal_lx * goal_lx), 0.5 / ORDER);
        let planes = (f64::from(fewest) * more).clamp(f64::from(fewest), f64::from(most));
        let (lx, variance) = look(planes as u32, 1);
        Measured { lx: exact + lx, variance: STUDENT_FACTOR * STUDENT_FACTOR * variance }
    }

    fn point_all_round(&self, source: &Source, at: &SurfacePoint, sensor: &Sensor) -> Rgb {
        let target = match &source.kind {
            SourceKind::Point { position, .. } => Target::Point(*position),
            SourceKind::Directional { towards, .. } => Target::Infinity(*towards),
            SourceKind::Area { .. } | SourceKind::Sky(_) => return Rgb::BLACK,
        };
        self.place_all_round(source, target, (at, sensor))
    }

    /// The light of a point source as if it were at a place, or of parallel light.
    fn place_all_round(
        &self,
        source: &Source,
        target: Target,
        (at, sensor): (&SurfacePoint, &Sensor),
    ) -> Rgb {
        let Some(towards) = target.towards(at.point).direction() else { return Rgb::BLACK };
        let at = at.facing(towards.to_normal());
        let place = match target {
            Target::Point(place) => place,
            Target::Infinity(_) => Point::ORIGIN,
        };
        let in_view = |target| self.chain_is_in_view(&source.chain, &at, target);
        let arriving = unoccluded_from(self.scene, source, place, &at, in_view);
        arriving.map_or(Rgb::BLACK, |arriving| {
            let seen = self.visibility_in_view(&source.chain, &at, arriving.target, None);
            arriving.illuminance_lx * seen * sensor.share(towards)
        })
    }

    /// One estimate of the light of a source with an extent.
    fn extent_all_round(
        &self,
        source: &Source,
        (at, sensor): (&SurfacePoint, &Sensor),
        planes: u32,
        dice: &mut Dice,
    ) -> Rgb {
        if let Some(luminous) = LuminousSource::of(source) {
            return mean(planes as usize, dice, |dice| {
                let place = Target::Point(luminous.place(dice));
                self.place_all_round(source, place, (at, sensor))
            });
        }
        if let Some(disc) = Disc::of(source) {
            return self.disc_all_round(disc, (at, sensor), planes as usize, dice);
        }
        mean(planes as usize, dice, |dice| {
            let at = at.facing(sensor.normal(dice.pair()));
            self.lit_by(source, &at, 1, dice)
        })
    }
}
