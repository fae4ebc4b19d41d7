//! Positions and validity radii of samples: the split-sphere model.
//!
//! The estimated error of extrapolating a sample is the distance over its radius plus a term for the change
//! of the normal. A sample serves places where this error is below the allowed one (Ward, Rubinstein, Clear
//! 1988). Its weight falls to zero at that limit, so there are no jumps.

use super::octree::Octree;
use crate::engine::ray::SurfacePoint;
use crate::scene::Scene;
use isolux_geometry::{Normal, Point, Ray, Vector};

/// The factor on the allowed error for a ray that ends where no sample serves.
const RELAXED: f64 = 3.0;

/// The largest distance of a place from the plane of a sample, as a share of their distance. Beyond it lies
/// another surface, like the next step of a stair.
const STEEPEST: f64 = 0.3;

/// The depth of a place below a sample, as a share of their distance, beyond which it lies behind the
/// sample's surface. The bend of the surface is allowed in addition.
const BELOW: f64 = 1e-4;

/// The share of the distance to the nearest visible surface within which no wall can hide a sample.
const CLEAR: f64 = 0.5;

/// The position and reach of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Site {
    /// The start of its rays, just above the surface.
    pub(super) origin: Point,
    /// The shading normal.
    pub(super) normal: Normal,
    /// The triangle that it lies on, which its rays skip.
    pub(super) triangle: u32,
    /// The harmonic mean of the distances to the surfaces it sees, within bounds, m.
    pub(super) radius_m: f64,
    /// The distance to the nearest surface it sees, m.
    pub(super) nearest_m: f64,
}

/// The contribution of a sample to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tie {
    /// The number of the sample.
    pub(super) sample: u32,
    /// The weight of its value, then that weight times the factors of its gradients: the vector from the
    /// sample to the place, m, and the cross product of their normals.
    pub(super) shares: [f32; 7],
}

/// The samples of one kind.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    pub(super) sites: Vec<Site>,
    /// The allowed error, relative: the inverse of Ward's least weight.
    allowed: f64,
    near: Octree,
    /// The samples by their reach with [`RELAXED`] error.
    wide: Octree,
}

impl Layer {
    /// A layer without samples.
    pub(super) fn new(scene: &Scene, allowed: f64) -> Self {
        let bounds = scene.bvh().mesh().bounds().unwrap_or((Point::ORIGIN, Point::ORIGIN));
        let tree = Octree::over(bounds);
        Self { sites: Vec::new(), allowed, near: tree.clone(), wide: tree }
    }

    /// Adds a sample and returns its number. Its radius is limited by those of samples that reach it, and
    /// theirs by its own (neighbour clamping: Krivanek, Bouatouch, Pattanaik, Zara 2006, "Making radiance and
    /// irradiance caching practical"). A surface close to one sample is as close to the next.
    pub(super) fn insert(&mut self, site: Site) -> u32 {
        let number = self.sites.len() as u32;
        let mut radius_m = site.radius_m;
        let mut shrunk = Vec::new();
        self.near.visit(site.origin, |other| {
            let there = &self.sites[other as usize];
            let distance_m = (there.origin - site.origin).length();
            if there.normal.dot(site.normal) > 0.9 && distance_m < self.allowed * there.radius_m {
                radius_m = radius_m.min(there.radius_m + distance_m);
                shrunk.push((other, distance_m));
            }
        });
        for (other, distance_m) in shrunk {
            let there = &mut self.sites[other as usize].radius_m;
            *there = there.min(radius_m + distance_m);
        }
        self.sites.push(Site { radius_m, ..site });
        self.near.insert(number, site.origin, self.allowed * radius_m);
        self.wide.insert(number, site.origin, RELAXED * self.allowed * radius_m);
        number
    }

    /// Whether a sample serves a place.
    pub(super) fn covers(&self, scene: &Scene, at: Point, normal: Normal) -> bool {
        let mut found = false;
        self.near.visit(at, |number| {
            found = found || {
                let site = &self.sites[number as usize];
                let is_near = site.error_at(at, normal).is_some_and(|e| e < self.allowed);
                is_near && site.sees(scene, at, normal)
            }
        });
        found
    }

    /// Appends the contributions of at most `most` samples to a place, with weights that sum to one. Where
    /// none serves it, samples farther off do. Nothing is appended if there are none either.
    pub(super) fn ties(
        &self,
        scene: &Scene,
        (at, normal): (Point, Normal),
        most: usize,
        ties: &mut Vec<Tie>,
    ) {
        let first = ties.len();
        self.collect(&self.near, self.allowed, scene, (at, normal), ties);
        if ties.len() == first {
            self.collect(&self.wide, RELAXED * self.allowed, scene, (at, normal), ties);
        }
        // The samples with the largest weights are kept.
        if ties.len() > first + most {
            ties[first..].sort_by(|a, b| b.shares[0].total_cmp(&a.shares[0]));
            ties.truncate(first + most);
        }
        let sum: f32 = ties[first..].iter().map(|tie| tie.shares[0]).sum();
        for tie in &mut ties[first..] {
            tie.shares = tie.shares.map(|share| share / sum);
        }
    }

    fn collect(
        &self,
        tree: &Octree,
        allowed: f64,
        scene: &Scene,
        (at, normal): (Point, Normal),
        ties: &mut Vec<Tie>,
    ) {
        tree.visit(at, |number| {
            let site = &self.sites[number as usize];
            let Some(error) = site.error_at(at, normal).filter(|e| *e < allowed) else { return };
            if !site.sees(scene, at, normal) {
                return;
            }
            let (shift, turn) = (at - site.origin, cross(site.normal, normal));
            // The weight of a very close sample is limited, so that others count, too.
            let weight = 1.0 / error.max(1e-3 * allowed) - 1.0 / allowed;
            let shares = [1.0, shift.x, shift.y, shift.z, turn.x, turn.y, turn.z];
            ties.push(Tie { sample: number, shares: shares.map(|s| (weight * s) as f32) });
        });
    }
}

impl Site {
    /// The sample as a place for direct light.
    pub(super) fn surface(&self) -> SurfacePoint {
        // The origin is already clear of the surface.
        let surface = SurfacePoint::in_space(self.origin, self.normal, 0.0);
        SurfacePoint { triangle: self.triangle, ..surface }
    }

    /// The estimated error of serving a place, relative; `None` where the place lies on another surface.
    fn error_at(&self, at: Point, normal: Normal) -> Option<f64> {
        let shift = at - self.origin;
        let distance_m = shift.length();
        let between = self.normal.to_vector() + normal.to_vector();
        let off_plane_m = (0.5 * shift.dot(between)).abs();
        let cos = self.normal.dot(normal);
        let is_surface = cos > 0.0 && off_plane_m <= STEEPEST * distance_m + 1e-5 * self.radius_m;
        is_surface.then(|| distance_m / self.radius_m + (1.0 - cos).max(0.0).sqrt())
    }

    /// Whether nothing stands between the sample and a place. Over a bent surface the test ray is raised by
    /// the bulge between them. A place below the sample's own surface was not seen by its rays, since that
    /// surface stands between; so it is with the room below a sample on the outside of a wall.
    fn sees(&self, scene: &Scene, at: Point, normal: Normal) -> bool {
        let shift = at - self.origin;
        let distance_m = shift.length();
        let bend = (normal.to_vector() - self.normal.to_vector()).length();
        let slack_m = (bend + BELOW) * distance_m + 1e-5 * self.radius_m;
        // The surface of the place itself hides samples that are below it.
        if shift.dot(normal.to_vector()) > slack_m {
            return false;
        }
        let is_below = -shift.dot(self.normal.to_vector()) > slack_m;
        if distance_m <= CLEAR * self.nearest_m && !is_below {
            return true;
        }
        let lift_m = 0.25 * distance_m * bend;
        let (from, to) = (self.origin + self.normal * lift_m, at + normal * lift_m);
        let ray = Ray::between(from, to);
        !scene.bvh().any_hit(&if is_below { ray } else { ray.skipping(self.triangle) })
    }
}

fn cross(a: Normal, b: Normal) -> Vector {
    a.to_vector().cross(b.to_vector())
}
