//! Colour quantities and angles.

mod angle;
mod rgb;

pub use angle::sincos_deg;
pub use rgb::Rgb;
