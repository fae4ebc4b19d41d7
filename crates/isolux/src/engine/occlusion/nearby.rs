//! What stands near a place, as short rays find it.

use crate::elements::{Elements, Subdivision};
use crate::engine::ray::{ShortRays, SurfacePoint};
use crate::map::Standing;
use crate::sampling::Key;
use crate::scene::Scene;
use isolux_geometry::{Hit, Point};
use rayon::prelude::*;
use std::sync::LazyLock;

/// Rays that look for something before a place.
const FEELERS: usize = 16;
static DIRECTIONS: LazyLock<ShortRays<FEELERS>> =
    LazyLock::new(|| ShortRays::of(Key::new(0).with(6)));

/// So many of them, the first, meet something that hides half of what there is.
const FEWEST_FEELERS: usize = 4;

/// How many of them must meet it in a gap: at an edge of a room half of them do, behind a cupboard all.
const CLOSED: usize = 13;

/// How far they look, as a share of the longest edge of the element: what is nearer than that
/// changes light from place to place in ways that its vertices do not tell.
pub(crate) const NEAR: f64 = 0.25;

/// How many must meet something as near as the element is long for its vertices not to tell what light
/// comes between them.
const BESET: usize = 3;

/// Whether something stands so close before a place that an element of such edges cannot tell what
/// light comes there: in the gap between a cupboard and its wall, on the ceiling above a column.
pub(crate) fn is_closed_in(scene: &Scene, at: &SurfacePoint, longest_edge_m: f64) -> bool {
    let (mut met, mut missed) = (0, 0);
    for index in 0..FEELERS {
        if scene.bvh().any_hit(&DIRECTIONS.ray_of(index, at, NEAR * longest_edge_m)) {
            met += 1;
        } else {
            missed += 1;
        }
        if met >= CLOSED || missed > FEELERS - CLOSED {
            break;
        }
    }
    met >= CLOSED
}

/// Whether there is something before a place that is as near as an element of such edges is long, transparent or not: panes part
/// light, too.
pub(crate) fn is_beset(scene: &Scene, at: &SurfacePoint, longest_edge_m: f64) -> bool {
    met_within(scene, at, longest_edge_m).iter().flatten().count() >= BESET
}

/// How long an element may at most be for a place not to be beset, m; infinite if nothing is within
/// `reach_m`.
pub(crate) fn beset_from_m(scene: &Scene, at: &SurfacePoint, reach_m: f64) -> f64 {
    let met = met_within(scene, at, reach_m);
    let mut near: Vec<f32> = met.iter().flatten().map(|hit| hit.t).collect();
    near.sort_by(f32::total_cmp);
    near.get(BESET - 1).map_or(f64::INFINITY, |&t| f64::from(t))
}

/// How close something stands before a place that hides much of what there is, m; infinite if nothing does within `reach_m`. A few rays
/// find out that nothing does.
pub(crate) fn hemmed_in_m(scene: &Scene, at: &SurfacePoint, reach_m: f64) -> f64 {
    let meets = |k: usize| scene.bvh().closest_hit(&DIRECTIONS.ray_of(k, at, reach_m)).is_some();
    if (0..FEWEST_FEELERS).any(meets) { beset_from_m(scene, at, reach_m) } else { f64::INFINITY }
}

/// What rays find that feel about before a place.
fn met_within(scene: &Scene, at: &SurfacePoint, reach_m: f64) -> [Option<Hit>; FEELERS] {
    DIRECTIONS.met(scene, |k| DIRECTIONS.ray_of(k, at, reach_m))
}

/// Longest edge of the element at a place, m; zero where there is none.
pub(crate) fn edge_at_m(elements: &Elements, at: &SurfacePoint) -> f64 {
    let corners = elements.locate(at.triangle, at.back, at.u, at.v);
    corners.map_or(0.0, |corners| longest_edge_m(elements, corners.map(|(vertex, _)| vertex)))
}

/// Longest edge of an element, m.
pub(crate) fn longest_edge_m(elements: &Elements, corners: [u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| elements.vertices()[v as usize].position);
    (b - a).length().max((c - b).length()).max((a - c).length())
}

/// Whether vertices are closed in, as it was felt last.
#[derive(Debug, Default)]
pub(crate) struct ClosedIn(Vec<Option<Feeling>>);

/// Where it was felt, and what.
#[derive(Debug)]
struct Feeling {
    place: (u32, Point),
    edge_m: f64,
    is_closed_in: bool,
}

impl ClosedIn {
    /// What vertices stand for on elements as they are now, those that were in the open among longer ones
    /// still are. Rays feel about only where that was not felt before.
    pub(crate) fn standings(
        &mut self,
        scene: &Scene,
        subdivision: &Subdivision,
        before: &[Option<Standing>],
        surface: impl Fn(usize) -> SurfacePoint + Sync,
    ) -> Vec<Option<Standing>> {
        let edges_m = subdivision.longest_edges_m();
        let on_border = subdivision.border_vertices();
        self.0.resize_with(before.len(), || None);
        let one = |(k, felt): (usize, &mut Option<Feeling>)| {
            if before[k] == Some(Standing::Open) {
                return Some(Standing::Open);
            }
            let (at, edge_m) = (surface(k), edges_m[k]);
            let place = (at.triangle, at.point);
            let known = felt.as_ref().filter(|felt| felt.place == place && felt.edge_m == edge_m);
            let is_closed_in = match known {
                Some(felt) => felt.is_closed_in,
                None => is_closed_in(scene, &at, edge_m),
            };
            *felt = Some(Feeling { place, edge_m, is_closed_in });
            Some(match (is_closed_in, on_border[k]) {
                (false, _) => Standing::Open,
                (true, true) => Standing::Rim,
                (true, false) => Standing::Gap,
            })
        };
        self.0.par_iter_mut().enumerate().map(one).collect()
    }
}
