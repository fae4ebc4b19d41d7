//! Caustics: light that reaches diffuse surfaces over specular ones that virtual luminaires do not
//! cover, carried by particles.

use super::accumulate::Effort;
use super::flights::Flights;
use super::plan::Plan;
use super::tally::Tally;
use crate::sampling::Key;
use crate::units::Rgb;
use rayon::prelude::*;

/// Caustic illuminance at the vertices that indirect light lives on by so many particles, and what it took.
pub(super) fn deposit(plan: &Plan, count: u32, key: Key) -> (Vec<Rgb>, Effort) {
    let nothing = || (vec![Rgb::BLACK; plan.indirect_vertices], Effort::default());
    let Some(flights) = Flights::new((plan.scene, plan.lighting), plan.aim.as_ref(), count, key)
    else {
        return nothing();
    };
    let flux_lm = flights.flux_lm();
    if !plan.lighting.leaves_caustics() {
        let (black, _) = nothing();
        let given_up_lx = plan.lighting.left_out() * flux_lm / plan.area_m2();
        return (black, Effort { rays: 0, given_up_lx });
    }
    let tally = Tally::new(plan, flux_lm, 1);
    let one = |index: u32| {
        let (rays, given_up) = flights.fly(index, |at, flux_lm| tally.add(0, at, flux_lm));
        given_up.into_iter().for_each(|flux_lm| tally.give_up(flux_lm));
        rays
    };
    let rays = (0..count).into_par_iter().map(one).sum();
    (tally.illuminance(0), Effort { rays, given_up_lx: tally.given_up_lx() })
}
