//! Elements that something stands across, such as a thin wall between two rooms that share a floor.
//!
//! Vertices on one side tell nothing of the light on the other. If two edges of an element are blocked, close to the
//! surface and well above it, and the third is not, an approximately straight line cuts one corner off. Places before
//! the line are read from that corner alone, those behind it from the others. If one edge is blocked and something
//! stands on the opposite corner, the line starts there.

use super::footprints::{END_EDGE_SHARE, LOW, stands_on};
use super::nearby::NEAR;
use crate::ablation::without;
use crate::elements::{Elements, FewNumbers, Origin, Subdivision, set_in_order, table_in_order};
use crate::engine::ray::{Deadline, NEVER, SurfacePoint};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point, Ray};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, HashSet};

/// The difference of light between the corners of an element, as a share of the greatest, above which it is uneven.
const UNEVEN_LIGHT_SHARE: f64 = 0.2;

/// The share of the light of another vertex of its element below which a vertex is dark.
const DARK_LIGHT_SHARE: f64 = 0.01;

/// The distance along an edge, as a share of it, up to which an object across it leaves the element nearly whole.
const JUST_BEHIND_EDGE_SHARE: f64 = 0.25;

/// The barriers across elements.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Barriers {
    #[serde(serialize_with = "table_in_order")]
    of_nodes: HashMap<u32, Barrier, FewNumbers>,
    /// The elements by their corners.
    #[serde(serialize_with = "set_in_order")]
    corners: HashSet<[u32; 3], FewNumbers>,
    /// The end of its edge that a vertex made by bisecting these elements sees, where it sees only one.
    #[serde(serialize_with = "table_in_order")]
    ends: HashMap<u32, u32, FewNumbers>,
}

/// A line that cuts one corner off an element.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Barrier {
    corner: usize,
    /// The inverse of the position of the line on each edge from that corner, as a share of the edge: the edge to the
    /// next corner, then to the one after.
    over: [f64; 2],
}

impl Barrier {
    /// The corners on the side of the line that a place with these weights lies on.
    pub(crate) fn side(&self, weights: [f64; 3]) -> [bool; 3] {
        let along = [1, 2].map(|k| weights[(self.corner + k) % 3] * self.over[k - 1]);
        let is_before = along[0] + along[1] < 1.0;
        [0, 1, 2].map(|k| (k == self.corner) == is_before)
    }
}

impl Barriers {
    /// The barriers across those of these nodes whose light is uneven; a test of all would take too long. The
    /// vertices of the nodes are numbered below `first`. Nodes whose turn comes after the end of the time count as free.
    pub(crate) fn of(
        scene: &Scene,
        elements: &Elements,
        (nodes, light): (impl Iterator<Item = Side>, &[Rgb]),
        (first, end): (usize, &Deadline),
    ) -> Self {
        if without("barriers") {
            return Self::default();
        }
        let is_uneven = |side: &Side| {
            let corners = elements.node(side.node).vertices;
            let [a, b, c] = corners.map(|vertex| light[vertex as usize].luminance());
            let (least, most) = (a.min(b).min(c), a.max(b).max(c));
            most - least > UNEVEN_LIGHT_SHARE * most
        };
        let nodes: Vec<Side> = nodes.filter(is_uneven).collect();
        let look = Look { scene, elements };
        let cut = |side| (!end.has_passed()).then(|| look.cut(side)).flatten();
        let found = nodes.par_iter().filter_map(|side| Some((side, cut(side)?)));
        let found: Vec<(&Side, Barrier)> = found.collect();
        let mut cuts = Self::default();
        for (side, cut) in found {
            cuts.of_nodes.insert(side.node, cut);
            cuts.corners.insert(elements.node(side.node).vertices);
            let above = side.above(scene);
            elements.visit_below(side.node, &mut |corners| {
                for vertex in corners.into_iter().filter(|&v| v as usize >= first) {
                    if let Some(end) = look.end_seen(vertex, &above) {
                        cuts.ends.insert(vertex, end);
                    }
                }
            });
        }
        cuts
    }

    /// Whether the barriers are across some of so many nodes, over so many vertices.
    pub(crate) fn are_of(&self, nodes: usize, vertices: usize) -> bool {
        let is_vertex = |v: &u32| (*v as usize) < vertices;
        self.of_nodes.iter().all(|(&node, of)| (node as usize) < nodes && of.corner < 3)
            && self.corners.iter().flatten().all(is_vertex)
            && self.ends.iter().flat_map(|(vertex, end)| [vertex, end]).all(is_vertex)
    }

    /// The barriers across the elements of a map.
    pub(crate) fn of_map(scene: &Scene, elements: &Elements, light: &[Rgb]) -> Self {
        Self::of(scene, elements, (Side::of_all(elements), light), (usize::MAX, &NEVER))
    }

    /// The barrier across a node, if there is one.
    #[inline]
    pub(crate) fn of_node(&self, node: u32) -> Option<&Barrier> {
        if self.of_nodes.is_empty() { None } else { self.of_nodes.get(&node) }
    }

    /// Whether something stands across the element with these corners.
    pub(crate) fn has(&self, corners: [u32; 3]) -> bool {
        self.corners.contains(&corners)
    }

    /// The end of its edge that a vertex sees, if it sees only one.
    pub(crate) fn end_of(&self, vertex: u32) -> Option<u32> {
        self.ends.get(&vertex).copied()
    }
}

/// Dark vertices close behind an object across their elements, such as corners of a box sunk into a floor, in
/// ascending order. All lit vertices that share elements with them lie beyond the object. It crosses the edges so
/// near to the dark vertex that these elements lie almost wholly on the lit side. `light_lx` is the light of a
/// vertex, if known.
pub(crate) fn shaded(
    scene: &Scene,
    subdivision: &Subdivision,
    sides: &[Side],
    light_lx: impl Fn(u32) -> Option<f64> + Sync,
) -> Vec<u32> {
    let place = |vertex: u32| subdivision.vertices()[vertex as usize].position;
    // Each dark vertex beside lit ones, with whether all of those lie beyond something.
    let of_side = |side: &Side| {
        let corners = subdivision.node(side.node).0.vertices;
        let most = corners.iter().filter_map(|&v| light_lx(v)).fold(0.0, f64::max);
        let known = corners.into_iter().filter(|&v| light_lx(v).is_some());
        let is_dark = |&v: &u32| light_lx(v).is_some_and(|lx| lx <= DARK_LIGHT_SHARE * most);
        let (dark, lit): (Vec<u32>, Vec<u32>) = known.partition(is_dark);
        if most == 0.0 || dark.is_empty() {
            return Vec::new();
        }
        let above = side.above(scene);
        let is_behind = |from: u32, to: u32| {
            blocked_at(scene, place(from), place(to), &above)
                .is_some_and(|at| at <= JUST_BEHIND_EDGE_SHARE)
        };
        dark.into_iter().map(|from| (from, lit.iter().all(|&to| is_behind(from, to)))).collect()
    };
    let mut found: Vec<(u32, bool)> = sides.par_iter().flat_map_iter(of_side).collect();
    found.par_sort_unstable();
    let all_behind = |of: &[(u32, bool)]| of.iter().all(|(_, is_behind)| *is_behind);
    found.chunk_by(|a, b| a.0 == b.0).filter(|of| all_behind(of)).map(|of| of[0].0).collect()
}

/// A node, and the side of the triangle that it lies on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) node: u32,
    pub(crate) triangle: u32,
    pub(crate) back: bool,
}

impl Side {
    /// The side of a node.
    pub(crate) fn of(subdivision: &Subdivision, node: u32) -> Self {
        let Origin { triangle, back, .. } = subdivision.node(node).1;
        Self { node, triangle, back }
    }

    /// The sides of all elements.
    pub(crate) fn of_all(elements: &Elements) -> impl Iterator<Item = Self> + '_ {
        elements.leaves().map(|(node, triangle, back)| Self { node, triangle, back })
    }

    /// A place on the same triangle.
    fn above(&self, scene: &Scene) -> SurfacePoint {
        SurfacePoint::new(scene, self.triangle, self.back, 1.0 / 3.0, 1.0 / 3.0)
    }
}

/// The scene and elements that are tested.
struct Look<'a> {
    scene: &'a Scene,
    elements: &'a Elements,
}

impl Look<'_> {
    fn cut(&self, side: &Side) -> Option<Barrier> {
        let above = side.above(self.scene);
        let vertices = self.elements.node(side.node).vertices;
        let corners = vertices.map(|v| self.elements.vertices()[v as usize].position);
        let blocked =
            |k: usize| blocked_at(self.scene, corners[k % 3], corners[(k + 1) % 3], &above);
        let edges = [0, 1, 2].map(blocked);
        if let [Some(at), None, None] | [None, Some(at), None] | [None, None, Some(at)] = edges {
            let corner = edges.iter().position(Option::is_some)?;
            let opposite = [0, 1, 2].map(|k| corners[(corner + 2 + k) % 3]);
            // The line runs from the corner with the object to the crossing of the opposite edge.
            let is_torn = stands_on(self.scene, opposite, &above);
            return is_torn.then_some(Barrier { corner, over: [1.0 / at, 1.0] });
        }
        // The corner opposite to the free edge is cut off.
        let free = edges.iter().position(Option::is_none)?;
        let corner = (free + 2) % 3;
        if edges.iter().flatten().count() != 2 {
            return None;
        }
        let at = |k: usize| {
            blocked_at(self.scene, corners[corner], corners[(corner + k) % 3], &above)
                .map(|t| 1.0 / t)
        };
        Some(Barrier { corner, over: [at(1)?, at(2)?] })
    }

    fn end_seen(&self, vertex: u32, above: &SurfacePoint) -> Option<u32> {
        let vertices = self.elements.vertices();
        let ends = vertices[vertex as usize].parents?;
        let place = |v: u32| vertices[v as usize].position;
        let sees =
            ends.map(|end| blocked_at(self.scene, place(vertex), place(end), above).is_none());
        match sees {
            [true, false] => Some(ends[0]),
            [false, true] => Some(ends[1]),
            _ => None,
        }
    }
}

/// The position of an object between two places of a surface, as a share of the way.
fn blocked_at(scene: &Scene, from: Point, to: Point, above: &SurfacePoint) -> Option<f64> {
    let way = |height_m: f64| {
        let raised = |p: Point| p + Normal::to_vector(above.geometric) * height_m;
        Ray::between(raised(from), raised(to)).skipping(above.triangle)
    };
    // Panes separate light, too, so the closest hit counts.
    scene.bvh().closest_hit(&way(NEAR * (to - from).length()))?;
    let at = f64::from(scene.bvh().closest_hit(&way(LOW * above.away_m))?.t);
    // An object at an end may stand on either side of it.
    (at > END_EDGE_SHARE && at < 1.0 - END_EDGE_SHARE).then_some(at)
}
