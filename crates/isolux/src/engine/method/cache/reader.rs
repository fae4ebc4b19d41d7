//! Readings of a scene from its cache alone, without a map, for views.

use super::hemisphere::Light;
use super::increments::allowed;
use super::placing::Place;
use super::store::{LEAST_RADIUS_IN_VIEWS, Making, Store};
use super::{CACHE_REPLICATES, CacheError, CacheSample, IrradianceCache};
use crate::elements::carries_map;
use crate::engine::gather::BrightSurfaces;
use crate::engine::light::{Lighting, Patches};
use crate::engine::ray::{Dice, NEVER, Places, SurfacePoint, place_key};
use crate::engine::read::GLANCE_SAMPLES;
use crate::map::{Illuminance, Standing};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use std::sync::Arc;

/// The density of samples and their number of rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CacheSettings {
    /// The largest error that the split-sphere model may estimate for extrapolating a sample, relative. The
    /// error of readings is far smaller, about its square.
    pub allowed: f64,
    /// The number of rays per near sample and replicate, a power of two.
    pub rays: u32,
    /// The number of rays per far sample and replicate.
    pub far_rays: u32,
    /// The seed of the random numbers.
    pub seed: u64,
}

impl CacheSettings {
    /// The density that a map of this accuracy (a fraction) would have, with rays in the same proportion.
    /// Best effort: a view has no check points to measure its accuracy.
    pub fn for_accuracy(accuracy: f64) -> Self {
        let rays = (RAYS_AT_ONE_PERCENT * 0.01 / accuracy.max(1e-6)).clamp(16.0, 1024.0);
        let rays = (rays as u32).next_power_of_two();
        Self { allowed: allowed(accuracy), rays, far_rays: (rays / 2).max(16), seed: 1 }
    }
}

/// The number of rays per sample and replicate for an accuracy of one per cent. In maps a trial chooses 16 to
/// 64.
const RAYS_AT_ONE_PERCENT: f64 = 64.0;

/// The result of making further samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Served {
    /// The new samples.
    pub made: IrradianceCache,
    /// The number of rays traced for them.
    pub rays: u64,
    /// Whether all needed samples were made.
    pub is_whole: bool,
}

/// A place on one side of a triangle of the scene, by the barycentric weights of its second and third
/// corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CachedPlace {
    /// The index of the triangle.
    pub triangle: u32,
    /// Whether the place is on the back.
    pub back: bool,
    /// The weight of the second corner.
    pub u: f64,
    /// The weight of the third corner.
    pub v: f64,
}

/// A reader of a scene by samples.
pub struct CacheReader<'s> {
    scene: &'s Scene,
    lighting: Lighting<'s>,
    bright: Option<Arc<BrightSurfaces>>,
    patches: Patches,
    places: Places<'s>,
    store: Store<'s>,
    settings: CacheSettings,
    /// The means of the near samples, and their variances.
    lights: Vec<Light>,
    variances: Vec<f64>,
}

impl<'s> CacheReader<'s> {
    /// A reader with the samples of a cache of any origin; an error if they cannot belong to the scene.
    pub fn new(
        scene: &'s Scene,
        cache: &IrradianceCache,
        settings: CacheSettings,
    ) -> Result<Self, CacheError> {
        cache.check(scene)?;
        let lighting = Lighting::new(scene);
        let (bright, _) = BrightSurfaces::of(scene, &lighting, settings.seed, &NEVER);
        let mut reader = Self {
            scene,
            lighting,
            bright,
            patches: Patches::new(),
            places: Places::of(scene),
            store: Store::new(scene, cache, (settings.allowed, LEAST_RADIUS_IN_VIEWS)),
            settings,
            lights: Vec::new(),
            variances: Vec::new(),
        };
        reader.learn();
        Ok(reader)
    }

    /// Whether some light is left out because samples do not see it: caustics of glass, gloss and curved
    /// mirrors.
    pub fn leaves_caustics(&self) -> bool {
        self.lighting.leaves_caustics()
    }

    /// Makes the samples that these places still need. The same places in any order and number, with the same
    /// cache, give the same samples on any number of threads.
    pub fn serve(&mut self, places: &[CachedPlace]) -> Served {
        self.serve_until(places, &|| false)
    }

    /// Makes the samples that these places still need until `is_over`. The samples made by then are the first
    /// of all, unchanged. The reader then gives no readings.
    pub fn serve_until(&mut self, places: &[CachedPlace], is_over: &dyn Fn() -> bool) -> Served {
        let Self { scene, lighting, bright, store, settings, .. } = self;
        let places = places.iter().filter_map(|at| place(scene, &self.places, at));
        let mut served = Served {
            rays: store.serve(places.map(|at| Place::from(&at)).collect(), &NEVER),
            ..Served::default()
        };
        let key = Key::new(settings.seed).with(7);
        let making = |part: u64, index: u64, rays: u32| Making {
            index,
            rays,
            key: key.with(part),
            lighting,
            bright: bright.as_deref(),
            caustic: &|_| Rgb::BLACK,
            deadline: &NEVER,
        };
        if store.far.known.is_empty() {
            served.rays += store.guess(&making(0, 0, settings.far_rays));
        }
        let mut far = Vec::new();
        for index in 0..CACHE_REPLICATES as u64 {
            if is_over() {
                return served;
            }
            let one = store.far_replicate(&making(1, index, settings.far_rays));
            let one = one.expect("without a deadline nothing is given up");
            served.rays += one.rays;
            far.push(one.lights);
        }
        served.made.samples = store.far.make_known();
        let near = |index| making(2, index, settings.rays);
        while store.near.is_wanting() {
            if is_over() {
                return served;
            }
            let (made, rays) = store.make_near(&near, &far);
            served.made.samples.extend(made);
            served.rays += rays;
        }
        served.is_whole = true;
        self.learn();
        served
    }

    /// Adds the means of samples that became known since the last call.
    fn learn(&mut self) {
        let new = self.store.near.known[self.lights.len()..].iter().map(CacheSample::mean);
        let (lights, variances): (Vec<Light>, Vec<f64>) = new.unzip();
        self.lights.extend(lights);
        self.variances.extend(variances);
    }

    /// The illuminance at a place, for pictures, which average over many places. Direct light is evaluated by
    /// a few shadow rays per emitting surface; indirect light comes from the samples around. The standard
    /// error is that of the samples. `None` where no sample is near, and where the surface carries no map.
    /// `number` tells readings of one place apart.
    pub fn glance(&self, at: &CachedPlace, number: u64) -> Option<Illuminance> {
        let at = place(self.scene, &self.places, at)?;
        let ties = self.store.ties(&Place::from(&at));
        if ties.is_empty() || self.store.near.is_wanting() {
            return None;
        }
        let variance = |tie: &super::layer::Tie| {
            let share = f64::from(tie.shares[0]);
            share * share * self.variances[tie.sample as usize]
        };
        let error_lx = ties.iter().map(variance).sum::<f64>().sqrt();
        let indirect = super::hemisphere::tied(&ties, &self.lights);
        let sequence = Sequence::new(place_key(at.point).with(number));
        let dice = &mut Dice::new(sequence, 0);
        let direct_lx = self.lighting.sampled_on(&self.patches, &at, GLANCE_SAMPLES, dice);
        Some(Illuminance {
            direct_lx,
            caustic_lx: Rgb::BLACK,
            indirect_lx: indirect,
            standard_error_lx: error_lx,
            indirect_standard_error_lx: error_lx,
            common_error_lx: 0.0,
            interpolation_error_lx: 0.0,
            bias_lx: 0.0,
            standing: Standing::Open,
            samples: ties.len() as u64,
        })
    }
}

/// The surface at a place, if it carries a map.
fn place(scene: &Scene, places: &Places, at: &CachedPlace) -> Option<SurfacePoint> {
    let CachedPlace { triangle, back, u, v } = *at;
    carries_map(scene, triangle, back)
        .then(|| places.pulled_in(SurfacePoint::new(scene, triangle, back, u, v)))
}
