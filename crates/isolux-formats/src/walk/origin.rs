//! Where the coordinates of the page count from.

use isolux::geometry::{Point, Vector};
use isolux::scene::Scene;

/// What is added to the coordinates of the page to have those of the scene: that of the ray kernel, nothing unless the scene is far
/// from its origin.
pub(super) fn origin(scene: &Scene) -> Vector {
    scene.bvh().mesh().origin - Point::ORIGIN
}
