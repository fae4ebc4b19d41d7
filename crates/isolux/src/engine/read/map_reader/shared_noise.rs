//! The error that readings nearby have in common: the noise of the surfaces that they read.

use crate::engine::gather::Operator;
use crate::engine::ray::SurfacePoint;
use crate::map::IlluminationMap;
use crate::units::Rgb;
use std::sync::OnceLock;

/// The common error at every vertex, lx, and the value one at every known vertex; computed when first used.
#[derive(Default)]
pub(super) struct SharedNoise(OnceLock<[Vec<Rgb>; 2]>);

impl SharedNoise {
    fn of_vertices(&self, map: &IlluminationMap) -> &[Vec<Rgb>; 2] {
        self.0.get_or_init(|| {
            let known = |of: fn(f64) -> f64| {
                let of = move |common_lx| Rgb::grey(of(common_lx));
                map.values.iter().map(move |v| v.map_or(Rgb::BLACK, |v| of(v.common_error_lx)))
            };
            [known(|lx| lx).collect(), known(|_| 1.0).collect()]
        })
    }

    /// The error that light gathered at a place has in common with light gathered nearby, lx: that of the
    /// vertices about it, or in space that of the surfaces seen.
    pub(super) fn lx(&self, map: &IlluminationMap, at: &SurfacePoint, operator: &Operator) -> f64 {
        let on_surface = at.triangle != u32::MAX;
        let stored = on_surface.then(|| map.interpolate(at.triangle, at.back, at.u, at.v));
        if let Some(stored) = stored.flatten() {
            return stored.common_error_lx;
        }
        let sum = |values: &[Rgb]| operator.reflected(values).into_iter().sum::<Rgb>().luminance();
        let [shared, whole] = self.of_vertices(map).each_ref().map(|of| sum(of));
        if whole > 0.0 { shared / whole } else { 0.0 }
    }
}
