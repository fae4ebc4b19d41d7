//! The increments on one mesh: an engine, its sums, and the map made from them.

mod engine;
mod outlook;
mod saved;

use super::request::SolveRequest;
use crate::ablation::without;
use crate::engine::gather::{OF_INTERPOLATED, noise_for};
use crate::engine::judge::{
    BELIEVED_INCREMENTS, Check, Checks, InterpolationErrors, OF_GOAL, Pooled, Verdict, accuracy,
    accuracy_of_map, check_points, energy_bound, filter,
};
use crate::engine::mesh::{HatFunctions, Trust, lend_noise};
use crate::engine::method::{CacheSample, Left, tally};
use crate::engine::particle::{Squared, element_parts};
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, Deadline, Estimate, Noise, Sample};
use crate::map::{Accuracy, FilterReport, Fresh, Method, Unshot, VertexLight};
use crate::units::Rgb;
use engine::{Engine, FEWEST_INCREMENTS};

/// The increments on one mesh.
pub(crate) struct Work<'p, 's> {
    pub(crate) plan: &'p Plan<'s>,
    engine: Engine<'p, 's>,
    pub(crate) sums: Accumulator,
    /// The check points and their sums. Radiosity has no replicates; its sums hold the shots of patches instead.
    pub(crate) checks: Checks,
    /// The mean light of paths given up, lx.
    pub(crate) given_up: Accumulator,
    /// The number of samples of a receiver in an increment: its gathering rays, or one for all particles.
    samples: u32,
    /// The light that radiosity has left to shoot.
    left: Option<Left>,
    /// Whether radiosity ends at its limit of unshot light, however accurate the map is.
    stops_at_unshot: bool,
    /// The relative accuracy goal of the run.
    goal: Option<f64>,
    /// The number of the first increment: zero, but for parts of runs.
    first: u64,
}

impl<'p, 's> Work<'p, 's> {
    /// The duration of an increment, s; `None` if it is unknown before the first one.
    pub(crate) fn pace_s(&mut self) -> Option<f64> {
        match &mut self.engine {
            Engine::Hybrid(hybrid) => Some(hybrid.pace_s()),
            Engine::Cache(cached) => Some(cached.pace_s()),
            Engine::Forward(_) | Engine::Radiosity(_) | Engine::OfPilot => None,
        }
    }

    /// The increments on elements made for a target, with the rays of an increment halved `halvings` times. The rays of
    /// `hybrid` suit the accuracy goal of the request, even if elements are made for a finer target.
    pub(crate) fn new(
        plan: &'p Plan<'s>,
        request: &SolveRequest,
        target: f64,
        halvings: u32,
    ) -> Self {
        let (goal, wanted) = match request.method {
            Method::Hybrid => (request.accuracy.unwrap_or(target), None),
            Method::Cache => (target, None),
            Method::Forward => (target, Some(1)),
            Method::Radiosity => (target, Some(request.radiosity.limits(target).check_rays)),
        };
        let noise = noise(plan, goal, target);
        let by_noise =
            || plan.tried.trial.rays_anywhere(noise, plan.light.reference_lx, FEWEST_INCREMENTS);
        let wanted = wanted.unwrap_or_else(by_noise);
        let most = most_rays(plan, request.max_memory_bytes);
        let rays = (wanted.min(most) >> halvings).max(1);
        let size = (halvings, goal, [rays, most]);
        let prepare = || Engine::prepared(plan, request, (target, noise), size);
        let is_in_time = || !plan.end.has_passed();
        // What was not prepared in time serves nothing.
        let prepared = is_in_time().then(prepare).filter(|_| is_in_time());
        let (points, engine) = prepared.unwrap_or((Vec::new(), Engine::OfPilot));
        let (sums, checks) = no_sums(plan, &engine, points);
        let given_up = Accumulator::new(1, reference_of(plan, &engine));
        let stops_at_unshot = request.radiosity.unshot.is_some();
        let (samples, left, goal) = (rays, None, request.accuracy);
        Self {
            plan,
            engine,
            sums,
            checks,
            given_up,
            samples,
            left,
            stops_at_unshot,
            goal,
            first: 0,
        }
        .in_units_of_light()
        .looked_at()
    }

    /// The increments with sums in units of the expected light. Engines of particles and shots keep one unit, since
    /// single ones may bring far more light than expected.
    fn in_units_of_light(mut self) -> Self {
        if self.has_nets() {
            let (expected, points) = (self.plan.expected(), &self.checks.points);
            self.checks.sums =
                self.checks.sums.expecting(check_points::about_lx(points, &expected));
            self.sums = self.sums.expecting(expected.iter().map(|light| light.luminance()));
        }
        self
    }

    fn looked_at(mut self) -> Self {
        self.look_what_is_left();
        self
    }

    fn look_what_is_left(&mut self) {
        if let Engine::Radiosity(radiosity) = &self.engine {
            self.left = Some(radiosity.left(&self.sums, &self.checks.sums));
        }
    }

    /// Adds one increment and returns the number of rays traced; `None` if its deadline passes before.
    pub(crate) fn increment(&mut self, deadline: &Deadline) -> Option<u64> {
        let index = self.first + self.sums.increments;
        let effort = match &mut self.engine {
            Engine::Hybrid(hybrid) => {
                let made = hybrid.increment(index, &self.checks.points, deadline)?;
                self.sums.add(made.receivers);
                self.checks.sums.add(made.checks);
                self.checks.lacking.add(element_parts::samples(&made.lacking));
                made.effort
            }
            Engine::Cache(cached) => {
                cached.increment(index, &mut self.sums, &mut self.checks, deadline)?
            }
            Engine::Forward(forward) => {
                forward.increment(index, &mut self.sums, &mut self.checks.lacking, deadline)?
            }
            Engine::Radiosity(radiosity) => {
                let left = self.left.as_ref().expect("radiosity always knows what is left");
                radiosity.shoot(&mut self.sums, &mut self.checks.sums, left, deadline)?
            }
            Engine::OfPilot => return None,
        };
        self.look_what_is_left();
        let direct = Rgb::grey(effort.given_up_lx);
        self.given_up.add(std::iter::once(Sample { direct, ..Sample::default() }));
        Some(effort.rays)
    }

    /// Whether there was time to prepare increments.
    pub(crate) const fn is_prepared(&self) -> bool {
        !matches!(self.engine, Engine::OfPilot)
    }

    /// Takes the light of the pilot for the first increment. Nothing is known of its error.
    pub(crate) fn take_light_of_pilot(&mut self) {
        self.engine = Engine::OfPilot;
        self.left = None;
        let points = std::mem::take(&mut self.checks.points);
        (self.sums, self.checks) = no_sums(self.plan, &self.engine, points);
        let indirect = self.plan.prolongate(&self.plan.light.guess);
        let light = self.plan.light.direct.iter().zip(indirect);
        let sample =
            |(&direct, indirect): (&Rgb, Rgb)| Sample { direct, indirect, ..Sample::default() };
        self.sums.add(light.map(sample));
        self.checks.sums.add(vec![Sample::default(); self.checks.sums.sums.len()]);
        self.checks.lacking.add(vec![Sample::default(); self.checks.lacking.sums.len()]);
        self.given_up.add(std::iter::once(Sample::default()));
    }

    /// The mean of indirect light and its bound, lx, if the mean exceeds the energy bound.
    pub(crate) fn beyond_energy(&self, allowed: &energy_bound::Allowed) -> Option<[f64; 2]> {
        allowed.excess_lx(|vertex| match &self.engine {
            Engine::Radiosity(_) => self.estimate(vertex).mean.indirect.luminance(),
            _ => self.sums.indirect_lx(vertex),
        })
    }

    /// The number of increments made ahead that are not added yet.
    pub(crate) fn ahead(&self) -> u64 {
        match &self.engine {
            Engine::Hybrid(hybrid) => hybrid.ahead(),
            _ => 0,
        }
    }

    /// The samples that the `cache` method has made.
    pub(crate) fn made(&mut self) -> Vec<CacheSample> {
        match &mut self.engine {
            Engine::Cache(cached) => cached.made(),
            _ => Vec::new(),
        }
    }

    fn interpolation(&self, trust: Trust, noise_is: Noise) -> InterpolationErrors {
        match &self.engine {
            Engine::Hybrid(_) | Engine::Cache(_) => {
                let Checks { points, sums, .. } = &self.checks;
                let errors = check_points::errors(sums, points, (trust, noise_is));
                let with_direct = |lx: f64| (lx * lx + self.noise_of_direct_lx2()).sqrt();
                let noise_lx = errors.noise_lx.map(with_direct);
                self.with_caustics(InterpolationErrors { noise_lx, ..errors }, noise_is)
            }
            Engine::Forward(_) => {
                self.with_caustics(tally::errors(self.plan, &self.sums), noise_is)
            }
            Engine::OfPilot => InterpolationErrors::default(),
            Engine::Radiosity(radiosity) => {
                let errors = radiosity.errors(&self.sums, &self.checks.points, self.ambient_lx());
                let squared = self.plan.errors.caustics_lx.powi(2);
                let [indirect_lx, total_lx] =
                    [errors.indirect_lx, errors.total_lx].map(|lx| (lx * lx + squared).sqrt());
                InterpolationErrors { indirect_lx, total_lx, ..errors }
            }
        }
    }

    /// The variance of direct light in readings that all increments share, lx2.
    const fn noise_of_direct_lx2(&self) -> f64 {
        match &self.engine {
            Engine::Hybrid(hybrid) => hybrid.noise_of_direct_lx2(),
            Engine::Cache(cached) => cached.noise_of_direct_lx2(),
            Engine::Forward(_) | Engine::Radiosity(_) | Engine::OfPilot => 0.0,
        }
    }

    /// The interpolation errors together with those of caustics, which parts of elements measure. Check points do not.
    fn with_caustics(&self, errors: InterpolationErrors, noise_is: Noise) -> InterpolationErrors {
        let (parts, area_m2) = (&self.plan.errors.parts, self.plan.area_m2());
        if parts.count() == 0 {
            return errors;
        }
        let told = self.caustics_told_lx2(noise_is);
        let squared = told + self.plan.errors.caustics_beside_lx2;
        let [indirect_lx, total_lx] =
            [errors.indirect_lx, errors.total_lx].map(|lx| (lx * lx + squared).sqrt());
        let variance = |vertex: u32| self.sums.estimate(vertex as usize).variance;
        let noise = parts.noise(variance, OF_INTERPOLATED) / area_m2;
        let noise_lx = errors.noise_lx.map(|lx| (lx * lx + noise).sqrt());
        // The standard errors of vertices contain it once the error is known.
        let caustics_lx = if self.is_believed() { told.sqrt() } else { 0.0 };
        InterpolationErrors { indirect_lx, total_lx, caustics_lx, noise_lx, ..errors }
    }

    /// The mean squared interpolation error of caustics in the checked elements, lx2; zero if none are checked.
    fn caustics_told_lx2(&self, noise_is: Noise) -> f64 {
        if self.checks.lacking.sums.is_empty() {
            return 0.0;
        }
        let seen: Squared = self.plan.errors.parts.errors(&self.checks.lacking).into_iter().sum();
        seen.with(noise_is) / self.plan.area_m2()
    }

    /// The light that radiosity has not shot.
    pub(crate) fn unshot(&self) -> Option<Unshot> {
        self.left.as_ref().map(|left| {
            let Left { share, ambient_lx, doubt_lx, .. } = *left;
            Unshot { share, ambient_lx, doubt_lx }
        })
    }

    fn ambient_lx(&self) -> Rgb {
        self.unshot().map_or(Rgb::BLACK, |unshot| unshot.ambient_lx)
    }

    /// The light at a vertex, with its variances.
    fn estimate(&self, vertex: usize) -> Estimate {
        match &self.engine {
            Engine::Radiosity(radiosity) => radiosity.estimate(&self.sums, vertex),
            _ => self.sums.estimate(vertex),
        }
    }

    /// Whether the engine makes few increments, each with many rays of every receiver.
    const fn has_nets(&self) -> bool {
        matches!(self.engine, Engine::Hybrid(_) | Engine::Cache(_))
    }

    pub(crate) fn is_believed(&self) -> bool {
        let fewest = match self.engine {
            Engine::Radiosity(_) => 1,
            _ => BELIEVED_INCREMENTS,
        };
        self.sums.increments >= fewest
    }

    /// The limits beyond which readers gather afresh; `None` if readers only interpolate.
    pub(crate) fn fresh(&self) -> Option<Fresh> {
        if !self.is_believed() || matches!(self.engine, Engine::Forward(_)) {
            return None;
        }
        let judged = self.judged(Noise::Counted);
        let over = judged.over_expected();
        let limit_lx = judged.trust.up_to_lx() * over;
        Some(Fresh {
            above_lx: limit_lx.is_finite().then_some(limit_lx),
            in_gaps_alone: judged.trust == Trust::AllButGaps,
            lookup_lx: judged.errors.untrusted_lx,
        })
    }

    pub(crate) fn accuracy(&self) -> Option<Accuracy> {
        if self.is_believed() { self.accuracy_if(Noise::Counted) } else { None }
    }

    fn accuracy_if(&self, noise_is: Noise) -> Option<Accuracy> {
        self.judged(noise_is).accuracy
    }

    /// The verdict on the map by check points, for the trust of readers that they allow.
    fn judged(&self, noise_is: Noise) -> Verdict {
        let pooled = self.left.is_none().then(|| Pooled::of(self.plan, |k| self.sums.estimate(k)));
        let by = |trust: Trust| {
            let errors = self.interpolation(trust, noise_is);
            Verdict { trust, errors, accuracy: self.accuracy_by(pooled.as_ref(), &errors) }
        };
        let Some(goal) = self.goal.filter(|_| self.has_nets()) else {
            return by(self.plan.trust());
        };
        let judged = Verdict::for_goal(goal, self.plan.errors.trusts, by);
        // Trust in all but gaps is decided only once the error is known.
        if noise_is != Noise::Counted || !self.is_believed() {
            return judged;
        }
        let is_enough = |accuracy: &Accuracy| {
            let error = libm::hypot(accuracy.statistical, accuracy.discretization);
            let lx = error.max(OF_GOAL * goal) * self.plan.light.reference_lx;
            let Checks { sums, points, .. } = &self.checks;
            !check_points::is_gathering_worth_while(sums, points, judged.trust, lx)
        };
        judged.or_all_but_gaps(goal, is_enough, by)
    }

    fn accuracy_by(
        &self,
        pooled: Option<&Pooled>,
        interpolation: &InterpolationErrors,
    ) -> Option<Accuracy> {
        if self.left.as_ref().is_some_and(|left| !left.is_bounded) {
            return None;
        }
        let given_up_lx = match &self.engine {
            Engine::Radiosity(radiosity) => radiosity.given_up_lx(),
            _ => self.given_up.estimate(0).mean.direct.luminance(),
        };
        let errors = InterpolationErrors { given_up_lx, ..*interpolation };
        let Some(pooled) = pooled else {
            let ambient_lx = self.ambient_lx();
            let doubt_lx = self.left.as_ref().map_or(0.0, |left| left.doubt_lx);
            let estimate = |vertex: usize| {
                let mut estimate = self.estimate(vertex).in_doubt_by(doubt_lx);
                estimate.mean.indirect += ambient_lx;
                estimate
            };
            return accuracy_of_map(self.plan, estimate, &errors);
        };
        accuracy(self.plan, pooled, &errors)
    }

    /// The values of the map, and the report of the filter.
    pub(crate) fn values(
        &self,
        filtered: bool,
    ) -> (Vec<Option<VertexLight>>, Option<FilterReport>) {
        let judged = self.is_believed().then(|| self.judged(Noise::Counted));
        let trust = judged.map_or(self.plan.trust(), |judged| judged.trust);
        let expected = self.plan.expected_lx(trust);
        let over = judged.as_ref().map_or(1.0, Verdict::over_expected);
        let of_caustics = self.caustic_variances();
        let value = |(k, expected_lx): (usize, f64)| {
            self.value(k, over * expected_lx, of_caustics.get(k).map_or(0.0, |lx2| lx2.0[0]))
        };
        let mut values: Vec<Option<VertexLight>> =
            expected.into_iter().enumerate().map(value).collect();
        let by_particles = matches!(self.engine, Engine::Forward(_));
        self.hold_deposits(&mut values, by_particles);
        let report = filtered.then(|| self.filter(&mut values, by_particles));
        if self.left.is_none() && !without("neighbour-noise") {
            lend_noise(&self.plan.mesh.elements, &mut values);
        }
        (values, report)
    }

    /// Bounds the light of particles where deposits overshoot: caustics, or all light.
    fn hold_deposits(&self, values: &mut [Option<VertexLight>], all: bool) {
        if !all && !self.plan.lighting.leaves_caustics() {
            return;
        }
        let hats = HatFunctions::new(&self.plan.mesh.subdivision, &self.plan.mesh.standings);
        let held = |read: &dyn Fn(&VertexLight) -> Rgb| -> Vec<Rgb> {
            let some = values[..self.plan.mesh.indirect_vertices].iter();
            let some: Vec<Rgb> = some.map(|v| v.as_ref().map_or(Rgb::BLACK, read)).collect();
            self.plan.prolongate(&hats.held(&some))
        };
        let caustic = held(&|v| v.caustic_lx);
        let others = all.then(|| [held(&|v| v.direct_lx - v.caustic_lx), held(&|v| v.indirect_lx)]);
        for (k, value) in values.iter_mut().enumerate() {
            let Some(value) = value else { continue };
            let mut direct = value.direct_lx - value.caustic_lx;
            if let Some([of_direct, of_indirect]) = &others {
                (direct, value.indirect_lx) = (of_direct[k], of_indirect[k]);
            }
            value.caustic_lx = caustic[k];
            value.direct_lx = direct + caustic[k];
        }
    }

    /// Filters indirect light and caustics, and direct light if particles have brought it.
    fn filter(&self, values: &mut [Option<VertexLight>], direct: bool) -> FilterReport {
        let coarse = self.plan.mesh.indirect_vertices;
        let part = |read: &dyn Fn(&VertexLight) -> Rgb| -> Vec<Rgb> {
            values[..coarse].iter().map(|v| v.as_ref().map_or(Rgb::BLACK, read)).collect()
        };
        let mut parts = vec![part(&|v| v.indirect_lx), part(&|v| v.caustic_lx)];
        if direct {
            parts.push(part(&|v| v.direct_lx - v.caustic_lx));
        }
        let variance: Vec<f64> = (0..coarse)
            .map(|k| self.estimate(k))
            .map(|e| if direct { e.variance } else { e.indirect_variance })
            .collect();
        let filtered = filter(self.plan, &parts, &variance, self.plan.light.reference_lx);
        let for_bare = self.plan.mesh.gathering_for_bare.iter();
        let for_bare = for_bare.map(|&v| values[v as usize].map_or(Rgb::BLACK, |v| v.indirect_lx));
        let for_bare: Vec<Rgb> = for_bare.collect();
        let fine = |(part, values): (usize, &Vec<Rgb>)| {
            self.plan.prolongate_beside(values, if part == 0 { &for_bare } else { &[] })
        };
        let fine: Vec<Vec<Rgb>> = filtered.values.iter().enumerate().map(fine).collect();
        for (k, value) in values.iter_mut().enumerate() {
            let Some(value) = value else { continue };
            let own_direct = value.direct_lx - value.caustic_lx;
            value.indirect_lx = fine[0][k];
            value.caustic_lx = fine[1][k];
            value.direct_lx = fine.get(2).map_or(own_direct, |part| part[k]) + value.caustic_lx;
        }
        filtered.report
    }

    /// The number of samples of a receiver in an increment. An interpolated receiver has that of a usual one.
    fn samples_of(&self, vertex: usize) -> u32 {
        let own = match &self.engine {
            Engine::Hybrid(hybrid) => hybrid.rays_of(vertex),
            _ => 0,
        };
        if own > 0 { own } else { self.samples }
    }

    /// The squared interpolation error of caustics at every vertex, lx2, which counts as noise; empty if it is not
    /// known.
    fn caustic_variances(&self) -> Vec<Rgb> {
        if self.checks.lacking.sums.is_empty() || !self.is_believed() {
            return Vec::new();
        }
        let mut variances = vec![Rgb::BLACK; self.plan.mesh.indirect_vertices];
        let parts = &self.plan.errors.parts;
        for (vertex, lx2) in parts.at_vertices(&parts.errors(&self.checks.lacking)) {
            variances[vertex as usize] = Rgb::grey(lx2);
        }
        self.plan.prolongate(&variances)
    }

    fn value(
        &self,
        vertex: usize,
        interpolation_error_lx: f64,
        caustic_variance: f64,
    ) -> Option<VertexLight> {
        let standing = self.plan.mesh.standings[vertex]?;
        let estimate = self.estimate(vertex);
        let mean = estimate.mean;
        // The estimate of radiosity contains this variance.
        let direct_variance = match self.engine {
            Engine::Radiosity(_) => 0.0,
            _ => self.plan.light.direct_variance[vertex],
        };
        Some(VertexLight {
            direct_lx: mean.direct + mean.caustic,
            caustic_lx: mean.caustic,
            indirect_lx: mean.indirect,
            standard_error_lx: (estimate.variance + direct_variance + caustic_variance).sqrt(),
            indirect_standard_error_lx: (estimate.indirect_variance + caustic_variance).sqrt(),
            common_error_lx: estimate.common_variance.min(estimate.indirect_variance).sqrt(),
            interpolation_error_lx,
            standing,
            samples: self.sums.increments * u64::from(self.samples_of(vertex)),
        })
    }
}

/// The relative noise that a map may have to reach a goal. Elements are made for a finer target if those for the goal
/// had larger errors than expected. Their errors are taken to exceed the expected ones by the same factor.
fn noise(plan: &Plan, goal: f64, target: f64) -> f64 {
    noise_for(goal, plan.errors.interpolation * goal / target)
}

/// The largest number of gathering rays of a receiver and increment for the allowed memory, a power of two. Half of the
/// memory may go to the operator, at 40 bytes an entry and a fifth more for gloss.
fn most_rays(plan: &Plan, max_memory_bytes: u64) -> u32 {
    let vertices = plan.mesh.indirect_vertices + plan.mesh.gathering_for_bare.len();
    let most = (max_memory_bytes / 2 / 48 / vertices.max(1) as u64).clamp(8, 1 << 20) as u32;
    if most.is_power_of_two() { most } else { most.next_power_of_two() / 2 }
}

/// The reference illuminance for the units of sums, lx.
fn reference_of(plan: &Plan, engine: &Engine) -> f64 {
    match engine {
        Engine::Radiosity(radiosity) => radiosity.reference_lx(),
        _ => plan.light.reference_lx,
    }
}

/// The sums of receivers and of check points before the first increment.
fn no_sums(plan: &Plan, engine: &Engine, points: Vec<Check>) -> (Accumulator, Checks) {
    let parts = plan.errors.parts.count();
    let (places, parts) = match engine {
        Engine::Radiosity(radiosity) => (radiosity.patches(), 0),
        Engine::Cache(_) => (check_points::places(&points, false), parts),
        Engine::Hybrid(_) => (check_points::places(&points, true), parts),
        Engine::Forward(_) | Engine::OfPilot => (0, parts),
    };
    let sums_of = |places: usize| Accumulator::new(places, reference_of(plan, engine));
    let sums = sums_of(plan.mesh.elements.vertices().len());
    let checks = Checks { points, sums: sums_of(places), lacking: sums_of(parts) };
    (sums, checks)
}
