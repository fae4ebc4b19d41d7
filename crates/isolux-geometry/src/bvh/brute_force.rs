//! The specification of the ray kernel: every triangle is tried.
//!
//! Slow, and kept as the oracle: the hierarchy returns the same hits bit for bit.

use super::local::Local;
use super::triangle_test::{Meeting, Shear, comes_before, corners};
use crate::{Hit, Ray, TriangleMesh};

/// The first triangle that the ray meets: see [`Bvh::closest_hit`](super::Bvh::closest_hit).
pub fn closest_hit(mesh: &TriangleMesh, ray: &Ray) -> Option<Hit> {
    let mut closest: Option<(u32, Meeting)> = None;
    for (triangle, meeting) in meetings(mesh, ray) {
        if closest.is_none_or(|best| comes_before((triangle, &meeting), (best.0, &best.1))) {
            closest = Some((triangle, meeting));
        }
    }
    closest.map(|(triangle, meeting)| meeting.of(triangle))
}

/// Whether the ray meets any triangle that is not transparent: see
/// [`Bvh::any_hit`](super::Bvh::any_hit).
pub fn any_hit(mesh: &TriangleMesh, is_transparent: impl Fn(u32) -> bool, ray: &Ray) -> bool {
    hits(mesh, ray).any(|hit| !is_transparent(hit.triangle))
}

/// All triangles that the ray meets, in the order of their indices.
pub fn hits(mesh: &TriangleMesh, ray: &Ray) -> impl Iterator<Item = Hit> {
    meetings(mesh, ray).map(|(triangle, meeting)| meeting.of(triangle))
}

fn meetings(mesh: &TriangleMesh, ray: &Ray) -> impl Iterator<Item = (u32, Meeting)> {
    let skip = ray.skip;
    Shear::new(&Local::of(ray, mesh.origin)).into_iter().flat_map(move |shear| {
        (0..mesh.len() as u32).filter(move |&triangle| Some(triangle) != skip).filter_map(
            move |triangle| {
                let corners = corners(mesh, triangle)?;
                Some((triangle, shear.meet(|corner, axis| corners[corner][axis])?))
            },
        )
    })
}
