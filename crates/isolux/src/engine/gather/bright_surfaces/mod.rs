//! Small surfaces that are lit far more than all others, such as a ceiling close above a lamp.
//!
//! Rays over the whole hemisphere seldom meet them and bring much light when they do. Few rays mostly gather too
//! little, by the same amount in all replicates, so the spread does not show it. Some rays are therefore sent there.
//! Reflected direct light is weighted between these and the other rays by the balance heuristic (Veach and Guibas
//! 1995, "Optimally combining sampling techniques for Monte Carlo rendering"). Light of further reflections is
//! brighter in a housing, too, but even within: a place that sees much of it finds it with little noise by the other
//! rays. Sent rays bring it where they arrive far more often, the others elsewhere (the cutoff heuristic of that
//! paper).

mod patches;

use crate::ablation::without;
use crate::elements::carries_map;
use crate::engine::light::{
    Emission, FIRST_PARTICLES, FURTHER_PARTICLES, Landing, Lighting, landings,
};
use crate::engine::ray::{Deadline, SurfacePoint};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use isolux_geometry::{Direction, Normal, Point, Ray, Vector};
use patches::{Patch, Patches, reflected_lm};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The ratio of reflected direct light to its mean over all surfaces above which a surface is bright. With
/// four, three of seven seeds of the hall with 100 luminaires take 1.4 to 2.2 times as long, as stray pools
/// are sent to (decision 39).
const BRIGHT_RATIO: f64 = 8.0;

/// The edge of the cubes that bright surfaces are divided into, as a share of their extent.
const CUBE_EDGE_SHARE: f64 = 1.0 / 16.0;
/// The largest number of cubes; with more, cubes are made larger. With 192, the hall with 100 luminaires takes 30
/// and 48 million rays in place of 30 and 39 million (two seeds, decision 31).
const MOST_CUBES: usize = 64;

/// The largest ratio of sent rays to other rays.
const MOST_SENT_RATIO: f64 = 0.5;

/// The bright surfaces of a scene.
#[derive(Serialize, Deserialize)]
pub(crate) struct BrightSurfaces {
    parts: Vec<Part>,
    patches: Patches,
    /// The part that each patch belongs to, and the density with which a place on the patch is drawn from the part,
    /// 1/m2.
    of_patches: Vec<(usize, f64)>,
    /// The direct light that all surfaces reflect in the mean, lx.
    mean_lx: f64,
}

/// Bright surfaces that lie together.
#[derive(Serialize, Deserialize)]
struct Part {
    centre: Point,
    radius_m: f64,
    /// Half of the sides of their bounding box, m.
    half: Vector,
    /// The mean direction that they face, weighted by flux; the shorter, the more the directions differ.
    facing: Vector,
    /// The direct light that they reflect, lm.
    flux_lm: f64,
    patches: Vec<Patch>,
    /// Running sums of the light that patches reflect, lm.
    sums_lm: Vec<f64>,
}

/// The position of a place among the bright surfaces.
#[derive(Clone, Copy)]
pub(crate) struct Spot {
    /// The number of the part.
    part: usize,
    /// The density with which the place is drawn from the part, 1/m2.
    density: f64,
}

/// Bright surfaces as seen from a place.
pub(crate) struct Seen<'b> {
    bright: &'b BrightSurfaces,
    origin: Point,
    axis: Normal,
    /// Running sums of the weights with which parts are drawn, lx.
    sums: Vec<f64>,
    /// The number of rays sent to them.
    pub(crate) sent: u32,
    /// The number of all other rays.
    others: u32,
}

impl BrightSurfaces {
    /// The bright surfaces found by particles of a seed, `None` if there are none or no time is left, and the number of those
    /// particles.
    pub(crate) fn of(
        scene: &Scene,
        lighting: &Lighting<'_>,
        seed: u64,
        end: &Deadline,
    ) -> (Option<Arc<Self>>, u64) {
        if without("bright-surfaces") {
            return (None, 0);
        }
        let key = Key::new(seed).with(0).with(13);
        let Some(emission) = Emission::new(scene) else { return (None, 0) };
        let times = landings::times(&emission);
        let area_m2 = area_m2(scene);
        let (mut bright, mut particles) = (None, 0);
        for (number, count) in [(0, FIRST_PARTICLES * times), (1, FURTHER_PARTICLES * times)] {
            let sequence = Sequence::new(key.with(number));
            let landed = landings::landed((scene, lighting), &emission, count, sequence, end);
            particles += u64::from(count);
            if end.has_passed() {
                return (None, particles);
            }
            bright = Self::told_by(scene, &landed, area_m2);
            if bright.is_none() {
                break;
            }
        }
        (bright.map(Arc::new), particles)
    }

    fn told_by(scene: &Scene, landed: &[Landing], area_m2: f64) -> Option<Self> {
        let flux_lm: f64 = landed.iter().map(|of| reflected_lm(scene, of)).sum();
        let mean_lx = flux_lm / area_m2;
        let patches = Patches::of(scene, landed, BRIGHT_RATIO * mean_lx);
        if patches.all.is_empty() {
            return None;
        }
        let cubes = divided(&patches.all);
        let mut of_patches = vec![(0, 0.0); patches.all.len()];
        let mut parts = Vec::with_capacity(cubes.len());
        for (number, cube) in cubes.into_iter().enumerate() {
            let part = Part::of(cube.iter().map(|&k| patches.all[k]).collect());
            for k in cube {
                of_patches[k] = (number, patches.all[k].reflected_lx / part.flux_lm);
            }
            parts.push(part);
        }
        Some(Self { parts, patches, of_patches, mean_lx })
    }

    /// Whether the surfaces are some of so many triangles.
    pub(crate) fn are_of(&self, triangles: u32) -> bool {
        let is_part = |part: &Part| {
            !part.patches.is_empty()
                && part.sums_lm.len() == part.patches.len()
                && part.patches.iter().all(|patch| patch.triangle < triangles)
        };
        self.patches.are_of(triangles)
            && self.of_patches.len() == self.patches.all.len()
            && self.of_patches.iter().all(|&(part, _)| part < self.parts.len())
            && self.parts.iter().all(is_part)
    }

    /// The bright surfaces as seen from a place with `rays` rays; `None` where no ray is worth sending.
    pub(crate) fn seen_from(&self, origin: Point, axis: Normal, rays: u32) -> Option<Seen<'_>> {
        let mut sum_lx = 0.0;
        let expected = self.parts.iter().map(|part| part.expected_lx(origin, axis));
        let sums: Vec<f64> = expected
            .map(|lx| {
                sum_lx += lx;
                sum_lx
            })
            .collect();
        let share = sum_lx / (sum_lx + self.mean_lx);
        let sent = (f64::from(rays) * share.min(MOST_SENT_RATIO)).ceil() as u32;
        let (bright, others) = (self, rays);
        (sent > 0).then_some(Seen { bright, origin, axis, sums, sent, others })
    }

    /// The part and density of a place; `None` where it is not bright.
    pub(crate) fn at(&self, place: &SurfacePoint) -> Option<Spot> {
        let (part, density) = self.of_patches[self.patches.at(place)?];
        Some(Spot { part, density })
    }
}

impl Part {
    fn of(patches: Vec<Patch>) -> Self {
        let corners = || patches.iter().flat_map(|patch| patch.corners);
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
        let mut sums_lm = Vec::with_capacity(patches.len());
        for patch in &patches {
            let own_lm = patch.area_m2 * patch.reflected_lx;
            flux_lm += own_lm;
            sums_lm.push(flux_lm);
            let [a, b, c] = patch.corners;
            let front = (b - a).cross(c - a).direction().map_or(Vector::ZERO, Direction::to_vector);
            facing += front * if patch.back { -own_lm } else { own_lm };
        }
        let facing = facing * (1.0 / flux_lm);
        Self { centre, radius_m, half, facing, flux_lm, patches, sums_lm }
    }

    /// The illuminance expected from the part at a place, without obstacles, lx.
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
    /// A random place to send a ray to; `triangle` is the one that the ray leaves. `None` if the place lies below the
    /// horizon, faces away, or has something before it. Rays that arrive there through glass are none of those that
    /// [`Seen::share`] weighs sent rays with.
    pub(crate) fn draw(
        &self,
        (scene, triangle): (&Scene, u32),
        [pick, _]: [f64; 2],
        [a, b]: [f64; 2],
    ) -> Option<(SurfacePoint, Spot)> {
        let total = self.sums[self.sums.len() - 1];
        let at = pick * total;
        let number = self.sums.partition_point(|&sum| sum <= at).min(self.sums.len() - 1);
        let before = if number > 0 { self.sums[number - 1] } else { 0.0 };
        let part = &self.bright.parts[number];
        let within = (at - before) / (self.sums[number] - before) * part.flux_lm;
        let patch = part.sums_lm.partition_point(|&sum| sum <= within).min(part.patches.len() - 1);
        let Patch { triangle: at, back, corners: [p, q, r], reflected_lx, .. } =
            part.patches[patch];
        let root = a.sqrt();
        let point = p + (q - p) * (root * (1.0 - b)) + (r - p) * (root * b);
        let [u, v] = scene.triangle(at).barycentric(point);
        let place = SurfacePoint::new(scene, at, back, u, v);
        let way = place.point - self.origin;
        let is_faced =
            way.dot(self.axis.to_vector()) > 0.0 && way.dot(place.geometric.to_vector()) < 0.0;
        let ray = || Ray::between(self.origin, place.start()).skipping(triangle);
        let is_seen = is_faced && scene.bvh().closest_hit(&ray()).is_none();
        is_seen.then_some((place, Spot { part: number, density: reflected_lx / part.flux_lm }))
    }

    /// The weight of a ray that has come straight to a place, by the balance heuristic, as a share of that of one of
    /// the other rays if none were sent. It is the same for sent and other rays.
    pub(crate) fn share(&self, spot: Spot, at: &SurfacePoint) -> f64 {
        let to = at.point - self.origin;
        let Some(direction) = to.direction() else { return 1.0 };
        let way = direction.to_vector();
        let cosine = way.dot(self.axis.to_vector());
        let facing = -way.dot(at.geometric.to_vector());
        if cosine <= 0.0 || facing <= 0.0 {
            return 1.0;
        }
        let Spot { part, density } = spot;
        let before = if part > 0 { self.sums[part - 1] } else { 0.0 };
        let chance = (self.sums[part] - before) / self.sums[self.sums.len() - 1];
        let of_sent = f64::from(self.sent) * chance * density * to.length_squared() / facing;
        let of_others = f64::from(self.others) * cosine / std::f64::consts::PI;
        of_others / (of_others + of_sent)
    }
}

/// The weight of a sent ray for light of further reflections, from the weight [`Seen::share`] of direct light; `None`
/// where the other rays bring it.
pub(crate) fn sent_alone(share: f64) -> Option<f64> {
    let of_others = share / (1.0 - share);
    // Sent rays bring it where they are as much denser than the others as bright surfaces have more of it.
    (of_others * BRIGHT_RATIO < 1.0).then_some(of_others)
}

/// The area of all surfaces that may be lit, m2.
fn area_m2(scene: &Scene) -> f64 {
    let sides = |triangle: u32| {
        let carrying = [false, true].into_iter().filter(|&back| carries_map(scene, triangle, back));
        carrying.count() as f64
    };
    let count = scene.triangle_count();
    (0..count).map(|triangle| sides(triangle) * scene.triangle(triangle).area()).sum()
}

/// Patches grouped by the cube of space that they lie in.
fn divided(bright: &[Patch]) -> Vec<Vec<usize>> {
    let middle = |of: &Patch| of.corners[0].lerp(of.corners[1], 0.5).lerp(of.corners[2], 1.0 / 3.0);
    let extent_m = |k: usize| {
        let all = bright.iter().map(|patch| middle(patch).to_vector().component(k));
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    let widest_m = (0..3).map(extent_m).fold(f64::MIN_POSITIVE, f64::max);
    let mut edge_m = CUBE_EDGE_SHARE * widest_m;
    loop {
        let mut cubes: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (number, patch) in bright.iter().enumerate() {
            let at = middle(patch).to_vector();
            let cube = [0, 1, 2].map(|k| (at.component(k) / edge_m).floor() as i64);
            cubes.entry(cube).or_default().push(number);
        }
        // All cubes are kept: light from a cube left out would be as noisy as if no rays were sent.
        if cubes.len() <= MOST_CUBES {
            return cubes.into_values().collect();
        }
        edge_m *= std::f64::consts::SQRT_2;
    }
}
