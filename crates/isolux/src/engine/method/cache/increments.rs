//! `cache`: the increments of a map that is read from samples.
//!
//! An increment is an independent replicate of the cache, with its own random rays at every sample and its
//! own fixed point of the light between samples. The positions of samples are fixed before the first
//! increment.

use super::super::caustics::Caustics;
use super::super::{caustics, hybrid};
use super::hemisphere::{Light, tied};
use super::layer::Tie;
use super::placing::Place;
use super::store::{LEAST_RADIUS_AT_VERTICES, Making, Replicate, Store};
use super::{CACHE_REPLICATES, CacheSample, IrradianceCache};
use crate::engine::judge::{Check, Checks, DirectThere, check_points};
use crate::engine::particle::element_parts;
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, Deadline, Effort, NEVER, Sample, SurfacePoint};
use crate::sampling::Key;
use crate::units::Rgb;
use rayon::prelude::*;
use std::time::Instant;

/// The allowed error of the split-sphere model for an accuracy of one per cent. With gradients, the true
/// error is about its square. Measured on CUBE and SPHERE.
const ALLOWED_AT_ONE_PERCENT: f64 = 0.35;
/// The least allowed error.
const LEAST_ALLOWED: f64 = 0.05;
/// The largest allowed error.
const MOST_ALLOWED: f64 = 0.6;

/// The rays of a far sample, as a share of those of a near one. Readings average the noise of many far
/// samples.
const FAR_RAYS: f64 = 0.5;
/// The least number of rays of a near sample.
const FEWEST_RAYS: u32 = 32;
/// The least number of rays of a far sample.
const FEWEST_FAR_RAYS: u32 = 16;

/// The method, ready for increments.
pub(crate) struct Cached<'p, 's> {
    plan: &'p Plan<'s>,
    store: Store<'s>,
    /// The contributions of near samples to vertices.
    ties: Vec<Vec<Tie>>,
    checks: Vec<Place>,
    far_ties: Vec<Vec<Tie>>,
    check_direct: DirectThere,
    rays: u32,
    /// The number of particles for caustics per increment.
    particles: u32,
    key: Key,
}

/// The allowed error that samples are placed for, given the accuracy goal.
pub(super) fn allowed(target: f64) -> f64 {
    (ALLOWED_AT_ONE_PERCENT * (target / 0.01).sqrt()).clamp(LEAST_ALLOWED, MOST_ALLOWED)
}

impl<'p, 's> Cached<'p, 's> {
    /// The method, with samples placed for the vertices of a plan beside those of a cache.
    pub(crate) fn new(
        plan: &'p Plan<'s>,
        checks: &[Check],
        (cache, target): (&IrradianceCache, f64),
        wanted: u32,
        seed: u64,
    ) -> Self {
        let key = Key::new(seed).with(6);
        let mut store = Store::new(plan.scene, cache, (allowed(target), LEAST_RADIUS_AT_VERTICES));
        let place = |vertex: usize| {
            let carries = plan.mesh.standings[vertex].is_some()
                && plan.mesh.carriers.is_active(vertex as u32);
            carries.then(|| Place::from(&plan.mesh.gatherers[vertex]))
        };
        let places: Vec<Option<Place>> = (0..plan.mesh.indirect_vertices).map(place).collect();
        store.serve(places.iter().flatten().copied().collect(), &plan.end);
        store.guess(&Making {
            index: 0,
            rays: FEWEST_FAR_RAYS,
            key: key.with(0),
            lighting: plan.lighting,
            bright: plan.light.bright.as_deref(),
            caustic: &|_| Rgb::BLACK,
            deadline: &plan.end,
        });
        let ties = |place: &Option<Place>| place.map_or(Vec::new(), |place| store.ties(&place));
        let ties = places.par_iter().map(ties).collect();
        let checked: Vec<Place> = checks.iter().map(|check| Place::from(&check.gatherer)).collect();
        let far_ties = checked.par_iter().map(|place| store.far_ties(place)).collect();
        let check_direct = check_points::direct(plan, checks, target, (key.with(0), &plan.end));
        let rays = wanted.max(FEWEST_RAYS).next_power_of_two();
        let particles = plan.particles(target, CACHE_REPLICATES as u64);
        Self { plan, store, ties, checks: checked, far_ties, check_direct, rays, particles, key }
    }

    /// The variance of direct light in readings that all increments have in common, lx2.
    pub(crate) const fn noise_of_direct_lx2(&self) -> f64 {
        self.check_direct.noise_lx2
    }

    /// The approximate duration of an increment, s, from a part of the check points.
    pub(crate) fn pace_s(&mut self) -> f64 {
        let started = Instant::now();
        let making = Making {
            index: 0,
            rays: FEWEST_RAYS,
            key: self.key.with(u64::MAX),
            lighting: self.plan.lighting,
            bright: self.plan.light.bright.as_deref(),
            caustic: &|_| Rgb::BLACK,
            deadline: &NEVER,
        };
        let places: Vec<Place> = self.checks.iter().step_by(8).copied().collect();
        self.store.fresh(
            &places,
            &making,
            &vec![Default::default(); self.store.far.layer.sites.len()],
        );
        let a_ray_s =
            started.elapsed().as_secs_f64() / (places.len().max(1) as f64 * f64::from(FEWEST_RAYS));
        let near = self.store.near.layer.sites.len() as f64 * f64::from(self.rays);
        let far = self.store.far.layer.sites.len() as f64 * f64::from(self.far_rays());
        let checked = self.checks.len() as f64 * f64::from(self.rays);
        a_ray_s * (near + far + checked)
    }

    fn far_rays(&self) -> u32 {
        ((f64::from(self.rays) * FAR_RAYS) as u32).max(FEWEST_FAR_RAYS)
    }

    /// Adds increment `index`; adds nothing and returns `None` if the deadline passes meanwhile.
    pub(crate) fn increment(
        &mut self,
        index: u64,
        receivers: &mut Accumulator,
        checks: &mut Checks,
        deadline: &Deadline,
    ) -> Option<Effort> {
        let (plan, key) = (self.plan, self.key.with(1 + index));
        let Checks { points: checks, sums: check_sums, lacking: lacking_sums } = checks;
        let (direct, check_direct) =
            hybrid::direct_light(plan, (&self.check_direct, checks), key.with(0), deadline)?;
        let Caustics { light: caustic, means: reflected_on, lacking, effort: particles } =
            caustics::deposit(plan, self.particles, key.with(1), deadline)?;
        let caustic_at = |at: &SurfacePoint| caustic_at(plan, &reflected_on, at);
        let (lighting, bright) = (plan.lighting, plan.light.bright.as_deref());
        let making = |part: u64, rays: u32| Making {
            index,
            rays,
            key: self.key.with(u64::MAX - part),
            lighting,
            bright,
            caustic: &caustic_at,
            deadline,
        };
        let (for_far, for_near) = (making(1, self.far_rays()), making(2, self.rays));
        let for_checks = making(3, self.rays);
        let Replicate { lights: far, rays: far_rays, lost: far_lost, unsettled_lx } =
            self.store.far_replicate(&for_far)?;
        let Replicate { lights: near, rays: near_rays, lost, .. } =
            self.store.near_replicate(&for_near, &far)?;
        let (fresh, check_rays) = self.store.fresh(&self.checks, &for_checks, &far);
        let mut gathered: Vec<Rgb> = self.ties.par_iter().map(|ties| tied(ties, &near)).collect();
        plan.mesh.waiting.fill(&mut gathered);
        let gathered = plan.mesh.fit.apply(&gathered);
        let lookups = self.lookups(&far, &fresh, &check_direct);
        let (indirect, caustic) = (plan.prolongate(&gathered), plan.prolongate(&caustic));
        let map = [direct.as_slice(), &caustic, &indirect];
        check_sums.add(check_points::samples(checks, (&fresh, &check_direct), map, Some(&lookups)));
        lacking_sums.add(element_parts::samples(&lacking));
        receivers.add((0..direct.len()).map(|k| Sample {
            direct: direct[k],
            caustic: caustic[k],
            indirect: indirect[k],
            passed_on: 0.0,
        }));
        Some(Effort {
            rays: far_rays + near_rays + check_rays + particles.rays,
            given_up_lx: particles.given_up_lx
                + (lost + far_lost) * plan.light.reference_lx
                + unsettled_lx,
        })
    }

    /// The error at check points of light that rays read from far samples, compared with light gathered
    /// there, lx.
    fn lookups(&self, far: &[Light], fresh: &[Rgb], direct: &[Rgb]) -> Vec<Rgb> {
        let is_direct_read = self.plan.lighting.are_read_at_ends();
        let lookup = |k: usize| {
            // No ray reads where no sample is.
            if self.far_ties[k].is_empty() {
                return Rgb::BLACK;
            }
            let direct = if is_direct_read { direct[k] } else { Rgb::BLACK };
            tied(&self.far_ties[k], far) - fresh[k] - direct
        };
        (0..fresh.len()).map(lookup).collect()
    }

    /// The samples made, if all their replicates are complete.
    pub(crate) fn made(&mut self) -> Vec<CacheSample> {
        self.store.make_known()
    }
}

/// The caustics at the end of a ray, interpolated from vertices, lx.
fn caustic_at(plan: &Plan, caustic: &[Rgb], at: &SurfacePoint) -> Rgb {
    if plan.lighting.leaves_caustics() {
        plan.read(plan.mesh.level, caustic, at)
    } else {
        Rgb::BLACK
    }
}
