//! Caustics: light that reaches diffuse surfaces over specular ones without virtual luminaires, carried by
//! particles.

use super::tally::Tally;
use crate::engine::particle::Flights;
use crate::engine::plan::Plan;
use crate::engine::ray::{Deadline, Effort};
use crate::sampling::Key;
use crate::units::Rgb;
use rayon::prelude::*;

/// Caustics from particles.
pub(crate) struct Caustics {
    /// The illuminance at the vertices that indirect light lives on, lx.
    pub(crate) light: Vec<Rgb>,
    /// The mean illuminance about these vertices, lx, nowhere negative. Further reflections start from it.
    pub(crate) means: Vec<Rgb>,
    /// The caustics that the vertices lack in the checked parts of elements, lx.
    pub(crate) lacking: Vec<f64>,
    pub(crate) effort: Effort,
}

/// Caustics from `count` particles; `None` if the deadline passes meanwhile.
pub(crate) fn deposit(plan: &Plan, count: u32, key: Key, deadline: &Deadline) -> Option<Caustics> {
    let nothing = |effort: Effort| Caustics {
        light: vec![Rgb::BLACK; plan.mesh.indirect_vertices],
        means: vec![Rgb::BLACK; plan.mesh.indirect_vertices],
        lacking: vec![0.0; plan.errors.parts.count()],
        effort,
    };
    let Some(flights) =
        Flights::new((plan.scene, plan.lighting), plan.tried.aim.as_ref(), count, key)
    else {
        return Some(nothing(Effort::default()));
    };
    let flux_lm = flights.flux_lm();
    if !plan.lighting.leaves_caustics() {
        let given_up_lx = plan.lighting.left_out() * flux_lm / plan.area_m2();
        return Some(nothing(Effort { rays: 0, given_up_lx }));
    }
    let tally = Tally::new(plan, flux_lm, 1);
    let one = |index: u32| {
        if deadline.has_passed() {
            return None;
        }
        let (rays, given_up) = flights.fly(index, |at, flux_lm| tally.add(0, at, flux_lm));
        given_up.into_iter().for_each(|flux_lm| tally.give_up(flux_lm));
        Some(rays)
    };
    let rays = (0..count).into_par_iter().map(one).sum::<Option<u64>>()?;
    let light = tally.illuminance(0);
    let lacking = tally.lacking(|vertex| light[vertex]);
    let means = tally.means(0);
    let effort = Effort { rays, given_up_lx: tally.given_up_lx() };
    Some(Caustics { light, means, lacking, effort })
}
