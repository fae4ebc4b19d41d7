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
pub(crate) use detail::{Details, LeafError, Refinement, refine_worst};
pub(crate) use fit::Fit;
pub(crate) use hat_functions::HatFunctions;
pub(crate) use neighbour_noise::{LEAST, lend_noise};
pub(crate) use room_scale::{bisect_to_scale, is_in_room};
pub(crate) use trust::{Trust, TrustLevels, WorstElements};
