//! Direct light of many luminaires by few shadow rays.
//!
//! A comb of evenly spaced teeth, shifted at random, is laid over all luminaires and images, each as
//! wide as what it is expected to give: in the order of the tree, so that neighbours in space are
//! neighbours under the comb. Those under a tooth are evaluated exactly, which tells the light
//! without obstacles to a few per cent; a second comb over these chooses which are looked at. What is
//! found is divided by the chance of having been chosen (Horvitz and Thompson 1952), so both
//! steps are free of bias whatever the widths are.

use super::Lighting;
use super::cut::{Cut, Part, Seen, View};
use super::source::{self, Source, Target};
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::units::Rgb;

/// Luminaires evaluated for every one that is looked at.
const EVALUATED_A_RAY: usize = 4;

/// A luminaire or image under a tooth.
struct Candidate<'s> {
    source: &'s Source,
    target: Target,
    /// What it would give without obstacles over the chance of having been chosen, lx.
    weighted_lx: Rgb,
}

/// The teeth of a comb: whole numbers plus a shift.
#[derive(Clone, Copy)]
struct Comb(f64);

impl Comb {
    /// Whether a tooth lies in `[from, to)`.
    fn meets(self, from: f64, to: f64) -> bool {
        (from - self.0).ceil() < (to - self.0).ceil()
    }
}

/// A part of the tree between two places of the comb.
struct Span {
    part: Part,
    from: f64,
    to: f64,
}

impl Lighting<'_> {
    /// Direct illuminance from luminaires without surface and their images, by about `rays` shadow
    /// rays; `cut` is that of the place.
    pub(super) fn lit_by_many(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let shifts = dice.pair();
        let candidates = self.candidates(cut, at, EVALUATED_A_RAY * rays, Comb(shifts[0]));
        let comb = Comb(shifts[1]);
        let total: f64 = candidates.iter().map(|c| c.weighted_lx.luminance()).sum();
        let (mut place, mut sum) = (0.0, Rgb::BLACK);
        for candidate in &candidates {
            let width = rays as f64 * (candidate.weighted_lx.luminance() / total);
            let end = place + width;
            if comb.meets(place, end) {
                let share = self.visibility(candidate.source, at, candidate.target, None);
                sum += candidate.weighted_lx * share / width.min(1.0);
            }
            place = end;
        }
        sum
    }

    /// The luminaires under the teeth of a comb, `count` of them.
    fn candidates(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        count: usize,
        comb: Comb,
    ) -> Vec<Candidate<'_>> {
        let mut found = Vec::with_capacity(count);
        let mut waiting = Vec::with_capacity(64);
        let (mut from, scale) = (0.0, count as f64 / cut.total);
        for &Seen { view, part, weight } in &cut.seen {
            let to = from + weight * scale;
            if comb.meets(from, to) {
                waiting.push(Span { part, from, to });
                let view = &cut.views[view];
                while let Some(span) = waiting.pop() {
                    match span.part {
                        Part::Lamp(lamp) => {
                            found.extend(self.candidate(view, lamp, at, span.to - span.from));
                        }
                        Part::Node(node) => self.divide(view, node, &span, comb, &mut waiting),
                    }
                }
            }
            from = to;
        }
        found
    }

    /// Divides the span of a cluster among its parts and keeps those under a tooth, the last first.
    fn divide(&self, view: &View, node: u32, span: &Span, comb: Comb, parts: &mut Vec<Span>) {
        let own = &self.tree.nodes[node as usize];
        let mut weights = [0.0; super::tree::GROUP];
        let (count, part): (usize, &dyn Fn(usize) -> Part) = match own.second {
            Some(second) => (2, &move |k| Part::Node(if k == 0 { node + 1 } else { second })),
            None => (own.count as usize, &|k| Part::Lamp(own.first + k as u32)),
        };
        let mut total = 0.0;
        for (k, weight) in weights[..count].iter_mut().enumerate() {
            *weight = view.weight(part(k));
            total += *weight;
        }
        if total <= 0.0 {
            return;
        }
        let first = parts.len();
        let (mut sum, mut from) = (0.0, span.from);
        for (k, weight) in weights[..count].iter().enumerate() {
            sum += weight;
            let to = span.from + (span.to - span.from) * (sum / total);
            if comb.meets(from, to) {
                parts.push(Span { part: part(k), from, to });
            }
            from = to;
        }
        parts[first..].reverse();
    }

    /// What a lamp chosen with a width under the comb gives.
    fn candidate(
        &self,
        view: &View,
        lamp: u32,
        at: &SurfacePoint,
        width: f64,
    ) -> Option<Candidate<'_>> {
        let luminaire = self.tree.lamps[lamp as usize].luminaire;
        let source = self.image(luminaire as usize, &self.chains[view.chain])?;
        let in_view = |target| self.chain_is_in_view(source, at, target);
        let arriving = source::unoccluded_if(self.scene, source, at, in_view)?;
        let weighted_lx = arriving.illuminance_lx / width.min(1.0);
        Some(Candidate { source, target: arriving.target, weighted_lx })
    }
}
