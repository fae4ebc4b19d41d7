//! Visibility of a source from a receiver: along its chain of mirrors and through thin panes.

pub(super) mod shadows;
pub(super) mod straight;

use self::straight::last_segment;
use self::straight::segment;
use super::lighting::Lighting;
use super::mirrors::chains::Chain;
use super::openings::{Beyond, View};
use super::sources::Target;
use crate::engine::ray::SurfacePoint;
use crate::units::Rgb;
use isolux_geometry::{Direction, Point};

impl Lighting<'_> {
    /// The share of light, 0 to 1 a channel, that comes from `target` to a receiver. A ray towards
    /// the image must meet the last mirror first, and so on back to the real luminaire. `emitter`
    /// is the emitting triangle, which does not shade itself.
    pub(crate) fn visibility(
        &self,
        chain: &[u32],
        at: &SurfacePoint,
        target: Target,
        emitter: Option<u32>,
    ) -> Rgb {
        if !self.chain_is_in_view(chain, at, target) {
            return Rgb::BLACK;
        }
        self.visibility_in_view(chain, at, target, emitter)
    }

    /// [`Lighting::visibility`] for a chain that is known to be in view. Light that comes by
    /// several chains, through an edge where mirrors meet, counts once: by the first.
    pub(crate) fn visibility_in_view(
        &self,
        chain: &[u32],
        at: &SurfacePoint,
        target: Target,
        emitter: Option<u32>,
    ) -> Rgb {
        if chain.is_empty() {
            return self.share_by(chain, at, target, emitter).unwrap_or(Rgb::BLACK);
        }
        let share = |chain: &[u32]| self.share_by(chain, at, target, emitter);
        let is_open = |twin: &Vec<u32>| {
            self.chain_is_in_view(twin, at, target) && share(twin).is_some_and(|s| !s.is_black())
        };
        let counts =
            |share: &Rgb| share.is_black() || !self.twins.before(chain).iter().any(is_open);
        share(chain).filter(counts).unwrap_or(Rgb::BLACK)
    }

    fn share_by(
        &self,
        chain: &[u32],
        at: &SurfacePoint,
        mut target: Target,
        emitter: Option<u32>,
    ) -> Option<Rgb> {
        let (mut from, mut reflected) = (*at, false);
        let mut share = Rgb::WHITE;
        for &plane in chain.iter().rev() {
            let met = self.meet_mirror(&from, target, plane);
            let (passed, on_mirror) =
                met.or_else(|| self.meet_at_edge((&from, reflected), target, (chain, plane)))?;
            share = share * passed;
            (from, reflected) = (on_mirror, true);
            target = self.unreflected(target, plane);
        }
        let ray = last_segment(&from, target, emitter);
        if !self.scene.bvh().any_hit(&ray) {
            return Some(share * self.through_glass(ray, target));
        }
        let passed = reflected.then(|| self.leave_edge(&from, (target, emitter), chain))??;
        Some(share * passed)
    }

    /// The transmittance of the panes before a mirror and the place on it, on the way to an image.
    /// `None` if another opaque surface comes first.
    fn meet_mirror(
        &self,
        from: &SurfacePoint,
        target: Target,
        plane: u32,
    ) -> Option<(Rgb, SurfacePoint)> {
        let (share, surface) = self.met(from, |from| segment(from, target))?;
        let is_it = self.mirrors.of(surface.triangle, surface.back) == Some(plane);
        is_it.then_some((share, surface))
    }

    /// The share of an emitter's light that arrives along a direction, through thin panes; zero if
    /// another surface comes first, or where a sky is dark.
    pub(crate) fn seen_along(&self, view: &View<'_>, direction: Direction) -> Rgb {
        if let Beyond::Sky(sky) = &view.before.beyond {
            let shines = !sky.luminance_cd_m2(direction).is_black();
            let target = Target::Infinity(direction);
            let share = || self.visibility(&[], &view.at, target, None);
            return if shines { share() } else { Rgb::BLACK };
        }
        // Without panes the triangle and side of the hit are enough.
        let met = if self.panes.exist() {
            let met = self.first_opaque(&view.at, direction);
            met.map(|(share, surface)| (share, surface.triangle, surface.back))
        } else {
            let hit = self.scene.bvh().closest_hit(&view.at.leave(direction));
            hit.map(|hit| (Rgb::WHITE, hit.triangle, hit.back))
        };
        let emits = |&(_, triangle, back): &(Rgb, u32, bool)| view.before.emits(triangle, back);
        met.filter(emits).map_or(Rgb::BLACK, |(share, ..)| share)
    }

    /// The share of light that comes to a receiver from a place on a triangle by a chain.
    pub(crate) fn share_from(
        &self,
        chain: &Chain,
        at: &SurfacePoint,
        place: Point,
        triangle: u32,
    ) -> Rgb {
        let image = |place: Point, &plane: &u32| self.mirrors.planes[plane as usize].image(place);
        let target = Target::Point(chain.planes.iter().fold(place, image));
        self.visibility(&chain.planes, at, target, Some(triangle))
    }
}
