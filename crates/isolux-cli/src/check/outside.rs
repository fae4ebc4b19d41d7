//! Luminaires outside of closed rooms.

use super::around::{all_around, extent_m};
use isolux::geometry::{Direction, Point, Ray};
use isolux::sampling::{CosineHemisphere, Key, Sequence};
use isolux::scene::{Body, Luminaire, LuminaireKind, Scene};

/// Rays from a wall that must all meet something for the space before it to be closed. Of a space with an opening that is a tenth
/// of what the wall sees, all miss it once in 800 walls.
const INWARD: u32 = 64;
/// The share of the size of the scene that rays begin before a wall: above the rounding of single precision.
const OFF: f64 = 1e-5;

/// Whether a luminaire lights nothing but backs of walls whose fronts face a closed space,
/// while it stands in the open itself: outside of a room, into which no light of it comes. Walls whose fronts face outwards, as
/// those of solids do, may be lit there.
pub(super) fn is_outside(scene: &Scene, luminaire: &Luminaire) -> bool {
    let LuminaireKind::Point { position, world_from_luminaire, intensity, .. } = &luminaire.kind
    else {
        return false;
    };
    let from = *position;
    let in_scene = |local: Direction| world_from_luminaire.vector(local.to_vector()).direction();
    let met = |direction: Direction| scene.bvh().closest_hit(&Ray::new(from, direction));
    let is_lit = |local: &Direction| intensity.intensity_cd(*local) > 0.0;
    let mut walls = Vec::new();
    for direction in all_around().into_iter().filter(is_lit).filter_map(in_scene) {
        let Some(hit) = met(direction) else { continue };
        let is_glass = matches!(scene.material(hit.triangle).body, Body::Dielectric(_));
        if !hit.back || is_glass {
            return false;
        }
        walls.push((hit.triangle, from + direction.to_vector() * f64::from(hit.t)));
    }
    let mut all = all_around().into_iter().filter_map(in_scene);
    let is_in_the_open = all.any(|direction| met(direction).is_none());
    let is_closed = |&(triangle, place): &(u32, Point)| faces_closed_space(scene, triangle, place);
    !walls.is_empty() && is_in_the_open && walls.iter().all(is_closed)
}

/// Whether all that the front of a wall sees from a place is of the scene.
fn faces_closed_space(scene: &Scene, triangle: u32, place: Point) -> bool {
    let front = scene.geometric_normal(triangle).to_direction();
    let off_m = OFF * extent_m(scene);
    let from = place + front.to_vector() * off_m;
    let sequence = Sequence::new(Key::new(3));
    (0..INWARD).all(|index| {
        let local = CosineHemisphere::sample(sequence.pair(index, 0));
        let hit = scene.bvh().closest_hit(&Ray::new(from, front.from_local(local)));
        // Light comes in through glass.
        hit.is_some_and(|hit| !matches!(scene.material(hit.triangle).body, Body::Dielectric(_)))
    })
}
