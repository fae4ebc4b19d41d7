//! How fine the map is made that is shown.

use crate::caller;
use isolux::engine::{Finer, FinerSettings};
use isolux::geometry::Point;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use std::time::{Duration, Instant};

/// Pixels across a picture that shows all of a scene: shorter edges would be seen from nearby alone.
const PIXELS: f64 = 2000.0;
/// Vertices that any browser draws.
const MOST_VERTICES: usize = 1_000_000;

/// How fine a scene is shown.
pub(crate) fn fineness(scene: &Scene) -> FinerSettings {
    let (low, high) = scene.bvh().mesh().bounds().unwrap_or((Point::ORIGIN, Point::ORIGIN));
    FinerSettings { least_edge_m: (high - low).length() / PIXELS, most_vertices: MOST_VERTICES }
}

/// A map with finer shadows, as fine as it becomes in a time.
pub(crate) fn finer(scene: &Scene, map: &IlluminationMap, limit: Duration) -> IlluminationMap {
    let started = Instant::now();
    let mut finer = Finer::new(scene, map);
    finer.refine(&fineness(scene), &mut || {
        caller::look();
        started.elapsed() < limit
    });
    finer.map()
}
