//! What of a source's light reaches a receiver: along its chain of mirrors, through thin panes.

pub(super) mod shadows;

use super::lighting::{EXACT_SOURCES, Lighting};
use super::openings::View;
use super::sources;
use super::sources::{Arriving, Target};
use crate::engine::ray::{Dice, SurfacePoint, pane};
use crate::scene::Body;
use crate::units::Rgb;
use isolux_geometry::{Direction, Ray, Vector};
use shadows::Shadows;

/// Thin panes one behind the other that a shadow ray passes.
pub(crate) const MAX_PANES: usize = 64;

impl Lighting<'_> {
    /// Such an estimate, a share of it: what it needs to know of shadows is asked later, with what others do.
    pub(crate) fn estimate_later(
        &self,
        at: &SurfacePoint,
        share: Rgb,
        dice: &mut Dice,
        shadows: &mut Shadows,
    ) -> Rgb {
        if self.sources.len() > EXACT_SOURCES {
            return share * self.estimate(at, dice);
        }
        let mut sum = Rgb::BLACK;
        for source in &self.sources {
            if !source.chain.is_empty() || source.is_area() {
                sum += share * self.lit_by(source, at, 1, dice);
            } else if let Some(arriving) = sources::unoccluded_if(self.scene, source, at, |_| true)
            {
                let Arriving { target, illuminance_lx } = arriving;
                shadows.ask(segment(at, target), target, share * illuminance_lx);
            }
        }
        sum
    }

    /// The light that arrives of all that was asked for.
    pub(crate) fn answer(&self, shadows: &mut Shadows) -> Rgb {
        let free = shadows.free(self.scene.bvh());
        free.map(|(ray, target, light)| light * self.through_glass(ray, target)).sum()
    }

    /// The share of light, 0 to 1 a channel, that comes from `target` to a receiver: the image is
    /// looked at, its last mirror must be met first, and so back to the real luminaire. `emitter`
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

    /// The same where the chain is known to be in view. What comes by several chains, through an edge where mirrors meet, counts
    /// once: by the first.
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

    fn unreflected(&self, target: Target, plane: u32) -> Target {
        let mirror = &self.mirrors.planes[plane as usize];
        match target {
            Target::Point(p) => Target::Point(mirror.image(p)),
            Target::Infinity(d) => Target::Infinity(d.reflect(mirror.normal)),
        }
    }

    /// Looks towards an image: the first opaque thing must be the mirror. What panes before it
    /// leave, and the place on the mirror.
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

    /// The first opaque thing in a direction, and what panes before it leave.
    pub(crate) fn first_opaque(
        &self,
        from: &SurfacePoint,
        direction: Direction,
    ) -> Option<(Rgb, SurfacePoint)> {
        self.met(from, |from| from.leave(direction))
    }

    /// What comes of an emitter's light along a direction from a place: through thin panes, unless something else is met first.
    pub(crate) fn seen_along(&self, view: &View<'_>, direction: Direction) -> Rgb {
        // Without panes nothing more needs to be known of what is met.
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

    fn met(
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

    /// What the transparent surfaces on an otherwise free segment let straight through: panes their
    /// transmittance, solid glass nothing (its light is bent: particles bring it).
    fn through_glass(&self, mut ray: Ray, target: Target) -> Rgb {
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

    /// What a surface lets straight through, if it is a thin pane.
    pub(crate) fn pane_share(&self, surface: &SurfacePoint, ray: &Ray) -> Option<Rgb> {
        let Body::Dielectric(glass) = &self.scene.material(surface.triangle).body else {
            return None;
        };
        let direction = Vector::from(ray.direction).direction()?;
        glass.thin.then(|| pane(glass, direction.cos(surface.shading).abs()).transmittance)
    }
}

/// The segment that ends on the emitter, which must not stop it; a triangle that it starts on it leaves
/// by its offset.
fn last_segment(from: &SurfacePoint, target: Target, emitter: Option<u32>) -> Ray {
    let ray = segment(from, target);
    emitter.map_or(ray, |index| ray.skipping(index))
}

pub(crate) fn segment(from: &SurfacePoint, target: Target) -> Ray {
    match target {
        Target::Point(p) => Ray::between(from.start(), p).skipping(from.triangle),
        Target::Infinity(direction) => from.leave(direction),
    }
}
