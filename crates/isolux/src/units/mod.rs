//! Colour quantities.

mod rgb;

pub use rgb::Rgb;
