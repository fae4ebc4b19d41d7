//! Caustics: light that reaches diffuse surfaces over specular ones that virtual luminaires do not
//! cover, carried by particles.

use super::accumulate::Effort;
use super::emission::Emission;
use super::particle::{Particle, scatterings};
use super::plan::Plan;
use super::tally::Tally;
use crate::sampling::{Key, Sequence};
use crate::scene::Body;
use crate::units::Rgb;
use rayon::prelude::*;

/// Particles a vertex and increment.
const PARTICLES_A_VERTEX: usize = 4;

/// Particles of an increment for so many vertices.
pub(super) fn particles(vertices: usize) -> u32 {
    (PARTICLES_A_VERTEX * vertices).next_power_of_two() as u32
}

/// Caustic illuminance at the vertices that indirect light lives on, and what it took.
pub(super) fn deposit(plan: &Plan, key: Key) -> (Vec<Rgb>, Effort) {
    let nothing = || (vec![Rgb::BLACK; plan.indirect_vertices], Effort::default());
    let Some(emission) = Emission::new(plan.scene) else { return nothing() };
    if !plan.lighting.leaves_caustics() {
        let (black, _) = nothing();
        let given_up_lx = plan.lighting.left_out() * emission.flux_lm() / plan.area_m2();
        return (black, Effort { rays: 0, given_up_lx });
    }
    let tally = Tally::new(plan, emission.flux_lm(), 1);
    let count = particles(plan.indirect_vertices);
    let sequence = Sequence::new(key);
    let most = scatterings(plan.scene);
    let fly = |index: u32| {
        let (scene, lighting) = (plan.scene, plan.lighting);
        let Some(mut particle) = Particle::emit(&emission, sequence, index, count, most) else {
            return 0;
        };
        let mut rays = 1;
        while let Some(at) = particle.advance(scene) {
            let opaque = matches!(scene.material(at.triangle).body, Body::Opaque { .. });
            // What virtual luminaires bring is theirs.
            if opaque && !particle.is_covered(lighting) {
                tally.add(0, &at, particle.flux_lm);
            }
            // Diffuse reflection ends a caustic.
            if !particle.scatter_specular(scene, lighting) {
                break;
            }
            if particle.is_given_up() {
                tally.give_up(particle.flux_lm);
                break;
            }
            rays += 1;
        }
        rays
    };
    let rays = (0..count).into_par_iter().map(fly).sum();
    (tally.illuminance(0), Effort { rays, given_up_lx: tally.given_up_lx() })
}
