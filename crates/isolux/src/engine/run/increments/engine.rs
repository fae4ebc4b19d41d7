//! The engine of a method, ready for increments.

use super::super::request::SolveRequest;
use crate::engine::judge::{BELIEVED_INCREMENTS, Check, check_points};
use crate::engine::light::Emission;
use crate::engine::method::{Cached, Forward, Hybrid, IncrementSize, Radiosity};
use crate::engine::particle::flights;
use crate::engine::plan::Plan;
use crate::map::Method;
use crate::sampling::Key;

/// The number of increments before a run may end at its accuracy: its error is known by then. The spreads of the three
/// vertices of a reading are together good enough (decision 12).
pub(super) const FEWEST_INCREMENTS: u64 = BELIEVED_INCREMENTS;

/// The engine of a method.
pub(super) enum Engine<'p, 's> {
    Hybrid(Hybrid<'p, 's>),
    Forward(Forward<'p, 's>),
    Cache(Box<Cached<'p, 's>>),
    Radiosity(Box<Radiosity<'p, 's>>),
    /// None: there was no time for one. The map has the light of the pilot.
    OfPilot,
}

impl<'p, 's> Engine<'p, 's> {
    /// The check points of a map, and the engine of a method. An increment has `rays` rays of a receiver, of which memory
    /// allows `most`.
    pub(super) fn prepared(
        plan: &'p Plan<'s>,
        request: &SolveRequest,
        (target, noise): (f64, f64),
        (halvings, goal, [rays, most]): (u32, f64, [u32; 2]),
    ) -> (Vec<Check>, Self) {
        let (key, seed) = (Key::new(request.seed).with(3), request.seed);
        let points = match request.method {
            Method::Hybrid | Method::Cache => check_points::draw(plan, rays, key),
            Method::Radiosity => check_points::draw_for_map(plan, rays, key),
            Method::Forward => Vec::new(),
        };
        let engine = match request.method {
            Method::Hybrid => {
                let (mean, particles) = rays_and_particles(plan, noise, goal, most);
                let of = IncrementSize { rays: mean, halvings, particles, goal };
                Self::Hybrid(Hybrid::new(plan, &points, of, most, seed))
            }
            Method::Cache => {
                let wanted = (&request.cache, target);
                Self::Cache(Box::new(Cached::new(plan, &points, wanted, rays, seed)))
            }
            Method::Forward => {
                let emission = Emission::new(plan.scene).expect("a scene without light is refused");
                Self::Forward(Forward::new(plan, emission, target, seed))
            }
            Method::Radiosity => {
                let settings = &request.radiosity;
                Self::Radiosity(Box::new(Radiosity::new(plan, &points, settings, target, seed)))
            }
        };
        (points, engine)
    }
}

/// The mean number of gathering rays of a receiver, and the number of particles of an increment. The allowed noise is
/// shared between them optimally.
fn rays_and_particles(plan: &Plan, noise: f64, goal: f64, most: u32) -> (f64, u32) {
    let rays = |noise: f64| {
        plan.tried
            .trial
            .wanted(noise, plan.light.reference_lx, FEWEST_INCREMENTS)
            .min(f64::from(most))
    };
    let (vertices, of_goal) = (plan.mesh.indirect_vertices, (goal, plan.light.reference_lx));
    let all = rays(noise) * plan.mesh.carriers.count(vertices) as f64;
    let share = plan.tried.caustic_noise.share(vertices, of_goal, FEWEST_INCREMENTS, all);
    let particles = plan.tried.caustic_noise.particles(vertices, of_goal, FEWEST_INCREMENTS, share);
    let left = (1.0 - share) / (1.0 - flights::LEAST_SHARE);
    (rays(noise * left.sqrt()), particles)
}
