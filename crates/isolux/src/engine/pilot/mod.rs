//! The pilot: a deterministic first look that fixes the elements before increments are counted.
//!
//! Coarse to fine: solve, see where the details are, bisect there, until the interpolation error is
//! a fixed part of the accuracy asked for. All receivers use the same random numbers here, so that
//! noise is smooth over surfaces and does not pass for detail.

mod bare;
mod batches;
mod caustics;
mod direct;
mod direct_refinement;
mod finish;
mod forecast;
mod indirect;
mod landing;
mod look;
mod middles;
mod opening;
mod refine;
mod round;
mod sharing;
mod smoothing;
mod standings;
mod state;
mod surrounded;
mod surroundings;
mod walls;

use crate::engine::gather::Unlit;
use crate::engine::light::Lighting;
use crate::engine::plan::Plan;
use crate::scene::Scene;
#[cfg(test)]
pub(super) use forecast::{Costs, Outlook};
pub(super) use forecast::{GoOn, Left, Round};
pub(super) use look::PilotRequest;
#[cfg(test)]
pub(super) use look::Survey;
use state::Pilot;
use std::mem;

/// Looks and refines; `go_on` is asked after every round. Adds to what earlier pilots of the run have found unlit.
pub(super) fn pilot<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    unlit: &mut Unlit,
    go_on: &mut GoOn<'_>,
) -> Plan<'s> {
    let mut pilot = Pilot::new(scene, lighting, request);
    pilot.near.unlit = mem::take(unlit);
    let look = pilot.elements_for_indirect_light(request, go_on);
    *unlit = mem::take(&mut pilot.near.unlit);
    pilot.finish(look, request, go_on)
}

/// What a pilot would find, without the whole of its work.
pub(super) fn foresee<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    go_on: &mut GoOn<'_>,
) {
    Pilot::new(scene, lighting, request).elements_for_indirect_light(request, go_on);
}
