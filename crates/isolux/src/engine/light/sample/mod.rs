//! Ways to draw luminaires and places on them.

mod adaptive;
pub(super) mod area;
mod clusters;
mod estimate;
mod many;
pub(super) mod measured;
pub(super) mod nearby;
mod one;
pub(super) mod patches;
