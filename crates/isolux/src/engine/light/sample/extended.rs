//! Light of sources with an extent, with its noise.

use super::super::lighting::Lighting;
use super::super::sources::Source;
use super::area::AreaSource;
use super::far::Disc;
use super::luminous::LuminousSource;
use super::measured::{Measured, REPLICATES, STUDENT_FACTOR};
use crate::engine::ray::{Dice, SurfacePoint, mean_and_variance};
use crate::sampling::Sequence;
use crate::units::Rgb;

/// Factor on the number of shadow rays if the noise is still too large.
const FURTHER_RAYS_FACTOR: usize = 4;

impl Lighting<'_> {
    /// Illuminance from the emitting surfaces and luminous areas among some sources, with the variance of its mean.
    /// `goal_lx` gives the allowed standard error for the light of a first measurement, lx. If the
    /// first standard error is larger, the surfaces that exceed their part of it get more shadow rays.
    pub(crate) fn of_surfaces(
        &self,
        which: impl Iterator<Item = u32>,
        at: &SurfacePoint,
        goal_lx: impl Fn(Rgb) -> f64,
        [fewest, most]: [usize; 2],
        sequence: Sequence,
    ) -> Measured {
        let surfaces: Vec<u32> = which.filter(|&k| self.sources[k as usize].has_extent()).collect();
        let measured = |&k: &u32, samples: usize| {
            let numbers = [sequence.fork(k, samples as u32), sequence];
            self.of_surface(&self.sources[k as usize], at, samples, numbers)
        };
        let mut found: Vec<Measured> = surfaces.iter().map(|of| measured(of, fewest)).collect();
        let sum = |found: &[Measured]| Measured {
            lx: found.iter().map(|m| m.lx).sum(),
            variance: found.iter().map(|m| STUDENT_FACTOR * STUDENT_FACTOR * m.variance).sum(),
        };
        let first = sum(&found);
        let goal = goal_lx(first.lx).powi(2);
        if first.variance > goal {
            let goal = goal / surfaces.len() as f64;
            for (found, of) in found.iter_mut().zip(&surfaces) {
                let mut samples = fewest;
                while found.variance > goal && samples < most {
                    samples = (FURTHER_RAYS_FACTOR * samples).min(most);
                    *found = measured(of, samples);
                }
            }
        }
        sum(&found)
    }

    /// Illuminance from one source with an extent, by `samples` shadow rays in each replicate. If no ray
    /// meets light, the variance assumes that the next one would.
    fn of_surface(
        &self,
        source: &Source,
        at: &SurfacePoint,
        samples: usize,
        [own, of_looks]: [Sequence; 2],
    ) -> Measured {
        let of_each: [Rgb; REPLICATES as usize] = std::array::from_fn(|replicate| {
            let mut dice = Dice::new(own, replicate as u32);
            self.lit_by(source, at, samples, &mut dice)
        });
        let (lx, variance) = mean_and_variance(&of_each);
        if !lx.is_black() {
            return Measured { lx, variance };
        }
        let samples = samples as f64 * f64::from(REPLICATES);
        let unseen_lx = match self.openings.view(source, at) {
            Some(view) => source.mean_cd_m2() * view.unseen(samples),
            None => self.unhidden_lx(source, at, &mut Dice::new(of_looks, 0)) / samples,
        };
        Measured { lx, variance: unseen_lx * unseen_lx }
    }

    /// Unoccluded illuminance from a source with an extent, lx; a rough value for large surfaces.
    fn unhidden_lx(&self, source: &Source, at: &SurfacePoint, dice: &mut Dice) -> f64 {
        match (AreaSource::of(source), LuminousSource::of(source)) {
            (Some(surface), _) => surface.unhidden_lx(at, dice),
            (None, Some(luminous)) => self.unhidden(luminous, at).luminance(),
            (None, None) => Disc::of(source).map_or(0.0, |disc| disc.unhidden_lx(at)),
        }
    }
}
