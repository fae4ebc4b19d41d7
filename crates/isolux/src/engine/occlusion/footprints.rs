//! Vertices that something stands on, such as a thin wall between two rooms whose floor has a row of vertices below
//! it.
//!
//! Such a vertex gets some light of either room and tells the light of neither. The elements around it are read from
//! their other corners.

use super::nearby::NEAR;
use crate::elements::{FewNumbers, Subdivision};
use crate::engine::ray::{COPLANAR_COS, Deadline, SurfacePoint};
use crate::scene::Scene;
use isolux_geometry::{Normal, Point, Ray};
use rayon::prelude::*;
use std::collections::HashSet;

/// The height of the lower test rays above the surface, in offsets of ray origins. Rays at the height of [`NEAR`], as
/// a share of the edge, must meet something, too, so that flat objects on the floor do not count.
pub(crate) const LOW: f64 = 4.0;

/// The distance from a vertex, as a share of the edge, below which an object stands on it.
pub(crate) const END_EDGE_SHARE: f64 = 1e-3;

/// The distance from an edge of the places between which objects are looked for, as a share of the element.
const BESIDE_EDGE_SHARE: f64 = 0.1;

/// Whether something stands on each vertex tested so far.
#[derive(Debug, Default)]
pub(crate) struct Footprints(Vec<bool>);

/// A place close to a vertex, beside an edge from it.
struct Place {
    vertex: u32,
    /// The other end of the edge.
    end: u32,
    /// The side of a triangle that the place lies on.
    side: (u32, bool),
    /// The points close to the vertex and farther along.
    at: [Point; 2],
}

impl Footprints {
    /// Tests the new vertices in elements that something stands close to. Those whose turn comes after the end of the time
    /// count as free of objects.
    pub(crate) fn look(
        &mut self,
        scene: &Scene,
        subdivision: &Subdivision,
        is_beset: impl Fn(u32) -> bool + Sync,
        end: &Deadline,
    ) {
        let first = self.0.len();
        self.0.resize(subdivision.vertex_count(), false);
        if self.0.len() == first {
            return;
        }
        let of_leaf = |node: u32| {
            let corners = subdivision.node(node).0.vertices;
            let new = (0..3).filter(move |&k| corners[k] as usize >= first);
            new.map(move |k| places(subdivision, node, k))
        };
        let leaves: Vec<u32> = subdivision.leaves().filter(|&node| is_beset(node)).collect();
        let within: Vec<[Place; 2]> = leaves.into_par_iter().flat_map_iter(of_leaf).collect();
        let is_parted = |a: &Place, b: &Place| {
            if end.has_passed() {
                return false;
            }
            let (triangle, back) = a.side;
            let above = SurfacePoint::new(scene, triangle, back, 1.0 / 3.0, 1.0 / 3.0);
            is_parted(scene, [a.at, b.at], &above)
        };
        let footprints = |[a, b]: &[Place; 2]| is_parted(a, b).then_some(a.vertex);
        let torn_within: Vec<u32> = within.par_iter().filter_map(footprints).collect();
        let mut beside: Vec<Place> = within.into_iter().flatten().collect();
        beside.par_sort_unstable_by_key(|place| (place.vertex, place.end, place.side));
        let are_flat = |a: &Place, b: &Place| a.side == b.side || lie_in_a_plane(scene, a, b);
        let footprints = |pair: &[Place]| match pair {
            [a, b] if (a.vertex, a.end) == (b.vertex, b.end) && are_flat(a, b) => {
                is_parted(a, b).then_some(a.vertex)
            }
            _ => None,
        };
        let torn_between: Vec<u32> = beside.par_windows(2).filter_map(footprints).collect();
        for vertex in torn_within.into_iter().chain(torn_between) {
            self.0[vertex as usize] = true;
        }
    }

    /// Adds new vertices as free of objects, where nothing stands close.
    pub(crate) fn skip(&mut self, subdivision: &Subdivision) {
        self.0.resize(subdivision.vertex_count(), false);
    }

    /// The vertices with objects that share an element with a vertex selected by `is_other`. Where that one is
    /// hidden, the element may have no other vertex beyond the object, and the light of this side would be read
    /// there.
    pub(crate) fn beside(
        &self,
        subdivision: &Subdivision,
        is_other: impl Fn(usize) -> bool,
    ) -> HashSet<u32, FewNumbers> {
        let mut found = HashSet::default();
        if !self.0.contains(&true) {
            return found;
        }
        for leaf in subdivision.leaves() {
            let corners = subdivision.node(leaf).0.vertices;
            if corners.iter().any(|&v| is_other(v as usize)) {
                found.extend(corners.into_iter().filter(|&v| self.has(v as usize)));
            }
        }
        found
    }

    pub(crate) fn has(&self, vertex: usize) -> bool {
        self.0[vertex]
    }
}

/// Whether something stands on the first corner of an element of a surface, and within the element.
pub(crate) fn stands_on(scene: &Scene, [at, a, b]: [Point; 3], above: &SurfacePoint) -> bool {
    is_parted(scene, [beside(at, a, b), beside(at, b, a)], above)
}

/// The places close to a corner of an element, beside either of its edges.
fn places(subdivision: &Subdivision, node: u32, corner: usize) -> [Place; 2] {
    let (own, origin) = subdivision.node(node);
    let [vertex, a, b] = [0, 1, 2].map(|k| own.vertices[(corner + k) % 3]);
    let at = |v: u32| subdivision.vertices()[v as usize].position;
    [(a, b), (b, a)].map(|(end, other)| Place {
        vertex,
        end,
        side: (origin.triangle, origin.back),
        at: beside(at(vertex), at(end), at(other)),
    })
}

/// Two points beside the edge of an element from its first corner to its second: close to the first, and farther
/// along.
fn beside(at: Point, end: Point, other: Point) -> [Point; 2] {
    let to = end.lerp(other, BESIDE_EDGE_SHARE) - at;
    // Objects are looked for between places at these shares of edges.
    [4.0 * END_EDGE_SHARE, NEAR].map(|share| at + to * share)
}

/// Whether the triangles of two places beside one edge lie in a plane: walls stand on edges of floors, too.
fn lie_in_a_plane(scene: &Scene, a: &Place, b: &Place) -> bool {
    let normal = |place: &Place| {
        let (triangle, back) = place.side;
        SurfacePoint::new(scene, triangle, back, 1.0 / 3.0, 1.0 / 3.0).geometric
    };
    normal(a).dot(normal(b)) > COPLANAR_COS
}

/// Whether something stands between two places, close to the surface and well above it.
fn is_parted(scene: &Scene, [a, b]: [[Point; 2]; 2], above: &SurfacePoint) -> bool {
    let up = Normal::to_vector(above.geometric);
    // The rays between the farther points run about as high as these are apart.
    let heights_m = [LOW * above.away_m, (b[1] - a[1]).length()];
    (0..2).all(|k| {
        let way = Ray::between(a[k] + up * heights_m[k], b[k] + up * heights_m[k]);
        scene.bvh().closest_hit(&way.skipping(above.triangle)).is_some()
    })
}
