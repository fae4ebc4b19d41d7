//! Whether an image is seen in its mirrors.

use super::super::lighting::Lighting;
use super::super::sources::Target;
use crate::engine::ray::SurfacePoint;

impl Lighting<'_> {
    /// Whether the way to an image goes through its mirrors, obstacles left out: without rays, and
    /// soon, as most of a room does not see itself in a mirror.
    pub(crate) fn chain_is_in_view(
        &self,
        chain: &[u32],
        at: &SurfacePoint,
        mut target: Target,
    ) -> bool {
        let mut from = at.point;
        for &plane in chain.iter().rev() {
            let mirror = &self.mirrors.planes[plane as usize];
            let towards = target.towards(from);
            let Some(crossing) = mirror.crossing(from, towards, self.mirrors.tolerance_m) else {
                return false;
            };
            from = crossing;
            target = self.unreflected(target, plane);
        }
        true
    }

    pub(crate) fn unreflected(&self, target: Target, plane: u32) -> Target {
        let mirror = &self.mirrors.planes[plane as usize];
        match target {
            Target::Point(p) => Target::Point(mirror.image(p)),
            Target::Infinity(d) => Target::Infinity(d.reflect(mirror.normal)),
        }
    }
}
