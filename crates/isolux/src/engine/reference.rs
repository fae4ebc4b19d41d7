//! The textbook way: path tracing at single places, the oracle of the engines.
//!
//! At a place every luminaire is asked for its direct light. Indirect light is the mean of random
//! paths (Kajiya 1986, "The rendering equation"): cosine-distributed, over specular surfaces to a
//! diffuse one, where direct light is estimated once, and on from there with the chance of its
//! reflectance. No map is read and there are no elements, so nothing is biased but by what is left
//! out: light that comes to a surface only by specular ways for which there are no virtual luminaires
//! (caustics of glass, gloss, curved mirrors and chains of more than six planar ones), at the place and
//! at every diffuse reflection, and paths caught by more than 128 specular surfaces in a row.

use super::accumulate::mean_and_variance;
use super::direct::Lighting;
use super::gather::Gatherer;
use super::path::{Dice, follow};
use super::place::{Places, ProbePoint, place_key};
use super::probe::ExactSettings;
use super::surface::SurfacePoint;
use crate::elements::carries_map;
use crate::map::{Illuminance, Standing};
use crate::sampling::{CosineHemisphere, Sequence};
use crate::scene::{Finish, Scene};
use crate::units::Rgb;
use isolux_geometry::Ray;
use rayon::prelude::*;

/// Greatest chance of a further reflection, so that paths end between surfaces that absorb nothing.
const MOST_LIKELY: f64 = 0.99;

/// Estimates illuminance at places of a scene, without a map.
pub struct PathTracer<'a> {
    scene: &'a Scene,
    lighting: Lighting<'a>,
    places: Places<'a>,
}

impl<'a> PathTracer<'a> {
    /// Prepares the luminaires of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, lighting: Lighting::new(scene), places: Places::of(scene) }
    }

    /// Whether there is light that paths leave out: caustics.
    pub fn leaves_caustics(&self) -> bool {
        self.lighting.leaves_caustics()
    }

    /// The illuminance at any point that faces any way, on a surface or not, with its standard error
    /// from independent replicates, each of low-discrepancy points of its own. Caustics are left
    /// out. Every place has random numbers of its own: errors of neighbours are independent.
    pub fn estimate(&self, at: ProbePoint, settings: &ExactSettings) -> Illuminance {
        let start = self.start(at);
        let key = place_key(at.position).with(settings.seed);
        let replicates = settings.replicates.max(2);
        let paths = |number: u32| {
            let sequence = Sequence::new(key.with(u64::from(number)));
            let path = |index| self.path(start, &mut Dice::new(sequence, index));
            (0..settings.rays).map(path).sum::<Rgb>() / f64::from(settings.rays.max(1))
        };
        let indirect: Vec<Rgb> = (0..replicates).into_par_iter().map(paths).collect();
        let (indirect_lx, indirect_variance) = mean_and_variance(&indirect);
        let (direct_lx, direct_variance) = self.direct(&start.surface, settings);
        Illuminance {
            direct_lx,
            caustic_lx: Rgb::BLACK,
            indirect_lx,
            interpolation_error_lx: 0.0,
            standing: Standing::Open,
            standard_error_lx: (indirect_variance + direct_variance).sqrt(),
            indirect_standard_error_lx: indirect_variance.sqrt(),
            samples: u64::from(replicates) * u64::from(settings.rays),
        }
    }

    fn start(&self, at: ProbePoint) -> Gatherer {
        let carries = |surface: &SurfacePoint| {
            let SurfacePoint { triangle, back, .. } = *surface;
            carries_map(self.scene, triangle, back)
        };
        self.places.surface_at(at, carries).map_or_else(
            || Gatherer::in_space(at.position, at.normal, 1),
            |surface| Gatherer::on_surface(self.places.pulled_in(surface), 1),
        )
    }

    /// Direct light of all luminaires and the variance of its mean.
    fn direct(&self, at: &SurfacePoint, settings: &ExactSettings) -> (Rgb, f64) {
        let key = place_key(at.point).with(settings.seed).with(u64::MAX);
        let one = |replicate: u32| {
            let sequence = Sequence::new(key.with(u64::from(replicate)));
            self.lighting.illuminance_by_all(at, &mut Dice::new(sequence, 0))
        };
        if self.lighting.is_measured_once() {
            return (one(0), 0.0);
        }
        let values: Vec<Rgb> = (0..settings.replicates.max(2)).map(one).collect();
        mean_and_variance(&values)
    }

    /// What one path brings of the light that was reflected diffusely at least once, lx.
    fn path(&self, start: Gatherer, dice: &mut Dice) -> Rgb {
        let mut light = Rgb::BLACK;
        // A surface that is both diffuse and a mirror divides a path.
        let mut waiting = vec![(start, Rgb::WHITE)];
        while let Some((from, throughput)) = waiting.pop() {
            for (surface, reflectance) in self.reflecting_ends(&from, dice) {
                let throughput = throughput * reflectance;
                light += throughput * self.lighting.estimate(&surface, dice);
                let chance = throughput.max_channel().min(MOST_LIKELY);
                let [survive, _] = dice.pair();
                if survive < chance {
                    waiting.push((Gatherer::on_surface(surface, 1), throughput / chance));
                }
            }
        }
        light
    }

    /// The diffuse surfaces that a cosine-distributed ray meets, each with the share of its
    /// illuminance that comes back along the ray.
    fn reflecting_ends(&self, from: &Gatherer, dice: &mut Dice) -> Vec<(SurfacePoint, Rgb)> {
        let axis = from.normal.to_direction();
        let direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
        let ray = Ray::new(from.origin, direction).skipping(from.surface.triangle);
        let mut ends = Vec::new();
        let meet = |surface: &SurfacePoint, finish: &Finish, throughput: Rgb| {
            let SurfacePoint { triangle, u, v, .. } = *surface;
            let reflectance = self.scene.diffuse_reflectance(finish, triangle, u, v);
            ends.extend((!reflectance.is_black()).then_some((*surface, throughput * reflectance)));
        };
        follow(self.scene, ray, direction, dice, meet);
        ends
    }
}
