//! Shadow rays of many places, traced together.

use super::super::sources::Target;
use crate::units::Rgb;
use isolux_geometry::{Bvh, Ray};

/// A shadow ray that no opaque surface blocks.
pub(crate) struct FreeRay {
    pub(crate) ray: Ray,
    /// The source that it reaches.
    pub(crate) target: Target,
    /// The light that comes along it if it passes no pane.
    pub(crate) light: Rgb,
}

/// A batch of shadow rays, each with the light that arrives if nothing blocks it.
#[derive(Default)]
pub(crate) struct Shadows {
    rays: Vec<Ray>,
    are_hit: Vec<bool>,
    asked: Vec<(Target, Rgb)>,
}

impl Shadows {
    /// Adds a shadow ray towards `from`, and the light that comes along it.
    pub(crate) fn ask(&mut self, ray: Ray, from: Target, light: Rgb) {
        self.rays.push(ray);
        self.asked.push((from, light));
    }

    /// The rays that no opaque surface blocks; the batch is then empty.
    pub(crate) fn free(&mut self, bvh: &Bvh) -> impl Iterator<Item = FreeRay> + '_ {
        let Self { rays, are_hit, asked } = self;
        are_hit.clear();
        are_hit.resize(rays.len(), false);
        bvh.any_hits(rays, are_hit);
        let all = rays.drain(..).zip(asked.drain(..)).zip(&*are_hit);
        let free = all.filter(|(_, is_hit)| !**is_hit);
        free.map(|((ray, (target, light)), _)| FreeRay { ray, target, light })
    }
}
