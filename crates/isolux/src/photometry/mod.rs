//! Luminous intensity distributions, and skies.
//!
//! Every distribution lives in the luminaire's own frame: the photometric axis (nadir, gamma = 0)
//! is **-z**, the C0 half-plane contains **+x**, the C90 half-plane contains **+y**. (glTF lights
//! shine along -z too.) A direction has gamma = acos(-z) and C = atan2(y, x).

mod angles;
mod axis;
mod check;
mod distribution;
mod sky;
mod strip;
mod symmetry;
#[cfg(test)]
mod tests;
mod ugr;
mod web;

pub use angles::AngleSystem;
pub use check::WebError;
pub use distribution::IntensityDistribution;
pub use sky::{AllWeather, CIE_TYPES, GeneralSky, Sky, SkyPatches, SkyPicture, SkyWeather};
pub use symmetry::Symmetry;
pub use ugr::{
    NoUgrTable, UGR_REFLECTANCES, UGR_ROOMS, UgrLayout, UgrReflectances, UgrRoom, UgrTable,
};
pub use web::PhotometricWeb;
