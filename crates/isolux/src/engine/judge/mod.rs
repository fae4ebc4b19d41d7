//! The quality of a map: its error from replicates and check points, the noise filter, and the energy bound.

mod accuracy;
pub(crate) mod check_points;
pub(crate) mod energy_bound;
mod filter;
mod verdict;

pub(crate) use accuracy::{
    BELIEVED_INCREMENTS, FEWEST_TO_MISS, Light, Pooled, accuracy, accuracy_of_map,
    early_statistical,
};
pub(crate) use check_points::{Check, Checks, DirectThere, InterpolationErrors};
#[cfg(test)]
pub(crate) use energy_bound::{Allowed, allowed_lx};
pub(crate) use filter::filter;
pub(crate) use verdict::{OF_GOAL, Verdict};
