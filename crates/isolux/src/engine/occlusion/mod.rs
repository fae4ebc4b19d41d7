//! What stands near a place, and across elements.

pub(crate) mod barriers;
mod footprints;
pub(crate) mod nearby;

pub(crate) use barriers::{Cut, Cuts, Side};
pub(crate) use footprints::{LOW, Torn};
pub(crate) use nearby::{Felt, NEAR};
