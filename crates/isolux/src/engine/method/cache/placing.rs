//! Placing of samples at places that no sample serves yet.
//!
//! Places are processed in a random order that depends on their positions alone, in batches that double. So
//! the first samples lie far apart and later ones between them. The rays of a batch are traced in parallel;
//! then samples are accepted one after another, so nothing depends on threads.

use super::hemisphere::{polar, reflected};
use super::layer::{Layer, Site};
use crate::elements::carries_map;
use crate::engine::gather::Gatherer;
use crate::engine::ray::{Deadline, Dice, SurfacePoint, follow, place_key};
use crate::sampling::{Key, Sequence};
use crate::scene::{Body, Scene};
use isolux_geometry::{Normal, Point, Ray};
use rayon::prelude::*;

/// The number of rays that measure distances around a place.
const FEELERS: u32 = 32;

/// The number of places on all surfaces that determine the typical size of rooms.
const TYPICAL_PLACES: u32 = 256;

/// The number of places in the first batch.
const FIRST_BATCH: usize = 32;

/// The number of rounds in which samples are placed at the ray ends of samples of the round before. Places
/// left over after the last round are served from farther off.
const ROUNDS: usize = 12;

/// A place where light is needed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// The start of its rays.
    pub(super) origin: Point,
    pub(super) normal: Normal,
    /// The triangle that it lies on.
    pub(super) triangle: u32,
}

impl From<&SurfacePoint> for Place {
    fn from(at: &SurfacePoint) -> Self {
        Self { origin: at.start(), normal: at.shading, triangle: at.triangle }
    }
}

impl From<&Gatherer> for Place {
    fn from(at: &Gatherer) -> Self {
        Self { origin: at.origin, normal: at.normal, triangle: at.surface.triangle }
    }
}

/// The least and the largest radius of samples, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Radii {
    pub(super) least_m: f64,
    pub(super) most_m: f64,
}

impl Radii {
    /// The radius of a sample with this mean and nearest distance. It is at most the nearest distance, since
    /// light near an edge or a contact changes within that.
    fn of(self, mean_m: f64, nearest_m: f64) -> f64 {
        mean_m.min(nearest_m).clamp(self.least_m, self.most_m)
    }
}

/// The mean radius that samples over all of the surface would have, m: the typical size of rooms.
pub(super) fn typical_radius_m(scene: &Scene, most_m: f64) -> f64 {
    let mut sides = Vec::new();
    let mut area_m2 = 0.0;
    for triangle in 0..scene.triangle_count() {
        for back in [false, true].into_iter().filter(|&b| carries_map(scene, triangle, b)) {
            area_m2 += scene.triangle(triangle).area();
            sides.push((area_m2, triangle, back));
        }
    }
    let radii = Radii { least_m: 0.0, most_m };
    let one = |index: u32| {
        let mut dice = Dice::new(Sequence::new(Key::new(0).with(10)), index);
        // Places are stratified: one in each of [`TYPICAL_PLACES`] equal parts of the area.
        let [pick, _] = dice.pair();
        let at_m2 = (f64::from(index) + pick) / f64::from(TYPICAL_PLACES) * area_m2;
        let (_, triangle, back) =
            sides[sides.partition_point(|s| s.0 <= at_m2).min(sides.len() - 1)];
        let [a, b] = dice.pair();
        let (u, v) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
        feel(scene, &Place::from(&SurfacePoint::new(scene, triangle, back, u, v)), radii).mean_m
    };
    if sides.is_empty() {
        return most_m;
    }
    let sum: f64 = (0..TYPICAL_PLACES).into_par_iter().map(one).collect::<Vec<f64>>().iter().sum();
    (sum / f64::from(TYPICAL_PLACES)).max(f64::MIN_POSITIVE)
}

/// The result of the rays that measure distances around a place.
struct Felt {
    site: Site,
    /// The harmonic mean of the distances, m, limited to the largest radius.
    mean_m: f64,
    /// The places where the rays end.
    ends: Vec<Place>,
}

/// Adds samples until all places are served. Returns the places that the new samples see, and the number of
/// rays.
pub(super) fn serve(
    scene: &Scene,
    layer: &mut Layer,
    places: Vec<Place>,
    (radii, deadline): (Radii, &Deadline),
) -> (Vec<Place>, u64) {
    let places = in_random_order(places);
    let (mut seen, mut rays) = (Vec::new(), 0);
    let (mut first, mut batch) = (0, FIRST_BATCH);
    while first < places.len() {
        let end = (first + batch).min(places.len());
        let part = &places[first..end];
        let felt: Vec<Felt> = part
            .par_iter()
            .filter(|place| {
                !deadline.has_passed() && !layer.covers(scene, place.origin, place.normal)
            })
            .map(|place| feel(scene, place, radii))
            .collect();
        rays += felt.len() as u64 * u64::from(FEELERS);
        for Felt { site, ends, .. } in felt {
            if !layer.covers(scene, site.origin, site.normal) {
                layer.insert(site);
                seen.extend(ends);
            }
        }
        (first, batch) = (end, 2 * batch);
    }
    (seen, rays)
}

/// Adds samples until all places are served, then for the places that the new samples see, and so on, up to
/// [`ROUNDS`] times. Returns the number of rays.
pub(super) fn serve_all_seen(
    scene: &Scene,
    layer: &mut Layer,
    mut places: Vec<Place>,
    (radii, deadline): (Radii, &Deadline),
) -> u64 {
    let mut rays = 0;
    for _ in 0..ROUNDS {
        if places.is_empty() {
            break;
        }
        let (seen, traced) = serve(scene, layer, places, (radii, deadline));
        places = seen;
        rays += traced;
    }
    rays
}

/// Each place once, in a random order that depends on the places alone.
fn in_random_order(places: Vec<Place>) -> Vec<Place> {
    let bits = |p: &Place| {
        let n = p.normal.to_vector();
        [p.origin.x, p.origin.y, p.origin.z, n.x, n.y, n.z].map(f64::to_bits)
    };
    let key = Key::new(0).with(8);
    let order = |p: &Place| bits(p).iter().fold(key, |key, &b| key.with(b)).bits();
    let mut ordered: Vec<(u64, Place)> = places.into_par_iter().map(|p| (order(&p), p)).collect();
    ordered.par_sort_unstable_by(|a, b| {
        let full = |(order, p): &(u64, Place)| (*order, bits(p), p.triangle);
        full(a).cmp(&full(b))
    });
    ordered.dedup_by(|a, b| a.0 == b.0 && bits(&a.1) == bits(&b.1));
    ordered.into_iter().map(|(_, place)| place).collect()
}

fn feel(scene: &Scene, place: &Place, radii: Radii) -> Felt {
    let sequence = Sequence::new(place_key(place.origin).with(9));
    let axis = place.normal.to_direction();
    let (mut nearness, mut nearest_m) = (0.0, f64::INFINITY);
    let mut ends = Vec::new();
    for index in 0..FEELERS {
        let mut dice = Dice::new(sequence, index);
        let direction = axis.from_local(polar(dice.pair()));
        let ray = Ray::new(place.origin, direction).skipping(place.triangle);
        let Some(hit) = scene.bvh().closest_hit(&ray) else { continue };
        nearest_m = nearest_m.min(f64::from(hit.t));
        let mut of_ray = None;
        let mut meet = |surface: &SurfacePoint, finish: &crate::scene::Finish| {
            let distance_m = (surface.point - place.origin).length();
            of_ray = of_ray.or(Some(distance_m));
            if !reflected(scene, surface, finish).is_black() {
                ends.push(Place::from(surface));
            }
        };
        let surface = SurfacePoint::from_hit(scene, &hit);
        match &scene.material(hit.triangle).body {
            Body::Opaque { front, back } => {
                let finish = if hit.back { back } else { front };
                if finish.mirror.is_black() && !finish.is_glossy() {
                    meet(&surface, finish);
                } else {
                    follow(scene, ray, direction, &mut dice, |at, finish, _| meet(at, finish));
                }
            }
            Body::Dielectric(_) => {
                follow(scene, ray, direction, &mut dice, |at, finish, _| meet(at, finish));
            }
        }
        nearness += of_ray.map_or(0.0, |distance_m| 1.0 / distance_m.max(1e-12));
    }
    let mean_m = (f64::from(FEELERS) / nearness).min(radii.most_m);
    let radius_m = radii.of(mean_m, nearest_m);
    let Place { origin, normal, triangle } = *place;
    Felt { site: Site { origin, normal, triangle, radius_m, nearest_m }, mean_m, ends }
}
