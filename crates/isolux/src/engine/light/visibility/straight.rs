//! Straight transmission of light, through free space and thin panes.

use super::super::lighting::Lighting;
use super::super::sources::Target;
use crate::engine::ray::SurfacePoint;
use crate::scene::Body;
use crate::units::Rgb;
use isolux_geometry::{Direction, Ray, Vector};

/// The most thin panes in a row that a shadow ray passes.
pub(crate) const MAX_PANES: usize = 64;

impl Lighting<'_> {
    /// The first opaque surface in a direction, and the transmittance of the panes before it.
    pub(crate) fn first_opaque(
        &self,
        from: &SurfacePoint,
        direction: Direction,
    ) -> Option<(Rgb, SurfacePoint)> {
        self.met(from, |from| from.leave(direction))
    }

    pub(crate) fn met(
        &self,
        from: &SurfacePoint,
        onwards: impl Fn(&SurfacePoint) -> Ray,
    ) -> Option<(Rgb, SurfacePoint)> {
        let mut ray = onwards(from);
        let mut share = Rgb::WHITE;
        for _ in 0..MAX_PANES {
            let hit = self.scene.bvh().closest_hit(&ray)?;
            let surface = SurfacePoint::from_hit(self.scene, &hit);
            match self.pane_share(&surface, &ray) {
                Some(passed) => {
                    share = share * passed;
                    ray = onwards(&surface.other_side());
                }
                None => return Some((share, surface)),
            }
        }
        None
    }

    /// The straight transmittance of the transparent surfaces on an otherwise free segment. Solid
    /// glass transmits nothing straight: particles carry its refracted light.
    pub(crate) fn through_glass(&self, mut ray: Ray, target: Target) -> Rgb {
        let mut share = Rgb::WHITE;
        for _ in 0..MAX_PANES {
            let Some(hit) = self.panes.closest_hit(&ray) else { return share };
            let surface = SurfacePoint::from_hit(self.scene, &hit);
            let Some(passed) = self.pane_share(&surface, &ray) else { return Rgb::BLACK };
            share = share * passed;
            ray = segment(&surface.other_side(), target);
        }
        Rgb::BLACK
    }

    /// The transmittance of a surface, if it is a thin pane.
    pub(crate) fn pane_share(&self, surface: &SurfacePoint, ray: &Ray) -> Option<Rgb> {
        let Body::Dielectric(glass) = &self.scene.material(surface.triangle).body else {
            return None;
        };
        let direction = Vector::from(ray.direction).direction()?;
        glass.thin.then(|| glass.pane(direction.cos(surface.shading).abs()).transmittance)
    }
}

/// The segment to an emitter, which must not block it. The offset at the start takes it off a
/// triangle that it starts on.
pub(crate) fn last_segment(from: &SurfacePoint, target: Target, emitter: Option<u32>) -> Ray {
    let ray = segment(from, target);
    emitter.map_or(ray, |index| ray.skipping(index))
}

pub(crate) fn segment(from: &SurfacePoint, target: Target) -> Ray {
    match target {
        Target::Point(p) => Ray::between(from.start(), p).skipping(from.triangle),
        Target::Infinity(direction) => from.leave(direction),
    }
}
