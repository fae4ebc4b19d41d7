//! A first mesh that knows the scale of every room.
//!
//! The size of the first elements comes of the area of the whole scene. A small room beside a large yard would be two elements a wall, and
//! light that is interpolated between its corners lacks some per cent at every reflection. How far a surface sees tells how fast light
//! varies over it.

use crate::elements::{Origin, Subdivision};
use crate::engine::ray::{ShortRays, SurfacePoint};
use crate::sampling::Key;
use crate::scene::Scene;
use isolux_geometry::{Normal, Point};
use rayon::prelude::*;
use std::sync::LazyLock;

/// Rays that tell how far an element sees: as far as three quarters of them do.
const FEELERS: usize = 8;
const COUNTED: usize = 6;
static DIRECTIONS: LazyLock<ShortRays<FEELERS>> =
    LazyLock::new(|| ShortRays::of(Key::new(0).with(12)));

/// Edges are no longer than this part of that.
const OF_REACH: f64 = 0.3;

/// Surfaces with elements so many times as long as they see far lie in a slit, not in a room; nor is what sees less far than this a room
/// that somebody works in, but the inside of a lamp or a cupboard, m.
const SLIT: f64 = 8.0;
const ROOM_M: f64 = 1.0;

/// So many vertices are added at most: below tables and cupboards one does not see far, either.
const MOST_ADDED: usize = 700;

/// Bisects elements that are longer than their surface sees far, the largest first.
pub(crate) fn bisect_to_scale(scene: &Scene, subdivision: &mut Subdivision, max_vertices: usize) {
    let most = (subdivision.vertex_count() + MOST_ADDED).min(max_vertices);
    // In corners one sees less far than from the middle of a wall, where light varies no less.
    let side = |subdivision: &Subdivision, node: u32| {
        let Origin { triangle, back, .. } = subdivision.node(node).1;
        2 * triangle as usize + usize::from(back)
    };
    let mut leaves: Vec<u32> = subdivision.leaves().collect();
    // However far one sees from those whose edges are all shorter, they are short enough.
    let mut is_long = vec![false; 2 * scene.triangle_count() as usize];
    for &node in &leaves {
        is_long[side(subdivision, node)] |= subdivision.longest_edge_m(node) > OF_REACH * ROOM_M;
    }
    leaves.retain(|&node| is_long[side(subdivision, node)]);
    let reach = |&node: &u32| {
        let at = SurfacePoint::amid_node(scene, subdivision, node);
        reach_m(scene, (at.start(), at.shading, at.triangle))
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
        farthest_m > ROOM_M && subdivision.longest_edge_m(node) < SLIT * farthest_m
    });
    while !asked.is_empty() {
        let allowed_m = |node: u32| OF_REACH * farthest_m[side(subdivision, node)];
        asked.retain(|&node| subdivision.longest_edge_m(node) > allowed_m(node));
        let area_m2 = |node: u32| subdivision.triangle(node).area();
        asked.sort_by(|&a, &b| area_m2(b).total_cmp(&area_m2(a)).then(a.cmp(&b)));
        let first = subdivision.node_count() as u32;
        for node in asked {
            if subdivision.vertex_count() >= most {
                return;
            }
            subdivision.bisect(node);
        }
        asked = subdivision.leaves().filter(|&node| node >= first).collect();
    }
}

/// Whether a place on a triangle sees as far as one in a room, and walls there.
pub(crate) fn is_in_room(scene: &Scene, place: (Point, Normal, u32)) -> bool {
    let reach_m = reach_m(scene, place);
    reach_m > ROOM_M && reach_m.is_finite()
}

/// How far a place on a triangle sees, m: as far as most rays.
fn reach_m(scene: &Scene, place: (Point, Normal, u32)) -> f64 {
    let met = DIRECTIONS.met(scene, |k| DIRECTIONS.ray(k, place));
    let mut distances_m = met.map(|hit| hit.map_or(f64::INFINITY, |hit| f64::from(hit.t)));
    distances_m.sort_by(f64::total_cmp);
    distances_m[COUNTED - 1]
}
