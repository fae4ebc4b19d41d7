//! Luminaires that light nothing.

use super::finding::Finding;
use isolux::geometry::{Direction, Point, Ray, Vector};
use isolux::scene::{Luminaire, LuminaireKind, Scene};

/// Findings shown one by one; more are counted.
const MAX_SHOWN: usize = 10;

/// What is the matter with a luminaire.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Trouble {
    NoFlux,
    LightsBlackBacks,
    LightsNothing,
}

pub(super) fn findings(scene: &Scene) -> Vec<Finding> {
    let troubled: Vec<(&Luminaire, Trouble)> =
        scene.luminaires().iter().filter_map(|l| Some((l, trouble(scene, l)?))).collect();
    let mut found: Vec<Finding> =
        troubled.iter().take(MAX_SHOWN).map(|(l, trouble)| finding(l, *trouble)).collect();
    if troubled.len() > MAX_SHOWN {
        let more = format!("{} more luminaires in trouble", troubled.len() - MAX_SHOWN);
        found.push(Finding::warning("luminaires", more, "mend the first ones and check again"));
    }
    found
}

fn trouble(scene: &Scene, luminaire: &Luminaire) -> Option<Trouble> {
    let LuminaireKind::Point { position, world_from_luminaire, intensity } = &luminaire.kind else {
        return None;
    };
    if intensity.luminous_flux_lm() <= 0.0 {
        return Some(Trouble::NoFlux);
    }
    let is_lit = |local: &Direction| intensity.intensity_cd(*local) > 0.0;
    let directions: Vec<Direction> = all_around().into_iter().filter(is_lit).collect();
    let seen: Vec<Option<bool>> = directions
        .iter()
        .filter_map(|local| world_from_luminaire.vector(local.to_vector()).direction())
        .map(|direction| sees_black_back(scene, *position, direction))
        .collect();
    match () {
        () if seen.is_empty() => None,
        () if seen.iter().all(Option::is_none) => Some(Trouble::LightsNothing),
        () if seen.iter().flatten().all(|black| *black) => Some(Trouble::LightsBlackBacks),
        () => None,
    }
}

/// Whether the first surface in a direction turns a black back; `None` if there is none.
fn sees_black_back(scene: &Scene, from: Point, direction: Direction) -> Option<bool> {
    let hit = scene.bvh().closest_hit(&Ray::new(from, direction))?;
    let back = scene.material(hit.triangle).finish(true);
    Some(hit.back && back.is_some_and(|f| *f == isolux::scene::Finish::BLACK))
}

/// The 26 neighbours of the middle of a cube of cubes, away from edges of a model on a grid.
fn all_around() -> Vec<Direction> {
    let steps = [-1.0, 0.0, 1.0];
    let mut directions = Vec::new();
    for x in steps {
        for y in steps {
            for z in steps {
                directions.extend(Vector::new(x + 0.013, y + 0.007, z - 0.011).direction());
            }
        }
    }
    directions
}

fn finding(luminaire: &Luminaire, trouble: Trouble) -> Finding {
    let (what, remedy) = match trouble {
        Trouble::NoFlux => ("gives no light", "raise its intensity or its dimming, or remove it"),
        Trouble::LightsNothing => ("lights no surface", "check its position and its aim"),
        Trouble::LightsBlackBacks => (
            "lights only backs of one-sided surfaces",
            "it is inside a solid, or the surfaces around it are turned inside out: move it or \
             flip them",
        ),
    };
    Finding::warning(format!("luminaire `{}`", luminaire.name), what, remedy)
}
