//! Elements for caustics: as fine as light is that specular surfaces throw together.
//!
//! No receiver sees a caustic coming: only particles find it. Some are sent ahead, in batches that share nothing random. On the
//! elements as they are, each batch makes the map that an increment would make of it, and counts what came to each of the parts of
//! every element. The product of what two batches lack is the squared error of interpolation there without any noise, in the mean;
//! what that varies by over batches tells what is noise. Elements are bisected where the error is no noise, particles are added where noise
//! hides it.

use super::Pilot;
use super::direct::MOST_REFLECTANCE;
use crate::elements::{Elements, Subdivision};
use crate::engine::accuracy::Light;
use crate::engine::flights::{CausticNoise, DOUBT, Flights};
use crate::engine::forecast::{FINE, GoOn};
use crate::engine::gather::known_weights;
use crate::engine::hats::Hats;
use crate::engine::look::{Look, PilotRequest};
use crate::engine::noise::Noise;
use crate::engine::parts::{PARTS, Parts, Squared, part_of, read_in_parts, squared_error};
use crate::engine::reflectance;
use crate::engine::surface::SurfacePoint;
use crate::map::Standing;
use crate::sampling::Key;
use rayon::prelude::*;
use std::cell::RefCell;

/// Particles that tell where light comes to at all.
const LET_GO: u32 = 1 << 13;

/// Caustics are counted where all light is so many times as much with them, root mean square.
const MUCH: f64 = 1.25;

/// Batches of particles.
const BATCHES: usize = 8;
/// Particles of a batch to start with, and at most.
const FIRST_PARTICLES: u32 = 1 << 11;
const MOST_PARTICLES: u32 = 1 << 18;
/// Rounds at most.
const ROUNDS: usize = 96;

/// The part of the accuracy asked for that interpolating caustics may take.
const SHARE: f64 = 0.3;

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

/// Flux that a particle has left somewhere, if it carried all there is.
#[derive(Clone, Copy, Debug)]
struct Deposit {
    triangle: u32,
    back: bool,
    place: [f64; 2],
    flux_lm: f64,
}

/// Particles that share all light.
#[derive(Debug, Default)]
struct Batch {
    deposits: Vec<Deposit>,
    particles: f64,
}

/// What of a batch came to an element.
#[derive(Clone, Copy, Debug)]
struct Landed {
    node: u32,
    part: usize,
    flux_lm: f64,
}

/// A batch on elements.
struct OnElements {
    /// In the order of the elements.
    landed: Vec<Landed>,
    /// At the vertices, as the map has it, lx.
    light: Vec<f64>,
}

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
    /// By element, the worst first; so many of them are to be checked.
    seen: Vec<Seen>,
    checked: usize,
    /// What the others err by, in the mean square over the surface, lx2.
    pub(super) beside_lx2: f64,
}

impl CausticErrors {
    /// Their share of light of this root mean square.
    pub(super) fn share(&self, reference_lx: f64) -> f64 {
        self.lx / reference_lx.max(f64::MIN_POSITIVE)
    }

    /// The elements that increments are to check.
    pub(super) fn parts(&self, subdivision: &Subdivision) -> Parts {
        let nodes: Vec<u32> = self.seen[..self.checked].iter().map(|s| s.node).collect();
        Parts::new(subdivision, &nodes)
    }
}

impl Pilot<'_> {
    /// Bisects elements until caustics are interpolated well enough, as far as a number of particles can tell.
    pub(super) fn refine_for_caustics(
        &mut self,
        look: &mut Look,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> CausticErrors {
        let mut batches: Vec<Batch> = (0..BATCHES).map(|_| Batch::default()).collect();
        let mut next = FIRST_PARTICLES;
        if !(self.lighting.leaves_caustics() && self.fly(&mut batches, next)) {
            return CausticErrors::default();
        }
        self.count_caustics(look, &batches);
        if look.reference_lx <= 0.0 {
            return CausticErrors::default();
        }
        let area_m2: f64 = look.errors.iter().map(|e| e.area_m2).sum();
        let goal = (request.goal * look.reference_lx).powi(2) * area_m2;
        let allowed = SHARE * SHARE * goal;
        let mut errors = CausticErrors::default();
        for round in 0..ROUNDS {
            let hats = Hats::new(&self.subdivision, &self.standings);
            let on: Vec<OnElements> = batches
                .par_iter()
                .map(|batch| self.on_elements(batch, &look.elements, &hats))
                .collect();
            let seen = self.seen(&on);
            let mut all = Squared::default();
            seen.iter().for_each(|s| all += s.squared);
            self.caustic_noise = self.noise_of(&on, &hats, &batches, area_m2, all.variance.sqrt());
            errors = errors_of(seen, all, (allowed, area_m2));
            let is_enough = all.sum <= allowed;
            let refined = round + 1 < ROUNDS
                && request.refines_caustics
                && !is_enough
                && self.bisect_for_caustics(&errors.seen, allowed, request.max_vertices);
            if refined {
                look.elements = self.subdivision.elements();
                self.extend_between();
                continue;
            }
            self.settle_between(look, request.is_fitted);
            // As much as increments will tell, or half of it.
            let is_told = all.variance.sqrt() <= 2.0 * DOUBT * goal;
            if is_told || next >= MOST_PARTICLES || !self.has_time(look, request, FINE, go_on) {
                break;
            }
            self.fly(&mut batches, next);
            next *= 2;
        }
        errors
    }

    /// Counts caustics as light, and what is reflected of them, where they are much of it: all that is small is small against that.
    fn count_caustics(&mut self, look: &mut Look, batches: &[Batch]) {
        let hats = Hats::new(&self.subdivision, &self.standings);
        let on: Vec<OnElements> =
            batches.iter().map(|batch| self.on_elements(batch, &look.elements, &hats)).collect();
        let n = on.len() as f64;
        let (mut area_m2, mut squares, mut lm, mut caustic_lm) = (0.0, 0.0, 0.0, 0.0);
        for (vertex, m2) in hats.areas_m2().iter().enumerate().filter(|(_, m2)| **m2 > 0.0) {
            let values = || on.iter().map(|batch| batch.light[vertex]);
            let (sum, own) = (values().sum::<f64>(), values().map(|lx| lx * lx).sum::<f64>());
            let other_lx = (self.direct[vertex] + self.indirect[vertex]).luminance();
            // Of batches that share nothing random, products are free of bias.
            let squared = (sum * sum - own) / (n * (n - 1.0));
            area_m2 += m2;
            squares += m2 * (other_lx * other_lx + 2.0 * other_lx * sum / n + squared);
            lm += m2 * (other_lx + sum / n);
            caustic_lm += m2 * sum / n;
        }
        let reflectance = reflectance::of_all(self.scene, &self.subdivision).min(MOST_REFLECTANCE);
        let reflected_lx = caustic_lm / area_m2 * reflectance / (1.0 - reflectance);
        let squares = squares + 2.0 * reflected_lx * lm + reflected_lx * reflected_lx * area_m2;
        let flux_lm = lm + reflected_lx * area_m2;
        let reference_lx = Light::of(area_m2, flux_lm, squares.max(0.0)).reference_lx();
        if reference_lx > MUCH * look.reference_lx {
            look.reference_lx = reference_lx;
            // What was tried without them tells nothing.
            self.trial = None;
        }
    }

    /// Places that some particles come to over specular surfaces.
    pub(super) fn reached_by_caustics(&self) -> Vec<SurfacePoint> {
        let of = (self.scene, self.lighting);
        let flights = Flights::new(of, None, LET_GO, self.key.with(10));
        let Some(flights) = flights.filter(|_| self.lighting.leaves_caustics()) else {
            return Vec::new();
        };
        let places_of = |index: u32| {
            let places = RefCell::new(Vec::new());
            flights.fly(index, |at, _| places.borrow_mut().push(*at));
            places.into_inner()
        };
        (0..LET_GO).into_par_iter().flat_map_iter(places_of).collect()
    }

    /// Adds so many particles to every batch; returns whether any of all came to a place that counts.
    fn fly(&mut self, batches: &mut [Batch], count: u32) -> bool {
        let of = (self.scene, self.lighting);
        for (k, batch) in batches.iter_mut().enumerate() {
            let key = Key::with(self.key.with(9).with(k as u64), batch.particles as u64);
            let Some(flights) = Flights::new(of, self.aim.as_ref(), count, key) else {
                return false;
            };
            let one = |index: u32| {
                let deposits = RefCell::new(Vec::new());
                let (rays, _) = flights.fly(index, |at, flux_lm| {
                    let (triangle, back, place) = (at.triangle, at.back, [at.u, at.v]);
                    let flux_lm = flux_lm.luminance() * f64::from(count);
                    deposits.borrow_mut().push(Deposit { triangle, back, place, flux_lm });
                });
                (deposits.into_inner(), rays)
            };
            let all: Vec<(Vec<Deposit>, u64)> = (0..count).into_par_iter().map(one).collect();
            self.traced += all.iter().map(|(_, rays)| rays).sum::<u64>();
            batch.deposits.extend(all.into_iter().flat_map(|(deposits, _)| deposits));
            batch.particles += f64::from(count);
        }
        batches.iter().any(|batch| !batch.deposits.is_empty())
    }

    /// What the map of a batch is, and where its particles came.
    fn on_elements(&self, batch: &Batch, elements: &Elements, hats: &Hats) -> OnElements {
        let mut fluxes = vec![0.0; self.subdivision.vertex_count()];
        let mut landed = Vec::with_capacity(batch.deposits.len());
        for deposit in &batch.deposits {
            let place = elements.place(u32::MAX, deposit.triangle, deposit.back, deposit.place);
            let Some(place) = place else { continue };
            let corners = elements.corners(place);
            let Some(weights) = known_weights(corners, &self.standings) else { continue };
            let flux_lm = deposit.flux_lm / batch.particles;
            for ((vertex, _), weight) in corners.iter().zip(weights) {
                fluxes[*vertex as usize] += weight * flux_lm;
            }
            let part = part_of(corners.map(|(_, weight)| weight));
            landed.push(Landed { node: place.node(), part, flux_lm });
        }
        landed.sort_by_key(|landed| landed.node);
        OnElements { landed, light: hats.corrected(&hats.means(fluxes.into_iter())) }
    }

    /// The elements on which there is something to see.
    fn seen(&self, on: &[OnElements]) -> Vec<Seen> {
        let lit = |vertex: u32| on.iter().any(|batch| batch.light[vertex as usize] != 0.0);
        let leaves: Vec<u32> = self.subdivision.leaves().collect();
        let one = |&node: &u32| {
            let corners = self.subdivision.node(node).0.vertices;
            corners.into_iter().any(lit).then(|| self.seen_of(node, on))
        };
        leaves.par_iter().with_min_len(256).filter_map(one).collect()
    }

    fn seen_of(&self, node: u32, on: &[OnElements]) -> Seen {
        let corners = self.subdivision.node(node).0.vertices;
        let area_m2 = self.subdivision.triangle(node).area();
        let mut deposits = 0;
        let mut sums = [(0.0, 0.0); PARTS];
        for batch in on {
            let values = corners.map(|v| batch.light[v as usize]);
            // What the batch has more in each part than it says, lx.
            let mut lacking = read_in_parts(corners, values, &self.standings).map(|read| -read);
            let start = batch.landed.partition_point(|landed| landed.node < node);
            for landed in batch.landed[start..].iter().take_while(|landed| landed.node == node) {
                deposits += 1;
                lacking[landed.part] += landed.flux_lm * PARTS as f64 / area_m2;
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

    /// Bisects the worst elements whose error is no noise, unless that matters little; returns whether there were any.
    fn bisect_for_caustics(&mut self, seen: &[Seen], allowed: f64, max_vertices: usize) -> bool {
        let least_edge_m = self.least_edge_m * LEAST_EDGE;
        let is_seen = |s: &&Seen| {
            s.deposits >= FEWEST_DEPOSITS
                && s.squared.is_believed(BELIEVED)
                && self.subdivision.longest_edge_m(s.node) > 2.0 * least_edge_m
        };
        let mut worst: Vec<&Seen> = seen.iter().filter(is_seen).collect();
        worst.sort_by(|a, b| b.squared.sum.total_cmp(&a.squared.sum).then(a.node.cmp(&b.node)));
        let all: f64 = worst.iter().map(|s| s.squared.sum).sum();
        if all < MATTERS * allowed {
            return false;
        }
        let (mut marked, mut any) = (0.0, false);
        for seen in worst {
            if marked >= MARKED_SHARE * all || self.subdivision.vertex_count() >= max_vertices {
                break;
            }
            self.subdivision.bisect_twice(seen.node);
            marked += seen.squared.sum;
            any = true;
        }
        any
    }

    /// What new vertices stand for, as long as nobody feels about.
    fn extend_between(&mut self) {
        for vertex in &self.subdivision.vertices()[self.standings.len()..] {
            let ends = vertex.parents.expect("made by bisection");
            let of = ends.map(|end| self.standings[end as usize]);
            self.standings.push(if of[0] == of[1] {
                of[0]
            } else {
                Standing::highest([of[0], of[1], None])
            });
            self.known.push(ends.iter().any(|&end| self.known[end as usize]));
        }
    }

    /// Direct light at new vertices, and indirect light from the ends of their edges.
    fn settle_between(&mut self, look: &Look, waits: bool) {
        let first = self.direct.len();
        if first == self.subdivision.vertex_count() {
            return;
        }
        let is_open = |of: &Option<Standing>| *of == Some(Standing::Open);
        let open: Vec<bool> = self.standings.iter().map(is_open).collect();
        if waits {
            self.carriers.between(&self.subdivision, first, &open);
        }
        self.settle(&look.elements);
    }

    /// How noisy caustics are on elements, and how much is in doubt of their error.
    fn noise_of(
        &self,
        on: &[OnElements],
        hats: &Hats,
        batches: &[Batch],
        area_m2: f64,
        doubt: f64,
    ) -> CausticNoise {
        let variance = |vertex: usize| {
            let n = on.len() as f64;
            let values = || on.iter().map(|batch| batch.light[vertex]);
            let mean = values().sum::<f64>() / n;
            values().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0)
        };
        let of = hats.areas_m2().iter().enumerate();
        let sum: f64 =
            of.filter(|(_, m2)| **m2 > 0.0).map(|(vertex, m2)| m2 * variance(vertex)).sum();
        let each = batches[0].particles;
        let all = BATCHES as f64 * each;
        CausticNoise::seen(sum / area_m2 * each, hats.areas_m2().len(), doubt / area_m2 * all)
    }
}

/// What is seen, all of it, and what of it increments are to check.
fn errors_of(mut seen: Vec<Seen>, all: Squared, (allowed, area_m2): (f64, f64)) -> CausticErrors {
    let weight = |s: &Seen| s.squared.sum.max(0.0) + s.squared.variance.sqrt();
    seen.sort_by(|a, b| weight(b).total_cmp(&weight(a)).then(a.node.cmp(&b.node)));
    let mut rest = all;
    let mut checked = 0;
    while checked < seen.len().min(MOST_CHECKED) && rest.with(Noise::Counted) > UNCHECKED * allowed
    {
        let Squared { sum, variance } = seen[checked].squared;
        rest = Squared { sum: rest.sum - sum, variance: rest.variance - variance };
        checked += 1;
    }
    let beside_lx2 = rest.with(Noise::Counted) / area_m2;
    CausticErrors { lx: (all.with(Noise::Counted) / area_m2).sqrt(), seen, checked, beside_lx2 }
}
