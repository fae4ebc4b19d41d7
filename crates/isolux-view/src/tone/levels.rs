//! What a tone operator goes between.

use crate::exposure::MIDDLE_GREY;

/// The two luminances that a tone operator goes between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// The luminance of the scene that [`crate::Exposure`] counts as 1, cd/m2.
    pub white_cd_m2: f64,
    /// The luminance of the white of the display, cd/m2.
    pub display_white_cd_m2: f64,
}

impl Levels {
    /// The luminance that eyes in the scene are taken to be adapted to, cd/m2: what the exposure shows as middle grey, 0.18.
    /// With [`crate::Exposure::Automatic`] that is the log-average of the view.
    pub fn adaptation_cd_m2(self) -> f64 {
        MIDDLE_GREY * self.white_cd_m2
    }
}
