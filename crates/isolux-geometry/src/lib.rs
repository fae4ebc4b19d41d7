//! What a ray hits: points, vectors, transforms, triangles, rays and the bounding volume hierarchy.
//!
//! Lengths are metres. Positions of triangles are `f32` (what the ray kernel reads), counted from an
//! origin of their mesh; everything computed from them is `f64`.

pub mod bvh;
mod ray;
mod transform;
mod triangle;
mod vector;
mod vectors;

pub use bvh::Bvh;
pub use ray::{End, Hit, Ray};
pub use transform::Transform;
pub use triangle::{Triangle, TriangleMesh};
pub use vector::{Direction, Normal, Point, Vector};
pub use vectors::{Vectorized, with_vectors};
