//! A run: pilot, increments, stop, map.

use super::accumulate::{Accumulator, MAX_INCREMENTS};
use super::accuracy::{BELIEVED_INCREMENTS, accuracy};
use super::checks::{self, Check};
use super::direct::Lighting;
use super::emission::Emission;
use super::forward::Forward;
use super::hybrid::Hybrid;
use super::pilot::{PilotRequest, Plan, pilot};
use super::predict;
use super::request::{Progress, SolveError, SolveRequest, Stage, Watch};
use super::tally;
use crate::map::{Accuracy, Illuminance, IlluminationMap, Method, Provenance};
use crate::sampling::Key;
use crate::scene::Scene;
use std::time::Instant;

/// Increments before a run may stop at its accuracy: the estimates of single receivers need them.
const FEWEST_INCREMENTS: u64 = 16;
/// Meshes tried before a run settles for what it has.
const MOST_STAGES: u32 = 4;
/// Accuracy that elements are made for where none is asked.
const DEFAULT_ACCURACY: f64 = 0.01;
/// Memory of a vertex, bytes: the subdivision with its edges, the operator's entries at the fewest
/// rays, sums and values. Measured on rooms; rounded up.
const BYTES_A_VERTEX: u64 = 2400;

/// Computes the illumination map of a scene.
///
/// `watch` is called after every round of the pilot and every increment and may stop the run; the
/// map is valid then, too. Everything but the moment of stopping depends only on the scene and the
/// request: a run that stops at its accuracy gives the same bits on any number of threads.
pub fn solve(
    scene: &Scene,
    request: &SolveRequest,
    watch: &mut dyn FnMut(&Progress) -> Watch,
) -> Result<IlluminationMap, SolveError> {
    check(scene, request)?;
    let lighting = Lighting::new(scene);
    let mut run = Run { scene, request, started: Instant::now(), rays: 0, stopped: false };
    let mut target = request.accuracy.unwrap_or(DEFAULT_ACCURACY);
    for stage in 1.. {
        let plan = run.pilot(&lighting, target, watch);
        let outcome = run.increments(&plan, target, stage == MOST_STAGES, watch);
        match outcome {
            Outcome::Done(map) => return Ok(*map),
            Outcome::TooCoarse => target *= 0.5,
        }
    }
    Err(SolveError::Stopped)
}

/// What came of the increments on one mesh.
enum Outcome {
    Done(Box<IlluminationMap>),
    /// The elements are too coarse for the accuracy asked for.
    TooCoarse,
}

fn check(scene: &Scene, request: &SolveRequest) -> Result<(), SolveError> {
    if Emission::new(scene).is_none() {
        return Err(SolveError::NoLight);
    }
    let vertices = crate::elements::Subdivision::new(scene).vertex_count() as u64;
    if vertices == 0 {
        return Err(SolveError::NoReceiver);
    }
    let needed = vertices * BYTES_A_VERTEX;
    if needed > request.max_memory_bytes {
        return Err(SolveError::Memory { needed, allowed: request.max_memory_bytes });
    }
    Ok(())
}

struct Run<'s, 'r> {
    scene: &'s Scene,
    request: &'r SolveRequest,
    started: Instant,
    rays: u64,
    stopped: bool,
}

impl<'s> Run<'s, '_> {
    fn elapsed_s(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    fn out_of_time(&self) -> bool {
        self.request.time_limit.is_some_and(|limit| self.started.elapsed() >= limit)
    }

    fn pilot(
        &mut self,
        lighting: &'s Lighting<'s>,
        target: f64,
        watch: &mut dyn FnMut(&Progress) -> Watch,
    ) -> Plan<'s> {
        let request = PilotRequest {
            target,
            mesh_target: self.request.mesh_accuracy,
            seed: self.request.seed,
            max_vertices: (self.request.max_memory_bytes / BYTES_A_VERTEX) as usize,
        };
        let before = self.rays;
        let scene = self.scene;
        let plan = pilot(scene, lighting, &request, &mut |receivers, rays| {
            self.rays = before + rays;
            let progress = self.progress(Stage::Pilot, 0, receivers as u64, None);
            self.stopped |= watch(&progress) == Watch::Stop;
            !self.stopped && !self.out_of_time()
        });
        self.rays = before + plan.rays;
        plan
    }

    fn progress(
        &self,
        stage: Stage,
        increments: u64,
        receivers: u64,
        accuracy: Option<Accuracy>,
    ) -> Progress {
        Progress {
            stage,
            increments,
            accuracy,
            target: self.request.accuracy,
            receivers,
            rays: self.rays,
            elapsed_s: self.elapsed_s(),
            prediction: None,
        }
    }

    /// Increments until the accuracy is reached, the time is up, or the watcher stops.
    fn increments(
        &mut self,
        plan: &Plan<'s>,
        target: f64,
        last_stage: bool,
        watch: &mut dyn FnMut(&Progress) -> Watch,
    ) -> Outcome {
        let mut work = Work::new(plan, self.request, target);
        let started_s = self.elapsed_s();
        loop {
            self.rays += work.increment();
            let accuracy = work.accuracy();
            let count = work.sums.increments;
            let mut progress =
                self.progress(Stage::Increments, count, work.sums.sums.len() as u64, accuracy);
            let goal = self.request.accuracy;
            let needed =
                accuracy.zip(goal).map(|(a, goal)| predict::increments_needed(&a, count, goal));
            progress.prediction = needed.flatten().map(|needed| {
                let needed = needed.max(FEWEST_INCREMENTS as f64);
                predict::finish(needed, count, started_s, progress.elapsed_s)
            });
            let reached = count >= FEWEST_INCREMENTS
                && accuracy.zip(goal).is_some_and(|(a, goal)| a.reached <= goal);
            self.stopped |= watch(&progress) == Watch::Stop;
            if reached || self.stopped || self.out_of_time() || count >= MAX_INCREMENTS {
                return Outcome::Done(Box::new(self.map(&work, accuracy, reached)));
            }
            // No number of increments helps where interpolation alone takes the whole error.
            let hopeless = matches!(needed, Some(None)) && count >= FEWEST_INCREMENTS;
            if hopeless && !last_stage && self.request.method == Method::Hybrid {
                return Outcome::TooCoarse;
            }
            if hopeless && work.is_settled(accuracy) {
                return Outcome::Done(Box::new(self.map(&work, accuracy, false)));
            }
        }
    }

    fn map(&self, work: &Work, accuracy: Option<Accuracy>, reached: bool) -> IlluminationMap {
        let increments = work.sums.increments;
        IlluminationMap {
            elements: work.plan.elements.clone(),
            values: (0..work.plan.known.len()).map(|k| work.value(k)).collect(),
            provenance: Provenance {
                scene: self.scene.name().to_owned(),
                scene_hash: self.scene.hash(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
                method: self.request.method,
                seed: self.request.seed,
                increments,
                rays: self.rays,
                time_s: self.elapsed_s(),
                accuracy_target: self.request.accuracy,
                complete: reached || self.request.accuracy.is_none(),
                accuracy,
            },
        }
    }
}

/// The increments on one mesh.
struct Work<'p, 's> {
    plan: &'p Plan<'s>,
    engine: Engine<'p, 's>,
    sums: Accumulator,
    checks: Checks,
    rays_a_value: u64,
}

enum Engine<'p, 's> {
    Hybrid(Hybrid<'p, 's>),
    Forward(Forward<'p, 's>),
}

/// The points that the hybrid engine checks itself at.
struct Checks {
    points: Vec<Check>,
    sums: Accumulator,
}

impl<'p, 's> Work<'p, 's> {
    fn new(plan: &'p Plan<'s>, request: &SolveRequest, target: f64) -> Self {
        let reference = plan.rms_lx;
        let points = match request.method {
            Method::Hybrid => checks::draw(plan, Key::new(request.seed).with(3)),
            Method::Forward => Vec::new(),
        };
        let sums = Accumulator::new(plan.elements.vertices().len(), reference);
        let check_sums = Accumulator::new(points.len(), reference);
        let checks = Checks { points, sums: check_sums };
        let rays = gathering_rays(target, plan.indirect_vertices, request.max_memory_bytes);
        let engine = match request.method {
            Method::Hybrid => Engine::Hybrid(Hybrid::new(plan, &checks.points, rays, request.seed)),
            Method::Forward => {
                let emission = Emission::new(plan.scene).expect("a scene without light is refused");
                Engine::Forward(Forward::new(plan, emission, request.seed))
            }
        };
        Self { plan, engine, sums, checks, rays_a_value: u64::from(rays) }
    }

    fn increment(&mut self) -> u64 {
        let index = self.sums.increments;
        match &self.engine {
            Engine::Hybrid(hybrid) => {
                hybrid.increment(index, &mut self.sums, &self.checks.points, &mut self.checks.sums)
            }
            Engine::Forward(forward) => forward.increment(index, &mut self.sums),
        }
    }

    fn accuracy(&self) -> Option<Accuracy> {
        if self.sums.increments < BELIEVED_INCREMENTS {
            return None;
        }
        let interpolation = match self.engine {
            Engine::Hybrid(_) => checks::errors(&self.checks.sums, &self.checks.points),
            Engine::Forward(_) => tally::errors(self.plan, &self.sums),
        };
        accuracy(self.plan, &self.sums, &interpolation)
    }

    /// Whether more increments would change little: noise is a small part of the error.
    fn is_settled(&self, accuracy: Option<Accuracy>) -> bool {
        accuracy.is_some_and(|a| a.statistical <= 0.25 * a.discretization)
    }

    fn value(&self, vertex: usize) -> Option<Illuminance> {
        if !self.plan.known[vertex] {
            return None;
        }
        let estimate = self.sums.estimate(vertex);
        let mean = estimate.mean;
        Some(Illuminance {
            direct_lx: mean.direct + mean.caustic,
            caustic_lx: mean.caustic,
            indirect_lx: mean.indirect,
            standard_error_lx: estimate.variance.sqrt(),
            indirect_standard_error_lx: estimate.indirect_variance.sqrt(),
            samples: self.sums.increments * self.rays_a_value,
        })
    }
}

/// Gathering rays of a receiver and increment: so many that about sixteen increments suffice for the
/// accuracy where one ray spreads by a quarter of the light, as far as memory allows.
fn gathering_rays(target: f64, vertices: usize, max_memory_bytes: u64) -> u32 {
    let wanted = ((0.64 / target.max(1e-6)) as u64).clamp(16, 1024).next_power_of_two();
    // Half the memory may go to the operator, 40 bytes an entry, a fifth more for gloss.
    let most = (max_memory_bytes / 2 / 48 / vertices.max(1) as u64).max(8);
    let most = if most.is_power_of_two() { most } else { most.next_power_of_two() / 2 };
    wanted.min(most) as u32
}
