//! Lumens of a watt where files speak in watts.

/// Luminous efficacy of Radiance's white, lm/W (`WHTEFFICACY` of its `color.h`).
pub(crate) const EFFICACY_LM_W: f64 = 179.0;
