//! Rays a second: both kernels in turns, so that what else the machine does meets them alike.

use crate::clock::ThreadClock;
use crate::kernel::{Kernel, Together};
use crate::statistics::{Spread, spread};
use isolux_geometry::{Bvh, Ray};
use serde::Serialize;
use std::sync::Barrier;

/// What is asked about each ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Query {
    ClosestHit,
    AnyHit,
}

/// Millions of rays a second.
#[derive(Debug, Serialize)]
pub(crate) struct Rates {
    pub(crate) query: Query,
    pub(crate) threads: usize,
    pub(crate) isolux_mrays_per_s: Spread,
    /// Asked about a thousand rays at a time.
    pub(crate) together_mrays_per_s: Spread,
    pub(crate) embree_mrays_per_s: Option<Spread>,
    /// Of isolux to Embree, turn by turn.
    pub(crate) ratio: Option<Spread>,
    /// The same for rays that isolux is asked about together.
    pub(crate) together_ratio: Option<Spread>,
    /// Of this number of threads to one, turn by turn, for isolux.
    pub(crate) scaling: Spread,
    /// Share of the rays that hit.
    pub(crate) hit_share: f64,
    /// Rays to which the two give different answers.
    pub(crate) differing: Option<usize>,
}

/// Rates of one turn, by number of threads less one.
struct Turn {
    isolux: [f64; THREADS],
    together: [f64; THREADS],
    embree: Option<[f64; THREADS]>,
}

/// All numbers of threads from one to this.
const THREADS: usize = 2;

/// Measures one query with one and with two threads.
pub(crate) fn measure(
    isolux: &Bvh,
    embree: Option<&impl Kernel>,
    query: Query,
    rays: &[Ray],
    turns: usize,
) -> [Rates; THREADS] {
    let turns: Vec<Turn> = (0..turns).map(|k| turn(isolux, embree, query, rays, k)).collect();
    let hits = rays.iter().filter(|ray| is_hit(isolux, query, ray)).count();
    let differing = embree.map(|embree| differing(isolux, embree, query, rays));
    [1, THREADS].map(|threads| {
        let per_turn = |value: &dyn Fn(&Turn) -> f64| spread(turns.iter().map(value).collect());
        let per_turn_with_embree = |value: &dyn Fn(&Turn, f64) -> f64| {
            let values = turns.iter().map(|t| t.embree.map(|e| value(t, e[threads - 1])));
            values.collect::<Option<Vec<f64>>>().map(spread)
        };
        Rates {
            query,
            threads,
            isolux_mrays_per_s: per_turn(&|t| t.isolux[threads - 1]),
            together_mrays_per_s: per_turn(&|t| t.together[threads - 1]),
            embree_mrays_per_s: per_turn_with_embree(&|_, embree| embree),
            ratio: per_turn_with_embree(&|t, embree| t.isolux[threads - 1] / embree),
            together_ratio: per_turn_with_embree(&|t, embree| t.together[threads - 1] / embree),
            scaling: per_turn(&|t| t.isolux[threads - 1] / t.isolux[0]),
            hit_share: hits as f64 / rays.len() as f64,
            differing,
        }
    })
}

/// All kernels, the last one first in every other turn.
fn turn(
    isolux: &Bvh,
    embree: Option<&impl Kernel>,
    query: Query,
    rays: &[Ray],
    number: usize,
) -> Turn {
    let embree_rates = embree.map(|_| [0.0; THREADS]);
    let mut turn = Turn { isolux: [0.0; THREADS], together: [0.0; THREADS], embree: embree_rates };
    for threads in 1..=THREADS {
        let place = threads - 1;
        for kernel in if number.is_multiple_of(2) { [0, 1, 2] } else { [2, 1, 0] } {
            match (kernel, &mut turn.embree, embree) {
                (0, ..) => turn.isolux[place] = rate(isolux, query, rays, threads),
                (1, ..) => turn.together[place] = rate(&Together(isolux), query, rays, threads),
                (_, Some(rates), Some(embree)) => {
                    rates[place] = rate(embree, query, rays, threads);
                }
                _ => {}
            }
        }
    }
    turn
}

/// The sum of the rates of threads that run together, each by its own clock.
fn rate(kernel: &impl Kernel, query: Query, rays: &[Ray], threads: usize) -> f64 {
    let start = Barrier::new(threads);
    std::thread::scope(|scope| {
        let run = |thread: usize| {
            stay_on_processor(thread);
            let (later, first) = rays.split_at(thread * rays.len() / threads);
            start.wait();
            rate_of_thread(kernel, query, [first, later])
        };
        let threads: Vec<_> = (0..threads).map(|k| scope.spawn(move || run(k))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap_or(f64::NAN)).sum()
    })
}

/// Keeps this thread where it is: one that wanders leaves what it has cached behind. Where that cannot
/// be asked for, it may wander.
#[cfg(target_os = "linux")]
fn stay_on_processor(number: usize) {
    use rustix::thread::{CpuSet, sched_setaffinity};
    let mut only = CpuSet::new();
    only.set(number);
    let _refused = sched_setaffinity(None, &only);
}

#[cfg(not(target_os = "linux"))]
fn stay_on_processor(_: usize) {}

fn rate_of_thread(kernel: &impl Kernel, query: Query, rays: [&[Ray]; 2]) -> f64 {
    let clock = ThreadClock::start();
    for rays in rays {
        match query {
            Query::ClosestHit => kernel.ask_closest(rays),
            Query::AnyHit => kernel.ask_any(rays),
        }
    }
    let count: usize = rays.iter().map(|part| part.len()).sum();
    count as f64 / clock.seconds() * 1e-6
}

fn is_hit(kernel: &impl Kernel, query: Query, ray: &Ray) -> bool {
    match query {
        Query::ClosestHit => kernel.closest(ray).is_some(),
        Query::AnyHit => kernel.any(ray),
    }
}

/// Relative difference of two distances that is none: both kernels round in `f32`, and close to
/// grazing the roundings of the corners count many times over.
const SAME_DISTANCE: f32 = 1e-4;

fn differing(a: &impl Kernel, b: &impl Kernel, query: Query, rays: &[Ray]) -> usize {
    let is_same = |ray: &Ray| match query {
        Query::ClosestHit => match (a.closest(ray), b.closest(ray)) {
            (Some(a), Some(b)) => (a.t - b.t).abs() <= SAME_DISTANCE * a.t.max(0.01),
            (a, b) => a.is_none() && b.is_none(),
        },
        Query::AnyHit => a.any(ray) == b.any(ray),
    };
    rays.iter().filter(|ray| !is_same(ray)).count()
}
