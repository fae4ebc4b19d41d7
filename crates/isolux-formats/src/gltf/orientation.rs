//! How a node turns what has no size: lights and cameras look along -z of their node.

use super::notes::Flaw;
use isolux::geometry::{Direction, Transform, Vector};

/// The direction of the node's -z axis.
pub(super) fn forward(world_from_node: &Transform) -> Result<Direction, Flaw> {
    (-world_from_node.columns[2]).direction().ok_or_else(|| {
        Flaw::new("its node is scaled to nothing and points nowhere", "use a scale other than 0")
    })
}

/// The rotation (or reflection) nearest in kind to a node's transform: its z axis kept, its x axis
/// made perpendicular, its handedness kept, all scale removed.
pub(super) fn rotation(world_from_node: &Transform) -> Transform {
    let [x, y, z] = world_from_node.columns;
    let Some(axis) = z.direction() else { return Transform::IDENTITY };
    let w = axis.to_vector();
    let across =
        |v: Vector| v.direction().and_then(|v| (v.to_vector() - w * v.dot(axis)).direction());
    let (u, v) = match (across(x), across(y)) {
        (Some(u), _) => (u.to_vector(), w.cross(u.to_vector())),
        (None, Some(v)) => (v.to_vector().cross(w), v.to_vector()),
        (None, None) => {
            let (u, v) = axis.frame();
            (u.to_vector(), v.to_vector())
        }
    };
    let v = if world_from_node.determinant() < 0.0 { -v } else { v };
    Transform { columns: [u, v, w], translation: Vector::ZERO }
}
