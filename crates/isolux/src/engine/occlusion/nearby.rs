//! Objects near a place, found by short rays.

use crate::elements::{Elements, Subdivision};
use crate::engine::ray::{Deadline, ShortRays, SurfacePoint};
use crate::map::Standing;
use crate::sampling::Key;
use crate::scene::Scene;
use isolux_geometry::{Hit, Point};
use rayon::prelude::*;
use std::sync::LazyLock;

/// The number of rays that look for objects near a place.
const FEELERS: usize = 16;
/// The directions of these rays.
static DIRECTIONS: LazyLock<ShortRays<FEELERS>> =
    LazyLock::new(|| ShortRays::of(Key::new(0).with(6)));

/// The number of rays, the first ones, of which at least one meets an object that hides half of the hemisphere.
const FIRST_FEELERS: usize = 4;

/// The number of rays that meet something in a gap: at an edge of a room half of them do, behind a cupboard all.
const CLOSED_FEELERS: usize = 13;

/// The length of the rays, as a share of the longest edge of the element. Closer objects change light from place to
/// place in ways that its vertices do not tell.
pub(crate) const NEAR: f64 = 0.25;

/// The number of rays that must meet something within the length of the element for its vertices not to tell the
/// light between them.
const BESET_FEELERS: usize = 3;

/// Whether something is so close to a place that an element with edges of this length cannot tell the light there, as
/// in the gap between a cupboard and its wall or on the ceiling above a column.
pub(crate) fn is_closed_in(scene: &Scene, at: &SurfacePoint, longest_edge_m: f64) -> bool {
    let (mut met, mut missed) = (0, 0);
    for index in 0..FEELERS {
        if scene.bvh().any_hit(&DIRECTIONS.ray_of(index, at, NEAR * longest_edge_m)) {
            met += 1;
        } else {
            missed += 1;
        }
        if met >= CLOSED_FEELERS || missed > FEELERS - CLOSED_FEELERS {
            break;
        }
    }
    met >= CLOSED_FEELERS
}

/// Whether something is nearer to a place than an element with edges of this length is long. Transparent objects
/// count, since panes separate light, too.
pub(crate) fn is_beset(scene: &Scene, at: &SurfacePoint, longest_edge_m: f64) -> bool {
    met_within(scene, at, longest_edge_m).iter().flatten().count() >= BESET_FEELERS
}

/// The largest length of an element for which a place is not beset, m; infinite if nothing is within `reach_m`.
pub(crate) fn beset_from_m(scene: &Scene, at: &SurfacePoint, reach_m: f64) -> f64 {
    let met = met_within(scene, at, reach_m);
    let mut near: Vec<f32> = met.iter().flatten().map(|hit| hit.t).collect();
    near.sort_by(f32::total_cmp);
    near.get(BESET_FEELERS - 1).map_or(f64::INFINITY, |&t| f64::from(t))
}

/// The distance of an object that hides much of the hemisphere of a place, m; infinite if none does within `reach_m`.
/// A few rays are enough to find that none does.
pub(crate) fn hemmed_in_m(scene: &Scene, at: &SurfacePoint, reach_m: f64) -> f64 {
    let meets = |k: usize| scene.bvh().closest_hit(&DIRECTIONS.ray_of(k, at, reach_m)).is_some();
    if (0..FIRST_FEELERS).any(meets) { beset_from_m(scene, at, reach_m) } else { f64::INFINITY }
}

/// The hits of short rays from a place.
fn met_within(scene: &Scene, at: &SurfacePoint, reach_m: f64) -> [Option<Hit>; FEELERS] {
    DIRECTIONS.met(scene, |k| DIRECTIONS.ray_of(k, at, reach_m))
}

/// The longest edge of the element at a place, m; zero where there is none.
pub(crate) fn edge_at_m(elements: &Elements, at: &SurfacePoint) -> f64 {
    let corners = elements.locate(at.triangle, at.back, at.u, at.v);
    corners.map_or(0.0, |corners| longest_edge_m(elements, corners.map(|(vertex, _)| vertex)))
}

/// The longest edge of an element, m.
pub(crate) fn longest_edge_m(elements: &Elements, corners: [u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| elements.vertices()[v as usize].position);
    (b - a).length().max((c - b).length()).max((a - c).length())
}

/// Whether vertices are closed in, with results kept from earlier tests.
#[derive(Debug, Default)]
pub(crate) struct ClosedIn(Vec<Option<Feeling>>);

/// The result of a test, with the place and edge length tested.
#[derive(Debug)]
struct Feeling {
    place: (u32, Point),
    edge_m: f64,
    is_closed_in: bool,
}

impl ClosedIn {
    /// The standings of vertices on the current elements. Vertices that were open among longer elements stay open.
    /// Rays test only places and edge lengths that were not tested before. Vertices whose turn comes after the end of the
    /// time count as open.
    pub(crate) fn standings(
        &mut self,
        (scene, subdivision): (&Scene, &Subdivision),
        before: &[Option<Standing>],
        surface: impl Fn(usize) -> SurfacePoint + Sync,
        end: &Deadline,
    ) -> Vec<Option<Standing>> {
        let edges_m = subdivision.longest_edges_m();
        let on_border = subdivision.border_vertices();
        self.0.resize_with(before.len(), || None);
        let one = |(k, felt): (usize, &mut Option<Feeling>)| {
            if before[k] == Some(Standing::Open) || end.has_passed() {
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
