//! Paths exactly through the edge or the corner where mirrors meet.
//!
//! Two mirrors at right angles form the same image in either order. In general, chains whose reflections combine to
//! the same motion form the same image: they are twins. A straight path to that image passes the mirrors in one order,
//! and so belongs to one twin, unless it passes through the edge where they meet. Then it belongs to all twins, and
//! rounding would decide which of them are open: none, one, or all. Here all of them are open, and the first counts:
//!
//! - Mirrors of the chain that a place of reflection lies on, within rounding, do not hide it. A mirror is met where it
//!   reaches to within rounding of the place. Any other surface blocks the path, as does a mirror just above a floor that
//!   the path meets from below.
//! - A chain counts if none of its twins before it is open.
//!
//! The images of a luminaire are found breadth first, so a chain in the list comes with all its twins before it.

use super::super::lighting::Lighting;
use super::super::mirrors::twins::Twins;
use super::super::sources::Target;
use super::super::visibility::straight::{MAX_PANES, segment};
use super::planar::Plane;
use crate::ablation::without;
use crate::engine::ray::SurfacePoint;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point, Ray, Vector};
use std::f64::consts::FRAC_PI_4;

/// Distance up to which a surface counts as at a place of reflection, in bounds of rounding: those
/// of the place, of the start of the ray, of its direction and of the plane.
const REFLECTION_ROUNDINGS: f64 = 4.0;

/// Cosine from which on a surface lies along a mirror and hides all of it, however near. For a
/// surface with this inclination, the strip that is ignored is some hundred roundings wide at most.
const ALONG_MIRROR_COS: f64 = 1.0 - 1e-4;

/// A reflection of a path.
#[derive(Clone, Copy)]
struct Reflection<'c> {
    point: Point,
    /// The normal of the mirror.
    normal: Normal,
    /// The chain of mirrors of the path.
    chain: &'c [u32],
}

impl Lighting<'_> {
    /// The twins among the chains that form images.
    pub(crate) fn find_twins(&self) -> Twins {
        let Some((low, high)) = self.scene.bvh().mesh().bounds() else { return Twins::default() };
        let of_sources = self.sources.iter().map(|source| source.chain.clone());
        let of_surfaces = self.chains().0.into_iter().map(|chain| chain.planes);
        Twins::of(&self.mirrors, [low, high], of_sources.chain(of_surfaces).collect())
    }

    /// The place where a path to an image meets a mirror, if rounding hides the place, and the
    /// transmittance of the panes before it. `reflected` tells whether the path starts on a mirror.
    #[cold]
    pub(crate) fn meet_at_edge(
        &self,
        (from, reflected): (&SurfacePoint, bool),
        target: Target,
        (chain, plane): (&[u32], u32),
    ) -> Option<(Rgb, SurfacePoint)> {
        if without("mirror-seams") {
            return None;
        }
        let mirror = &self.mirrors.planes[plane as usize];
        // Offsets of starts from mirrors would add up from one mirror to the next.
        let start = if reflected { from.point } else { from.start() };
        let crossing = mirror.crossing(start, target.towards(start), self.mirrors.tolerance_m)?;
        let ends = [
            Some(Reflection { point: crossing, normal: mirror.normal, chain }),
            reflected.then_some(Reflection { point: from.point, normal: from.geometric, chain }),
        ];
        let share = self.passed(from, (Target::Point(crossing), None), ends)?;
        Some((share, self.mirror_near(mirror, plane, crossing)?))
    }

    /// The transmittance of the panes on the straight path from a place on a mirror to the source.
    /// `None` if a surface blocks it that the place does not lie on.
    #[cold]
    pub(crate) fn leave_edge(
        &self,
        from: &SurfacePoint,
        towards: (Target, Option<u32>),
        chain: &[u32],
    ) -> Option<Rgb> {
        let end = Reflection { point: from.point, normal: from.geometric, chain };
        self.passed(from, towards, [Some(end), None])
    }

    /// The transmittance of the panes on a path. The path may cross mirrors of its chain that one of its
    /// `ends` lies on, if they are inclined to the mirror there; any other opaque surface blocks it.
    fn passed(
        &self,
        from: &SurfacePoint,
        (target, emitter): (Target, Option<u32>),
        ends: [Option<Reflection<'_>>; 2],
    ) -> Option<Rgb> {
        let bvh = self.scene.bvh();
        let mut ray = segment(from, target);
        let mut share = Rgb::WHITE;
        for _ in 0..MAX_PANES {
            let Some(hit) = bvh.closest_hit(&ray).filter(|hit| Some(hit.triangle) != emitter)
            else {
                return Some(share);
            };
            let surface = SurfacePoint::from_hit(self.scene, &hit);
            let plane_of = |back: bool| self.mirrors.of(surface.triangle, back);
            let lies_on = |end: Reflection<'_>| {
                let is_across = surface.geometric.dot(end.normal).abs() < ALONG_MIRROR_COS;
                let off_m = (end.point - surface.point).dot(surface.geometric.to_vector()).abs();
                let is_of_chain =
                    [false, true].into_iter().filter_map(plane_of).any(|p| end.chain.contains(&p));
                is_of_chain && is_across && off_m <= REFLECTION_ROUNDINGS * bvh.offset_m(end.point)
            };
            match self.pane_share(&surface, &ray) {
                Some(passed) => share = share * passed,
                None if ends.into_iter().flatten().any(lies_on) => (),
                None => return None,
            }
            ray = segment(&surface.other_side(), target);
        }
        None
    }

    /// A place on a plane's mirrors, if they reach to within rounding of it. It is searched for
    /// there and in eight directions about it.
    fn mirror_near(&self, mirror: &Plane, plane: u32, at: Point) -> Option<SurfacePoint> {
        let beside_m = REFLECTION_ROUNDINGS * self.scene.bvh().offset_m(at);
        let above_m = beside_m + self.mirrors.tolerance_m;
        let (u, v) = mirror.normal.to_direction().frame();
        let beside = (0..8).map(|k| {
            let (s, c) = libm::sincos(f64::from(k) * FRAC_PI_4);
            u * (beside_m * c) + v * (beside_m * s)
        });
        let down = -mirror.normal.to_direction();
        let met = |shift: Vector| {
            let mut ray = Ray::new(at + shift + mirror.normal * above_m, down);
            let mut left_m = 2.0 * above_m;
            // Where mirrors meet at a sharp angle, the other one lies in front.
            for _ in 0..MAX_PANES {
                let hit = self.scene.bvh().closest_hit(&ray.up_to(left_m as f32))?;
                let surface = SurfacePoint::from_hit(self.scene, &hit);
                if self.mirrors.of(hit.triangle, hit.back) == Some(plane) {
                    return Some(SurfacePoint { point: at, ..surface });
                }
                left_m -= f64::from(hit.t);
                ray = surface.other_side().leave(down);
            }
            None
        };
        std::iter::once(Vector::ZERO).chain(beside).find_map(met)
    }
}
