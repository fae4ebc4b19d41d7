//! Trial rays and particles: the noise and costs from which increments are predicted.

use super::look::Survey;
use super::state::Pilot;
use crate::engine::gather::{Gatherer, RayTrial, known_at, ray_trial};
use crate::engine::judge::BELIEVED_INCREMENTS;
use crate::engine::particle::{CausticNoise, ParticleTrial};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::Sequence;
use rayon::prelude::*;
use std::time::{Duration, Instant};

impl Pilot<'_> {
    /// Measures the noise of gathered light and of caustics with trial rays and particles, if there is time.
    pub(super) fn try_some(&mut self, look: &Survey, target: f64) {
        if self.end.has_passed() {
            return;
        }
        let vertices = look.elements.vertices();
        let carries =
            |&v: &usize| self.near.standings[v].is_some() && self.mesh.carriers.is_active(v as u32);
        let all: Vec<usize> = (0..vertices.len()).filter(carries).collect();
        let every = all.len().div_ceil(ray_trial::RECEIVERS).max(1);
        let gatherers = self.gatherers();
        self.look_at_walls_again(&look.elements, target);
        let some = all.into_iter().step_by(every);
        let some: Vec<(Gatherer, f64)> = some
            .map(|v| (self.before_walls(v as u32, gatherers[v]), vertices[v].area_m2))
            .collect();
        let gathering = self.gathering(&look.elements, u32::MAX, &self.near.standings);
        let (reference_lx, increments) = (look.reference_lx, BELIEVED_INCREMENTS);
        let wanted = (ray_trial::RunGoal { target, reference_lx, increments }, self.key.with(6));
        let started = Instant::now();
        let (trial, rays) =
            RayTrial::of(&gathering, &some, &self.indirect.lx, wanted, self.tried.trial);
        self.costs.tried.add(started.elapsed(), rays as f64);
        if !self.lighting.is_measured_once() {
            self.costs.again.add(self.measures_again(&some), some.len() as f64);
        }
        self.tried.trial = Some(trial);
        self.traced += rays;
        let areas_m2: Vec<f64> = vertices.iter().map(|v| v.area_m2).collect();
        let read = |at: &SurfacePoint| known_at(&look.elements, u32::MAX, &self.near.standings, at);
        let of = (self.scene, self.lighting);
        let ParticleTrial { noise, aim, rays } =
            CausticNoise::tried(of, &areas_m2, read, self.key.with(7));
        self.tried.caustic_noise = noise;
        self.tried.aim = aim;
        self.traced += rays;
    }

    /// The time to measure direct light at some vertices again.
    fn measures_again(&self, some: &[(Gatherer, f64)]) -> Duration {
        let (started, sequence) = (Instant::now(), Sequence::new(self.key.with(1)));
        some.par_iter().filter(|_| !self.end.has_passed()).for_each(|(of, _)| {
            std::hint::black_box(
                self.lighting.illuminance(&of.surface, &mut Dice::new(sequence, 0)),
            );
        });
        started.elapsed()
    }
}
