//! Light from emitting surfaces.

use super::Lighting;
use super::source::{Emitter, Source, Target, facing_cos};
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::sampling::SphericalTriangle;
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};

/// Emitters of at most so many triangles a sample are sampled by solid angle, with the exact
/// unoccluded illuminance as control; larger ones by area, which costs less and spreads more.
const TRIANGLES_A_SAMPLE: usize = 32;

impl Lighting<'_> {
    /// Illuminance from one emitting surface, by `samples` shadow rays.
    pub(super) fn lit_by_area(
        &self,
        source: &Source,
        emitter: &Emitter,
        triangles: &[[Point; 3]],
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        if triangles.len() > TRIANGLES_A_SAMPLE * samples {
            let one = |_| self.by_area(source, emitter, triangles, at, dice);
            return source.colour * ((0..samples).map(one).sum::<Rgb>() / samples as f64);
        }
        let parts: Vec<f64> = triangles.iter().map(|t| projected_solid_angle(at, t)).collect();
        let whole: f64 = parts.iter().sum();
        if whole <= 0.0 {
            return Rgb::BLACK;
        }
        let (mut kept, mut lost, mut seen) = (Rgb::BLACK, Rgb::BLACK, false);
        for _ in 0..samples {
            if let Some((value, share)) =
                self.by_solid_angle(source, emitter, triangles, &parts, whole, at, dice)
            {
                kept += share * value;
                lost += (Rgb::WHITE - share) * value;
                seen |= !share.is_black();
            }
        }
        // The exact unoccluded value less the estimated shadow has no variance where nothing is in
        // the way; in full shadow the plain estimate, zero, has none. An image is mostly hidden by
        // the frame of its mirror.
        let mostly_free = seen && source.chain.is_empty();
        let steradians = if mostly_free {
            Rgb::grey(whole) - lost / samples as f64
        } else {
            kept / samples as f64
        };
        source.colour * steradians
    }

    /// One direction into the emitter: projected solid angle it stands for, and what is seen of it.
    #[expect(clippy::too_many_arguments, reason = "the loop above owns the tables")]
    fn by_solid_angle(
        &self,
        source: &Source,
        emitter: &Emitter,
        triangles: &[[Point; 3]],
        parts: &[f64],
        whole: f64,
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Option<(f64, Rgb)> {
        let [pick, _] = dice.pair();
        let square = dice.pair();
        let mut left = pick * whole;
        let k = parts.iter().position(|&p| {
            left -= p;
            left < 0.0
        })?;
        let corners = triangles[k];
        let spherical = SphericalTriangle::new(at.point, corners)?;
        let direction = spherical.sample(square)?;
        let cos = facing_cos(direction, at.shading, at.geometric)?;
        let target = on_plane(at.point, direction.to_vector(), corners)?;
        let share = self.visibility(source, at, Target::Point(target), Some(emitter.indices[k]));
        Some((cos * spherical.solid_angle_sr * whole / parts[k], share))
    }

    /// One point of the emitter, uniform by area: projected solid angle times visible share.
    fn by_area(
        &self,
        source: &Source,
        emitter: &Emitter,
        triangles: &[[Point; 3]],
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Rgb {
        let [pick, _] = dice.pair();
        let [a, b] = dice.pair();
        let total_m2 = emitter.area_sums_m2.last().copied().unwrap_or(0.0);
        let k = emitter.area_sums_m2.partition_point(|&sum| sum <= pick * total_m2);
        let k = k.min(triangles.len() - 1);
        let [p, q, r] = triangles[k];
        let root = a.sqrt();
        let target = p + (q - p) * (root * (1.0 - b)) + (r - p) * (root * b);
        let to_target = target - at.point;
        let (Some(direction), Some(normal)) =
            (to_target.direction(), (q - p).cross(r - p).normal())
        else {
            return Rgb::BLACK;
        };
        let cos_there = -direction.cos(normal);
        let Some(cos) = facing_cos(direction, at.shading, at.geometric) else { return Rgb::BLACK };
        if cos_there <= 0.0 {
            return Rgb::BLACK;
        }
        let steradians = cos * cos_there * total_m2 / to_target.length_squared();
        self.visibility(source, at, Target::Point(target), Some(emitter.indices[k])) * steradians
    }
}

/// Where a ray meets the plane of a triangle.
fn on_plane(from: Point, direction: Vector, [a, b, c]: [Point; 3]) -> Option<Point> {
    let normal = (b - a).cross(c - a);
    let t = (a - from).dot(normal) / direction.dot(normal);
    (t > 0.0 && t.is_finite()).then(|| from + direction * t)
}

/// Projected solid angle (integral of the cosine at the receiver) of a triangle that emits from its
/// counter-clockwise side: Lambert's formula over the part above the horizon (Lambert 1760; in
/// Arvo's notation, "The irradiance Jacobian for partially occluded polyhedral sources", 1994).
fn projected_solid_angle(at: &SurfacePoint, corners: &[Point; 3]) -> f64 {
    let [a, b, c] = *corners;
    if (b - a).cross(c - a).dot(at.point - a) <= 0.0 {
        return 0.0;
    }
    let normal = at.shading.to_vector();
    let polygon = above_horizon(&corners.map(|p| p - at.point), normal);
    let mut sum = 0.0;
    for (k, &from) in polygon.iter().enumerate() {
        let to = polygon[(k + 1) % polygon.len()];
        let edge = from.cross(to);
        if let Some(axis) = edge.direction() {
            let angle = libm::atan2(edge.length(), from.dot(to));
            sum += angle * axis.to_vector().dot(normal);
        }
    }
    // Seen from the receiver the emitting side turns clockwise.
    (-0.5 * sum).max(0.0)
}

/// Sutherland and Hodgman's clip of a triangle at the horizon.
fn above_horizon(corners: &[Vector; 3], normal: Vector) -> Vec<Vector> {
    let mut kept = Vec::with_capacity(4);
    for k in 0..3 {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let (h0, h1) = (from.dot(normal), to.dot(normal));
        if h0 >= 0.0 {
            kept.push(from);
        }
        if (h0 > 0.0 && h1 < 0.0) || (h0 < 0.0 && h1 > 0.0) {
            kept.push(from + (to - from) * (h0 / (h0 - h1)));
        }
    }
    kept
}
