//! Reading a map: direct light afresh, the rest interpolated; or all of it afresh.

use super::direct::Lighting;
use super::gather::{DirectAtEnds, Gatherer, Gathering};
use super::path::Dice;
use super::place::{Places, ProbePoint, place_key};
use super::surface::SurfacePoint;
use crate::map::{Illuminance, IlluminationMap};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;

/// Independent estimates of the direct light of emitting surfaces, for its standard error.
const DIRECT_REPLICATES: u64 = 8;

/// Shadow rays to every emitting surface in a reading for a picture.
const GLANCE_SAMPLES: usize = 4;

/// How hard [`MapReader::estimate`] tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExactSettings {
    /// Gathering rays of one replicate.
    pub rays: u32,
    /// Independent replicates, at least two.
    pub replicates: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for ExactSettings {
    fn default() -> Self {
        Self { rays: 1024, replicates: 16, seed: 1 }
    }
}

/// Reads a map with its scene at hand.
pub struct MapReader<'a> {
    scene: &'a Scene,
    map: &'a IlluminationMap,
    lighting: Lighting<'a>,
    known: Vec<bool>,
    light: Vec<Rgb>,
    places: Places<'a>,
    /// Error of what is read from vertices that replicates do not tell, lx.
    unseen_lx: f64,
}

impl<'a> MapReader<'a> {
    /// Prepares the luminaires of the scene.
    pub fn new(scene: &'a Scene, map: &'a IlluminationMap) -> Self {
        let reflected =
            |v: &Option<Illuminance>| v.map_or(Rgb::BLACK, |v| v.indirect_lx + v.caustic_lx);
        Self {
            scene,
            map,
            lighting: Lighting::new(scene),
            known: map.values.iter().map(Option::is_some).collect(),
            light: map.values.iter().map(reflected).collect(),
            places: Places::of(scene),
            unseen_lx: unseen_lx(map),
        }
    }

    /// A reading of [`MapReader::at`] or [`MapReader::probe`] with the standard errors of replicates
    /// alone, without the interpolation error and the bias of the map.
    pub fn by_replicates(&self, reading: Illuminance) -> Illuminance {
        let unseen = self.unseen_lx * self.unseen_lx;
        let less = |error: f64| (error * error - unseen).max(0.0).sqrt();
        Illuminance {
            standard_error_lx: less(reading.standard_error_lx),
            indirect_standard_error_lx: less(reading.indirect_standard_error_lx),
            ..reading
        }
    }

    /// The illuminance at barycentric weights `(1 - u - v, u, v)` of a side of a triangle: direct
    /// light evaluated afresh there, indirect light and caustics interpolated. The standard error
    /// counts, beside that of replicates, the interpolation error and the bias that the map
    /// reports for the scene, the same everywhere. `None` where the map knows nothing.
    pub fn at(&self, triangle: u32, back: bool, u: f64, v: f64) -> Option<Illuminance> {
        let stored = self.map.interpolate(triangle, back, u, v)?;
        let surface = SurfacePoint::new(self.scene, triangle, back, u, v);
        Some(self.with_fresh_direct(stored, &self.places.pulled_in(surface)))
    }

    /// The same by a few shadow rays for every emitting surface, for pictures, which take a mean over
    /// many places anyway: noisy, and the standard error leaves that noise out. `number` tells
    /// readings of one place apart.
    pub fn glance(
        &self,
        triangle: u32,
        back: bool,
        u: f64,
        v: f64,
        number: u64,
    ) -> Option<Illuminance> {
        let stored = self.map.interpolate(triangle, back, u, v)?;
        let at = self.places.pulled_in(SurfacePoint::new(self.scene, triangle, back, u, v));
        let sequence = Sequence::new(place_key(at.point).with(number));
        let direct = self.lighting.sampled(&at, GLANCE_SAMPLES, &mut Dice::new(sequence, 0));
        Some(Illuminance {
            direct_lx: direct + stored.caustic_lx,
            standard_error_lx: stored.indirect_standard_error_lx,
            ..stored
        })
    }

    /// As [`MapReader::at`] at a point on a surface, on the side that `normal` points to. `None` where no
    /// surface that carries a known value lies within a ten-thousandth of the scene's extent.
    pub fn probe(&self, at: ProbePoint) -> Option<Illuminance> {
        let surface = self.find_surface(at)?;
        let SurfacePoint { triangle, back, u, v, .. } = surface;
        let stored = self.map.interpolate(triangle, back, u, v)?;
        Some(self.with_fresh_direct(stored, &self.places.pulled_in(surface)))
    }

    /// The same of the bare map, direct light interpolated, too. The standard error is that of
    /// replicates alone.
    pub fn interpolated(&self, at: ProbePoint) -> Option<Illuminance> {
        let SurfacePoint { triangle, back, u, v, .. } = self.find_surface(at)?;
        self.map.interpolate(triangle, back, u, v)
    }

    /// The illuminance at any point that faces any way, on a surface or not: direct light afresh,
    /// indirect light by gathering over the map. Caustics are read from the map where the point is
    /// on a surface; in free space they are unknown and left out. The standard error counts the
    /// interpolation error and the bias of the map as if they were the same everywhere.
    pub fn estimate(&self, at: ProbePoint, settings: &ExactSettings) -> Illuminance {
        let on_surface = self.find_surface(at).map(|s| self.places.pulled_in(s));
        let gatherer = on_surface
            .map(|surface| Gatherer::on_surface(surface, settings.rays))
            .unwrap_or_else(|| Gatherer::in_space(at.position, at.normal, settings.rays));
        let gathering = Gathering {
            scene: self.scene,
            lighting: &self.lighting,
            elements: &self.map.elements,
            level: u32::MAX,
            known: &self.known,
            direct: DirectAtEnds::Evaluated,
        };
        let key = Key::new(settings.seed).with(4);
        let replicates = settings.replicates.max(2);
        let rows = vec![gatherer; replicates as usize];
        let values = gathering.operator(&rows, |k| key.with(k as u64)).apply(&self.light);
        let (indirect_lx, variance) = mean_and_variance(&values);
        let looked_up = self.lookup_error() * indirect_lx.luminance();
        let indirect_variance = variance + looked_up * looked_up;
        let caustic_lx = on_surface
            .and_then(|s| self.map.interpolate(s.triangle, s.back, s.u, s.v))
            .map_or(Rgb::BLACK, |stored| stored.caustic_lx);
        let (direct, direct_variance) = self.direct(&gatherer.surface);
        Illuminance {
            direct_lx: direct + caustic_lx,
            caustic_lx,
            indirect_lx,
            standard_error_lx: (indirect_variance + direct_variance).sqrt(),
            indirect_standard_error_lx: indirect_variance.sqrt(),
            samples: u64::from(replicates) * u64::from(settings.rays),
        }
    }

    /// The surface at a point that carries the map.
    fn find_surface(&self, at: ProbePoint) -> Option<SurfacePoint> {
        self.places.surface_at(at, |surface| {
            let SurfacePoint { triangle, back, u, v, .. } = *surface;
            self.map.elements.locate(triangle, back, u, v).is_some()
        })
    }

    /// What the map that gathering rays read may be off by, other than by noise, relative.
    fn lookup_error(&self) -> f64 {
        let accuracy = self.map.provenance.accuracy;
        accuracy.map_or(0.0, |a| (a.bias * a.bias + a.discretization * a.discretization).sqrt())
    }

    fn with_fresh_direct(&self, stored: Illuminance, at: &SurfacePoint) -> Illuminance {
        let (direct, variance) = self.direct(at);
        let indirect = libm::hypot(stored.indirect_standard_error_lx, self.unseen_lx);
        Illuminance {
            direct_lx: direct + stored.caustic_lx,
            standard_error_lx: (indirect * indirect + variance).sqrt(),
            indirect_standard_error_lx: indirect,
            ..stored
        }
    }

    /// Direct light at a place and the variance of its mean.
    fn direct(&self, at: &SurfacePoint) -> (Rgb, f64) {
        let key = place_key(at.point);
        let one = |replicate| {
            self.lighting.illuminance(at, &mut Dice::new(Sequence::new(key.with(replicate)), 0))
        };
        if self.lighting.is_exact() {
            return (one(0), 0.0);
        }
        let values: Vec<Rgb> = (0..DIRECT_REPLICATES).map(one).collect();
        mean_and_variance(&values)
    }
}

/// Discretization and bias as reported: a share of the root mean square of the light, evenly. (In
/// proportion to the indirect light fewer intervals hold the truth: dark edges err most.)
fn unseen_lx(map: &IlluminationMap) -> f64 {
    let Some(accuracy) = map.provenance.accuracy else { return 0.0 };
    let (mut area_m2, mut squared) = (0.0, 0.0);
    for (vertex, value) in map.elements.vertices().iter().zip(&map.values) {
        let Some(value) = value else { continue };
        let lx = value.illuminance_lx();
        area_m2 += vertex.area_m2;
        squared += vertex.area_m2 * lx * lx;
    }
    let share = libm::hypot(accuracy.discretization, accuracy.bias);
    if area_m2 > 0.0 { share * (squared / area_m2).sqrt() } else { 0.0 }
}

/// Mean of independent values and variance of their photometric mean.
pub(super) fn mean_and_variance(values: &[Rgb]) -> (Rgb, f64) {
    let n = values.len() as f64;
    let mean = values.iter().copied().sum::<Rgb>() / n;
    let squares: f64 = values.iter().map(|v| (*v - mean).luminance()).map(|d| d * d).sum();
    (mean, squares / (n * (n - 1.0)))
}
