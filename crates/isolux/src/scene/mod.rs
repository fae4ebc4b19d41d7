//! A scene as solved: geometry, materials and luminaires that cannot be invalid.
//!
//! Readers fill [`SceneParts`], the plain description; [`Scene::assemble`] checks all of it at once
//! and builds the ray kernel. Engines take only a [`Scene`].

mod assemble;
mod beyond;
mod bounded;
mod check;
mod coat;
mod diffuse_only;
mod grid;
mod hanging;
mod hash;
mod luminaire;
mod luminous_area;
mod material;
mod mounted;
mod north;
mod origin;
pub(crate) mod pane;
mod parts;
mod problem;
mod relight;
mod requirement;
mod sealed;
mod texture;
mod view;

pub use assemble::Scene;
pub use bounded::{Lowered, MOST_REFLECTANCE};
pub use grid::CalculationGrid;
pub use hanging::world_from_luminaire;
pub use luminaire::{AreaLuminaire, Fitting, Luminaire, LuminaireKind, Maintenance};
pub use luminous_area::{AreaShape, LuminousArea};
pub use material::{Body, Coat, Dielectric, Finish, Gloss, Material, Reflectance};
pub use north::world_from_sky;
pub use pane::Pane;
pub use parts::{SceneParts, Shape, UpAxis};
pub use problem::{Place, SceneProblem};
pub use requirement::{Condition, EmergencyArea, GridQuantity, Requirement};
pub use texture::Texture;
pub use view::Camera;
