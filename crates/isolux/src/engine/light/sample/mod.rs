//! Ways to draw luminaires and places on them.

pub(super) mod adaptive;
pub(super) mod area;
mod clusters;
mod many;
pub(super) mod nearby;
pub(super) mod patches;
