//! Colour quantities, angles, and numbers as text.

mod angle;
mod digits;
mod markup;
mod rgb;

pub use angle::sincos_deg;
pub use digits::{Digits, first_digit, short, significant, to_decimals, to_error, with_error};
pub use markup::escape_markup;
pub use rgb::Rgb;
