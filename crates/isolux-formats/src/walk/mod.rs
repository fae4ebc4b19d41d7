//! Containers for the walk-through in a browser: a scene, the mesh of a map, its light. `web/src/wire.ts` is the other side.
//!
//! What is shown needs fewer bits than what is computed: coordinates are 16 bits of the box around a surface, illuminances have
//! 9 bits and an exponent, errors are half floats. A vertex with light takes 18 bytes, a triangle 6.

mod container;
mod html;
mod light;
mod luminaires;
mod mesh;
mod octahedral;
mod origin;
mod planes;
mod record;
mod scene;
mod sky;

pub use html::{Embedded, Page, embed};
pub use light::Light;
pub use mesh::Mesh;
pub use record::Steps;
pub use scene::{ColourMap, Told, Tone, scene};
