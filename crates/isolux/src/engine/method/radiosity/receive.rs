//! The light that a receiver gets from one shot.
//!
//! A receiver walks down the tree of the patch until the light of a node is nearly constant for it and two
//! rays show the node visible or hidden as a whole. A triangle contributes its closed-form form factor times
//! the mean transmittance of two rays to places on it. So unoccluded light is exact but for the approximation
//! of the light over the node. Near elements, above all across an edge or a corner, are divided further for
//! this receiver alone, with light linear between their corners. Far clusters of many triangles contribute
//! through two places, drawn in proportion to their light. For planar mirrors the receiver looks from its own
//! image.

use super::form_factor::form_factor;
use super::light::Light;
use super::limits::Limits;
use super::sources::{Face, Kind, Source, Sources};
use crate::engine::gather::Gatherer;
use crate::engine::light::{Chain, Lighting};
use crate::engine::occlusion::nearby;
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};
use std::f64::consts::PI;

/// The error from a kernel that is linear over a node, in units of the squared angle that the node subtends,
/// as a share of the spread of the linear part of the light.
const ERROR_OF_LINEAR: f64 = 0.4;
/// The error from the rest of the light, in the same unit, as a share of its spread. A linear kernel ignores
/// the rest; the true one differs from a linear one by about this much.
const ERROR_OF_REST: f64 = 0.4;

/// The standard error of the sum of these errors over a receiver, as a share of their sum with one sign.
/// Measured on CUBE at accuracies from 0.3 % to 5 %, where vertices are off by a fifth to a half.
const DOUBT: f64 = 0.5;

/// The least distance of a cluster that is taken as a whole, in its radii.
const CLUSTER_APART: f64 = 1.5;

/// The most halvings of an element for one receiver. They resolve light from a thousandth of its edge away.
const MOST_HALVINGS: u32 = 16;

/// The number of attempts to find a place on a triangle above the horizon.
const TRIES: u32 = 4;

/// The light received.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Received {
    pub(super) lx: Rgb,
    /// The variance of its photometric value, from the spread of visibility and the doubt in form factors,
    /// lx2.
    pub(super) variance: f64,
    /// The error from treating light as linear under a linear kernel, if all of it has one sign, lx.
    doubt_lx: f64,
    pub(super) rays: u64,
}

/// A shot of one patch.
pub(super) struct Shot<'a> {
    pub(super) sources: &'a Sources,
    pub(super) lighting: &'a Lighting<'a>,
    pub(super) chains: &'a [Chain],
    pub(super) patch: usize,
    /// The light of the nodes of the patch.
    pub(super) light: &'a [Light],
    /// The absolute flux of the elements of the patch before each node, and before its end, lm.
    pub(super) sums_lm: &'a [f64],
    /// The exitance at the corners of an element, seen from within a gap that it is part of or not.
    pub(super) corners: &'a (dyn Fn(u32, &Face, bool) -> [Rgb; 3] + Sync),
    pub(super) limits: Limits,
}

/// One receiver that looks by way of one chain of mirrors.
struct Look<'a> {
    shot: &'a Shot<'a>,
    chain: &'a Chain,
    gatherer: &'a Gatherer,
    /// The image of the receiver: the point from which it would see the same without mirrors.
    from: Point,
    normal: Vector,
    sequence: Sequence,
    next: u32,
    received: Received,
}

/// A part of an element, for one receiver.
#[derive(Clone, Copy)]
struct Piece {
    corners: [Point; 3],
    values: [Rgb; 3],
    triangle: u32,
    halvings: u32,
}

impl Shot<'_> {
    /// The light that a receiver gets from the shot.
    pub(super) fn receive(&self, gatherer: &Gatherer, key: Key) -> Received {
        let mut sum = Received::default();
        for (number, chain) in (0..).zip(self.chains) {
            let image = self.lighting.image_of_receiver(chain, &gatherer.surface);
            let Some((from, normal)) = image else { continue };
            let sequence = Sequence::new(key.with(number));
            let received = Received::default();
            let mut look =
                Look { shot: self, chain, gatherer, from, normal, sequence, next: 0, received };
            look.node(self.sources.patches[self.patch].start);
            sum.lx += look.received.lx * chain.reflectance;
            let weight = chain.reflectance.luminance();
            sum.variance += weight * weight * look.received.variance;
            sum.doubt_lx += weight * look.received.doubt_lx;
            sum.rays += look.received.rays;
        }
        let doubt_lx = DOUBT * sum.doubt_lx;
        sum.variance += doubt_lx * doubt_lx;
        sum
    }
}

impl Look<'_> {
    fn node(&mut self, node: u32) {
        let sources = self.shot.sources;
        let light = self.shot.light[(node - sources.patches[self.shot.patch].start) as usize];
        let source = &sources.nodes[node as usize];
        if light.is_none() || (source.centre - self.from).dot(self.normal) <= -source.radius_m {
            return;
        }
        match &source.kind {
            Kind::Cluster => self.cluster(node, source, &light),
            Kind::Face(face) => self.face(node, source, face, &light),
        }
    }

    fn below(&mut self, source: &Source) {
        source.children.into_iter().flatten().for_each(|child| self.node(child));
    }

    fn cluster(&mut self, node: u32, source: &Source, light: &Light) {
        let distance_m = (source.centre - self.from).length();
        if distance_m > CLUSTER_APART * source.radius_m {
            let nearest_m = distance_m - source.radius_m;
            let most_lx = light.size * source.area_m2 / (PI * nearest_m * nearest_m);
            let is_small = most_lx <= self.shot.limits.noise_lx;
            let is_clear = |look: &mut Self| {
                let difference = look.drawn(node, source) - look.drawn(node, source);
                0.5 * difference.luminance().abs() <= look.shot.limits.noise_lx
            };
            if is_small || most_lx <= self.shot.limits.most_lx && is_clear(self) {
                let two = [self.drawn(node, source), self.drawn(node, source)];
                self.add(two);
                return;
            }
        }
        self.below(source);
    }

    /// Adds the mean of two estimates. They share no random numbers with the decision to stop here; otherwise
    /// nodes that seem all visible or all hidden would be trusted too much.
    fn add(&mut self, two: [Rgb; 2]) {
        let half = 0.5 * (two[0] - two[1]).luminance();
        self.received.lx += (two[0] + two[1]) * 0.5;
        self.received.variance += half * half;
    }

    /// The light of a cluster from one place in it, drawn in proportion to light.
    fn drawn(&mut self, cluster: u32, whole: &Source) -> Rgb {
        let Shot { sources, light, sums_lm, .. } = *self.shot;
        let first = sources.patches[self.shot.patch].start;
        let [pick, other] = self.pair();
        let sums = &sums_lm[(cluster - first) as usize..=(whole.end - first) as usize];
        let (low, high) = (sums[0], sums[sums.len() - 1]);
        let at = low + pick * (high - low);
        let k = sums[1..].partition_point(|&sum| sum <= at).min(sums.len() - 2);
        let (own_lm, node) = (sums[k + 1] - sums[k], cluster + k as u32);
        // The remainder of a random number after a choice is again uniform.
        let left = ((at - sums[k]) / own_lm).clamp(0.0, 1.0 - f64::EPSILON);
        let chance = own_lm / (high - low);
        let source = &sources.nodes[node as usize];
        let Kind::Face(face) = &source.kind else { return Rgb::BLACK };
        let place = place(face.corners, [left, other]);
        let to = place - self.from;
        let squared = to.length_squared();
        let (cos, cos_there) = (to.dot(self.normal), -to.dot(face.normal));
        if !(cos > 0.0 && cos_there > 0.0) {
            return Rgb::BLACK;
        }
        let kernel = cos * cos_there / (PI * squared * squared);
        let mean = light[(node - first) as usize].mean;
        mean * self.share(place, face.triangle) * (source.area_m2 * kernel / chance)
    }

    fn face(&mut self, node: u32, source: &Source, face: &Face, light: &Light) {
        // A receiver in the plane of a triangle, like vertices of smooth surfaces, does not see it.
        let height_m = (self.from - face.corners[0]).dot(face.normal);
        if height_m <= self.gatherer.surface.away_m {
            return;
        }
        let distance_m = (source.centre - self.from).length();
        let angle = source.radius_m / distance_m;
        let in_gap = self.gatherer.in_gap && angle > 0.5;
        let fits = !in_gap && self.take(face.corners, face.triangle, light, Some(angle));
        if fits {
            return;
        }
        if source.children.is_some() {
            self.below(source);
            return;
        }
        let reach_m = nearby::NEAR * 2.0 * source.radius_m;
        let in_gap = self.gatherer.in_gap && distance_m - source.radius_m < reach_m;
        let values = (self.shot.corners)(node, face, in_gap);
        let (corners, triangle) = (face.corners, face.triangle);
        self.piece(Piece { corners, values, triangle, halvings: 0 });
    }

    /// Adds the light of a piece of an element, or of its halves.
    fn piece(&mut self, piece: Piece) {
        let light = Light::of_corners(piece.values);
        if light.is_none() {
            return;
        }
        let [a, b, c] = piece.corners;
        let centre = Point::ORIGIN + (a.to_vector() + b.to_vector() + c.to_vector()) / 3.0;
        let radius_m = piece.corners.map(|p| (p - centre).length()).into_iter().fold(0.0, f64::max);
        let angle = radius_m / (centre - self.from).length();
        let angle = (piece.halvings < MOST_HALVINGS).then_some(angle);
        if self.take(piece.corners, piece.triangle, &light, angle) {
            return;
        }
        for half in piece.halves() {
            self.piece(half);
        }
    }

    /// Adds the light of a triangle as a whole. Returns false and adds nothing if it should be divided.
    /// `angle` is its radius over its distance; without it, the triangle is never divided.
    fn take(
        &mut self,
        corners: [Point; 3],
        triangle: u32,
        light: &Light,
        angle: Option<f64>,
    ) -> bool {
        let limits = self.shot.limits;
        let (linear, rest) = light.spreads();
        let near = angle.unwrap_or(1.0).min(1.0);
        let error = (ERROR_OF_LINEAR * linear + ERROR_OF_REST * rest) * near * near;
        if angle.is_some() && error > limits.tolerance_lx {
            return false;
        }
        let factor = form_factor(self.from, self.normal, corners);
        if factor == 0.0 {
            return true;
        }
        if angle.is_some() && light.size * factor > limits.most_lx {
            return false;
        }
        let lx = light.weighted(corners.map(|corner| self.kernel(corner))) * factor;
        if angle.is_some() && 0.5 * lx.luminance().abs() > limits.noise_lx {
            let difference = self.seen(corners, triangle) - self.seen(corners, triangle);
            if 0.5 * (lx * difference).luminance().abs() > limits.noise_lx {
                return false;
            }
        }
        let two = [self.seen(corners, triangle), self.seen(corners, triangle)];
        self.add(two.map(|share| lx * share));
        self.received.doubt_lx += error * factor;
        true
    }

    /// The kernel of light from a place, without the factors that are constant over a plane.
    fn kernel(&self, place: Point) -> f64 {
        let to = place - self.from;
        let squared = to.length_squared();
        to.dot(self.normal).max(0.0) / (squared * squared).max(f64::MIN_POSITIVE)
    }

    /// The transmittance to a random place on a triangle, above the horizon if one is found.
    fn seen(&mut self, corners: [Point; 3], triangle: u32) -> Rgb {
        let mut target = place(corners, self.pair());
        for _ in 1..TRIES {
            if (target - self.from).dot(self.normal) > 0.0 {
                break;
            }
            target = place(corners, self.pair());
        }
        self.share(target, triangle)
    }

    fn share(&mut self, place: Point, triangle: u32) -> Rgb {
        self.received.rays += 1 + self.chain.planes.len() as u64;
        self.shot.lighting.share_from(self.chain, &self.gatherer.surface, place, triangle)
    }

    fn pair(&mut self) -> [f64; 2] {
        self.next += 1;
        self.sequence.pair(self.next - 1, 0)
    }
}

impl Piece {
    /// The halves of the piece, bisected at its longest edge.
    fn halves(self) -> [Self; 2] {
        let p = self.corners;
        let length = |k: usize| (p[(k + 1) % 3] - p[k]).length_squared();
        let longest = (0..3).max_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0);
        let next = (longest + 1) % 3;
        let middle = p[longest].lerp(p[next], 0.5);
        let value = (self.values[longest] + self.values[next]) * 0.5;
        let half = |moved: usize| {
            let mut half = self;
            half.corners[moved] = middle;
            half.values[moved] = value;
            half.halvings += 1;
            half
        };
        [half(next), half(longest)]
    }
}

/// The point of a triangle for a point of the unit square, uniform over its area.
fn place([a, b, c]: [Point; 3], [x, y]: [f64; 2]) -> Point {
    let root = x.sqrt();
    a + (b - a) * (root * (1.0 - y)) + (c - a) * (root * y)
}
