//! Backs that stand off from their fronts, for renderers that show every surface from both sides.

use super::display::Surface;
use crate::lightmap::Target;
use isolux::scene::Scene;

/// Distance of a back from its front, of the longest side of the scene: 0.1 mm in a room of 10 m. Rays in single
/// precision miss a surface by some 1e-7 of the scene.
const STAND_OFF: f64 = 1e-5;

/// How far backs have to stand off for a target, m. Cycles, of Blender, knows no culling: of a front and a back in one
/// place it shows either.
pub(super) fn distance_m(scene: &Scene, target: Target) -> f64 {
    if target != Target::Blender {
        return 0.0;
    }
    let corners = |axis: usize| {
        let triangles = 0..scene.triangle_count();
        triangles.flat_map(move |t| scene.triangle(t).corners.map(|p| f64::from(p.to_f32()[axis])))
    };
    let sides = [0, 1, 2].map(|axis| {
        corners(axis).fold([f64::MAX, f64::MIN], |[low, high], c| [low.min(c), high.max(c)])
    });
    let longest = sides.iter().fold(0.0, |most, [low, high]| f64::max(most, high - low));
    let farthest = sides.iter().flatten().fold(0.0, |most, c| f64::max(most, c.abs()));
    // Far from the origin less would be lost in rounding.
    f64::max(STAND_OFF * longest, 4.0 * f64::from(f32::EPSILON) * farthest)
}

/// Moves vertices along their normals.
pub(super) fn stand_off(surface: &mut Surface, distance_m: f64) {
    for (position, normal) in surface.positions.iter_mut().zip(&surface.normals) {
        for (coordinate, along) in position.iter_mut().zip(normal) {
            *coordinate = (f64::from(*coordinate) + distance_m * f64::from(*along)) as f32;
        }
    }
}
