//! What is asked for.

/// What of the scene is left out on purpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Luminaires: their light is in the lightmap.
    pub without_lights: bool,
}
