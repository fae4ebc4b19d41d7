//! The pilot: the deterministic loop of adaptive refinement that fixes the elements before the first increment.
//!
//! The first survey solves for the light, later ones gather at new vertices. Each round bisects the elements whose
//! errors are too large, until each kind of error meets its goal. All receivers use the same random numbers
//! here: noise is then smooth over surfaces and is not mistaken for detail.

mod bare;
mod criteria;
mod direct;
mod finish;
mod forecast;
mod indirect;
mod landing;
mod look;
mod middles;
mod refine;
mod round;
mod sharing;
mod standings;
mod state;
mod surrounded;
mod surroundings;
mod survey;
mod walls;

use crate::engine::gather::Unlit;
use crate::engine::light::Lighting;
use crate::engine::plan::Plan;
use crate::scene::Scene;
#[cfg(test)]
pub(super) use forecast::{Costs, EachIncrement, Outlook};
pub(super) use forecast::{GoOn, Left, Round};
pub(super) use look::PilotRequest;
use state::Pilot;

/// Runs the pilot to its end and returns the plan. `go_on` is asked after every round. Earlier pilots of the run have
/// found the places `unlit`.
pub(super) fn pilot<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    unlit: &Unlit,
    go_on: &mut GoOn<'_>,
) -> Plan<'s> {
    let mut pilot = Pilot::new(scene, lighting, request);
    pilot.near.unlit = unlit.clone();
    let look = pilot.elements_for_indirect_light(request, go_on);
    pilot.finish(look, request, go_on)
}

/// Runs the first part of a pilot for its reports to `go_on` alone. Returns the number of vertices at its end.
pub(super) fn foresee<'s>(
    scene: &'s Scene,
    lighting: &'s Lighting<'s>,
    request: &PilotRequest,
    go_on: &mut GoOn<'_>,
) -> usize {
    Pilot::new(scene, lighting, request).foresee(request, go_on)
}
