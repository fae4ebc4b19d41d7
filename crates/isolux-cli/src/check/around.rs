//! What is around a place: directions, and how far a scene reaches.

use isolux::geometry::{Direction, Vector};
use isolux::scene::Scene;

/// The diagonal of the box around a scene, m.
pub(super) fn extent_m(scene: &Scene) -> f64 {
    scene.bvh().mesh().bounds().map_or(0.0, |(low, high)| (high - low).length())
}

/// The 26 neighbours of the middle of a cube of cubes, away from edges of a model on a grid.
pub(super) fn all_around() -> Vec<Direction> {
    let steps = [-1.0, 0.0, 1.0];
    let mut directions = Vec::new();
    for x in steps {
        for y in steps {
            for z in steps {
                directions.extend(Vector::new(x + 0.013, y + 0.007, z - 0.011).direction());
            }
        }
    }
    directions
}
