//! What is asked for.

use crate::Reach;

/// What of the scene is left out on purpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Luminaires: their light is in the lightmap.
    pub without_lights: bool,
    /// Which files the scene may name.
    pub reach: Reach,
}
