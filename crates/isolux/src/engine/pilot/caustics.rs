//! Elements for caustics: as fine as light is that specular surfaces throw together.
//!
//! No receiver sees a caustic coming: only particles find it. Some are sent ahead, in batches that share nothing random. On the
//! elements as they are, each batch makes the map that an increment would make of it, and counts what came to each of the parts of
//! every element. The product of what two batches lack is the squared error of interpolation there without any noise, in the mean;
//! what that varies by over batches tells what is noise. Elements are bisected where the error is no noise, particles are added where noise
//! hides it: first to those there are, which are kept and placed on every new mesh. Where increments will need far more of them, so many
//! are sent that they are looked at once and not kept, anew for every mesh.

use super::batches::{BATCHES, Batches, Brought};
use super::direct::MOST_REFLECTANCE;
use super::forecast::{FINE, GoOn};
use super::look::{PilotRequest, Survey};
use super::state::Pilot;
use crate::elements::Subdivision;
use crate::engine::judge::Light;
use crate::engine::mesh::HatFunctions;
use crate::engine::particle::{
    CausticNoise, DOUBT, ElementParts, PARTS, Squared, read_in_parts, squared_error,
};
use crate::engine::ray::{Noise, reflectance};
use crate::map::Standing;
use rayon::prelude::*;

/// Caustics are counted where all light is so many times as much with them, root mean square.
const MUCH: f64 = 1.25;

/// Particles of a batch to start with, and of those that are kept at most.
const FIRST_PARTICLES: u32 = 1 << 11;
const MOST_KEPT: u32 = 1 << 18;
/// Particles of a batch at most, kept or not, and how many are looked at together.
const MOST_PARTICLES: u32 = 1 << 22;
const AT_ONCE: u32 = 1 << 15;
/// The part of the particles that increments will need that may be sent ahead for one mesh.
const AHEAD: f64 = 0.5;
/// Rounds at most.
const ROUNDS: usize = 96;

/// The part of the accuracy asked for that interpolating caustics may take, and what it may if to find out where more is lacking takes
/// more particles than it takes to tell how much.
const SHARE: f64 = 0.3;
const MOST_SHARE: f64 = 0.5;

/// Elements with fewer deposits tell nothing.
const FEWEST_DEPOSITS: usize = 16;

/// The shortest edges for caustics, as a share of those for other light.
const LEAST_EDGE: f64 = 1.0 / 64.0;

/// Nothing is bisected for less than this share of the error allowed, in the square.
const MATTERS: f64 = 0.25;
/// The share of what can be bisected that a round does (Dörfler 1996).
const MARKED_SHARE: f64 = 0.75;

/// Elements that increments check at most, and the share of the error allowed that others may have, in the square.
const MOST_CHECKED: usize = 8192;
const UNCHECKED: f64 = 0.02;

/// An error is believed that is so many times the standard error of its square.
const BELIEVED: f64 = 2.5;
/// The same where every mesh takes new particles, so that there are few.
const LIKELY: f64 = 2.0;

/// What is seen of an element.
#[derive(Clone, Copy, Debug)]
struct Seen {
    node: u32,
    /// Of all batches.
    deposits: usize,
    squared: Squared,
}

/// What caustics lack on the elements.
#[derive(Debug, Default)]
pub(super) struct CausticErrors {
    /// Root mean square over the surface, lx.
    pub(super) lx: f64,
    /// All of them.
    all: Squared,
    /// By element, the worst first; so many of them are to be checked.
    seen: Vec<Seen>,
    checked: usize,
    /// What the others err by, in the mean square over the surface, lx2.
    pub(super) beside_lx2: f64,
}

/// What is asked of elements, lx2 m2: the square of all the error that is asked for, over the surface, and what caustics may take of it.
#[derive(Clone, Copy)]
struct Asked {
    area_m2: f64,
    goal: f64,
    allowed: f64,
}

impl CausticErrors {
    /// Their share of light of this root mean square.
    pub(super) fn share(&self, reference_lx: f64) -> f64 {
        self.lx / reference_lx.max(f64::MIN_POSITIVE)
    }

    /// Whether no more is in doubt of them than increments will leave, or twice that.
    fn are_told(&self, asked: Asked) -> bool {
        self.all.variance.sqrt() <= 2.0 * DOUBT * asked.goal
    }

    /// Whether they leave enough of what is asked for to all else.
    fn are_small(&self, asked: Asked) -> bool {
        self.all.sum <= MOST_SHARE * MOST_SHARE * asked.goal
    }

    /// The elements that increments are to check.
    pub(super) fn parts(&self, subdivision: &Subdivision) -> ElementParts {
        let nodes: Vec<u32> = self.seen[..self.checked].iter().map(|s| s.node).collect();
        ElementParts::new(subdivision, &nodes)
    }
}

impl Pilot<'_> {
    /// Bisects elements until caustics are interpolated well enough, as far as a number of particles can tell.
    pub(super) fn refine_for_caustics(
        &mut self,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> CausticErrors {
        let mut batches = Batches::new();
        if !(self.lighting.leaves_caustics() && self.fly_and_keep(&mut batches, FIRST_PARTICLES)) {
            return CausticErrors::default();
        }
        self.count_caustics(look, &batches);
        if look.reference_lx <= 0.0 {
            return CausticErrors::default();
        }
        let area_m2: f64 = look.errors.iter().map(|e| e.area_m2).sum();
        let goal = (request.goal * look.reference_lx).powi(2) * area_m2;
        let asked = Asked { area_m2, goal, allowed: SHARE * SHARE * goal };
        let mut errors = CausticErrors::default();
        for round in 0..ROUNDS {
            let hats = HatFunctions::new(&self.mesh.subdivision, &self.near.standings);
            let on = self.kept(&batches, &look.elements, &hats);
            errors = self.judged(&on, &hats, asked);
            let may_refine = round + 1 < ROUNDS && request.refines_caustics;
            if may_refine
                && self.bisect_for_caustics(
                    &errors,
                    asked,
                    (BELIEVED, MARKED_SHARE, request.max_vertices),
                )
            {
                look.elements = self.mesh.subdivision.elements();
                self.extend_between();
                continue;
            }
            self.settle_between(look, request.is_fitted);
            let count = batches.kept();
            let may_find_more = count < MOST_KEPT && request.refines_caustics;
            let is_enough = errors.are_told(asked) && (errors.are_small(asked) || !may_find_more)
                || count >= MOST_KEPT && f64::from(2 * count) > self.most_ahead(look, request);
            if is_enough || !self.has_time(look, request, FINE, go_on) {
                break;
            }
            if count >= MOST_KEPT {
                return self.refine_further(look, request, go_on, (batches, asked));
            }
            self.fly_and_keep(&mut batches, count);
        }
        errors
    }

    /// The same by particles of which none is kept, where increments will need more than there were: twice as many for every new mesh.
    fn refine_further(
        &mut self,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
        (mut batches, asked): (Batches, Asked),
    ) -> CausticErrors {
        let most = self.most_ahead(look, request);
        let mut count = 2 * MOST_KEPT;
        loop {
            let hats = HatFunctions::new(&self.mesh.subdivision, &self.near.standings);
            let elements = look.elements.clone();
            let has_time = |pilot: &mut Self| pilot.has_time(look, request, FINE, go_on);
            let of = (&elements, &hats);
            let on = self.brought(&mut batches, (count, AT_ONCE), of, has_time);
            let is_whole = on[0].particles >= f64::from(count);
            // Where time was short there may be more of those that are kept.
            let is_less = on[0].particles < f64::from(batches.kept());
            let on = if is_less { self.kept(&batches, &elements, &hats) } else { on };
            let errors = self.judged(&on, &hats, asked);
            let is_last = !is_whole || f64::from(2 * count) > most || !request.refines_caustics;
            let refined = !is_last
                && self.bisect_for_caustics(&errors, asked, (LIKELY, 1.0, request.max_vertices));
            if refined {
                look.elements = self.mesh.subdivision.elements();
                self.extend_between();
                self.settle_between(look, request.is_fitted);
            } else if is_last || errors.are_told(asked) {
                return errors;
            }
            count *= 2;
        }
    }

    /// Particles of every batch that may be sent for one mesh.
    fn most_ahead(&self, look: &Survey, request: &PilotRequest) -> f64 {
        let needed = self.tried.caustic_noise.needed((request.goal, look.reference_lx));
        (AHEAD * needed / BATCHES as f64).min(f64::from(MOST_PARTICLES))
    }

    /// What batches tell of the elements they were brought to; also how noisy they are.
    fn judged(&mut self, on: &[Brought], hats: &HatFunctions, asked: Asked) -> CausticErrors {
        let seen = self.seen(on);
        let mut all = Squared::default();
        seen.iter().for_each(|s| all += s.squared);
        self.tried.caustic_noise = noise_of(on, hats, asked.area_m2, all.variance.sqrt());
        errors_of(seen, all, asked)
    }

    /// Counts caustics as light, and what is reflected of them, where they are much of it: all that is small is small against that.
    fn count_caustics(&mut self, look: &mut Survey, batches: &Batches) {
        let hats = HatFunctions::new(&self.mesh.subdivision, &self.near.standings);
        let on = self.kept(batches, &look.elements, &hats);
        let n = on.len() as f64;
        let (mut area_m2, mut squares, mut lm, mut caustic_lm) = (0.0, 0.0, 0.0, 0.0);
        for (vertex, m2) in hats.areas_m2().iter().enumerate().filter(|(_, m2)| **m2 > 0.0) {
            let values = || on.iter().map(|batch| batch.light[vertex]);
            let (sum, own) = (values().sum::<f64>(), values().map(|lx| lx * lx).sum::<f64>());
            let other_lx = (self.direct.lx[vertex] + self.indirect.lx[vertex]).luminance();
            // Of batches that share nothing random, products are free of bias.
            let squared = (sum * sum - own) / (n * (n - 1.0));
            area_m2 += m2;
            squares += m2 * (other_lx * other_lx + 2.0 * other_lx * sum / n + squared);
            lm += m2 * (other_lx + sum / n);
            caustic_lm += m2 * sum / n;
        }
        let reflectance =
            reflectance::of_all(self.scene, &self.mesh.subdivision).min(MOST_REFLECTANCE);
        let reflected_lx = caustic_lm / area_m2 * reflectance / (1.0 - reflectance);
        let squares = squares + 2.0 * reflected_lx * lm + reflected_lx * reflected_lx * area_m2;
        let flux_lm = lm + reflected_lx * area_m2;
        let reference_lx = Light::of(area_m2, flux_lm, squares.max(0.0)).reference_lx();
        if reference_lx > MUCH * look.reference_lx {
            look.reference_lx = reference_lx;
            // What was tried without them tells nothing.
            self.tried.trial = None;
        }
    }

    /// The elements on which there is something to see.
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
            // What the batch has more in each part than it says, lx.
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

    /// Bisects the worst elements whose error is no noise, until those are such a share of it, unless that matters little or errors are
    /// small enough; returns whether there were any.
    fn bisect_for_caustics(
        &mut self,
        errors: &CausticErrors,
        asked: Asked,
        (believed, share, max_vertices): (f64, f64, usize),
    ) -> bool {
        if errors.all.sum <= asked.allowed {
            return false;
        }
        let least_edge_m = self.mesh.least_edge_m * LEAST_EDGE;
        let is_seen = |s: &&Seen| {
            s.deposits >= FEWEST_DEPOSITS
                && s.squared.is_believed(believed)
                && self.mesh.subdivision.longest_edge_m(s.node) > 2.0 * least_edge_m
        };
        let mut worst: Vec<&Seen> = errors.seen.iter().filter(is_seen).collect();
        worst.sort_by(|a, b| b.squared.sum.total_cmp(&a.squared.sum).then(a.node.cmp(&b.node)));
        let all: f64 = worst.iter().map(|s| s.squared.sum).sum();
        if all < MATTERS * asked.allowed {
            return false;
        }
        let (mut marked, mut any) = (0.0, false);
        for seen in worst {
            if marked >= share * all || self.mesh.subdivision.vertex_count() >= max_vertices {
                break;
            }
            self.mesh.subdivision.bisect_twice(seen.node);
            marked += seen.squared.sum;
            any = true;
        }
        any
    }

    /// What new vertices stand for, as long as nobody feels about.
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

    /// Direct light at new vertices, and indirect light from the ends of their edges.
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
        self.settle(&look.elements);
    }
}

/// How noisy caustics are on elements, and how much is in doubt of their error.
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

/// What is seen, all of it, and what of it increments are to check.
fn errors_of(mut seen: Vec<Seen>, all: Squared, asked: Asked) -> CausticErrors {
    let weight = |s: &Seen| s.squared.sum.max(0.0) + s.squared.variance.sqrt();
    seen.sort_by(|a, b| weight(b).total_cmp(&weight(a)).then(a.node.cmp(&b.node)));
    let (mut rest, unchecked) = (all, UNCHECKED * asked.allowed);
    let mut checked = 0;
    while checked < seen.len().min(MOST_CHECKED) && rest.with(Noise::Counted) > unchecked {
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
