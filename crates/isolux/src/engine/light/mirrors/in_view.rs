//! Visibility of an image in its mirrors, without obstacles.

use super::super::lighting::Lighting;
use super::super::sources::Target;
use crate::engine::ray::SurfacePoint;

impl Lighting<'_> {
    /// Whether the path to an image passes through its mirrors, without obstacles. The test is fast
    /// and takes no rays, since most of a room is out of view in a mirror.
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
