//! Elements as a mesh of functions: detail coefficients, carriers of indirect light, fits, and expected errors.

mod bounded;
mod carriers;
mod coarsening;
mod detail;
mod fit;
mod hat_functions;
mod neighbour_noise;
mod room_scale;
pub(crate) mod trust;

pub(crate) use bounded::{Range, corrected};
pub(crate) use carriers::{Carriers, Waiting};
pub(crate) use detail::{Details, LeafError, MARKED_SHARE, Refinement, refine_worst};
pub(crate) use fit::Fit;
pub(crate) use hat_functions::HatFunctions;
pub(crate) use neighbour_noise::{LEAST, lend_noise};
pub(crate) use room_scale::{bisect_to_scale, is_in_room};
pub(crate) use trust::{Trust, TrustLevels, WorstElements};

/// The index that stands for no element, vertex, patch or node.
pub(crate) const NO_INDEX: u32 = u32::MAX;

/// The least number of vertices or elements of one task, where little is done for each.
const MIN_TASK_LENGTH: usize = 1024;
