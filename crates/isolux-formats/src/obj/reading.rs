//! How a file is read.

use super::meaning::Materials;
use crate::Reach;

/// What is known of a file from elsewhere.
pub(crate) struct Reading<'a> {
    /// Whether its unit of length is known, so that its size surprises nobody.
    pub(crate) unit_is_known: bool,
    /// Whether a material is replaced by another: then it is not looked at, and comes out black.
    pub(crate) is_replaced: &'a dyn Fn(&str) -> bool,
    /// Whether materials are read as meant.
    pub(crate) materials: Materials,
    /// Whether faces without a material reflect the colours of their vertices.
    pub(crate) vertex_colours: bool,
    /// Which files it may name.
    pub(crate) reach: Reach,
}
