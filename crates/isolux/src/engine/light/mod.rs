//! Luminaires and emitting surfaces: their mirror images, and sampling of the light that they send.

mod arrivals;
mod emission;
mod far_sky;
mod highlights;
pub(crate) mod landings;
mod lighting;
mod mirrors;
mod opening_search;
mod openings;
mod panes;
mod particle;
mod polygon;
mod prepare;
mod sample;
mod sources;
mod tree;
mod visibility;

pub use arrivals::{Arrival, arrivals};
pub(crate) use emission::{Emission, Emitted};
pub use highlights::{Highlighted, Highlights, Shining};
pub(crate) use landings::{BELIEVED_DEVIATIONS, FIRST_PARTICLES, FURTHER_PARTICLES, Landing, Sum};
pub(crate) use lighting::Lighting;
pub(crate) use mirrors::chains::Chain;
pub(crate) use mirrors::met::MirrorChain;
pub(crate) use particle::{Particle, scatterings};
pub(crate) use sample::measured::{Goal, Measured, REPLICATES};
pub(crate) use sample::nearby::NearbyLuminaires;
pub(crate) use sample::patches::Patches;
pub use sample::pooled::ShadowRays;
pub(crate) use sources::LuminaireId;
pub(crate) use visibility::shadows::Shadows;
