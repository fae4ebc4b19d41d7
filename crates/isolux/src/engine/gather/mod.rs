//! Final gathering: the indirect light of a receiver, by rays that read the map where they end.

mod allotment;
mod bright_surfaces;
pub(crate) mod control_variate;
mod direct_residual;
mod gatherer;
mod hidden_places;
mod operator;
pub(crate) mod ray_trial;
mod waves;

#[cfg(test)]
pub(crate) use allotment::Shared;
pub(crate) use allotment::{allot, allot_by_noise, areas_m2, mean_of};
pub(crate) use bright_surfaces::{BrightSurfaces, Seen};
pub(crate) use control_variate::ControlVariate;
#[cfg(test)]
pub(crate) use control_variate::lacking;
pub(crate) use direct_residual::{DirectResidual, Kept, Over};
pub(crate) use gatherer::{
    DirectAtEnds, Gatherer, Gathering, known_at, known_on_side, known_weights,
};
pub(crate) use hidden_places::{CutOff, Element, Sight, Unlit, sees};
#[cfg(test)]
pub(crate) use operator::GivenRow;
pub(crate) use operator::Operator;
pub(crate) use ray_trial::{
    FEWEST_UNJUDGED, NET_ORDER, NOISE_SHARE, OF_INTERPOLATED, RayTrial, noise_for,
};
