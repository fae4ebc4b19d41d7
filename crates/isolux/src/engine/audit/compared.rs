//! The comparison of a reading with paths at one place.

use super::places::{Drawn, Where};
use crate::engine::method::{PathTracer, Traced};
use crate::engine::ray::SurfacePoint;
use crate::engine::read::MapReader;
use crate::map::{Illuminance, IlluminationMap};
use crate::sampling::Key;

/// The half-width of a 95 % interval, in standard errors.
const IN_95_OF_100: f64 = 1.96;

/// The reading and the paths at a place, photometric.
pub(super) struct Compared {
    pub(super) at: SurfacePoint,
    pub(super) drawn: Where,
    pub(super) read_lx: f64,
    /// The standard error that the reading reports, lx.
    pub(super) standard_error_lx: f64,
    pub(super) traced_lx: f64,
    pub(super) traced_variance: f64,
    /// The unbiased estimate of the squared error of the reading, lx2; it may be negative.
    pub(super) squared_lx2: f64,
    /// The unbiased estimate of the squared error of the bare map, lx2.
    pub(super) interpolated_lx2: f64,
    /// The brightest paths, as multiples of the mean of the place.
    pub(super) brightest: Vec<f64>,
}

/// The outcome of comparing a map with paths at a place.
pub(super) struct Comparison {
    /// `None` where the map knows nothing.
    pub(super) compared: Option<Compared>,
    /// Whether the place was drawn by area.
    pub(super) by_area: bool,
    /// The number of rays of the paths and of direct light in the reading.
    pub(super) rays: u64,
}

impl Compared {
    /// The reading less the mean of the paths, lx.
    pub(super) const fn apart_lx(&self) -> f64 {
        self.read_lx - self.traced_lx
    }

    /// The difference in standard errors of both together.
    pub(super) fn in_errors(&self) -> f64 {
        let error = libm::hypot(self.standard_error_lx, self.traced_variance.sqrt());
        let apart = self.apart_lx();
        if apart == 0.0 { 0.0 } else { apart / error }
    }

    /// Whether the difference lies outside the 95 % interval.
    pub(super) fn is_outside(&self) -> bool {
        self.in_errors().abs() > IN_95_OF_100
    }
}

/// Compares a map with paths at a place, in `replicates` replicates of `paths / replicates` paths.
pub(super) fn compare(
    map: &IlluminationMap,
    (reader, tracer): (&MapReader, &PathTracer),
    place: &Drawn,
    (replicates, paths): (u32, u32),
    key: Key,
) -> Comparison {
    let by_area = place.drawn == Where::ByArea;
    let SurfacePoint { triangle, back, u, v, .. } = place.at;
    let Some(read) = reader.at(triangle, back, u, v) else {
        return Comparison { compared: None, by_area, rays: 0 };
    };
    let traced = tracer.traced(&place.at, (replicates, paths.div_ceil(replicates)), key.with(3));
    // Readings evaluate luminaires, in several replicates where luminaires are sampled.
    let rays = traced.rays + tracer.rays_of_reading();
    // Light that paths leave out is subtracted from the readings.
    let left_out = |of: &Illuminance| match tracer.leaves_caustics() {
        true => of.caustic_lx.luminance(),
        false => 0.0,
    };
    let read_lx = read.illuminance_lx() - left_out(&read);
    let bare = map.interpolate(triangle, back, u, v);
    let bare_lx = bare.map_or(read_lx, |bare| bare.illuminance_lx() - left_out(&bare));
    let compared = compared(place, (read_lx, read.standard_error_lx), bare_lx, &traced);
    Comparison { compared: Some(compared), by_area, rays }
}

fn compared(
    place: &Drawn,
    (read_lx, standard_error_lx): (f64, f64),
    bare_lx: f64,
    traced: &Traced,
) -> Compared {
    let values: Vec<f64> = traced.replicates.iter().map(|[a, b]| (*a + *b).luminance()).collect();
    let n = values.len() as f64;
    let traced_lx = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - traced_lx) * (v - traced_lx)).sum();
    let traced_variance = squares / (n * (n - 1.0));
    // This is the mean product of the differences of two replicates.
    let squared = |lx: f64| (lx - traced_lx) * (lx - traced_lx) - traced_variance;
    let brightest = match traced_lx > 0.0 {
        true => traced.brightest.iter().map(|lx| lx / traced_lx).collect(),
        false => Vec::new(),
    };
    Compared {
        at: place.at,
        drawn: place.drawn,
        read_lx,
        standard_error_lx,
        traced_lx,
        traced_variance,
        squared_lx2: squared(read_lx),
        interpolated_lx2: squared(bare_lx),
        brightest,
    }
}
