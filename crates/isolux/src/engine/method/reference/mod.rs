//! The reference: path tracing at single places, which checks the methods.
//!
//! Direct light of every luminaire is evaluated at the place. Indirect light is the mean of random paths
//! (Kajiya 1986, "The rendering equation"). A path starts cosine-distributed and passes specular surfaces up
//! to a diffuse one. Direct light is estimated there once, and the path goes on with the probability of the
//! reflectance. Where a lamp is close to a surface, few paths meet its light there, and the others are too
//! dark. Where luminaires are few, they therefore send out light as well: its landing places are connected to
//! every place of a path, and weighted against random hits by the balance heuristic (Veach and Guibas 1995).
//!
//! Light by way of glass, gloss and curved mirrors has no virtual luminaires. That of emitting surfaces is
//! found by random hits, and that of skies by paths that leave the scene. That of other luminaires without surface is found by particles, whose first diffuse
//! surface is connected to every place of a path. No map and no elements are used, so the only bias is the
//! light left out: such light of luminaires without surface on the place itself, which no path can meet, and
//! paths over more than 128 specular surfaces in a row.

mod daylight;
mod paths;
mod sensitivity;

use crate::elements::carries_map;
use crate::engine::gather::Gatherer;
use crate::engine::light::{Emission, Lighting, LuminaireId, Measured, REPLICATES};
use crate::engine::ray::{
    Deadline, Dice, Places, ProbePoint, SurfacePoint, mean_and_variance, place_key,
};
use crate::engine::read::ExactSettings;
use crate::map::{Illuminance, Standing};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
pub use daylight::{Coefficients, Daylight};
pub use paths::PathTracer;
use rayon::prelude::*;
pub use sensitivity::Sensitivity;
use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The result of paths at a place.
pub(crate) struct Traced {
    /// Direct and indirect light of each replicate, lx.
    pub(crate) replicates: Vec<[Rgb; 2]>,
    /// The brightest of all paths, photometric, lx.
    pub(crate) brightest: Vec<f64>,
    /// The number of rays, with shadow rays as far as their number is known.
    pub(crate) rays: u64,
}

/// The number of shadow rays of a replicate to each emitting surface at the place itself.
const SHADOW_RAYS: usize = 4;

impl<'a> PathTracer<'a> {
    /// A path tracer; prepares the luminaires of the scene.
    pub fn new(scene: &'a Scene) -> Self {
        Self::with_lighting(scene, Arc::new(Lighting::new(scene)))
    }

    /// A path tracer that prepares the luminaires of the scene within some time, or else samples them with more noise.
    pub fn prepared_within(scene: &'a Scene, time: Duration) -> Self {
        let end = Deadline::at(Instant::now().checked_add(time));
        Self::with_lighting(scene, Arc::new(Lighting::prepared_until(scene, &end)))
    }

    /// A path tracer with prepared luminaires.
    pub(crate) fn with_lighting(scene: &'a Scene, lighting: Arc<Lighting<'a>>) -> Self {
        let senders = Emission::new(scene).filter(|_| lighting.are_few_points());
        let leaves = lighting.leaves_caustics();
        let over_specular =
            Emission::new(scene).filter(|_| leaves && !scene.luminaires().is_empty());
        let emitters = if leaves { emitters(scene) } else { HashMap::new() };
        Self { scene, lighting, places: Places::of(scene), senders, over_specular, emitters }
    }

    /// Whether some light is left out: caustics of luminaires without surface, on the place itself.
    pub fn leaves_caustics(&self) -> bool {
        self.over_specular.is_some()
    }

    /// The illuminance at any point that faces any way, on a surface or not. The standard error comes from
    /// independent replicates, each with its own low-discrepancy points. Caustics of luminaires without
    /// surface are left out. Every place has its own random numbers, so errors of neighbours are independent.
    pub fn estimate(&self, at: ProbePoint, settings: &ExactSettings) -> Illuminance {
        let start = self.start(at);
        let key = place_key(at.position).with(settings.seed);
        let replicates = settings.replicates.max(2);
        let paths = |number: u32| {
            let found = self.replicate(start, key.with(u64::from(number)), settings.rays);
            let mean = |light: Rgb| light / f64::from(settings.rays.max(1));
            [mean(found.sum.caustic), mean(found.sum.indirect)]
        };
        let found: Vec<[Rgb; 2]> = (0..replicates).into_par_iter().map(paths).collect();
        let part = |k: usize| mean_and_variance(&found.iter().map(|f| f[k]).collect::<Vec<_>>());
        let both = mean_and_variance(&found.iter().map(|[a, b]| *a + *b).collect::<Vec<_>>());
        let (caustic_lx, _) = part(0);
        let (indirect_lx, _) = part(1);
        let (_, found_variance) = both;
        let direct = self.direct(&start.surface, settings);
        Illuminance {
            direct_lx: direct.lx + caustic_lx,
            caustic_lx,
            indirect_lx,
            interpolation_error_lx: 0.0,
            bias_lx: 0.0,
            standing: Standing::Open,
            standard_error_lx: (found_variance + direct.variance).sqrt(),
            indirect_standard_error_lx: found_variance.sqrt(),
            common_error_lx: 0.0,
            samples: u64::from(replicates) * u64::from(settings.rays),
        }
    }

    /// About the illuminance at a point that faces any way, photometric, lx, by few paths. Their direct light is drawn from all
    /// luminaires: a thousand of them take as long as ten.
    pub fn rough_lx(&self, at: ProbePoint, paths: u32) -> f64 {
        let start = self.start(at);
        let key = place_key(at.position);
        let found = self.replicate(start, key.with(0), paths).sum;
        let sequence = Sequence::new(key.with(1));
        let direct =
            |index: u32| self.lighting.estimate(&start.surface, &mut Dice::new(sequence, index));
        let direct: Rgb = (0..paths).map(direct).sum();
        (direct + found.caustic + found.indirect).luminance() / f64::from(paths.max(1))
    }

    /// The approximate number of shadow rays of direct light in one reading of a map.
    pub(crate) fn rays_of_reading(&self) -> u64 {
        let looks = if self.lighting.samples_exactly() { 1 } else { REPLICATES };
        u64::from(looks) * self.lighting.rays_of_sampled(SHADOW_RAYS)
    }

    /// The light at a place of a surface from independent replicates of `paths` paths each. Each replicate
    /// estimates direct light anew, unless it is exact.
    pub(crate) fn traced(
        &self,
        at: &SurfacePoint,
        (replicates, paths): (u32, u32),
        key: Key,
    ) -> Traced {
        let start = Gatherer::on_surface(self.places.pulled_in(*at), 1);
        let exact = self.lighting.samples_exactly();
        let sampled = self.lighting.sampled_again(&start.surface, SHADOW_RAYS);
        let direct =
            |number: u64| sampled(&mut Dice::new(Sequence::new(key.with(number).with(1)), 0));
        let once = exact.then(|| direct(0));
        let (mut brightest, mut rays, mut found) = (Vec::new(), 0, Vec::new());
        for number in 0..u64::from(replicates) {
            let of_paths = self.replicate(start, key.with(number).with(0), paths);
            let share = 1.0 / f64::from(paths.max(1));
            let direct_lx = once.unwrap_or_else(|| direct(number));
            found.push([direct_lx + of_paths.sum.caustic * share, of_paths.sum.indirect * share]);
            brightest.extend(of_paths.brightest);
            rays += of_paths.rays;
        }
        let looks = if exact { 1 } else { u64::from(replicates) };
        rays += looks * self.lighting.rays_of_sampled(SHADOW_RAYS);
        brightest.sort_by(|a, b| f64::total_cmp(b, a));
        brightest.truncate(paths::BRIGHTEST);
        Traced { replicates: found, brightest, rays }
    }

    fn start(&self, at: ProbePoint) -> Gatherer {
        let carries = |surface: &SurfacePoint| {
            let SurfacePoint { triangle, back, .. } = *surface;
            carries_map(self.scene, triangle, back)
        };
        self.places.surface_at(at, carries).map_or_else(
            || Gatherer::in_space(self.scene, at.position, at.normal, 1),
            |surface| Gatherer::on_surface(self.places.pulled_in(surface), 1),
        )
    }

    /// The direct light of all luminaires and the variance of its mean.
    fn direct(&self, at: &SurfacePoint, settings: &ExactSettings) -> Measured {
        let sequence = Sequence::new(place_key(at.point).with(settings.seed).with(u64::MAX));
        let shadow_rays = u64::from(settings.replicates.max(2)) * u64::from(settings.rays);
        self.lighting.read_by_all(at, shadow_rays, sequence)
    }
}

/// The emitting surfaces of a scene, by triangle and side.
fn emitters(scene: &Scene) -> HashMap<(u32, bool), LuminaireId> {
    let of_one = |(number, area): (u32, &crate::scene::AreaLuminaire)| {
        let back = area.back;
        let sides: Vec<(u32, bool)> = area.triangles.iter().map(|&t| (t, back)).collect();
        sides.into_iter().map(move |side| (side, LuminaireId::Area(number)))
    };
    (0..).zip(scene.area_luminaires()).flat_map(of_one).collect()
}
