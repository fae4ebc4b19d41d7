//! Elements that something stands across, like a thin wall between two rooms that share a floor.
//!
//! Vertices on one side tell nothing of the light on the other. Where two edges of an element are blocked, close to the
//! surface and well above it, and the third is not, one corner is cut off from the others by about a straight line: what lies
//! before it is read from that corner alone, what lies behind it from the others. Where one edge is blocked and something
//! stands on the corner opposite, the line leads from there.

use super::footprints::{AT_END, LOW, stands_on};
use super::nearby::NEAR;
use crate::ablation::without;
use crate::elements::{Elements, FewNumbers, Origin, Subdivision};
use crate::engine::ray::SurfacePoint;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point, Ray};
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};

/// Light that differs by more than this share of the greatest at the corners of an element is not alike.
const UNEVEN: f64 = 0.2;

/// A vertex with less than this share of the light of another of its element is in the dark beside it.
const DARK: f64 = 0.01;

/// What stands across an edge within this part of it leaves the element nearly whole.
const JUST_BEHIND: f64 = 0.25;

/// All of them.
#[derive(Debug, Default)]
pub(crate) struct Barriers {
    of_nodes: HashMap<u32, Barrier, FewNumbers>,
    /// The same elements by their corners.
    corners: HashSet<[u32; 3], FewNumbers>,
    /// Of vertices made by bisecting them, the end of their edge that they see, where they see one alone.
    ends: HashMap<u32, u32, FewNumbers>,
}

/// A corner that is cut off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Barrier {
    corner: usize,
    /// One over the share of the edges from there, to the next corner and the one after, at which the cut is met.
    over: [f64; 2],
}

impl Barrier {
    /// The corners on whose side a place with these weights lies.
    pub(crate) fn side(&self, weights: [f64; 3]) -> [bool; 3] {
        let along = [1, 2].map(|k| weights[(self.corner + k) % 3] * self.over[k - 1]);
        let is_before = along[0] + along[1] < 1.0;
        [0, 1, 2].map(|k| (k == self.corner) == is_before)
    }
}

impl Barriers {
    /// Among these nodes of elements, whose vertices are among the first so many, where vertices tell of light that is not alike: to
    /// look at all would take too long.
    pub(crate) fn of(
        scene: &Scene,
        elements: &Elements,
        (nodes, light): (impl Iterator<Item = Side>, &[Rgb]),
        first: usize,
    ) -> Self {
        if without("barriers") {
            return Self::default();
        }
        let is_uneven = |side: &Side| {
            let corners = elements.node(side.node).vertices;
            let [a, b, c] = corners.map(|vertex| light[vertex as usize].luminance());
            let (least, most) = (a.min(b).min(c), a.max(b).max(c));
            most - least > UNEVEN * most
        };
        let nodes: Vec<Side> = nodes.filter(is_uneven).collect();
        let look = Look { scene, elements };
        let found = nodes.par_iter().filter_map(|side| Some((side, look.cut(side)?)));
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

    /// Among the elements of a map.
    pub(crate) fn of_map(scene: &Scene, elements: &Elements, light: &[Rgb]) -> Self {
        Self::of(scene, elements, (elements.leaves().map(Side::from), light), usize::MAX)
    }

    /// How a node is cut, if it is.
    #[inline]
    pub(crate) fn of_node(&self, node: u32) -> Option<&Barrier> {
        if self.of_nodes.is_empty() { None } else { self.of_nodes.get(&node) }
    }

    /// Whether the element with these corners is cut.
    pub(crate) fn has(&self, corners: [u32; 3]) -> bool {
        self.corners.contains(&corners)
    }

    /// The only end of its edge that a vertex sees, if it does not see both.
    pub(crate) fn end_of(&self, vertex: u32) -> Option<u32> {
        self.ends.get(&vertex).copied()
    }
}

/// Vertices in the dark close behind what stands across their elements, like corners of a box that is sunk into a floor: all that they
/// share elements with and has light lies beyond it, so far along the edge there that these elements are as good as all on that
/// side. In the order of their numbers; `light_lx` of a vertex is what is known of it.
pub(crate) fn shaded(
    scene: &Scene,
    subdivision: &Subdivision,
    sides: &[Side],
    light_lx: impl Fn(u32) -> Option<f64> + Sync,
) -> Vec<u32> {
    let place = |vertex: u32| subdivision.vertices()[vertex as usize].position;
    // Of every dark vertex beside light, whether all of that lies beyond something.
    let of_side = |side: &Side| {
        let corners = subdivision.node(side.node).0.vertices;
        let most = corners.iter().filter_map(|&v| light_lx(v)).fold(0.0, f64::max);
        let known = corners.into_iter().filter(|&v| light_lx(v).is_some());
        let is_dark = |&v: &u32| light_lx(v).is_some_and(|lx| lx <= DARK * most);
        let (dark, lit): (Vec<u32>, Vec<u32>) = known.partition(is_dark);
        if most == 0.0 || dark.is_empty() {
            return Vec::new();
        }
        let above = side.above(scene);
        let is_behind = |from: u32, to: u32| {
            blocked_at(scene, place(from), place(to), &above).is_some_and(|at| at <= JUST_BEHIND)
        };
        dark.into_iter().map(|from| (from, lit.iter().all(|&to| is_behind(from, to)))).collect()
    };
    let mut found: Vec<(u32, bool)> = sides.par_iter().flat_map_iter(of_side).collect();
    found.par_sort_unstable();
    let all_behind = |of: &[(u32, bool)]| of.iter().all(|(_, is_behind)| *is_behind);
    found.chunk_by(|a, b| a.0 == b.0).filter(|of| all_behind(of)).map(|of| of[0].0).collect()
}

/// Keeps those of some vertices that one sees along their surface, where they do not all have about the same light. Of each its place and
/// what is known of its light, lx.
pub(crate) fn keep_seen(
    scene: &Scene,
    (from, above): (Point, &SurfacePoint),
    of: impl Fn(u32) -> (Point, Option<f64>),
    some: &mut Vec<u32>,
) {
    let known = some.iter().filter_map(|&v| of(v).1);
    let (least, most) = known.fold((f64::INFINITY, 0.0_f64), |(a, b), lx| (a.min(lx), b.max(lx)));
    if most - least > UNEVEN * most {
        some.retain(|&to| blocked_at(scene, from, of(to).0, above).is_none());
    }
}

/// A node, and the side of a triangle that it lies on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) node: u32,
    pub(crate) triangle: u32,
    pub(crate) back: bool,
}

impl From<(u32, u32, bool)> for Side {
    fn from((node, triangle, back): (u32, u32, bool)) -> Self {
        Self { node, triangle, back }
    }
}

impl Side {
    /// Of a node.
    pub(crate) fn of(subdivision: &Subdivision, node: u32) -> Self {
        let Origin { triangle, back, .. } = subdivision.node(node).1;
        Self { node, triangle, back }
    }

    /// A place of the same triangle.
    fn above(&self, scene: &Scene) -> SurfacePoint {
        SurfacePoint::new(scene, self.triangle, self.back, 1.0 / 3.0, 1.0 / 3.0)
    }
}

/// What elements are looked at in.
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
            // From the corner on which it stands to where the edge is met.
            let is_torn = stands_on(self.scene, opposite, &above);
            return is_torn.then_some(Barrier { corner, over: [1.0 / at, 1.0] });
        }
        // Opposite the edge that is free.
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

/// Where on the way between two places of a surface something stands, as a share of it.
fn blocked_at(scene: &Scene, from: Point, to: Point, above: &SurfacePoint) -> Option<f64> {
    let way = |height_m: f64| {
        let raised = |p: Point| p + Normal::to_vector(above.geometric) * height_m;
        Ray::between(raised(from), raised(to)).skipping(above.triangle)
    };
    // Panes part light, too.
    scene.bvh().closest_hit(&way(NEAR * (to - from).length()))?;
    let at = f64::from(scene.bvh().closest_hit(&way(LOW * above.away_m))?.t);
    // What stands at an end may as well stand on the other side of it.
    (at > AT_END && at < 1.0 - AT_END).then_some(at)
}
