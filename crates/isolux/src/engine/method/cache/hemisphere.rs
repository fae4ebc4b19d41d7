//! The view of a sample as a linear function of the light in it: irradiance and its two gradients.
//!
//! Rays are cosine-distributed and stratified: one in every cell of a polar grid over the hemisphere. Their
//! light gives the irradiance. The translational gradient comes from the differences between neighbouring
//! cells, which widen and shrink when the sample moves. The rotational gradient comes from the change of
//! cosines when it turns (Ward and Heckbert 1992, "Irradiance gradients"). Where rays end, direct light is
//! evaluated at once. The light of further reflections stays open, as contributions (ties) of far samples.

use super::layer::{Layer, Site, Tie};
use crate::engine::gather::{BrightSurfaces, Seen};
use crate::engine::light::Lighting;
use crate::engine::mesh::corrected;
use crate::engine::ray::{Dice, PathEnd, follow_on};

use crate::engine::ray::SurfacePoint;
use crate::sampling::Sequence;
use crate::scene::{Finish, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Ray, Vector};
use std::f64::consts::PI;

/// The least distance of obstacles in the translational gradient, as a share of the radius of the sample. At
/// smaller distances two rays in neighbouring cells do not locate an edge.
const NEAREST_EDGE: f64 = 0.25;

/// The largest number of samples that one ray reads.
pub(super) const TIES_OF_RAY: usize = 4;

/// The irradiance at a sample: its value, lx, its gradient along the axes of the world, lx/m, and its
/// gradient when the normal turns about them, lx/rad; each with three channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Light(pub(super) [[f64; 3]; 7]);

impl Light {
    pub(super) fn value(&self) -> Rgb {
        Rgb(self.0[0])
    }
}

/// The light of some ties: the mean of the samples' values, corrected by their gradients.
pub(super) fn tied(ties: &[Tie], lights: &[Light]) -> Rgb {
    let (mut mean, mut turned) = ([0.0; 3], [0.0; 3]);
    for tie in ties {
        let Light(parts) = &lights[tie.sample as usize];
        // Most surfaces are flat: the rotational part is zero there.
        let is_flat = tie.shares[4..] == [0.0; 3];
        let shares = if is_flat { &tie.shares[..4] } else { &tie.shares[..] };
        for (k, (part, &share)) in parts.iter().zip(shares).enumerate() {
            let sum = if k == 0 { &mut mean } else { &mut turned };
            for (sum, channel) in sum.iter_mut().zip(part) {
                *sum += f64::from(share) * channel;
            }
        }
    }
    corrected(Rgb(mean), Rgb(turned))
}

/// A function for the caustics at a place, lx.
pub(super) type Caustic<'a> = &'a (dyn Fn(&SurfacePoint) -> Rgb + Sync);

/// The scene as rays read it where they end.
#[derive(Clone, Copy)]
pub(super) struct Surroundings<'a> {
    pub(super) scene: &'a Scene,
    /// The far samples, for the light of further reflections.
    pub(super) far: &'a Layer,
    /// The luminaires, if direct light is evaluated at ray ends; `None` if it is read from far samples.
    pub(super) lighting: Option<&'a Lighting<'a>>,
    /// Bright surfaces that rays are sent to, where direct light is evaluated.
    pub(super) bright: Option<&'a BrightSurfaces>,
    /// The caustics at ray ends.
    pub(super) caustic: Caustic<'a>,
}

/// The view of a sample.
#[derive(Clone, Debug, Default)]
pub(super) struct Hemisphere {
    rays: Vec<Sight>,
    ends: Vec<End>,
    ties: Vec<Tie>,
    /// The direct light at the sample itself, where it is read with the rest.
    pub(super) own: Rgb,
    /// The light of rays sent to bright surfaces, and their number.
    of_sent: Light,
    sent: u32,
    /// The share of rays that were given up over specular surfaces, or that ended where no far sample is.
    pub(super) lost: f64,
}

/// The contribution of a unit of light along a ray to each part of the irradiance, and the end of its range
/// in `ends`.
#[derive(Clone, Copy, Debug)]
struct Sight {
    adds: [f64; 7],
    ends: u32,
}

/// A surface that a ray meets.
#[derive(Clone, Copy, Debug)]
struct End {
    /// The share of its light that comes back along the ray.
    share: Rgb,
    /// Its direct light and caustics.
    given: Rgb,
    /// The end of its range in `ties`.
    ties: u32,
}

impl Hemisphere {
    /// The view along `rays` rays, a power of two.
    pub(super) fn look(of: &Surroundings, from: &Site, rays: u32, sequence: Sequence) -> Self {
        let grid = Grid::of(rays);
        let axis = from.normal.to_direction();
        let mut seen = Self::default();
        let bright = of.bright.and_then(|all| all.seen_from(from.origin, from.normal, rays));
        let mut cells = vec![(0, 0.0); rays as usize];
        for index in 0..rays {
            let mut dice = Dice::new(sequence, index);
            let square = dice.pair();
            let direction = axis.from_local(polar(square));
            let share = 1.0 / f64::from(rays);
            let nearness = seen.ray((of, bright.as_ref()), from, (direction, share), &mut dice);
            cells[grid.cell(square)] = (index, nearness.min(1.0 / (NEAREST_EDGE * from.radius_m)));
        }
        let gradients = grid.gradients(&cells, axis);
        for (ray, [along, turning]) in seen.rays.iter_mut().zip(gradients) {
            let adds = [along.x, along.y, along.z, turning.x, turning.y, turning.z];
            ray.adds[1..].copy_from_slice(&adds);
        }
        if let Some((bright, all)) = bright.as_ref().zip(of.lighting) {
            seen.sent = bright.sent;
            for index in 0..bright.sent {
                let dice = &mut Dice::new(sequence, rays + index);
                seen.send((of, all), from, (bright, rays), dice);
            }
        }
        seen
    }

    /// Adds a ray to a bright surface, for the direct light there.
    fn send(
        &mut self,
        (of, lighting): (&Surroundings, &Lighting),
        from: &Site,
        (bright, rays): (&Seen, u32),
        dice: &mut Dice,
    ) {
        let [pick, within] = [dice.pair(), dice.pair()];
        let drawn = bright.draw((of.scene, from.triangle), pick, within);
        let Some((to, spot)) = drawn else { return };
        let reflectance = to.reflectance(of.scene);
        let share = bright.share(spot, &to) / f64::from(rays);
        let light = reflectance * lighting.estimate(&to, dice) * share;
        let [along, turning] = gradients_of_patch(from, &to);
        let adds = [1.0, along.x, along.y, along.z, turning.x, turning.y, turning.z];
        for (part, adds) in self.of_sent.0.iter_mut().zip(adds) {
            part.iter_mut().zip(light.0).for_each(|(part, channel)| *part += adds * channel);
        }
    }

    /// Adds a ray; returns the inverse of the distance to the first surface it meets, 1/m.
    fn ray(
        &mut self,
        (of, bright): (&Surroundings, Option<&Seen>),
        from: &Site,
        (direction, share): (Direction, f64),
        dice: &mut Dice,
    ) -> f64 {
        let mut met: Vec<(SurfacePoint, Rgb, bool)> = Vec::new();
        let mut nearness = 0.0;
        let ray = Ray::new(from.origin, direction).skipping(from.triangle);
        let hit = of.scene.bvh().closest_hit(&ray);
        let end =
            follow_on(of.scene, hit, direction, dice, |number, surface, finish, throughput| {
                if nearness == 0.0 {
                    nearness = 1.0 / (surface.point - from.origin).length().max(1e-12);
                }
                let reflectance = reflected(of.scene, surface, finish);
                if !reflectance.is_black() {
                    met.push((*surface, throughput * reflectance, number == 0));
                }
            });
        if let PathEnd::GivenUp(lost) = end {
            self.lost += lost * share;
        }
        for (surface, reflectance, straight) in met {
            let before = self.ties.len();
            let place = (surface.start(), surface.shading);
            of.far.ties(of.scene, place, TIES_OF_RAY, &mut self.ties);
            if self.ties.len() == before {
                self.lost += share * reflectance.luminance();
            }
            let direct = of.lighting.map_or(Rgb::BLACK, |all| all.estimate(&surface, dice));
            let spot = bright.filter(|_| straight).zip(of.bright.and_then(|all| all.at(&surface)));
            let met = spot.map_or(1.0, |(bright, spot)| bright.share(spot, &surface));
            let given = direct * met + (of.caustic)(&surface);
            self.ends.push(End { share: reflectance, given, ties: self.ties.len() as u32 });
        }
        let ends = self.ends.len() as u32;
        self.rays.push(Sight { adds: [share, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], ends });
        nearness
    }

    /// The irradiance at the sample, given the light of the far samples.
    pub(super) fn light(&self, far: &[Light]) -> Light {
        let mut light = self.of_sent;
        light.0[0].iter_mut().zip(self.own.0).for_each(|(part, own)| *part += own);
        let (mut end, mut tie) = (0, 0);
        for ray in &self.rays {
            let mut of_ray = [0.0; 3];
            for met in &self.ends[end..ray.ends as usize] {
                let further = tied(&self.ties[tie..met.ties as usize], far);
                for (k, of_ray) in of_ray.iter_mut().enumerate() {
                    *of_ray += met.share.0[k] * (met.given.0[k] + further.0[k]);
                }
                tie = met.ties as usize;
            }
            end = ray.ends as usize;
            for (part, &adds) in light.0.iter_mut().zip(&ray.adds) {
                for (part, of_ray) in part.iter_mut().zip(&of_ray) {
                    *part += adds * of_ray;
                }
            }
        }
        light
    }

    pub(super) fn ray_count(&self) -> u64 {
        self.rays.len() as u64 + u64::from(self.sent)
    }
}

/// The relative gradients of the light from a small patch when the place moves, 1/m, and when it turns,
/// 1/rad.
fn gradients_of_patch(from: &Site, to: &SurfacePoint) -> [Vector; 2] {
    let way = to.point - from.origin;
    let (normal, facing) = (from.normal.to_vector(), to.geometric.to_vector());
    let rises = way.dot(normal);
    let along = way * (4.0 / way.length_squared())
        - normal * (1.0 / rises)
        - facing * (1.0 / way.dot(facing));
    // As for the other rays, the gradient is along the surface alone.
    [along - normal * along.dot(normal), normal.cross(way) * (1.0 / rises)]
}

/// The diffuse reflectance of a surface; black for the back of one without.
pub(super) fn reflected(scene: &Scene, at: &SurfacePoint, finish: &Finish) -> Rgb {
    scene.diffuse_reflectance(finish, at.triangle, at.u, at.v)
}

/// The cosine-distributed direction at a point of the unit square, whose coordinates are the squared sine of
/// the angle to the normal and the azimuth in turns.
pub(super) fn polar([sine_squared, turns]: [f64; 2]) -> Vector {
    let (sin, cos) = (sine_squared.sqrt(), (1.0 - sine_squared).max(0.0).sqrt());
    let (y, x) = libm::sincos(2.0 * PI * turns);
    Vector::new(sin * x, sin * y, cos)
}

/// A polar grid over the hemisphere, with one ray of a low-discrepancy sequence in every cell.
struct Grid {
    /// The number of rings about the normal.
    rings: usize,
    /// The number of cells in a ring.
    sectors: usize,
}

impl Grid {
    fn of(rays: u32) -> Self {
        // With four times as many sectors as rings, cells are about as long as wide.
        let rings = 1 << (rays.max(1).ilog2().saturating_sub(2) / 2);
        Self { rings, sectors: (rays as usize / rings).max(1) }
    }

    fn cell(&self, [sine_squared, turns]: [f64; 2]) -> usize {
        let part = |share: f64, of: usize| ((share * of as f64) as usize).min(of - 1);
        part(sine_squared, self.rings) * self.sectors + part(turns, self.sectors)
    }

    /// The contribution of a unit of light along each ray to the two gradients. `cells` has each ray and its
    /// inverse distance, 1/m.
    fn gradients(&self, cells: &[(u32, f64)], axis: Direction) -> Vec<[Vector; 2]> {
        let mut gradients = vec![[Vector::ZERO; 2]; cells.len()];
        let (rings, sectors) = (self.rings, self.sectors);
        let at = |ring: usize, sector: usize| cells[ring * sectors + sector % sectors];
        let sine = |ring: usize| (ring as f64 / rings as f64).sqrt();
        let around = |turns: f64| {
            let (y, x) = libm::sincos(2.0 * PI * turns);
            (Vector::new(x, y, 0.0), Vector::new(-y, x, 0.0))
        };
        for sector in 0..sectors {
            let (outwards, _) = around((sector as f64 + 0.5) / sectors as f64);
            let (_, across) = around(sector as f64 / sectors as f64);
            for ring in 0..rings {
                let (own, nearness) = at(ring, sector);
                let mut shift = |to: Vector, other: (u32, f64), share: f64| {
                    let along = to * (share * nearness.max(other.1) / PI);
                    gradients[own as usize][0] += along;
                    gradients[other.0 as usize][0] += -along;
                };
                if ring > 0 {
                    // This is the inner edge of the cell, which moves inwards as the sample moves outwards.
                    let (sin, cos_squared) = (sine(ring), 1.0 - sine(ring) * sine(ring));
                    let width = 2.0 * PI / sectors as f64;
                    shift(outwards, at(ring - 1, sector), width * sin * cos_squared);
                }
                let other = at(ring, sector + sectors - 1);
                shift(across, other, sine(ring + 1) - sine(ring));
                let (_, turn) = around((sector as f64 + 0.5) / sectors as f64);
                gradients[own as usize][1] =
                    turn * (mean_tangent(ring, rings) / cells.len() as f64);
            }
        }
        let (u, v) = axis.frame();
        let to_world = |local: Vector| u * local.x + v * local.y;
        gradients.into_iter().map(|both| both.map(to_world)).collect()
    }
}

/// The mean over a ring of the tangent of the angle to the normal: the integral of `sqrt(s / (1 - s))`.
fn mean_tangent(ring: usize, rings: usize) -> f64 {
    let integral = |s: f64| libm::asin(s.sqrt()) - (s * (1.0 - s)).max(0.0).sqrt();
    let part = |ring: usize| ring as f64 / rings as f64;
    (integral(part(ring + 1)) - integral(part(ring))) * rings as f64
}
