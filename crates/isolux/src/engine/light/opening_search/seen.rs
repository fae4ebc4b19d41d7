//! Trial rays of places to an emitting surface, and the better kind of rays that follows from them.

use super::super::lighting::Lighting;
use super::super::openings::{ANYWHERE_SHARE, Before, Through, Told, View, Zones};
use crate::engine::ray::{Deadline, Dice, SurfacePoint};
use crate::sampling::{Key, Sequence};
use isolux_geometry::Point;
use rayon::prelude::*;
use std::f64::consts::PI;

/// The largest share of free trial rays to an emitter with which a place counts as dark.
const DARK_FREE_SHARE: f64 = 0.25;

/// Trial rays of a place to each opening.
const TRIAL_RAYS: usize = 4;
/// Number of trial rays that the mean over all places counts as.
const PRIOR_RAYS: f64 = 1.0;

/// The smallest weight of an opening in a part of the scene: a hundredth of the trial rays pass it.
const LEAST_WEIGHT: f64 = 0.1;

/// The largest share of the variance that rays to openings may leave in order to be used.
const MOST_VARIANCE_SHARE: f64 = 0.5;

/// A place with its trial rays to an emitter.
pub(super) struct Looked {
    pub(super) at: SurfacePoint,
    /// Projected solid angle of the emitter without obstacles, sr.
    pub(super) whole: f64,
    pub(super) looks: usize,
    pub(super) free: Vec<Point>,
    pub(super) stopped: Vec<Point>,
}

impl Looked {
    pub(super) fn nothing(at: &SurfacePoint, whole: f64, looks: usize) -> Self {
        Self { at: *at, whole, looks, free: Vec::new(), stopped: Vec::new() }
    }

    pub(super) fn is_dark(&self) -> bool {
        self.free.len() as f64 <= DARK_FREE_SHARE * self.looks as f64
    }
}

/// The trial rays of a place through an opening.
#[derive(Clone, Copy)]
struct Seen {
    /// Projected solid angle of the opening, sr.
    steradians: f64,
    /// Number of rays through it that reach the emitter.
    looks: u32,
}

/// The trial rays of all places through openings; `None` where an opening is below the horizon.
pub(super) struct ThroughOpenings<'a> {
    before: &'a Before,
    looked: &'a [Looked],
    seen: Vec<Vec<Option<Seen>>>,
}

impl<'a> ThroughOpenings<'a> {
    /// Sends the rays; `None` if the time is over before all of them are sent.
    pub(super) fn of(
        lighting: &Lighting,
        before: &'a Before,
        looked: &'a [Looked],
        (key, end): (Key, &Deadline),
    ) -> Option<Self> {
        let one = |(k, looked): (usize, &Looked)| {
            let mut dice = Dice::new(Sequence::new(key), k as u32);
            let all = 0..before.openings.len() as u32;
            let seen = |opening| seen(lighting, before, opening, &looked.at, &mut dice);
            (!end.has_passed()).then(|| all.map(seen).collect())
        };
        let seen: Option<_> = looked.par_iter().enumerate().map(one).collect();
        Some(Self { before, looked, seen: seen? })
    }

    /// The parts of the scene, each with the openings that its rays should go to.
    pub(super) fn zones(&self) -> Zones {
        let all: Vec<u32> = (0..self.looked.len() as u32).collect();
        let mut everywhere = vec![0.0; self.before.openings.len()];
        for Through { opening, weight } in self.through(&all, |_| 0.0) {
            everywhere[opening as usize] = weight * weight;
        }
        let told = all.par_iter().map(|&k| {
            let own = self.through(&[k], |opening| everywhere[opening]);
            Told::new(&self.looked[k as usize].at, self.variances(k as usize, &own))
        });
        let told: Vec<Told> = told.collect();
        Zones::of(&told, &|of| self.best(of, &everywhere))
    }

    /// Whether a place sees anything of the emitter. Places that see nothing, as inside a wall,
    /// tell nothing and do not matter.
    fn sees_any(&self, place: usize) -> bool {
        let through = self.seen[place].iter().flatten().any(|seen| seen.looks > 0);
        through || !self.looked[place].free.is_empty()
    }

    /// The openings through which some places see the emitter. `prior` is the assumed share of one
    /// further trial ray that reaches it.
    fn through(&self, of: &[u32], prior: impl Fn(usize) -> f64) -> Vec<Through> {
        let one = |opening: usize| {
            let telling = of.iter().filter(|&&k| self.sees_any(k as usize));
            let all = telling.filter_map(|&k| self.seen[k as usize][opening]);
            let (mut count, mut came) = (PRIOR_RAYS, PRIOR_RAYS * prior(opening));
            for seen in all {
                count += TRIAL_RAYS as f64;
                came += f64::from(seen.looks);
            }
            let weight = (came / count).sqrt();
            (came > 0.0).then_some(Through { opening: opening as u32, weight })
        };
        (0..self.before.openings.len()).filter_map(one).collect()
    }

    /// The openings for some places, or none if rays to all of the emitter are better.
    fn best(&self, of: &[u32], everywhere: &[f64]) -> Vec<Through> {
        let mut through = self.through(of, |opening| everywhere[opening]);
        through.retain(|through| through.weight >= LEAST_WEIGHT);
        let [mut to_all, mut to_openings] = [0.0; 2];
        for &k in of {
            let [all, openings] = self.variances(k as usize, &through);
            to_all += all;
            to_openings += openings;
        }
        if to_openings <= MOST_VARIANCE_SHARE * to_all { through } else { Vec::new() }
    }

    /// Variance of a ray from a place to all of the emitter, and of one to openings or over the hemisphere.
    /// Both are zero where no opening is above the horizon, as all rays then go to the emitter.
    fn variances(&self, place: usize, through: &[Through]) -> [f64; 2] {
        let (looked, seen) = (&self.looked[place], &self.seen[place]);
        let [mut inside, mut weighted, mut of_light] = [0.0; 3];
        for &Through { opening, weight } in through {
            let Some(seen) = seen[opening as usize] else { continue };
            let light = seen.steradians * f64::from(seen.looks) / TRIAL_RAYS as f64;
            inside += light;
            weighted += seen.steradians * weight;
            of_light += light / weight;
        }
        if weighted <= 0.0 {
            return [0.0; 2];
        }
        let is_outside = |to: &&Point| {
            let is_passed = |through: &Through| {
                let opening = &self.before.openings[through.opening as usize];
                opening.is_passed(looked.at.point, **to - looked.at.point)
            };
            !through.iter().any(is_passed)
        };
        let outside = looked.free.iter().filter(is_outside).count();
        let outside = looked.whole * outside as f64 / looked.looks as f64;
        let to_openings =
            weighted * of_light / (1.0 - ANYWHERE_SHARE) + PI * outside / ANYWHERE_SHARE;
        [looked.whole * (inside + outside), to_openings]
    }
}

/// The trial rays of a place through an opening.
fn seen(
    lighting: &Lighting,
    before: &Before,
    opening: u32,
    at: &SurfacePoint,
    dice: &mut Dice,
) -> Option<Seen> {
    let through = [Through { opening, weight: 1.0 }];
    let view = View::new(before, &through, at).filter(|view| view.whole > 0.0)?;
    let sequence = dice.fork();
    let comes = |k: usize| {
        let mut dice = Dice::new(sequence, k as u32);
        let pair = dice.pair();
        let direction = view.through_one(pair, &mut dice);
        direction.is_some_and(|(direction, _)| !lighting.seen_along(&view, direction).is_black())
    };
    let looks = (0..TRIAL_RAYS).filter(|&k| comes(k)).count() as u32;
    Some(Seen { steradians: view.whole, looks })
}
