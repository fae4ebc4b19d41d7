//! The error that readings nearby have in common: the noise of the surfaces that they read.

use crate::engine::gather::Operator;
use crate::engine::ray::SurfacePoint;
use crate::map::IlluminationMap;
use crate::units::Rgb;
use std::sync::OnceLock;

/// What readings have in common.
pub(super) struct SharedNoise {
    /// The common error at every vertex, lx, and the value one at every known vertex; computed when first used.
    of_map: OnceLock<[Vec<Rgb>; 2]>,
    /// What the squared weight of a vertex adds to the variance by the noise of direct light there; none where that has no noise.
    of_direct_lx2: Vec<f64>,
}

impl SharedNoise {
    /// With the noise of direct light as rays read it.
    pub(super) const fn of(of_direct_lx2: Vec<f64>) -> Self {
        Self { of_map: OnceLock::new(), of_direct_lx2 }
    }

    fn of_vertices(&self, map: &IlluminationMap) -> &[Vec<Rgb>; 2] {
        self.of_map.get_or_init(|| {
            let known = |of: fn(f64) -> f64| {
                let of = move |common_lx| Rgb::grey(of(common_lx));
                map.values.iter().map(move |v| v.map_or(Rgb::BLACK, |v| of(v.common_error_lx)))
            };
            [known(|lx| lx).collect(), known(|_| 1.0).collect()]
        })
    }

    /// The error that light gathered at a place has in common with light gathered nearby, lx.
    pub(super) fn lx(&self, map: &IlluminationMap, at: &SurfacePoint, operator: &Operator) -> f64 {
        libm::hypot(self.of_map_lx(map, at, operator), self.of_direct_lx(operator))
    }

    /// The noise of direct light that rays have read.
    fn of_direct_lx(&self, operator: &Operator) -> f64 {
        let weights = match self.of_direct_lx2.len() {
            0 => return 0.0,
            vertices => operator.weights(vertices),
        };
        let all = weights.iter().zip(&self.of_direct_lx2);
        all.map(|(weight, lx2)| weight * weight * lx2).sum::<f64>().sqrt()
    }

    /// The error of the vertices about a place, or in space that of the surfaces seen.
    fn of_map_lx(&self, map: &IlluminationMap, at: &SurfacePoint, operator: &Operator) -> f64 {
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
