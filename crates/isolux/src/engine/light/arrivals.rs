//! What of the light of luminaires comes to the scene at all.
//!
//! A lamp above the ceiling of a room, or a beam past everything, takes part in no map: the map is right, and yet not what was meant. Few
//! particles of every luminaire tell, each followed over mirrors and glass to where it is first known to matter, or not to.

use super::emission::Emission;
use crate::elements::carries_map;
use crate::engine::ray::{Dice, PathEnd, follow};
use crate::sampling::{Key, Sequence};
use crate::scene::{LuminaireKind, Scene};
use rayon::prelude::*;

/// Particles of all luminaires together, and bounds of those of one: shares of many are known to a hundredth together, that of one alone to
/// less than that.
const PARTICLES: usize = 1 << 14;
const FEWEST: usize = 16;
const MOST: usize = 1 << 12;

/// Where less than this share arrives, as many particles as there may be look again: of one that sends a tenth of its light into the scene, the
/// fewest particles miss that once in five times, and these never.
const LITTLE: f64 = 0.05;

/// What becomes of the light of a luminaire.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Name of the luminaire, or of the shape that emits.
    pub name: String,
    /// Its luminous flux, lm; none of parallel light, which has no end.
    pub luminous_flux_lm: Option<f64>,
    /// The share that comes to a side that carries a map, straight or over mirrors and glass.
    pub arrives: f64,
    /// The share that leaves the scene without, or ends on a side that carries none and reflects nothing: the back of a one-sided
    /// surface, another lamp. Mirrors and glass keep the rest. Of parallel light what passes by the scene is not counted.
    pub lost: f64,
}

/// Counts of particles.
#[derive(Clone, Copy, Default)]
struct Counts {
    arrived: usize,
    left: usize,
    /// Ended on what carries no map.
    shut_out: usize,
    kept: usize,
}

/// That of all luminaires that have flux, emitting surfaces last. The same for the same scene.
pub fn arrivals(scene: &Scene) -> Vec<Arrival> {
    let Some(emission) = Emission::new(scene) else { return Vec::new() };
    let count = (PARTICLES / emission.count()).clamp(FEWEST, MOST);
    let with_flux = (0..emission.count()).into_par_iter().filter(|&k| emission.part(k) > 0.0);
    with_flux.map(|number| arrival(scene, &emission, number, count)).collect()
}

fn arrival(scene: &Scene, emission: &Emission, number: usize, count: usize) -> Arrival {
    let point = scene.luminaires().get(number);
    let is_parallel = point.is_some_and(|l| matches!(l.kind, LuminaireKind::Directional { .. }));
    let shares = |look: u64, count: usize| {
        let sequence = Sequence::new(Key::new(number as u64).with(look));
        let counts = sent(scene, emission, number, (sequence, count));
        let left = if is_parallel { 0 } else { counts.left };
        let lost = left + counts.shut_out;
        let all = (counts.arrived + counts.kept + lost) as f64;
        // Nothing of parallel light may have met anything.
        if all > 0.0 { [counts.arrived as f64 / all, lost as f64 / all] } else { [0.0, 1.0] }
    };
    let first = shares(0, count);
    let [arrives, lost] = if first[0] < LITTLE { shares(1, MOST) } else { first };
    let area = || &scene.area_luminaires()[number - scene.luminaires().len()];
    Arrival {
        name: match point {
            Some(luminaire) => luminaire.name.clone(),
            None => scene.shape_names()[area().shape as usize].clone(),
        },
        luminous_flux_lm: (!is_parallel).then(|| emission.part(number) * emission.flux_lm()),
        arrives,
        lost,
    }
}

/// Where particles of a luminaire come to.
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
