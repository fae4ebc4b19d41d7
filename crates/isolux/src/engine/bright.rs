//! Small surfaces that are lit far more than all others, as a ceiling is above a lamp that hangs below it.
//!
//! Rays that are spread over the hemisphere seldom meet them, and bring much light when they do: what few rays gather is mostly too
//! little, and the same in all replicates, so that their spread tells nothing of it. Some rays are therefore sent there, and the
//! direct light that is reflected there is weighted between these and the others by the balance heuristic (Veach and Guibas
//! 1995, "Optimally combining sampling techniques for Monte Carlo rendering"). Light that was reflected before is even, and left
//! to the others.

use super::surface::SurfacePoint;
use crate::elements::{Elements, TOGETHER};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Direction, Normal, Point, Vector};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Bright is what reflects so many times as much direct light as surfaces do in the mean.
const BRIGHT: f64 = 8.0;

/// It matters if it reflects this share of all direct light.
const MATTERS: f64 = 0.02;

/// What is bright is divided into cubes of this share of its extent, larger ones if they were more than so many.
const CUBE: f64 = 1.0 / 16.0;
const MOST_CUBES: usize = 64;

/// No more than this share as many rays are sent as there are others, and none where this share of the light or less comes from there.
const MOST_SENT: f64 = 0.5;
const FEWEST_SENT: f64 = 0.01;

/// Of no part of the bright surfaces.
const NONE: u8 = u8::MAX;

/// Bright surfaces.
pub(super) struct Bright {
    parts: Vec<Part>,
    /// Of every node of the elements, the part that it belongs to, and how likely a place there is to be drawn from it, 1/m2.
    of_nodes: Vec<(u8, f32)>,
    /// Triangles of the scene that are bright somewhere, front and back.
    has: Vec<[bool; 2]>,
    /// What all surfaces reflect of direct light in the mean, lx.
    mean_lx: f64,
}

/// Bright surfaces that lie together.
struct Part {
    centre: Point,
    radius_m: f64,
    /// Half of the box around them.
    half: Vector,
    /// The way they face in the mean: the shorter, the less it says.
    facing: Vector,
    /// Direct light that they reflect, lm.
    flux_lm: f64,
    leaves: Vec<Leaf>,
    /// Running sums of what leaves reflect, lm.
    sums_lm: Vec<f64>,
}

#[derive(Clone, Copy)]
struct Leaf {
    node: u32,
    triangle: u32,
    back: bool,
    corners: [Point; 3],
    area_m2: f64,
    reflected_lx: f64,
}

/// Bright surfaces as seen from a receiver.
pub(super) struct Seen<'b> {
    bright: &'b Bright,
    origin: Point,
    axis: Normal,
    /// Running sums of how likely parts are to be drawn.
    sums: Vec<f64>,
    /// Rays that are sent to them, and all others.
    pub(super) sent: u32,
    others: u32,
}

impl Bright {
    /// What is bright by the direct light at vertices; `None` where nothing is.
    pub(super) fn of(
        scene: &Scene,
        elements: &Elements,
        direct: impl Fn(u32) -> Rgb + Sync,
    ) -> Option<Self> {
        let leaves = leaves(scene, elements, direct);
        let total = |of: &mut dyn Iterator<Item = &Leaf>| -> [f64; 2] {
            of.fold([0.0; 2], |[m2, lm], l| [m2 + l.area_m2, lm + l.area_m2 * l.reflected_lx])
        };
        let [area_m2, flux_lm] = total(&mut leaves.iter());
        let mean_lx = flux_lm / area_m2;
        let is_bright = |leaf: &Leaf| leaf.reflected_lx > BRIGHT * mean_lx;
        let [_, of_bright_lm] = total(&mut leaves.iter().filter(|leaf| is_bright(leaf)));
        if of_bright_lm <= MATTERS * flux_lm {
            return None;
        }
        let bright: Vec<Leaf> = leaves.into_iter().filter(is_bright).collect();
        let parts = divided(&bright);
        let mut of_nodes = vec![(NONE, 0.0); elements.node_count()];
        let mut has = vec![[false; 2]; elements.roots().len()];
        for (number, part) in parts.iter().enumerate() {
            for leaf in &part.leaves {
                let density = (leaf.reflected_lx / part.flux_lm) as f32;
                of_nodes[leaf.node as usize] = (number as u8, density);
                has[leaf.triangle as usize][usize::from(leaf.back)] = true;
            }
        }
        Some(Self { parts, of_nodes, has, mean_lx })
    }

    /// As seen by so many rays from a place; `None` where none is worth sending.
    pub(super) fn seen_from(&self, origin: Point, axis: Normal, rays: u32) -> Option<Seen<'_>> {
        let mut sum_lx = 0.0;
        let expected = self.parts.iter().map(|part| part.expected_lx(origin, axis));
        let sums: Vec<f64> = expected
            .map(|lx| {
                sum_lx += lx;
                sum_lx
            })
            .collect();
        let share = sum_lx / (sum_lx + self.mean_lx);
        let sent = (f64::from(rays) * share.min(MOST_SENT)).ceil() as u32;
        let (bright, others) = (self, rays);
        (share > FEWEST_SENT && sent > 0).then_some(Seen {
            bright,
            origin,
            axis,
            sums,
            sent,
            others,
        })
    }

    /// The part that a place belongs to and how likely it is to be drawn from it, 1/m2.
    fn at(&self, elements: &Elements, at: &SurfacePoint) -> Option<(u8, f64)> {
        let SurfacePoint { triangle, back, u, v, .. } = *at;
        if !self.has[triangle as usize][usize::from(back)] {
            return None;
        }
        let place = elements.place(u32::MAX, triangle, back, [u, v])?;
        let (part, density) = self.of_nodes[place.node() as usize];
        (part != NONE).then_some((part, f64::from(density)))
    }
}

impl Part {
    fn of(leaves: Vec<Leaf>) -> Self {
        let corners = || leaves.iter().flat_map(|leaf| leaf.corners);
        let bounds = |k: usize| {
            let all = corners().map(move |p| p.to_vector().component(k));
            [all.clone().fold(f64::MAX, f64::min), all.fold(f64::MIN, f64::max)]
        };
        let [x, y, z] = [0, 1, 2].map(bounds);
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        let half = |[low, high]: [f64; 2]| 0.5 * (high - low);
        let centre = Point::new(middle(x), middle(y), middle(z));
        let half = Vector::new(half(x), half(y), half(z));
        let radius_m = corners().map(|p| (p - centre).length()).fold(0.0, f64::max);
        let (mut flux_lm, mut facing) = (0.0, Vector::ZERO);
        let mut sums_lm = Vec::with_capacity(leaves.len());
        for leaf in &leaves {
            let own_lm = leaf.area_m2 * leaf.reflected_lx;
            flux_lm += own_lm;
            sums_lm.push(flux_lm);
            let [a, b, c] = leaf.corners;
            let front = (b - a).cross(c - a).direction().map_or(Vector::ZERO, Direction::to_vector);
            facing += front * if leaf.back { -own_lm } else { own_lm };
        }
        let facing = facing * (1.0 / flux_lm);
        Self { centre, radius_m, half, facing, flux_lm, leaves, sums_lm }
    }

    /// The illuminance that it is expected to give at a place, without obstacles, lx.
    fn expected_lx(&self, from: Point, axis: Normal) -> f64 {
        let to = self.centre - from;
        let distance_m = to.length() + self.radius_m;
        let axis = axis.to_vector();
        let reach_m: f64 = (0..3).map(|k| axis.component(k).abs() * self.half.component(k)).sum();
        let at_receiver = (to.dot(axis) + reach_m) / distance_m;
        let even = 1.0 - self.facing.length();
        let at_part = (-to.dot(self.facing) + self.radius_m) / distance_m + even;
        let cosines = at_receiver.clamp(0.0, 1.0) * at_part.clamp(0.0, 1.0);
        let squared = to.length_squared() + self.radius_m * self.radius_m;
        self.flux_lm * cosines / (std::f64::consts::PI * squared)
    }
}

impl Seen<'_> {
    /// A place to send a ray to, and its direction from here; `None` if that lies below the horizon or faces away.
    pub(super) fn draw(
        &self,
        scene: &Scene,
        [pick, _]: [f64; 2],
        [a, b]: [f64; 2],
    ) -> Option<(SurfacePoint, Direction)> {
        let total = self.sums[self.sums.len() - 1];
        let at = pick * total;
        let number = self.sums.partition_point(|&sum| sum <= at).min(self.sums.len() - 1);
        let before = if number > 0 { self.sums[number - 1] } else { 0.0 };
        let part = &self.bright.parts[number];
        let within = (at - before) / (self.sums[number] - before) * part.flux_lm;
        let leaf = part.sums_lm.partition_point(|&sum| sum <= within).min(part.leaves.len() - 1);
        let Leaf { triangle, back, corners: [p, q, r], .. } = part.leaves[leaf];
        let root = a.sqrt();
        let point = p + (q - p) * (root * (1.0 - b)) + (r - p) * (root * b);
        let [u, v] = scene.triangle(triangle).barycentric(point);
        let place = SurfacePoint::new(scene, triangle, back, u, v);
        let direction = (place.point - self.origin).direction()?;
        let way = direction.to_vector();
        let is_seen =
            way.dot(self.axis.to_vector()) > 0.0 && way.dot(place.geometric.to_vector()) < 0.0;
        is_seen.then_some((place, direction))
    }

    /// What a ray of those sent there, or of the others, counts that has come straight to a place, as a share of the hemisphere
    /// weighted by the cosine: the same for both.
    pub(super) fn share(&self, elements: &Elements, at: &SurfacePoint) -> f64 {
        let to = at.point - self.origin;
        let Some(direction) = to.direction() else { return self.of_others() };
        let Some((part, density)) = self.bright.at(elements, at) else { return self.of_others() };
        let way = direction.to_vector();
        let cosine = way.dot(self.axis.to_vector());
        let facing = -way.dot(at.geometric.to_vector());
        if cosine <= 0.0 || facing <= 0.0 {
            return self.of_others();
        }
        let number = usize::from(part);
        let before = if number > 0 { self.sums[number - 1] } else { 0.0 };
        let chance = (self.sums[number] - before) / self.sums[self.sums.len() - 1];
        let of_sent = chance * density * to.length_squared() / facing;
        let of_others = cosine / std::f64::consts::PI;
        of_others / (f64::from(self.others) * of_others + f64::from(self.sent) * of_sent)
    }

    fn of_others(&self) -> f64 {
        1.0 / f64::from(self.others)
    }
}

/// All elements, each with what it reflects of direct light.
fn leaves(scene: &Scene, elements: &Elements, direct: impl Fn(u32) -> Rgb + Sync) -> Vec<Leaf> {
    let leaf = |(node, triangle, back): (u32, u32, bool)| {
        let finish = scene.material(triangle).finish(back)?;
        let vertices = elements.node(node).vertices;
        let corners = vertices.map(|k| elements.vertices()[k as usize].position);
        let [a, b, c] = corners;
        let of_all: Rgb = vertices.into_iter().map(&direct).sum();
        let middle = a + ((b - a) + (c - a)) * (1.0 / 3.0);
        let [u, v] = scene.triangle(triangle).barycentric(middle);
        let reflectance = scene.diffuse_reflectance(finish, triangle, u, v);
        Some(Leaf {
            node,
            triangle,
            back,
            corners,
            area_m2: 0.5 * (b - a).cross(c - a).length(),
            reflected_lx: (of_all * reflectance).luminance() / 3.0,
        })
    };
    let all: Vec<(u32, u32, bool)> = elements.leaves().collect();
    all.into_par_iter().with_min_len(TOGETHER).filter_map(leaf).collect()
}

/// Elements by the cube of space that they lie in.
fn divided(bright: &[Leaf]) -> Vec<Part> {
    let middle =
        |leaf: &Leaf| leaf.corners[0].lerp(leaf.corners[1], 0.5).lerp(leaf.corners[2], 1.0 / 3.0);
    let extent_m = |k: usize| {
        let all = bright.iter().map(|leaf| middle(leaf).to_vector().component(k));
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    let widest_m = (0..3).map(extent_m).fold(f64::MIN_POSITIVE, f64::max);
    let mut edge_m = CUBE * widest_m;
    let cubes = loop {
        let mut cubes: BTreeMap<[i64; 3], Vec<Leaf>> = BTreeMap::new();
        for leaf in bright {
            let at = middle(leaf).to_vector();
            let cube = [0, 1, 2].map(|k| (at.component(k) / edge_m).floor() as i64);
            cubes.entry(cube).or_default().push(*leaf);
        }
        // What is left out would be as noisy as if nothing were sent there.
        if cubes.len() <= MOST_CUBES {
            break cubes;
        }
        edge_m *= std::f64::consts::SQRT_2;
    };
    cubes.into_values().map(Part::of).collect()
}
