//! Maps of the same surfaces put together, and refined for display.

mod finer;
mod mix;
mod trees;
pub use finer::{Finer, FinerSettings};
pub use mix::{MixError, MixPart, Mixed, mix, mix_apart};
