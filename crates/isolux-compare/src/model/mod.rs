//! Scenes in code: flat shapes, spheres and luminaires as plain parts.

mod flat;
mod light;
mod sphere;

pub use flat::{Rectangle, inward_box, outward_box, polygon};
pub use light::{aimed, isotropic};
pub use sphere::{SphereMesh, octant, sphere};
