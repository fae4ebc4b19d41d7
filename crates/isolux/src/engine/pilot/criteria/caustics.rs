//! Adaptive refinement for caustics, from trial particles.
//!
//! Receivers cannot find caustics; only particles do. Independent batches of trial particles are sent before the
//! first increment. On the present elements each batch makes the map of an increment, and counts the flux that
//! comes to each part of every element. The product of the differences of two batches is an unbiased estimate of
//! the squared interpolation error; its spread over batches is the noise.
//!
//! Elements are bisected where the error stands out from the noise. Elsewhere particles are added. Particles are
//! first kept and placed on every new mesh. If increments will need far more of them, new ones are sent for every
//! mesh and are not kept.

use super::batches::{BATCHES, Batches, Brought};
use super::{Criterion, Marked, Which};
use crate::elements::Subdivision;
use crate::engine::judge::Light;
use crate::engine::mesh::{HatFunctions, MARKED_SHARE};
use crate::engine::particle::{
    CausticNoise, DOUBT_SHARE, ElementParts, PARTS, Squared, read_in_parts, squared_error,
};
use crate::engine::pilot::direct::MOST_MEAN_REFLECTANCE;
use crate::engine::pilot::forecast::{FINE_EXCESS, GoOn};
use crate::engine::pilot::look::{PilotRequest, Survey};
use crate::engine::pilot::state::{Pilot, SHARP_EDGE_SHARE};
use crate::engine::ray::Noise;
use crate::map::Standing;
use crate::units::Rgb;
use rayon::prelude::*;

/// The ratio of all light with caustics to that without, root mean square, above which caustics count as light.
const CAUSTIC_LIGHT_RATIO: f64 = 1.25;

/// The first number of particles of a batch.
const FIRST_BATCH_PARTICLES: u32 = 1 << 11;
/// The largest number of particles of a batch whose deposits are kept.
const MOST_KEPT_PARTICLES: u32 = 1 << 18;
/// The largest number of particles of a batch for one mesh.
const MOST_BATCH_PARTICLES: u32 = 1 << 22;
/// The number of particles of a batch that are processed together if they are not kept.
const PARTICLES_AT_ONCE: u32 = 1 << 15;
/// The largest number of trial particles for one mesh, as a share of those that increments will need.
const PARTICLES_AHEAD_SHARE: f64 = 0.5;
/// The largest number of rounds.
const MOST_ROUNDS: usize = 96;

/// The allowed interpolation error of caustics, as a share of the accuracy goal.
const ERROR_SHARE: f64 = 0.3;
/// The same share where it takes more particles to find the places of the error than its size.
const MOST_ERROR_SHARE: f64 = 0.5;

/// The least number of deposits in an element that is bisected.
const FEWEST_DEPOSITS: usize = 16;

/// The least squared error of all candidates for bisection, as a share of the allowed squared error.
const LEAST_CANDIDATE_ERROR_SHARE: f64 = 0.25;

/// The largest number of elements that increments check.
const MOST_CHECKED_ELEMENTS: usize = 8192;
/// The allowed squared error of all other elements, as a share of the allowed squared error.
const UNCHECKED_ERROR_SHARE: f64 = 0.02;

/// The least ratio of a squared error to its standard error at which the error is believed. With 1.5, chance finds
/// thousands of elements: 1 % below a ball of glass takes 139 s in place of 21 s. With 3, 2 % below a ball and a
/// panel takes twice as long (decision 29).
const BELIEVED_ERROR_RATIO: f64 = 2.5;
/// The same ratio where every mesh takes new particles. Few meshes are made then.
const LIKELY_ERROR_RATIO: f64 = 2.0;

/// The measured error of an element.
#[derive(Clone, Copy, Debug)]
struct Seen {
    node: u32,
    /// The number of deposits of all batches.
    deposits: usize,
    squared: Squared,
}

/// The interpolation errors of caustics on the elements.
#[derive(Debug, Default)]
pub(crate) struct CausticErrors {
    /// The root mean square error over the surface, lx.
    pub(crate) lx: f64,
    /// The sum of the squared errors, lx2 m2.
    all: Squared,
    /// The errors by element, the worst first.
    seen: Vec<Seen>,
    /// The number of the worst elements that increments are to check.
    checked: usize,
    /// The mean squared error of all others over the surface, lx2.
    pub(crate) beside_lx2: f64,
}

/// The goals of the refinement: the area, m2, the squared accuracy goal over that area, lx2 m2, and the squared
/// error allowed for caustics, lx2 m2.
#[derive(Clone, Copy)]
struct Asked {
    area_m2: f64,
    goal: f64,
    allowed: f64,
}

impl CausticErrors {
    /// The error as a share of the reference light.
    pub(crate) fn share(&self, reference_lx: f64) -> f64 {
        self.lx / reference_lx.max(f64::MIN_POSITIVE)
    }

    /// Whether the standard error of the squared error is at most twice the doubt that increments will leave.
    fn are_told(&self, asked: Asked) -> bool {
        self.all.variance.sqrt() <= 2.0 * DOUBT_SHARE * asked.goal
    }

    /// Whether the errors leave enough of the accuracy goal to all others.
    fn are_small(&self, asked: Asked) -> bool {
        self.all.sum <= MOST_ERROR_SHARE * MOST_ERROR_SHARE * asked.goal
    }

    /// The elements that increments are to check.
    pub(crate) fn parts(&self, subdivision: &Subdivision) -> ElementParts {
        let nodes: Vec<u32> = self.seen[..self.checked].iter().map(|s| s.node).collect();
        ElementParts::new(subdivision, &nodes)
    }
}

/// The criterion for caustics.
pub(crate) struct Caustics {
    batches: Batches,
    asked: Asked,
    errors: CausticErrors,
    rounds: usize,
    /// The particles of each batch for the next mesh, where they are not kept.
    fresh: Option<u32>,
}

impl Caustics {
    /// The criterion with the first particles sent; `None` where no particle comes to a surface by way of
    /// specular ones, or there is no light.
    pub(crate) fn new(
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
    ) -> Option<Self> {
        let mut batches = Batches::new();
        if !(pilot.lighting.leaves_caustics()
            && pilot.fly_and_keep(&mut batches, FIRST_BATCH_PARTICLES))
        {
            return None;
        }
        pilot.count_caustics(look, &batches);
        let area_m2: f64 = look.errors.iter().map(|e| e.area_m2).sum();
        let goal = (request.goal * look.reference_lx).powi(2) * area_m2;
        let asked = Asked { area_m2, goal, allowed: ERROR_SHARE * ERROR_SHARE * goal };
        let errors = CausticErrors::default();
        (look.reference_lx > 0.0).then_some(Self { batches, asked, errors, rounds: 0, fresh: None })
    }

    /// The errors on the final elements.
    pub(crate) fn into_errors(self) -> CausticErrors {
        self.errors
    }

    /// The elements to bisect by kept particles. If there are none, more particles are sent until errors are known
    /// well enough.
    fn by_kept(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Option<Vec<u32>> {
        loop {
            self.rounds += 1;
            let hats = HatFunctions::new(&pilot.mesh.subdivision, &pilot.near.standings);
            let on = pilot.kept(&self.batches, &look.elements, &hats);
            self.errors = pilot.judged(&on, &hats, self.asked);
            if self.rounds < MOST_ROUNDS && request.refines_caustics {
                let worst = pilot.worst_for_caustics(
                    &self.errors,
                    self.asked,
                    BELIEVED_ERROR_RATIO,
                    MARKED_SHARE,
                );
                if !worst.is_empty() {
                    return Some(worst);
                }
            }
            pilot.settle_between(look, request.is_fitted);
            let count = self.batches.kept();
            let may_find_more = count < MOST_KEPT_PARTICLES && request.refines_caustics;
            let (errors, asked) = (&self.errors, self.asked);
            let is_enough = errors.are_told(asked) && (errors.are_small(asked) || !may_find_more)
                || count >= MOST_KEPT_PARTICLES
                    && f64::from(2 * count) > pilot.most_ahead(look, request);
            let is_last = is_enough || self.rounds >= MOST_ROUNDS;
            if is_last || !pilot.has_time(look, request, FINE_EXCESS, go_on) {
                return None;
            }
            if count >= MOST_KEPT_PARTICLES {
                self.fresh = Some(2 * MOST_KEPT_PARTICLES);
                return self.by_fresh(pilot, look, request, go_on);
            }
            pilot.fly_and_keep(&mut self.batches, count);
        }
    }

    /// The elements to bisect by particles that are not kept, twice as many for every new mesh.
    fn by_fresh(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Option<Vec<u32>> {
        pilot.settle_between(look, request.is_fitted);
        let most = pilot.most_ahead(look, request);
        while let Some(count) = self.fresh {
            let hats = HatFunctions::new(&pilot.mesh.subdivision, &pilot.near.standings);
            let has_time =
                |pilot: &mut Pilot<'_>| pilot.has_time(look, request, FINE_EXCESS, go_on);
            let of = (&look.elements, &hats);
            let on = pilot.brought(&mut self.batches, (count, PARTICLES_AT_ONCE), of, has_time);
            let is_whole = on[0].particles >= f64::from(count);
            // If time was short, the kept particles may be more.
            let is_less = on[0].particles < f64::from(self.batches.kept());
            let on = if is_less { pilot.kept(&self.batches, &look.elements, &hats) } else { on };
            self.errors = pilot.judged(&on, &hats, self.asked);
            if !is_whole || f64::from(2 * count) > most || !request.refines_caustics {
                return None;
            }
            self.fresh = Some(2 * count);
            let worst = pilot.worst_for_caustics(&self.errors, self.asked, LIKELY_ERROR_RATIO, 1.0);
            if !worst.is_empty() {
                return Some(worst);
            }
            if self.errors.are_told(self.asked) {
                return None;
            }
        }
        None
    }
}

impl Criterion for Caustics {
    fn marked(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Option<Marked> {
        let twice = match self.fresh {
            None => self.by_kept(pilot, look, request, go_on),
            Some(_) => self.by_fresh(pilot, look, request, go_on),
        }?;
        let which = Which::Nodes { once: Vec::new(), twice };
        Some(Marked { which, excess: None, max_vertices: request.max_vertices })
    }

    fn follow(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        _request: &PilotRequest,
        _go_on: &mut GoOn<'_>,
    ) {
        look.elements = pilot.mesh.subdivision.elements();
        pilot.extend_between();
    }

    fn end(&mut self, pilot: &mut Pilot<'_>, look: &Survey, request: &PilotRequest) {
        pilot.settle_between(look, request.is_fitted);
    }
}

impl Pilot<'_> {
    /// The largest number of particles of a batch for one mesh.
    fn most_ahead(&self, look: &Survey, request: &PilotRequest) -> f64 {
        let needed = self.tried.caustic_noise.needed((request.goal, look.reference_lx));
        (PARTICLES_AHEAD_SHARE * needed / BATCHES as f64).min(f64::from(MOST_BATCH_PARTICLES))
    }

    /// The errors of the elements that these batches show. Their noise is stored, too.
    fn judged(&mut self, on: &[Brought], hats: &HatFunctions, asked: Asked) -> CausticErrors {
        let seen = self.seen(on);
        let mut all = Squared::default();
        seen.iter().for_each(|s| all += s.squared);
        self.tried.caustic_noise = noise_of(on, hats, asked.area_m2, all.variance.sqrt());
        errors_of(seen, all, asked)
    }

    /// Adds caustics and their reflected light to the reference light, if they are a large part of it. Accuracies are
    /// relative to that light.
    fn count_caustics(&mut self, look: &mut Survey, batches: &Batches) {
        let hats = HatFunctions::new(&self.mesh.subdivision, &self.near.standings);
        let on = self.kept(batches, &look.elements, &hats);
        let n = on.len() as f64;
        let (mut area_m2, mut squares, mut lm, mut caustic_lm) = (0.0, 0.0, 0.0, 0.0);
        for (vertex, m2) in hats.areas_m2().iter().enumerate().filter(|(_, m2)| **m2 > 0.0) {
            let values = || on.iter().map(|batch| batch.light[vertex]);
            let (sum, own) = (values().sum::<f64>(), values().map(|lx| lx * lx).sum::<f64>());
            let other_lx = (self.direct.lx[vertex] + self.indirect.lx[vertex]).luminance();
            // Products of independent batches are unbiased.
            let squared = (sum * sum - own) / (n * (n - 1.0));
            area_m2 += m2;
            squares += m2 * (other_lx * other_lx + 2.0 * other_lx * sum / n + squared);
            lm += m2 * (other_lx + sum / n);
            caustic_lm += m2 * sum / n;
        }
        let reflectance = self.mean_reflectance().min(MOST_MEAN_REFLECTANCE);
        let reflected_lx = caustic_lm / area_m2 * reflectance / (1.0 - reflectance);
        let squares = squares + 2.0 * reflected_lx * lm + reflected_lx * reflected_lx * area_m2;
        let flux_lm = lm + reflected_lx * area_m2;
        let reference_lx = Light::of(area_m2, flux_lm, squares.max(0.0)).reference_lx();
        if reference_lx > CAUSTIC_LIGHT_RATIO * look.reference_lx {
            look.reference_lx = reference_lx;
            // The trial of rays without caustics does not apply.
            self.tried.trial = None;
        }
    }

    /// The errors of the elements that get any caustic light.
    fn seen(&self, on: &[Brought]) -> Vec<Seen> {
        let lit = |vertex: u32| on.iter().any(|batch| batch.light[vertex as usize] != 0.0);
        let leaves: Vec<u32> = self.mesh.subdivision.leaves().collect();
        let one = |&node: &u32| {
            let corners = self.mesh.subdivision.node(node).0.vertices;
            corners.into_iter().any(lit).then(|| self.seen_of(node, on))
        };
        leaves.par_iter().with_min_len(256).filter_map(one).collect()
    }

    fn seen_of(&self, node: u32, on: &[Brought]) -> Seen {
        let corners = self.mesh.subdivision.node(node).0.vertices;
        let area_m2 = self.mesh.subdivision.triangle(node).area();
        let mut deposits = 0;
        let mut sums = [(0.0, 0.0); PARTS];
        for batch in on {
            let values = corners.map(|v| batch.light[v as usize]);
            // The light of the batch in each part beyond its own map, lx.
            let mut lacking =
                read_in_parts(corners, values, &self.near.standings).map(|read| -read);
            let came = batch.to(node);
            deposits += came.deposits;
            for (lacking, lm) in lacking.iter_mut().zip(came.fluxes_lm) {
                *lacking += lm / batch.particles * PARTS as f64 / area_m2;
            }
            for (sum, lx) in sums.iter_mut().zip(lacking) {
                *sum = (sum.0 + lx, sum.1 + lx * lx);
            }
        }
        let n = on.len() as f64;
        let means = sums.map(|(sum, squares)| {
            (sum / n, ((squares - sum * sum / n) / (n * (n - 1.0))).max(0.0))
        });
        Seen { node, deposits, squared: squared_error(&means, area_m2) }
    }

    /// The worst elements whose error is believed, until their squared errors are `share` of those of all such
    /// elements. None where errors are small enough or the gain is small.
    fn worst_for_caustics(
        &self,
        errors: &CausticErrors,
        asked: Asked,
        believed: f64,
        share: f64,
    ) -> Vec<u32> {
        if errors.all.sum <= asked.allowed {
            return Vec::new();
        }
        let least_edge_m = self.mesh.least_edge_m * SHARP_EDGE_SHARE;
        let is_seen = |s: &&Seen| {
            s.deposits >= FEWEST_DEPOSITS
                && s.squared.is_believed(believed)
                && self.mesh.subdivision.longest_edge_m(s.node) > 2.0 * least_edge_m
        };
        let mut worst: Vec<&Seen> = errors.seen.iter().filter(is_seen).collect();
        worst.sort_by(|a, b| b.squared.sum.total_cmp(&a.squared.sum).then(a.node.cmp(&b.node)));
        let all: f64 = worst.iter().map(|s| s.squared.sum).sum();
        if all < LEAST_CANDIDATE_ERROR_SHARE * asked.allowed {
            return Vec::new();
        }
        let mut marked = 0.0;
        let is_marked = |s: &&Seen| {
            let is_marked = marked < share * all;
            marked += s.squared.sum;
            is_marked
        };
        worst.into_iter().take_while(is_marked).map(|s| s.node).collect()
    }

    /// Gives new vertices a preliminary standing, from the ends of their edges, without short rays.
    fn extend_between(&mut self) {
        for vertex in &self.mesh.subdivision.vertices()[self.near.standings.len()..] {
            let ends = vertex.parents.expect("made by bisection");
            let of = ends.map(|end| self.near.standings[end as usize]);
            self.near.standings.push(if of[0] == of[1] {
                of[0]
            } else {
                Standing::highest([of[0], of[1], None])
            });
            self.near.known.push(ends.iter().any(|&end| self.near.known[end as usize]));
        }
    }

    /// Computes direct light at new vertices and interpolates indirect light from the ends of their edges.
    fn settle_between(&mut self, look: &Survey, waits: bool) {
        let first = self.direct.lx.len();
        if first == self.mesh.subdivision.vertex_count() {
            return;
        }
        let is_open = |of: &Option<Standing>| *of == Some(Standing::Open);
        let open: Vec<bool> = self.near.standings.iter().map(is_open).collect();
        if waits {
            self.mesh.carriers.between(&self.mesh.subdivision, first, &open);
        }
        self.indirect.gathered.resize(self.mesh.subdivision.vertex_count(), false);
        self.complete_rays();
        let gatherers = self.gatherers();
        self.complete_direct(&look.elements, &gatherers);
        self.look_for_torn();
        self.complete_standings(&gatherers);
        self.indirect.lx.resize(gatherers.len(), Rgb::BLACK);
        self.mesh.carriers.fill(&mut self.indirect.lx);
    }
}

/// The noise of caustics on the elements, with the doubt of their error.
fn noise_of(on: &[Brought], hats: &HatFunctions, area_m2: f64, doubt: f64) -> CausticNoise {
    let variance = |vertex: usize| {
        let n = on.len() as f64;
        let values = || on.iter().map(|batch| batch.light[vertex]);
        let mean = values().sum::<f64>() / n;
        values().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0)
    };
    let of = hats.areas_m2().iter().enumerate();
    let sum: f64 = of.filter(|(_, m2)| **m2 > 0.0).map(|(vertex, m2)| m2 * variance(vertex)).sum();
    let each = on[0].particles;
    let all = BATCHES as f64 * each;
    CausticNoise::seen(sum / area_m2 * each, hats.areas_m2().len(), doubt / area_m2 * all)
}

/// The errors over the surface, with the elements that increments are to check.
fn errors_of(mut seen: Vec<Seen>, all: Squared, asked: Asked) -> CausticErrors {
    let weight = |s: &Seen| s.squared.sum.max(0.0) + s.squared.variance.sqrt();
    seen.sort_by(|a, b| weight(b).total_cmp(&weight(a)).then(a.node.cmp(&b.node)));
    let (mut rest, unchecked) = (all, UNCHECKED_ERROR_SHARE * asked.allowed);
    let mut checked = 0;
    while checked < seen.len().min(MOST_CHECKED_ELEMENTS) && rest.with(Noise::Counted) > unchecked {
        let Squared { sum, variance } = seen[checked].squared;
        rest = Squared { sum: rest.sum - sum, variance: rest.variance - variance };
        checked += 1;
    }
    let over_surface = |squared: Squared| squared.with(Noise::Counted) / asked.area_m2;
    CausticErrors {
        lx: over_surface(all).sqrt(),
        beside_lx2: over_surface(rest),
        all,
        seen,
        checked,
    }
}
