//! A first mesh at the scale of every room.
//!
//! The area of the whole scene gives the size of the first elements. A small room beside a large yard would get two
//! elements per wall, and light interpolated between its corners lacks some per cent at every reflection. The
//! distance that a surface sees tells how fast light varies over it.

use crate::elements::{Origin, Subdivision};
use crate::engine::ray::{Deadline, ShortRays, Stand, SurfacePoint};
use crate::sampling::Key;
use crate::scene::Scene;
use rayon::prelude::*;
use std::sync::LazyLock;

/// The number of rays that tell the distance that an element sees.
const FEELERS: usize = 8;
/// The directions of these rays.
static DIRECTIONS: LazyLock<ShortRays<FEELERS>> =
    LazyLock::new(|| ShortRays::of(Key::new(0).with(12)));

/// The longest edge of an element, as a share of the distance that it sees.
const MOST_EDGE_SHARE: f64 = 0.3;

/// The ratio of the edges of elements to the distance seen above which a surface lies in a slit, not in a room.
const SLIT_EDGE_RATIO: f64 = 8.0;
/// The distance seen, m, below which a surface is no room that somebody works in, but the inside of a lamp or
/// a cupboard. Without it, the insides of luminous boxes take hundreds of vertices and seven times the time
/// (decision 42).
const LEAST_ROOM_M: f64 = 1.0;

/// The largest number of added vertices: surfaces below tables and cupboards do not see far, either.
const MOST_ADDED_VERTICES: usize = 700;

/// Bisects elements that are too long for the distance that their surface sees, the largest first. Surfaces that nothing is known of by
/// the end of the time keep their elements.
pub(crate) fn bisect_to_scale(
    scene: &Scene,
    subdivision: &mut Subdivision,
    max_vertices: usize,
    end: &Deadline,
) {
    let most = (subdivision.size() + MOST_ADDED_VERTICES).min(max_vertices);
    // Corners see less far than the middle of a wall, but light varies no less there; so the farthest distance
    // counts.
    let side = |subdivision: &Subdivision, node: u32| {
        let Origin { triangle, back, .. } = subdivision.node(node).1;
        2 * triangle as usize + usize::from(back)
    };
    let mut leaves: Vec<u32> = subdivision.leaves().collect();
    // Surfaces with short edges need no rays: their elements are short enough for any distance.
    let mut is_long = vec![false; 2 * scene.triangle_count() as usize];
    for &node in &leaves {
        is_long[side(subdivision, node)] |=
            subdivision.longest_edge_m(node) > MOST_EDGE_SHARE * LEAST_ROOM_M;
    }
    leaves.retain(|&node| is_long[side(subdivision, node)]);
    let reach = |&node: &u32| match end.has_passed() {
        true => f64::INFINITY,
        false => reach_m(scene, SurfacePoint::amid_node(scene, subdivision, node).stand()),
    };
    let reaches_m: Vec<f64> = leaves.par_iter().map(reach).collect();
    let farthest = |&is_long: &bool| if is_long { 0.0_f64 } else { f64::INFINITY };
    let mut farthest_m: Vec<f64> = is_long.iter().map(farthest).collect();
    for (&node, reach_m) in leaves.iter().zip(reaches_m) {
        let of_side = &mut farthest_m[side(subdivision, node)];
        *of_side = of_side.max(reach_m);
    }
    let mut asked = leaves;
    asked.retain(|&node| {
        let farthest_m = farthest_m[side(subdivision, node)];
        farthest_m > LEAST_ROOM_M && subdivision.longest_edge_m(node) < SLIT_EDGE_RATIO * farthest_m
    });
    while !asked.is_empty() {
        let allowed_m = |node: u32| MOST_EDGE_SHARE * farthest_m[side(subdivision, node)];
        asked.retain(|&node| subdivision.longest_edge_m(node) > allowed_m(node));
        let area_m2 = |node: u32| subdivision.triangle(node).area();
        asked.sort_by(|&a, &b| area_m2(b).total_cmp(&area_m2(a)).then(a.cmp(&b)));
        let first = subdivision.node_count() as u32;
        for node in asked {
            if subdivision.size() >= most {
                return;
            }
            subdivision.bisect(node);
        }
        asked = subdivision.leaves().filter(|&node| node >= first).collect();
    }
}

/// Whether a place on a triangle sees as far as one in a room, and sees walls there.
pub(crate) fn is_in_room(scene: &Scene, place: Stand) -> bool {
    let reach_m = reach_m(scene, place);
    reach_m > LEAST_ROOM_M && reach_m.is_finite()
}

/// The distance that three quarters of the rays from a place on a triangle do not exceed, m.
fn reach_m(scene: &Scene, place: Stand) -> f64 {
    let met = DIRECTIONS.met(scene, |k| DIRECTIONS.ray(k, place));
    let mut distances_m = met.map(|hit| hit.map_or(f64::INFINITY, |hit| f64::from(hit.t)));
    distances_m.sort_by(f64::total_cmp);
    distances_m[FEELERS * 3 / 4 - 1]
}
