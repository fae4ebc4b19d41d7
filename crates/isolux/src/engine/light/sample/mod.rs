//! Sampling of luminaires and of places on them.

mod adaptive;
mod all_round;
pub(super) mod area;
mod clusters;
mod estimate;
mod extended;
mod far;
pub(super) mod luminous;
mod many;
pub(super) mod measured;
pub(super) mod nearby;
mod one;
pub(super) mod patches;
pub(super) mod pooled;
