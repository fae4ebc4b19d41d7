//! The increments on one mesh: an engine, what it has summed, and the map that makes.

use super::accumulate::{Accumulator, Sample, Sums};
use super::accuracy::{BELIEVED_INCREMENTS, accuracy, early_statistical, lookup_lx};
use super::cache::{CacheSample, Cached};
use super::checks::{self, Check, InterpolationErrors};
use super::deadline::Deadline;
use super::emission::Emission;
use super::filter::filter;
use super::forward::Forward;
use super::hybrid::Hybrid;
use super::plan::Plan;
use super::predict;
use super::request::{SolveError, SolveRequest};
use super::state::{RunState, restore};
use super::tally;
use crate::map::{Accuracy, FilterReport, Fresh, Illuminance, Method};
use crate::sampling::Key;
use crate::units::Rgb;

/// Increments before a run may stop at its accuracy: as soon as it is believed. (Readings mix three
/// vertices, whose spreads make one good enough: decision 12.)
pub(super) const FEWEST_INCREMENTS: u64 = BELIEVED_INCREMENTS;

/// Greatest factor between the interpolation error seen and that expected that is believed, either
/// way: details tell the order at least.
const MOST_OVER: f64 = 10.0;

/// The increments on one mesh.
pub(super) struct Work<'p, 's> {
    pub(super) plan: &'p Plan<'s>,
    engine: Engine<'p, 's>,
    pub(super) sums: Accumulator,
    pub(super) checks: Checks,
    /// What paths given up would bring in the mean.
    pub(super) given_up: Accumulator,
    /// Samples of a receiver in an increment: its gathering rays, or one for all particles.
    samples: u32,
}

enum Engine<'p, 's> {
    Hybrid(Hybrid<'p, 's>),
    Forward(Forward<'p, 's>),
    Cache(Box<Cached<'p, 's>>),
}

/// The points that the hybrid engine checks itself at.
pub(super) struct Checks {
    points: Vec<Check>,
    pub(super) sums: Accumulator,
}

impl<'p, 's> Work<'p, 's> {
    /// Seconds that an increment takes; `None` where nobody knows before the first.
    pub(super) fn pace_s(&mut self) -> Option<f64> {
        match &mut self.engine {
            Engine::Hybrid(hybrid) => Some(hybrid.pace_s()),
            Engine::Cache(cached) => Some(cached.pace_s()),
            Engine::Forward(_) => None,
        }
    }

    /// With the rays of an increment halved so many times.
    pub(super) fn new(
        plan: &'p Plan<'s>,
        request: &SolveRequest,
        target: f64,
        halvings: u32,
    ) -> Self {
        let reference = plan.rms_lx;
        let wanted = match request.method {
            Method::Hybrid | Method::Cache => {
                plan.trial.rays_for(target, plan.rms_lx, FEWEST_INCREMENTS)
            }
            Method::Forward => 1,
        };
        let most = most_rays(plan.indirect_vertices, request.max_memory_bytes);
        let rays = (wanted.min(most) >> halvings).max(1);
        let points = match request.method {
            Method::Hybrid | Method::Cache => {
                checks::draw(plan, rays, Key::new(request.seed).with(3))
            }
            Method::Forward => Vec::new(),
        };
        let sums = Accumulator::new(plan.elements.vertices().len(), reference);
        let check_sums = Accumulator::new(
            checks::places(points.len(), request.method != Method::Cache),
            reference,
        );
        let checks = Checks { points, sums: check_sums };
        let engine = match request.method {
            Method::Hybrid => Engine::Hybrid(Hybrid::new(plan, &checks.points, rays, request.seed)),
            Method::Cache => {
                let cached =
                    Cached::new(plan, &checks.points, (&request.cache, target), rays, request.seed);
                Engine::Cache(Box::new(cached))
            }
            Method::Forward => {
                let emission = Emission::new(plan.scene).expect("a scene without light is refused");
                Engine::Forward(Forward::new(plan, emission, request.seed))
            }
        };
        Self { plan, engine, sums, checks, given_up: Accumulator::new(1, reference), samples: rays }
    }

    pub(super) fn restore(&mut self, saved: &RunState) -> Result<(), SolveError> {
        restore(&mut self.sums, &saved.receivers, saved.increments)?;
        restore(&mut self.checks.sums, &saved.checks, saved.increments)?;
        restore(&mut self.given_up, &saved.given_up, saved.increments)
    }

    /// Adds one increment; returns the rays traced, or nothing if the deadline passes before.
    pub(super) fn increment(&mut self, deadline: Deadline) -> Option<u64> {
        let index = self.sums.increments;
        let effort = match &mut self.engine {
            Engine::Hybrid(hybrid) => {
                let Checks { points, sums } = &mut self.checks;
                hybrid.increment(index, &mut self.sums, points, sums, deadline)?
            }
            Engine::Cache(cached) => {
                let Checks { points, sums } = &mut self.checks;
                cached.increment(index, &mut self.sums, points, sums, deadline)?
            }
            Engine::Forward(forward) => forward.increment(index, &mut self.sums),
        };
        let direct = Rgb::grey(effort.given_up_lx);
        self.given_up.add(std::iter::once(Sample { direct, ..Sample::default() }));
        Some(effort.rays)
    }

    /// The samples of a cache that were made.
    pub(super) fn made(&mut self) -> Vec<CacheSample> {
        match &mut self.engine {
            Engine::Cache(cached) => cached.made(),
            Engine::Hybrid(_) | Engine::Forward(_) => Vec::new(),
        }
    }

    fn interpolation(&self) -> InterpolationErrors {
        match self.engine {
            Engine::Hybrid(_) | Engine::Cache(_) => {
                checks::errors(&self.checks.sums, &self.checks.points)
            }
            Engine::Forward(_) => tally::errors(self.plan, &self.sums),
        }
    }

    /// The factor by which elements err more than the pilot has expected.
    fn over_expected(&self) -> f64 {
        let seen = if self.is_believed() { self.interpolation().over_expected } else { None };
        seen.map_or(1.0, |factor| factor.clamp(1.0 / MOST_OVER, MOST_OVER))
    }

    fn is_believed(&self) -> bool {
        self.sums.increments >= BELIEVED_INCREMENTS
    }

    /// Where readers gather afresh.
    pub(super) fn fresh(&self) -> Option<Fresh> {
        if !self.is_believed() || matches!(self.engine, Engine::Forward(_)) {
            return None;
        }
        let limit_lx = self.plan.trusted_up_to_lx * self.over_expected();
        let lookup_lx = lookup_lx(self.plan, &self.interpolation());
        Some(Fresh { above_lx: limit_lx.is_finite().then_some(limit_lx), lookup_lx })
    }

    pub(super) fn accuracy(&self) -> Option<Accuracy> {
        if !self.is_believed() {
            return None;
        }
        let interpolation = self.interpolation();
        let given_up_lx = self.given_up.estimate(0).mean.direct.luminance();
        let errors = InterpolationErrors { given_up_lx, ..interpolation };
        accuracy(self.plan, &self.sums, &errors)
    }

    /// The increments that a target will take in all; `None` if it cannot be reached. Until the error is
    /// believed, by noise alone; from one increment, what elements and rays are made for.
    pub(super) fn increments_needed(&self, accuracy: Option<Accuracy>, target: f64) -> Option<f64> {
        let count = self.sums.increments;
        let needed = if count < BELIEVED_INCREMENTS {
            let statistical = early_statistical(self.plan, &self.sums).unwrap_or(0.0);
            let share = statistical / target;
            Some(count as f64 * share * share)
        } else {
            accuracy.and_then(|a| predict::increments_needed(&a, count, target))
        };
        needed.map(|needed| needed.max(FEWEST_INCREMENTS as f64))
    }

    /// Whether no number of increments will tell how good the map is: there is no light on it, or
    /// the light that was given up may be more than what is there.
    pub(super) fn is_vain(&self, accuracy: Option<Accuracy>) -> bool {
        let dark = self.plan.rms_lx == 0.0;
        let given_up = self.given_up.sums != [Sums::default()];
        self.sums.increments >= FEWEST_INCREMENTS && accuracy.is_none() && (dark || given_up)
    }

    /// Whether more increments would change little: noise is a small part of the error.
    pub(super) fn is_settled(&self, accuracy: Option<Accuracy>) -> bool {
        accuracy.is_some_and(|a| a.statistical <= 0.25 * libm::hypot(a.discretization, a.bias))
    }

    /// The values of the map, and what the filter did to them.
    pub(super) fn values(
        &self,
        filtered: bool,
    ) -> (Vec<Option<Illuminance>>, Option<FilterReport>) {
        let expected = self.plan.expected_lx();
        let over = self.over_expected();
        let value = |(k, expected_lx): (usize, f64)| self.value(k, over * expected_lx);
        let mut values: Vec<Option<Illuminance>> =
            expected.into_iter().enumerate().map(value).collect();
        let by_particles = matches!(self.engine, Engine::Forward(_));
        let report = filtered.then(|| self.filter(&mut values, by_particles));
        values.iter_mut().flatten().for_each(without_negative_light);
        (values, report)
    }

    /// Filters indirect light and caustics, and direct light where particles brought it.
    fn filter(&self, values: &mut [Option<Illuminance>], direct: bool) -> FilterReport {
        let coarse = self.plan.indirect_vertices;
        let part = |read: &dyn Fn(&Illuminance) -> Rgb| -> Vec<Rgb> {
            values[..coarse].iter().map(|v| v.as_ref().map_or(Rgb::BLACK, read)).collect()
        };
        let mut parts = vec![part(&|v| v.indirect_lx), part(&|v| v.caustic_lx)];
        if direct {
            parts.push(part(&|v| v.direct_lx - v.caustic_lx));
        }
        let variance: Vec<f64> = (0..coarse)
            .map(|k| self.sums.estimate(k))
            .map(|e| if direct { e.variance } else { e.indirect_variance })
            .collect();
        let filtered = filter(self.plan, &parts, &variance, self.plan.rms_lx);
        let fine: Vec<Vec<Rgb>> =
            filtered.values.iter().map(|part| self.plan.prolongate(part)).collect();
        for (k, value) in values.iter_mut().enumerate() {
            let Some(value) = value else { continue };
            let own_direct = value.direct_lx - value.caustic_lx;
            value.indirect_lx = fine[0][k];
            value.caustic_lx = fine[1][k];
            value.direct_lx = fine.get(2).map_or(own_direct, |part| part[k]) + value.caustic_lx;
        }
        filtered.report
    }

    fn value(&self, vertex: usize, interpolation_error_lx: f64) -> Option<Illuminance> {
        let standing = self.plan.standings[vertex]?;
        let estimate = self.sums.estimate(vertex);
        let mean = estimate.mean;
        Some(Illuminance {
            direct_lx: mean.direct + mean.caustic,
            caustic_lx: mean.caustic,
            indirect_lx: mean.indirect,
            standard_error_lx: (estimate.variance + self.plan.direct_variance[vertex]).sqrt(),
            indirect_standard_error_lx: estimate.indirect_variance.sqrt(),
            interpolation_error_lx,
            standing,
            samples: self.sums.increments * u64::from(self.samples),
        })
    }
}

/// Takes back what noise and overshooting deposits of particles have put below zero, so that the
/// total is not negative, with direct light afresh or without: it can only come nearer to the truth.
fn without_negative_light(value: &mut Illuminance) {
    let direct = value.direct_lx - value.caustic_lx;
    for k in 0..3 {
        let indirect = value.indirect_lx.0[k].max(0.0);
        let caustic = value.caustic_lx.0[k].max(-indirect);
        value.indirect_lx.0[k] = indirect;
        value.caustic_lx.0[k] = caustic;
        value.direct_lx.0[k] = direct.0[k].max(-(indirect + caustic)) + caustic;
    }
}

/// Gathering rays of a receiver and increment that memory allows: half of it may go to the operator,
/// 40 bytes an entry, a fifth more for gloss.
fn most_rays(vertices: usize, max_memory_bytes: u64) -> u32 {
    let most = (max_memory_bytes / 2 / 48 / vertices.max(1) as u64).clamp(8, 1 << 20) as u32;
    if most.is_power_of_two() { most } else { most.next_power_of_two() / 2 }
}
