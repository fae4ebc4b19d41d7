//! Samples as plain values.

use super::hemisphere::Light;
use super::layer::Site;
use crate::engine::ray::mean_and_variance;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point};

/// The number of independent replicates of every sample.
pub const CACHE_REPLICATES: usize = 8;

/// The kind of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleKind {
    /// A sample that is read at places. Its rays read far samples.
    Near,
    /// A sample that rays read where they end. Its own rays read far samples, too, so its light includes all
    /// reflections.
    Far,
}

/// A sample of indirect irradiance.
#[derive(Clone, Debug, PartialEq)]
pub struct CacheSample {
    /// The kind of the sample.
    pub kind: SampleKind,
    /// The position, just above the surface, m.
    pub position: Point,
    /// The shading normal of the side.
    pub normal: Normal,
    /// The triangle of the scene that it lies on.
    pub triangle: u32,
    /// The harmonic mean of the distances to the surfaces it sees, within bounds, m.
    pub radius_m: f64,
    /// The distance to the nearest surface it sees, m; infinite where it sees nothing.
    pub nearest_m: f64,
    /// The indirect illuminance in independent replicates, lx.
    pub replicates_lx: [Rgb; CACHE_REPLICATES],
    /// The gradient of their mean along the axes of the world, lx/m.
    pub along: [Rgb; 3],
    /// The gradient of their mean when the normal turns about the axes of the world, lx/rad.
    pub turning: [Rgb; 3],
}

/// The samples of one scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IrradianceCache {
    /// All samples, in the order in which they were made.
    pub samples: Vec<CacheSample>,
}

/// The reason why samples do not belong to a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CacheError {
    /// A sample lies on a triangle that does not exist.
    #[error("sample {sample} lies on triangle {triangle}, but the scene has {triangles}")]
    Triangle {
        /// The number of the sample.
        sample: usize,
        /// The triangle of the sample.
        triangle: u32,
        /// The number of triangles in the scene.
        triangles: u32,
    },
    /// A value of a sample is impossible.
    #[error("the {what} of sample {sample} is not a possible one")]
    Value {
        /// The number of the sample.
        sample: usize,
        /// The name of the value.
        what: &'static str,
    },
}

impl IrradianceCache {
    /// Checks samples of any origin; an error if no run can have made them for this scene.
    pub fn check(&self, scene: &Scene) -> Result<(), CacheError> {
        let triangles = scene.triangle_count();
        for (number, sample) in self.samples.iter().enumerate() {
            if sample.triangle >= triangles {
                let triangle = sample.triangle;
                return Err(CacheError::Triangle { sample: number, triangle, triangles });
            }
            if let Some(what) = sample.impossible() {
                return Err(CacheError::Value { sample: number, what });
            }
        }
        Ok(())
    }

    /// The number of samples of a kind.
    pub fn count(&self, kind: SampleKind) -> usize {
        self.samples.iter().filter(|sample| sample.kind == kind).count()
    }
}

impl CacheSample {
    fn impossible(&self) -> Option<&'static str> {
        let finite = |values: &[Rgb]| values.iter().all(|v| v.is_finite());
        let checks = [
            ("position", self.position.is_finite()),
            ("radius", self.radius_m > 0.0 && self.radius_m.is_finite()),
            ("distance", self.nearest_m >= 0.0),
            ("illuminance", finite(&self.replicates_lx)),
            ("gradient", finite(&self.along) && finite(&self.turning)),
        ];
        checks.iter().find(|(_, is_possible)| !is_possible).map(|(what, _)| *what)
    }

    pub(super) fn site(&self) -> Site {
        let Self { position: origin, normal, triangle, radius_m, nearest_m, .. } = *self;
        Site { origin, normal, triangle, radius_m, nearest_m }
    }

    /// The light of a replicate, with the gradients of the mean.
    pub(super) fn light(&self, replicate: usize) -> Light {
        self.with_gradients(self.replicates_lx[replicate])
    }

    /// The mean light and the variance of its photometric value.
    pub(super) fn mean(&self) -> (Light, f64) {
        let (value, variance) = mean_and_variance(&self.replicates_lx);
        (self.with_gradients(value), variance)
    }

    fn with_gradients(&self, value: Rgb) -> Light {
        let ([ax, ay, az], [tx, ty, tz]) = (self.along, self.turning);
        Light([value, ax, ay, az, tx, ty, tz].map(|part| part.0))
    }
}

/// The sums of the replicates of a sample in progress.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    values: [Rgb; CACHE_REPLICATES],
    counts: [u32; CACHE_REPLICATES],
    along: [Rgb; 3],
    turning: [Rgb; 3],
}

impl Sum {
    /// Adds increment `index`. Increments beyond [`CACHE_REPLICATES`] are spread over the replicates.
    pub(super) fn add(&mut self, index: u64, light: &Light) {
        let replicate = (index % CACHE_REPLICATES as u64) as usize;
        let [value, gradients @ ..] = light.0.map(Rgb);
        self.values[replicate] += value;
        self.counts[replicate] += 1;
        for k in 0..3 {
            self.along[k] += gradients[k];
            self.turning[k] += gradients[3 + k];
        }
    }

    /// The sample; `None` until every replicate has a value.
    pub(super) fn sample(&self, kind: SampleKind, site: &Site) -> Option<CacheSample> {
        if self.counts.contains(&0) {
            return None;
        }
        let count = f64::from(self.counts.iter().sum::<u32>());
        let mut replicates_lx = self.values;
        for (value, &count) in replicates_lx.iter_mut().zip(&self.counts) {
            *value = *value / f64::from(count);
        }
        let Site { origin, normal, triangle, radius_m, nearest_m } = *site;
        Some(CacheSample {
            kind,
            position: origin,
            normal,
            triangle,
            radius_m,
            nearest_m,
            replicates_lx,
            along: self.along.map(|g| g / count),
            turning: self.turning.map(|g| g / count),
        })
    }
}
