//! Where the coordinates of the page count from.

use isolux::geometry::{Point, Vector};
use isolux::scene::Scene;

/// What is added to the coordinates of the page to have those of the scene: that of the ray kernel, nothing unless the scene is far
/// from its origin.
pub(super) fn origin(scene: &Scene) -> Vector {
    // A multiple of a power of two near the scene, which is exact in 24 bits.
    let zero = scene.bvh().mesh().local_from_world(Point::ORIGIN);
    Vector::from(zero.map(|c| 0.0 - f64::from(c)))
}
