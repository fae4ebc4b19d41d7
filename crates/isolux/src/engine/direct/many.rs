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
use super::source::{self, Target};
use super::tree::Node;
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::units::Rgb;

/// Luminaires evaluated for every one that is looked at.
const EVALUATED_A_RAY: usize = 4;

/// A luminaire or image under a tooth.
struct Candidate<'s> {
    chain: &'s [u32],
    target: Target,
    /// What it would give without obstacles over the chance of having been chosen, lx.
    weighted_lx: Rgb,
}

/// The teeth of a comb: whole numbers plus a shift.
#[derive(Clone, Copy)]
struct Comb(f64);

impl Comb {
    /// The number of the first tooth at or after a place of zero or more.
    fn tooth_from(self, place: f64) -> u32 {
        let teeth = place - self.0;
        let whole = teeth as u32;
        whole + u32::from(teeth > f64::from(whole))
    }

    /// Whether a tooth lies in `[from, to)`.
    fn meets(self, from: f64, to: f64) -> bool {
        self.tooth_from(from) < self.tooth_from(to)
    }
}

/// A part of the tree between two places of the comb.
#[derive(Clone, Copy)]
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
                let share = self.visibility(candidate.chain, at, candidate.target, None);
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
        let mut waiting: Vec<Span> = Vec::with_capacity(64);
        let (mut from, scale) = (0.0, count as f64 / cut.total);
        for &Seen { view, part, weight } in &cut.seen {
            let to = from + weight * scale;
            if comb.meets(from, to) {
                waiting.push(Span { part, from, to });
                let seeing = Seeing { view: &cut.views[view], at, comb };
                while let Some(span) = waiting.pop() {
                    self.choose(&seeing, &span, &mut waiting, &mut found);
                }
            }
            from = to;
        }
        found
    }

    /// Chooses a lamp or lamps under the teeth of a span, or divides it.
    fn choose<'s>(
        &'s self,
        seeing: &Seeing,
        span: &Span,
        waiting: &mut Vec<Span>,
        found: &mut Vec<Candidate<'s>>,
    ) {
        match span.part {
            Part::Lamp(lamp) => found.extend(self.candidate(seeing, lamp, span.to - span.from)),
            Part::Node(number) => {
                let node = &self.tree.nodes[number as usize];
                match node.second {
                    _ if node.kind.is_some() => self.choose_alike(seeing, span, node, found),
                    Some(second) => {
                        divide(seeing, span, [number + 1, second].map(Part::Node), waiting);
                    }
                    None => {
                        let lamps = node.first..node.first + node.count;
                        divide(seeing, span, lamps.map(Part::Lamp), waiting);
                    }
                }
            }
        }
    }

    /// Chooses among lamps of one kind by their power alone.
    fn choose_alike<'s>(
        &'s self,
        seeing: &Seeing,
        span: &Span,
        node: &Node,
        found: &mut Vec<Candidate<'s>>,
    ) {
        let (first, end) = (node.first as usize, (node.first + node.count) as usize);
        let sums_cd = &self.tree.peak_sums_cd[first..=end];
        let scale = (span.to - span.from) / (sums_cd[sums_cd.len() - 1] - sums_cd[0]);
        let mut last = None;
        let comb = seeing.comb;
        for tooth in comb.tooth_from(span.from)..comb.tooth_from(span.to) {
            let sum_cd = sums_cd[0] + (f64::from(tooth) + comb.0 - span.from) / scale;
            let lamp = place_in(sums_cd, sum_cd);
            if last != Some(lamp) {
                let width = (sums_cd[lamp + 1] - sums_cd[lamp]) * scale;
                found.extend(self.candidate(seeing, (first + lamp) as u32, width));
            }
            last = Some(lamp);
        }
    }

    /// What a lamp chosen with a width under the comb gives.
    fn candidate(&self, seeing: &Seeing, lamp: u32, width: f64) -> Option<Candidate<'_>> {
        let Seeing { view, at, .. } = *seeing;
        let chain: &[u32] = &self.chains[view.chain];
        if !chain.is_empty() && !self.images.has(lamp, view.chain) {
            return None;
        }
        let lamp = &self.tree.lamps[lamp as usize];
        let planes = chain.iter().map(|&p| &self.mirrors.planes[p as usize]);
        let target = Target::Point(planes.clone().fold(lamp.position, |p, plane| plane.image(p)));
        if !self.chain_is_in_view(chain, at, target) {
            return None;
        }
        let kind = &self.tree.kinds[lamp.kind as usize];
        let reaching = view.reaching(lamp.position, &kind.frame)?;
        let candela = source::intensity(self.scene, kind.luminaire).intensity_cd(reaching.local);
        let colour = planes.fold(lamp.colour, |colour, plane| colour * plane.reflectance);
        let weighted_lx = colour * (candela * reaching.per_cd / width.min(1.0));
        (!weighted_lx.is_black()).then_some(Candidate { chain, target, weighted_lx })
    }
}

/// The interval of running sums that a sum lies in: where it lies if all are alike, else searched for.
fn place_in(sums: &[f64], sum: f64) -> usize {
    let last = sums.len() - 2;
    let share = (sum - sums[0]) / (sums[last + 1] - sums[0]);
    let guess = ((share * (last + 1) as f64) as usize).min(last);
    if sums[guess] <= sum && sum < sums[guess + 1] {
        return guess;
    }
    sums.partition_point(|&s| s <= sum).clamp(1, last + 1) - 1
}

/// Who looks, and the comb.
struct Seeing<'a> {
    view: &'a View<'a>,
    at: &'a SurfacePoint,
    comb: Comb,
}

/// Divides a span among parts by their weights, and keeps those under a tooth, the last first.
fn divide(
    seeing: &Seeing,
    span: &Span,
    parts: impl IntoIterator<Item = Part>,
    waiting: &mut Vec<Span>,
) {
    let first = waiting.len();
    let mut sum = 0.0;
    for part in parts {
        let from = sum;
        sum += seeing.view.weight(part);
        waiting.push(Span { part, from, to: sum });
    }
    let place = |s: f64| span.from + (span.to - span.from) * (s / sum);
    let mut kept = first;
    for k in first..waiting.len() {
        let Span { part, from, to } = waiting[k];
        let (from, to) = (place(from), place(to));
        if sum > 0.0 && seeing.comb.meets(from, to) {
            waiting[kept] = Span { part, from, to };
            kept += 1;
        }
    }
    waiting.truncate(kept);
    waiting[first..].reverse();
}
