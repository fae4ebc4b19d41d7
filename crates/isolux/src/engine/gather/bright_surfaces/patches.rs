//! Patches of surfaces with about equally many particles each: the more light there is, the smaller the patches.
//!
//! Every side of a triangle on which particles land is bisected until few are left in a patch, whatever the elements
//! of a map. So light as narrow as the gap before a lamp is separated from its surroundings.

use crate::engine::light::{BELIEVED_DEVIATIONS, Landing, Sum};
use crate::engine::mesh::NO_INDEX;
use crate::engine::ray::SurfacePoint;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Point;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The number of particles above which a patch is bisected. The density of light in a patch of so few errs by a
/// third.
const FEW_PARTICLES: usize = 8;

/// The least length of the longest edge of a patch that is bisected, in rounding bounds of positions.
const LEAST_EDGE_ROUNDINGS: f64 = 4.0;

/// A node of the bisection of a side.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct Node {
    /// The corner opposite to the edge that is bisected.
    corner: u8,
    /// The first of the two halves, or [`NO_INDEX`].
    below: u32,
    /// The number of the patch if the node has no halves, or [`NO_INDEX`].
    patch: u32,
}

/// A patch that is not bisected further.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub(super) struct Patch {
    pub(super) triangle: u32,
    pub(super) back: bool,
    pub(super) corners: [Point; 3],
    pub(super) area_m2: f64,
    /// The direct light that it reflects, lx.
    pub(super) reflected_lx: f64,
}

/// All patches that are brighter than a limit.
#[derive(Serialize, Deserialize)]
pub(super) struct Patches {
    /// The first node of the front and back of each triangle.
    roots: Vec<[u32; 2]>,
    nodes: Vec<Node>,
    pub(super) all: Vec<Patch>,
}

/// A particle, with the barycentric coordinates of the place where it has landed.
#[derive(Clone, Copy)]
struct Arrived {
    at: [f64; 2],
    reflected_lm: f64,
}

/// A part of a triangle in barycentric coordinates, with the particles there.
struct Part {
    node: u32,
    corners: [[f64; 2]; 3],
    area_m2: f64,
    arrived: Vec<Arrived>,
    /// Whether the part, or one that contains it, is bright beyond chance.
    is_sure: bool,
}

impl Patches {
    /// The patches that reflect more than `least_lx`, beyond chance.
    pub(super) fn of(scene: &Scene, landed: &[Landing], least_lx: f64) -> Self {
        let mut sides: BTreeMap<(u32, bool), Vec<Arrived>> = BTreeMap::new();
        for of in landed {
            let reflected_lm = reflected_lm(scene, of);
            if reflected_lm > 0.0 {
                let side = sides.entry((of.triangle, of.back)).or_default();
                side.push(Arrived { at: of.place, reflected_lm });
            }
        }
        let (nodes, all) = (Vec::new(), Vec::new());
        let mut patches = Self { roots: Vec::new(), nodes, all };
        for (side, arrived) in sides {
            patches.divide(scene, side, arrived, least_lx);
        }
        patches
    }

    /// Whether the patches are parts of so many triangles, and the way down to each ends.
    pub(super) fn are_of(&self, triangles: u32) -> bool {
        let count = self.nodes.len();
        let is_node = |(number, node): (usize, &Node)| {
            let below = node.below as usize;
            let goes_down = node.below == NO_INDEX || below > number && below + 1 < count;
            let is_patch = node.patch == NO_INDEX || (node.patch as usize) < self.all.len();
            node.corner < 3 && goes_down && is_patch
        };
        self.roots.len() <= triangles as usize
            && self.roots.iter().flatten().all(|&r| r == NO_INDEX || (r as usize) < count)
            && self.nodes.iter().enumerate().all(is_node)
            && self.all.iter().all(|patch| patch.triangle < triangles)
    }

    /// The number of the patch that a place lies in.
    pub(super) fn at(&self, place: &SurfacePoint) -> Option<usize> {
        let root = self.roots.get(place.triangle as usize)?[usize::from(place.back)];
        if root == NO_INDEX {
            return None;
        }
        let mut weights = [1.0 - place.u - place.v, place.u, place.v];
        let mut node = self.nodes[root as usize];
        while node.below != NO_INDEX {
            let half = half(&mut weights, usize::from(node.corner));
            node = self.nodes[node.below as usize + half];
        }
        (node.patch != NO_INDEX).then_some(node.patch as usize)
    }

    fn divide(
        &mut self,
        scene: &Scene,
        (triangle, back): (u32, bool),
        arrived: Vec<Arrived>,
        least_lx: f64,
    ) {
        let (first_node, first_patch) = (self.nodes.len(), self.all.len());
        let whole = scene.triangle(triangle);
        let point = |[u, v]: [f64; 2]| whole.point(u, v);
        let (node, area_m2) = (self.add_node(), whole.area());
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let mut left = vec![Part { node, corners, area_m2, arrived, is_sure: false }];
        while let Some(part) = left.pop() {
            let Sum { flux_lm, squares_lm2 } = part.sum();
            let least_lm = least_lx * part.area_m2;
            let is_sure =
                part.is_sure || flux_lm - BELIEVED_DEVIATIONS * squares_lm2.sqrt() > least_lm;
            let points = part.corners.map(point);
            let (corner, edge_m) = longest(points);
            let least_m = LEAST_EDGE_ROUNDINGS * scene.bvh().offset_m(points[0]);
            if part.arrived.len() > FEW_PARTICLES && edge_m > least_m {
                left.extend(self.bisect(part, corner, is_sure));
            } else if is_sure && flux_lm > least_lm {
                self.nodes[part.node as usize].patch = self.all.len() as u32;
                let (corners, area_m2) = (points, part.area_m2);
                let reflected_lx = flux_lm / area_m2;
                self.all.push(Patch { triangle, back, corners, area_m2, reflected_lx });
            }
        }
        if self.all.len() == first_patch {
            self.nodes.truncate(first_node);
            return;
        }
        let needed = triangle as usize + 1;
        self.roots.resize(self.roots.len().max(needed), [NO_INDEX; 2]);
        self.roots[triangle as usize][usize::from(back)] = node;
    }

    fn bisect(&mut self, part: Part, corner: usize, is_sure: bool) -> [Part; 2] {
        let Part { node, corners, area_m2, arrived, .. } = part;
        let below = self.add_node();
        self.add_node();
        self.nodes[node as usize] = Node { corner: corner as u8, below, patch: NO_INDEX };
        let [_, second, third] = around(corner);
        let middle = [0, 1].map(|k| 0.5 * (corners[second][k] + corners[third][k]));
        let halves = [third, second].map(|moved| {
            let mut corners = corners;
            corners[moved] = middle;
            corners
        });
        let mut parts = [Vec::new(), Vec::new()];
        for of in arrived {
            parts[half(&mut weights_in(corners, of.at), corner)].push(of);
        }
        let area_m2 = 0.5 * area_m2;
        let [first, other] = parts;
        [(0, first), (1, other)].map(|(k, arrived)| Part {
            node: below + k as u32,
            corners: halves[k],
            area_m2,
            arrived,
            is_sure,
        })
    }

    fn add_node(&mut self) -> u32 {
        self.nodes.push(Node { corner: 0, below: NO_INDEX, patch: NO_INDEX });
        self.nodes.len() as u32 - 1
    }
}

impl Part {
    fn sum(&self) -> Sum {
        let mut sum = Sum::default();
        self.arrived.iter().for_each(|of| sum.add(of.reflected_lm));
        sum
    }
}

/// The light of a particle that the surface reflects, lm.
pub(super) fn reflected_lm(scene: &Scene, of: &Landing) -> f64 {
    let Landing { triangle, back, place: [u, v], flux_lm } = *of;
    let reflectance = scene.material(triangle).finish(back);
    let reflectance =
        reflectance.map_or(Rgb::BLACK, |of| scene.diffuse_reflectance(of, triangle, u, v));
    flux_lm * reflectance.luminance()
}

const fn around(corner: usize) -> [usize; 3] {
    [corner, (corner + 1) % 3, (corner + 2) % 3]
}

/// The number of the half that a place lies in, of a triangle bisected opposite to a corner. Its weights become those
/// of the half's corners, where the middle of the edge replaces the missing corner.
fn half(weights: &mut [f64; 3], corner: usize) -> usize {
    let [_, second, third] = around(corner);
    let half = usize::from(weights[second] < weights[third]);
    let [kept, lost] = [[second, third], [third, second]][half];
    weights[kept] -= weights[lost];
    weights[lost] *= 2.0;
    half
}

/// The weights at a place of the corners of a part of a triangle.
fn weights_in([a, b, c]: [[f64; 2]; 3], [u, v]: [f64; 2]) -> [f64; 3] {
    let cross =
        |p: [f64; 2], q: [f64; 2]| (p[0] - a[0]) * (q[1] - a[1]) - (p[1] - a[1]) * (q[0] - a[0]);
    let whole = cross(b, c);
    let (second, third) = (cross([u, v], c) / whole, cross(b, [u, v]) / whole);
    [1.0 - second - third, second, third]
}

/// The corner opposite to the longest edge, and the length of that edge, m.
fn longest(corners: [Point; 3]) -> (usize, f64) {
    let edge_m = |corner: usize| {
        let [_, second, third] = around(corner);
        (corners[second] - corners[third]).length()
    };
    let longer = |best: (usize, f64), corner: usize| {
        let edge_m = edge_m(corner);
        if edge_m > best.1 { (corner, edge_m) } else { best }
    };
    (0..3).fold((0, 0.0), longer)
}
