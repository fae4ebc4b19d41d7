//! Readings of a map: direct light evaluated afresh, the rest interpolated or gathered.

mod effort;
mod local_error;
mod on_sensor;
mod parts;
mod pictured;
mod shared_noise;
mod sight;
mod state;
mod told;
mod unlit;
mod walls;

use crate::engine::gather::{BrightSurfaces, DirectAtEnds, DirectResidual, Gatherer, Kept, Over};
use crate::engine::light::{Lighting, Patches};
use crate::engine::mesh::LEAST as LEAST_OF_NOISE;
use crate::engine::occlusion::{Barriers, nearby};
use crate::engine::ray::{
    Dice, NEVER, PathEnd, Places, ProbePoint, SurfacePoint, follow, place_key,
};
use crate::map::{Illuminance, IlluminationMap, Standing, VertexLight};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use effort::{FRESH_REPLICATES, LOOKS, OF_FEW, TRIAL_RAYS, TRIAL_RAYS_IN_SPACE};
use isolux_geometry::Ray;
pub use pictured::PictureLight;
use shared_noise::SharedNoise;
use state::{FRESH_NOISE, Gathered, LocalFactors, StoredDirect, Unseen};
pub use state::{MapReader, reference_lx};
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
pub use told::{Allowance, IndirectReading, Told};

/// The number of shadow rays per emitting surface in a reading for a picture.
pub(crate) const GLANCE_SAMPLES: usize = 4;
/// The fewest and the most samples per element of the residual of direct light between vertices: as many, by fours, as keep the noise
/// that all readings share within that of their own rays.
const KEPT: [u64; 2] = [4, 256];

/// The effort of [`MapReader::estimate`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExactSettings {
    /// The number of gathering rays of one replicate.
    pub rays: u32,
    /// The number of independent replicates, at least two.
    pub replicates: u32,
    /// The seed of the random numbers.
    pub seed: u64,
}

impl Default for ExactSettings {
    fn default() -> Self {
        Self { rays: 1024, replicates: 16, seed: 1 }
    }
}

impl<'a> MapReader<'a> {
    /// A reader of a map; prepares the luminaires of the scene.
    pub fn new(scene: &'a Scene, map: &'a IlluminationMap) -> Self {
        let lighting = Arc::new(Lighting::new(scene));
        let (bright, _) = BrightSurfaces::of(scene, &lighting, map.provenance.seed, &NEVER);
        Self::prepared((scene, map), lighting, bright)
    }

    /// A reader of a map with prepared luminaires, and with bright surfaces prepared for the seed of the map.
    pub(crate) fn prepared(
        (scene, map): (&'a Scene, &'a IlluminationMap),
        lighting: Arc<Lighting<'a>>,
        bright: Option<Arc<BrightSurfaces>>,
    ) -> Self {
        let ambient = map.ambient_lx();
        let reflected = |v: &Option<VertexLight>| {
            v.map_or(Rgb::BLACK, |v| v.indirect_lx + v.caustic_lx + ambient)
        };
        let direct = |v: &Option<VertexLight>| v.map_or(Rgb::BLACK, |v| v.direct_lx - v.caustic_lx);
        let are_read = lighting.are_read_at_ends();
        let light: Vec<Rgb> = map.values.iter().map(reflected).collect();
        let reader = Self {
            scene,
            map,
            lighting,
            bright,
            at_ends: StoredDirect {
                values: are_read.then(|| map.values.iter().map(direct).collect()),
                varying: None,
            },
            standings: map.values.iter().map(|v| v.map(|v| v.standing)).collect(),
            cuts: Barriers::of_map(scene, &map.elements, &light),
            light,
            places: Places::of(scene),
            backdrop: None,
            patches: Patches::new(),
            unseen: Unseen::of(map),
            local: LocalFactors { of_vertices: Vec::new(), arriving: 0.0 },
            shared_noise: SharedNoise::of(Vec::new()),
            rays: AtomicU64::new(0),
        };
        let (kept, varying) = reader.kept().unzip();
        let noise = kept.as_ref().map_or(Vec::new(), |kept| kept.variances_lx2.clone());
        let values = kept.map(|kept| kept.values).or(reader.at_ends.values.clone());
        let (of_vertices, arriving) = reader.parts_of_vertices();
        Self {
            backdrop: reader.walls(),
            at_ends: StoredDirect { values, varying },
            local: LocalFactors { of_vertices, arriving },
            shared_noise: SharedNoise::of(noise),
            ..reader
        }
    }

    /// Direct light at the vertices as rays read it, with its residual between them, and the elements where
    /// it varies between vertices; `None` where there is no residual.
    fn kept(&self) -> Option<(Kept, Vec<bool>)> {
        let over = Over {
            scene: self.scene,
            lighting: &self.lighting,
            elements: &self.map.elements,
            standings: &self.standings,
            direct: self.at_ends.values.as_deref()?,
            bright: self.bright.as_deref(),
        };
        let key = Key::new(self.map.provenance.seed).with(14);
        let kept = DirectResidual::of(&over, self.unseen.reached_lx, (key.with(0), &NEVER))?;
        let allowed_lx = FRESH_NOISE * self.unseen.reached_lx;
        let [mut samples, most] = KEPT;
        loop {
            let read = kept.read(&over, (samples, key.with(1)), &NEVER);
            let read = read.expect("without a deadline nothing is given up");
            self.count(kept.rays(samples));
            if kept.noise_lx(&read) <= allowed_lx || samples >= most {
                return Some((read, kept.varying));
            }
            samples *= 4;
        }
    }

    /// A reading of [`MapReader::at`] or [`MapReader::probe`] with the standard errors of its replicates
    /// alone, without the interpolation error and the bias of the map.
    pub fn by_replicates(&self, reading: Illuminance) -> Illuminance {
        let unseen = libm::hypot(reading.interpolation_error_lx, reading.bias_lx);
        let unseen = unseen * unseen;
        let less = |error: f64| match error {
            f64::INFINITY => error,
            _ => (error * error - unseen).max(0.0).sqrt(),
        };
        Illuminance {
            standard_error_lx: less(reading.standard_error_lx),
            indirect_standard_error_lx: less(reading.indirect_standard_error_lx),
            ..reading
        }
    }

    /// The illuminance at barycentric weights `(1 - u - v, u, v)` of a side of a triangle. Direct light is
    /// evaluated there, and caustics are interpolated. Indirect light is interpolated where the map is
    /// trusted, and gathered over the map elsewhere. The standard error counts the spread of replicates, the
    /// interpolation error expected there, and the local part of the bias of the scene. It is infinite where
    /// the map does not know its error. `None` where the map knows nothing.
    pub fn at(&self, triangle: u32, back: bool, u: f64, v: f64) -> Option<Illuminance> {
        self.read(SurfacePoint::new(self.scene, triangle, back, u, v))
    }

    fn read(&self, surface: SurfacePoint) -> Option<Illuminance> {
        let (indirect, at) = self.indirect(surface, Allowance::ANY)?;
        let part = self.part_at(&surface);
        Some(self.told(self.with_fresh_direct(indirect, (&at, part))))
    }

    /// The indirect light at a place, and the place at which direct light is evaluated.
    fn indirect(
        &self,
        surface: SurfacePoint,
        allowance: Allowance,
    ) -> Option<(Illuminance, SurfacePoint)> {
        let stored = self.stored_at(&surface)?;
        let at = self.places.pulled_in(surface);
        let Some(fresh) = self.map.provenance.fresh else {
            return Some((stored, at));
        };
        let edge_m = nearby::edge_at_m(&self.map.elements, &at);
        let indirect = if self.is_trusted((fresh, allowance), &stored, (&at, edge_m)) {
            self.with_interpolation_error(stored, self.part_at(&surface))
        } else {
            let in_gap = nearby::is_closed_in(self.scene, &at, edge_m);
            let trial = Gatherer::on_surface(at, TRIAL_RAYS).in_gap(in_gap);
            match allowance.noise {
                f64::INFINITY => self.gathered(stored, trial, fresh.lookup_lx),
                _ => self.gathered_for_picture(stored, (trial, allowance), fresh.lookup_lx),
            }
        };
        Some((indirect, at))
    }

    /// Indirect light gathered over the map. The number of rays is such that noise falls to that of the map.
    /// The part of the light still read close by has the error `lookup_lx`.
    fn gathered(&self, stored: Illuminance, trial: Gatherer, lookup_lx: f64) -> Illuminance {
        let key = self.gathering_key(&trial);
        let part = self.part_of(&trial);
        let trial = self.before_walls(trial);
        // Other random numbers than those of the trial: stopping at a small variance would report too small
        // variances.
        let needed = self.rays_needed(trial, self.noise_goal_lx(part), key);
        let gatherer = trial.with_rays(needed.rays);
        let Gathered { lx, variance, close, common_lx } =
            self.gather(gatherer, self.direct_at_ends(), (FRESH_REPLICATES, key.with(1)));
        let samples = u64::from(FRESH_REPLICATES) * u64::from(gatherer.rays);
        let variance = variance.max(least_variance(&stored, samples));
        Illuminance {
            indirect_lx: lx,
            indirect_standard_error_lx: libm::hypot(
                libm::hypot(OF_FEW * variance.sqrt(), of_caustics(&stored)),
                libm::hypot(common_lx, self.map.ambient_doubt_lx()),
            ),
            common_error_lx: common_lx,
            interpolation_error_lx: close * part * lookup_lx,
            bias_lx: part * self.unseen.bias_lx,
            samples,
            ..stored
        }
    }

    /// The illuminance at a point on a surface, on the side that `normal` points to, as [`MapReader::at`]
    /// reads it. `None` where no surface with a known value lies within a ten-thousandth of the scene's
    /// extent.
    pub fn probe(&self, at: ProbePoint) -> Option<Illuminance> {
        self.read(self.find_surface(at)?)
    }

    /// The illuminance as [`MapReader::probe`] reads it on a surface with a known value, else as in free
    /// space: direct light is evaluated, indirect light is gathered over the map until its noise is below the
    /// error of the map, and caustics are unknown and left out. `None` where only the inside of something is
    /// seen.
    pub fn measure(&self, at: ProbePoint) -> Option<Illuminance> {
        self.probe(at).or_else(|| {
            let trial = Gatherer::in_space(self.scene, at.position, at.normal, TRIAL_RAYS_IN_SPACE);
            if !self.sees_light(&trial) {
                return None;
            }
            let lookup_lx = self.map.provenance.fresh.map_or(0.0, |fresh| fresh.lookup_lx);
            let indirect = self.gathered(Illuminance::NOTHING, trial, lookup_lx);
            let part = self.part_of(&trial);
            Some(self.told(self.with_fresh_direct(indirect, (&trial.surface, part))))
        })
    }

    /// Whether a point lies on a surface that carries the map, where caustics are known.
    pub fn is_on_surface(&self, at: ProbePoint) -> bool {
        self.find_surface(at).is_some()
    }

    /// Whether some ray leaves the scene or meets a place that sees a known vertex of its element. (Elements
    /// may reach below things that stand on them.)
    fn sees_light(&self, from: &Gatherer) -> bool {
        let sequence = Sequence::new(place_key(from.surface.point).with(8));
        let axis = from.normal.to_direction();
        (0..LOOKS).any(|index| {
            let mut dice = Dice::new(sequence, index);
            let direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
            let mut is_known = false;
            let end = follow(
                self.scene,
                Ray::new(from.origin, direction),
                direction,
                &mut dice,
                |surface, _, _| {
                    is_known |= self.sees_vertex(surface, |_| true);
                },
            );
            is_known || end == PathEnd::Left
        })
    }

    /// The illuminance at a point on a surface as the bare map interpolates it, direct light included. The
    /// standard error is that of replicates alone.
    pub fn interpolated(&self, at: ProbePoint) -> Option<Illuminance> {
        let SurfacePoint { triangle, back, u, v, .. } = self.find_surface(at)?;
        self.map.interpolate(triangle, back, u, v)
    }

    /// The illuminance at any point that faces any way, on a surface or not. Direct light is evaluated, and
    /// indirect light is gathered over the map. Caustics are read from the map where the point is on a
    /// surface; in free space they are unknown and left out. The standard error counts the expected local
    /// part of the interpolation error and the bias of the map; it is infinite where these are unknown.
    pub fn estimate(&self, at: ProbePoint, settings: &ExactSettings) -> Illuminance {
        let on_surface = self.find_surface(at).map(|s| self.places.pulled_in(s));
        let gatherer = on_surface
            .map(|at| {
                let edge_m = nearby::edge_at_m(&self.map.elements, &at);
                let in_gap = nearby::is_closed_in(self.scene, &at, edge_m);
                Gatherer::on_surface(at, settings.rays).in_gap(in_gap)
            })
            .unwrap_or_else(|| {
                Gatherer::in_space(self.scene, at.position, at.normal, settings.rays)
            });
        let key = Key::new(settings.seed).with(4);
        let replicates = settings.replicates.max(2);
        let Gathered { lx: indirect_lx, variance, common_lx, .. } =
            self.gather(gatherer, DirectAtEnds::Evaluated, (replicates, key));
        // The lookup error is in proportion to the light read, but at least the local bias, since a dark
        // place may read bright ones.
        let part = self.part_of(&gatherer);
        let bias_lx = part * self.unseen.bias_lx;
        let looked_up = (self.lookup_error() * indirect_lx.luminance()).max(bias_lx);
        let stored = on_surface.and_then(|s| self.map.interpolate(s.triangle, s.back, s.u, s.v));
        let samples = u64::from(replicates) * u64::from(settings.rays);
        let variance = variance.max(stored.map_or(0.0, |stored| least_variance(&stored, samples)));
        let caustic_lx = stored.map_or(Rgb::BLACK, |stored| stored.caustic_lx);
        let of_caustics = stored.map_or(0.0, |stored| of_caustics(&stored));
        let doubt_lx = self.map.ambient_doubt_lx();
        let beside =
            [looked_up, of_caustics, common_lx, doubt_lx].map(|lx| lx * lx).iter().sum::<f64>();
        let indirect_variance = variance + beside;
        let about_lx = stored.map_or(0.0, |stored| stored.illuminance_lx());
        let direct = self.direct(&gatherer.surface, (about_lx, part));
        self.told(Illuminance {
            direct_lx: direct.lx + caustic_lx,
            caustic_lx,
            indirect_lx,
            standard_error_lx: (indirect_variance + direct.variance).sqrt(),
            indirect_standard_error_lx: indirect_variance.sqrt(),
            common_error_lx: common_lx,
            interpolation_error_lx: 0.0,
            bias_lx: looked_up,
            standing: Standing::Open,
            samples: u64::from(replicates) * u64::from(settings.rays),
        })
    }

    /// The error beyond noise of the map that gathering rays read, relative.
    fn lookup_error(&self) -> f64 {
        let accuracy = self.map.provenance.accuracy;
        accuracy.map_or(0.0, |a| (a.bias * a.bias + a.discretization * a.discretization).sqrt())
    }
}

/// The least variance of light gathered by `samples` rays where the map has a value with noise. Fewer rays
/// may all have missed the direction that most of the light comes from.
fn least_variance(stored: &Illuminance, samples: u64) -> f64 {
    let [all, caustics] = [stored.indirect_standard_error_lx, of_caustics(stored)];
    let of_map = (all * all - caustics * caustics).max(0.0);
    LEAST_OF_NOISE * of_map * stored.samples as f64 / samples.max(1) as f64
}

/// The error of caustics where only they are read from the map: at most the map's error of caustics and
/// indirect light together, and at most their own value.
fn of_caustics(stored: &Illuminance) -> f64 {
    stored.indirect_standard_error_lx.min(stored.caustic_lx.luminance().abs())
}
