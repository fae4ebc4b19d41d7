//! The share of the light of each luminaire that reaches the scene.
//!
//! A lamp above the ceiling of a room, or a beam past everything, takes part in no map. The map is
//! right, but not the one that was meant. A few particles of every luminaire find such lamps. Each
//! is followed over mirrors and glass to the first place where it matters, or to its end.

use super::emission::Emission;
use crate::elements::carries_map;
use crate::engine::ray::{Dice, PathEnd, follow};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use rayon::prelude::*;

/// Particles of all luminaires together. The share of many luminaires together is known to a
/// hundredth, that of a single one less well.
const TOTAL_PARTICLES: usize = 1 << 14;
/// The fewest particles of one luminaire.
const FEWEST_PARTICLES: usize = 16;
/// The most particles of one luminaire.
const MOST_PARTICLES: usize = 1 << 12;
/// The most particles of all second looks together, if all luminaires need one.
const MOST_SECOND_PARTICLES: usize = 1 << 22;

/// Share of arriving light below which [`MOST_PARTICLES`] particles look again. Of a luminaire that sends a tenth
/// of its light into the scene, [`FEWEST_PARTICLES`] particles miss all once in five times, and [`MOST_PARTICLES`]
/// never.
const LITTLE_ARRIVING_SHARE: f64 = 0.05;

/// The fate of the light of a luminaire.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Name of the luminaire, or of the shape that emits.
    pub name: String,
    /// Luminous flux, lm; `None` for light from infinitely far away, which is unbounded.
    pub luminous_flux_lm: Option<f64>,
    /// Share that reaches a side that carries a map, straight or over mirrors and glass.
    pub arrives: f64,
    /// Share that leaves the scene before, or ends on a side that carries no map and reflects
    /// nothing: the back of a one-sided surface, another lamp. Mirrors and glass keep the rest.
    /// Light from infinitely far away that passes by the scene is not counted.
    pub lost: f64,
}

/// Numbers of particles by their end.
#[derive(Clone, Copy, Default)]
struct Counts {
    arrived: usize,
    left: usize,
    /// Particles that ended on a side that carries no map.
    shut_out: usize,
    kept: usize,
}

/// The arrival of every luminaire that has flux, emitting surfaces last. It is the same for the same scene.
pub fn arrivals(scene: &Scene) -> Vec<Arrival> {
    let Some(emission) = Emission::new(scene) else { return Vec::new() };
    let count = (TOTAL_PARTICLES / emission.count()).clamp(FEWEST_PARTICLES, MOST_PARTICLES);
    let with_flux = (0..emission.count()).into_par_iter().filter(|&k| emission.part(k) > 0.0);
    with_flux.map(|number| arrival(scene, &emission, number, count)).collect()
}

fn arrival(scene: &Scene, emission: &Emission, number: usize, count: usize) -> Arrival {
    let point = scene.luminaires().get(number);
    let is_far = point.is_some_and(|l| l.kind.is_infinitely_far());
    let shares = |look: u64, count: usize| {
        let sequence = Sequence::new(Key::new(number as u64).with(look));
        let counts = sent(scene, emission, number, (sequence, count));
        let left = if is_far { 0 } else { counts.left };
        let lost = left + counts.shut_out;
        let all = (counts.arrived + counts.kept + lost) as f64;
        // All light from far away may pass by the scene.
        if all > 0.0 { [counts.arrived as f64 / all, lost as f64 / all] } else { [0.0, 1.0] }
    };
    let first = shares(0, count);
    let more = (MOST_SECOND_PARTICLES / emission.count()).clamp(count, MOST_PARTICLES);
    let [arrives, lost] = if first[0] < LITTLE_ARRIVING_SHARE { shares(1, more) } else { first };
    let area = || &scene.area_luminaires()[number - scene.luminaires().len()];
    Arrival {
        name: match point {
            Some(luminaire) => luminaire.name.clone(),
            None => scene.shape_names()[area().shape as usize].clone(),
        },
        luminous_flux_lm: (!is_far).then(|| emission.part(number) * emission.flux_lm()),
        arrives,
        lost,
    }
}

/// Numbers of particles of a luminaire by their end.
fn sent(
    scene: &Scene,
    emission: &Emission,
    number: usize,
    (sequence, count): (Sequence, usize),
) -> Counts {
    let mut counts = Counts::default();
    for index in 0..count as u32 {
        let mut dice = Dice::new(sequence, index);
        let [pick, _] = dice.pair();
        let (square, place) = (dice.pair(), dice.pair());
        let Some(sent) = emission.emit_from(number, pick, square, place) else { continue };
        let (mut arrived, mut ends) = (false, false);
        let end = follow(scene, sent.ray, sent.direction, &mut dice, |at, finish, _| {
            arrived |= carries_map(scene, at.triangle, at.back);
            ends = finish.mirror.is_black() && !finish.is_glossy();
        });
        match end {
            _ if arrived => counts.arrived += 1,
            PathEnd::Left => counts.left += 1,
            _ if ends => counts.shut_out += 1,
            _ => counts.kept += 1,
        }
    }
    counts
}
