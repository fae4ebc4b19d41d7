//! Operations on finished maps: sums of maps of the same surfaces, and finer shadows for display.

mod finer;
mod mix;
mod trees;
pub use finer::{Finer, FinerSettings};
pub use mix::{MixError, MixPart, Mixed, mix, mix_apart};
