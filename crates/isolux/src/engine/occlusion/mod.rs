//! Objects near a place, across elements, and on vertices.

pub(crate) mod barriers;
mod footprints;
pub(crate) mod nearby;

pub(crate) use barriers::{Barrier, Barriers, Side};
pub(crate) use footprints::{Footprints, LOW};
pub(crate) use nearby::{ClosedIn, NEAR};
