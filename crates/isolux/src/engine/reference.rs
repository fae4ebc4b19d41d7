//! The textbook way: path tracing at single places, the oracle of the engines.
//!
//! At a place every luminaire is asked for its direct light. Indirect light is the mean of random
//! paths (Kajiya 1986, "The rendering equation"): cosine-distributed, over specular surfaces to a
//! diffuse one, where direct light is estimated once, and on from there with the chance of its
//! reflectance. Where a lamp hangs close to a surface such paths seldom meet what it lights there, and are all wrong when none does; few
//! luminaires therefore send light out as well: where it lands is looked at from every place of a path, weighted against
//! paths that come there by chance by the balance heuristic (Veach and Guibas 1995). No map is read and there are no elements, so nothing is biased but by what is left
//! out: light that comes to a surface only by specular ways for which there are no virtual luminaires
//! (caustics of glass, gloss, curved mirrors and chains of more than six planar ones), at the place and
//! at every diffuse reflection, and paths caught by more than 128 specular surfaces in a row.

use super::accumulate::mean_and_variance;
use super::direct::{Lighting, Measured};
use super::emission::Emission;
use super::gather::Gatherer;
use super::path::{Dice, follow_on};
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
    /// Luminaires that send out light, if they do.
    senders: Option<Emission<'a>>,
}

/// A diffuse surface at the end of a ray.
struct End {
    surface: SurfacePoint,
    /// What of its illuminance comes back along the ray.
    share: Rgb,
    /// How likely it was to be met, 1/m2; none of one that is met by way of mirrors.
    density: Option<f64>,
}

impl<'a> PathTracer<'a> {
    /// Prepares the luminaires of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        let lighting = Lighting::new(scene);
        let senders = Emission::new(scene).filter(|_| lighting.are_few_points());
        Self { scene, lighting, places: Places::of(scene), senders }
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
        let direct = self.direct(&start.surface, settings);
        Illuminance {
            direct_lx: direct.lx,
            caustic_lx: Rgb::BLACK,
            indirect_lx,
            interpolation_error_lx: 0.0,
            bias_lx: 0.0,
            standing: Standing::Open,
            standard_error_lx: (indirect_variance + direct.variance).sqrt(),
            indirect_standard_error_lx: indirect_variance.sqrt(),
            common_error_lx: 0.0,
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
    fn direct(&self, at: &SurfacePoint, settings: &ExactSettings) -> Measured {
        let sequence = Sequence::new(place_key(at.point).with(settings.seed).with(u64::MAX));
        let shadow_rays = u64::from(settings.replicates.max(2)) * u64::from(settings.rays);
        self.lighting.read_by_all(at, shadow_rays, sequence)
    }

    /// What one path brings of the light that was reflected diffusely at least once, lx.
    fn path(&self, start: Gatherer, dice: &mut Dice) -> Rgb {
        let mut light = Rgb::BLACK;
        // A surface that is both diffuse and a mirror divides a path.
        let mut waiting = vec![(start, Rgb::WHITE)];
        while let Some((from, throughput)) = waiting.pop() {
            if let Some(senders) = &self.senders {
                light += throughput * self.sent(senders, &from, dice);
            }
            for End { surface, share, density } in self.reflecting_ends(&from, dice) {
                let throughput = throughput * share;
                let direct_lx = self.lighting.estimate(&surface, dice);
                // Where no light lands, a ray may end that could hardly come there, too.
                let lit = self.senders.as_ref().filter(|_| !direct_lx.is_black());
                let met = lit.zip(density).map_or(1.0, |(senders, by_chance)| {
                    by_chance / (by_chance + senders.landing(direct_lx))
                });
                light += throughput * direct_lx * met;
                let chance = throughput.max_channel().min(MOST_LIKELY);
                let [survive, _] = dice.pair();
                if survive < chance {
                    waiting.push((Gatherer::on_surface(surface, 1), throughput / chance));
                }
            }
        }
        light
    }

    /// What a place gets from where a luminaire has sent some of its light, lx.
    fn sent(&self, senders: &Emission, from: &Gatherer, dice: &mut Dice) -> Rgb {
        let landed = senders.emit(dice).and_then(|sent| self.scene.bvh().closest_hit(&sent.ray));
        let Some(surface) = landed.map(|hit| SurfacePoint::from_hit(self.scene, &hit)) else {
            return Rgb::BLACK;
        };
        let reflectance = surface.reflectance(self.scene);
        let by_chance = density(from, &surface);
        let way = Ray::between(from.origin, surface.start()).skipping(from.surface.triangle);
        let is_dark = by_chance <= 0.0 || reflectance.is_black();
        if is_dark || self.scene.bvh().any_hit(&way) {
            return Rgb::BLACK;
        }
        let direct_lx = self.lighting.estimate(&surface, dice);
        reflectance * direct_lx * (by_chance / (by_chance + senders.landing(direct_lx)))
    }

    /// The diffuse surfaces that a cosine-distributed ray meets.
    fn reflecting_ends(&self, from: &Gatherer, dice: &mut Dice) -> Vec<End> {
        let axis = from.normal.to_direction();
        let direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
        let ray = Ray::new(from.origin, direction).skipping(from.surface.triangle);
        let mut ends = Vec::new();
        let meet = |number: u32, surface: &SurfacePoint, finish: &Finish, throughput: Rgb| {
            let SurfacePoint { triangle, u, v, .. } = *surface;
            let reflectance = self.scene.diffuse_reflectance(finish, triangle, u, v);
            if !reflectance.is_black() {
                let density = (number == 0).then(|| density(from, surface));
                ends.push(End { surface: *surface, share: throughput * reflectance, density });
            }
        };
        follow_on(self.scene, self.scene.bvh().closest_hit(&ray), direction, dice, meet);
        ends
    }
}

/// How likely a cosine-distributed ray is to end at a place if nothing is between, 1/m2.
fn density(from: &Gatherer, at: &SurfacePoint) -> f64 {
    let way = at.point - from.origin;
    let away = way.dot(from.normal.to_vector());
    let facing = -way.dot(at.geometric.to_vector());
    let squared = way.length_squared();
    if away > 0.0 && facing > 0.0 && squared > 0.0 {
        away * facing / (std::f64::consts::PI * squared * squared)
    } else {
        0.0
    }
}
