//! Shadow rays of many places, traced together.

use super::super::sources::Target;
use crate::units::Rgb;
use isolux_geometry::{Bvh, Ray};

/// Light that arrives unless something stands between.
#[derive(Default)]
pub(crate) struct Shadows {
    rays: Vec<Ray>,
    are_hit: Vec<bool>,
    asked: Vec<(Target, Rgb)>,
}

impl Shadows {
    /// Light that comes along a ray from where it leads.
    pub(crate) fn ask(&mut self, ray: Ray, from: Target, light: Rgb) {
        self.rays.push(ray);
        self.asked.push((from, light));
    }

    /// All that nothing opaque stands before; none is left to ask for.
    pub(crate) fn free(&mut self, bvh: &Bvh) -> impl Iterator<Item = (Ray, Target, Rgb)> + '_ {
        let Self { rays, are_hit, asked } = self;
        are_hit.clear();
        are_hit.resize(rays.len(), false);
        bvh.any_hits(rays, are_hit);
        let all = rays.drain(..).zip(asked.drain(..)).zip(&*are_hit);
        all.filter(|(_, is_hit)| !**is_hit).map(|((ray, (from, light)), _)| (ray, from, light))
    }
}
