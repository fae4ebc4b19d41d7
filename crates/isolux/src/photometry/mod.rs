//! Luminous intensity distributions.
//!
//! Every distribution lives in the luminaire's own frame: the photometric axis (nadir, gamma = 0)
//! is **-z**, the C0 half-plane contains **+x**, the C90 half-plane contains **+y**. (glTF lights
//! shine along -z too.) A direction has gamma = acos(-z) and C = atan2(y, x).

mod angles;
mod axis;
mod check;
mod distribution;
mod strip;
mod symmetry;
#[cfg(test)]
mod tests;
mod web;

pub use angles::AngleSystem;
pub use check::WebError;
pub use distribution::IntensityDistribution;
pub use symmetry::Symmetry;
pub use web::PhotometricWeb;
