//! What places have seen of an emitting surface, and what that says of where rays had better go.

use super::super::lighting::Lighting;
use super::super::openings::{ANYWHERE, Before, Through, Told, View, Zones};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::{Key, Sequence};
use isolux_geometry::Point;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Places from where up to this share of the looks at an emitter sees it are in the dark.
const DARK: f64 = 0.25;

/// Looks of a place at each opening, and how many those of all places count beside them.
const LOOKS: usize = 4;
const PRIOR: f64 = 1.0;

/// Openings that less than a hundredth of the looks of a part gets through are not for it.
const LEAST_WEIGHT: f64 = 0.1;

/// Rays go to openings where this leaves at most so much of the variance.
const GAIN: f64 = 0.5;

/// A place that looked at an emitter.
pub(super) struct Looked {
    pub(super) at: SurfacePoint,
    /// Projected solid angle of the emitter if nothing were in the way, sr.
    pub(super) whole: f64,
    pub(super) looks: usize,
    pub(super) free: Vec<Point>,
    pub(super) stopped: Vec<Point>,
}

impl Looked {
    pub(super) fn is_dark(&self) -> bool {
        self.free.len() as f64 <= DARK * self.looks as f64
    }
}

/// What a place has seen through an opening.
#[derive(Clone, Copy)]
struct Seen {
    /// Projected solid angle of the opening, sr.
    steradians: f64,
    /// Looks through it that came to the emitter.
    looks: u32,
}

/// What all places have seen through openings: nothing where they are below the horizon.
pub(super) struct ThroughOpenings<'a> {
    before: &'a Before,
    looked: &'a [Looked],
    seen: Vec<Vec<Option<Seen>>>,
}

impl<'a> ThroughOpenings<'a> {
    pub(super) fn of(
        lighting: &Lighting,
        before: &'a Before,
        looked: &'a [Looked],
        key: Key,
    ) -> Self {
        let one = |(k, looked): (usize, &Looked)| {
            let mut dice = Dice::new(Sequence::new(key), k as u32);
            let all = 0..before.openings.len() as u32;
            all.map(|opening| seen(lighting, before, opening, &looked.at, &mut dice)).collect()
        };
        Self { before, looked, seen: looked.par_iter().enumerate().map(one).collect() }
    }

    /// From where rays had better go to which openings.
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

    /// Whether a place sees anything of the emitter: in the dark inside of a wall nothing is known, and it does not matter.
    fn sees_any(&self, place: usize) -> bool {
        let through = self.seen[place].iter().flatten().any(|seen| seen.looks > 0);
        through || !self.looked[place].free.is_empty()
    }

    /// The openings that some places see the emitter through; `prior` is the share of one look more that does.
    fn through(&self, of: &[u32], prior: impl Fn(usize) -> f64) -> Vec<Through> {
        let one = |opening: usize| {
            let telling = of.iter().filter(|&&k| self.sees_any(k as usize));
            let all = telling.filter_map(|&k| self.seen[k as usize][opening]);
            let (mut count, mut came) = (PRIOR, PRIOR * prior(opening));
            for seen in all {
                count += LOOKS as f64;
                came += f64::from(seen.looks);
            }
            let weight = (came / count).sqrt();
            (came > 0.0).then_some(Through { opening: opening as u32, weight })
        };
        (0..self.before.openings.len()).filter_map(one).collect()
    }

    /// The same, if rays had better go there.
    fn best(&self, of: &[u32], everywhere: &[f64]) -> Vec<Through> {
        let mut through = self.through(of, |opening| everywhere[opening]);
        through.retain(|through| through.weight >= LEAST_WEIGHT);
        let [mut to_all, mut to_openings] = [0.0; 2];
        for &k in of {
            let [all, openings] = self.variances(k as usize, &through);
            to_all += all;
            to_openings += openings;
        }
        if to_openings <= GAIN * to_all { through } else { Vec::new() }
    }

    /// Variance of a ray from a place to all of the emitter, and of one to openings or anywhere: of nothing where all rays go to the
    /// emitter, as no opening is above the horizon.
    fn variances(&self, place: usize, through: &[Through]) -> [f64; 2] {
        let (looked, seen) = (&self.looked[place], &self.seen[place]);
        let [mut inside, mut weighted, mut of_light] = [0.0; 3];
        for &Through { opening, weight } in through {
            let Some(seen) = seen[opening as usize] else { continue };
            let light = seen.steradians * f64::from(seen.looks) / LOOKS as f64;
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
        let to_openings = weighted * of_light / (1.0 - ANYWHERE) + PI * outside / ANYWHERE;
        [looked.whole * (inside + outside), to_openings]
    }
}

/// Looks through an opening.
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
    let looks = (0..LOOKS).filter(|&k| comes(k)).count() as u32;
    Some(Seen { steradians: view.whole, looks })
}
