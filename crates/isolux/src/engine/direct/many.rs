//! Direct light of many luminaires by few shadow rays.
//!
//! A comb of evenly spaced teeth, shifted at random, is laid over all luminaires and images, each as
//! wide as what it is expected to give: in the order of the tree, so that neighbours in space are
//! neighbours under the comb. Those under a tooth are evaluated exactly and looked at; of a cluster under
//! a tooth, one of a few. What is found is divided by the chance of having been chosen (Hansen and
//! Hurwitz 1943), so there is no bias whatever the widths are, and no noise where the widths are right and
//! nothing is hidden.

use super::cut::{Cut, Part, Parts, View};
use super::patches::Patches;
use super::source::{self, Target};
use super::tree::Node;
use super::{Lighting, RAYS_TO_MANY, drawn};
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::units::Rgb;

/// So many times as many points as rays are looked at one by one, without noise.
const MORE_POINTS: usize = 4;

/// Luminaires of a cluster among which one is chosen.
const CHOICE: usize = 8;

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
}

impl Lighting<'_> {
    /// [`Lighting::sampled`] where many readings of a surface lie close by.
    pub(in crate::engine) fn sampled_on(
        &self,
        patches: &Patches,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        if !self.has_many() {
            return self.by_all(at, samples, dice);
        }
        self.lit_by_cut(&self.cut_on(patches, at), at, (RAYS_TO_MANY, samples), dice)
    }

    /// An unbiased estimate by about `rays` shadow rays, where many readings of a surface lie close by; where points are
    /// not many more, by one to each of them.
    pub(in crate::engine) fn by_rays_on(
        &self,
        patches: &Patches,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let samples = (rays / self.area_sources.max(1)).max(1);
        if self.tree.lamps.is_empty() || self.points <= MORE_POINTS * rays {
            return self.by_all(at, samples, dice);
        }
        self.lit_by_cut(&self.cut_on(patches, at), at, (rays, samples), dice)
    }

    /// Direct illuminance from luminaires without surface and their images, by `rays` shadow rays;
    /// `cut` is that of the place.
    pub(super) fn lit_by_many(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let mut sum = Rgb::BLACK;
        self.look(cut, at, rays, dice, |found| sum += found);
        sum / rays as f64
    }

    /// Direct illuminance by so many shadow rays to the luminaires of a cut, and so many to every emitting surface.
    pub(super) fn lit_by_cut(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        (rays, samples): (usize, usize),
        dice: &mut Dice,
    ) -> Rgb {
        let points = self.lit_by_many(cut, at, rays, dice);
        self.others().fold(points, |sum, source| sum + self.lit_by(source, at, samples, dice))
    }

    /// Looks along a comb of `rays` teeth, one more or less: each tells what all would give if they gave
    /// as it does.
    pub(super) fn look(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
        mut found: impl FnMut(Rgb),
    ) {
        let comb = Comb(dice.pair()[0]);
        let choices = dice.fork();
        let Parts { seen, total } = &*cut.parts;
        let scale = rays as f64 / total;
        let mut place = 0.0;
        let mut next = comb.tooth_from(0.0);
        for seen in seen {
            place += seen.weight * scale;
            let teeth = next..comb.tooth_from(place);
            if teeth.is_empty() {
                continue;
            }
            next = teeth.end;
            let Some(view) = &cut.views[seen.chain] else { continue };
            let of_all = total / seen.weight;
            match seen.part {
                Part::Lamp(lamp) => {
                    let lit = self.lit_by_lamp(view, lamp, at) * of_all;
                    teeth.for_each(|_| found(lit));
                }
                Part::Node(node) => teeth.for_each(|tooth| {
                    found(self.lit_by_one_of(node, view, at, choices.pair(tooth, 0)) * of_all);
                }),
            }
        }
    }

    /// The same with a look at each of them.
    pub(super) fn lit_by_each(&self, cut: &Cut, at: &SurfacePoint) -> Rgb {
        let lit = |chain: usize, lamps: std::ops::Range<u32>| -> Rgb {
            let view = cut.views[chain].as_ref();
            view.map_or(Rgb::BLACK, |view| lamps.map(|k| self.lit_by_lamp(view, k, at)).sum())
        };
        let parts = cut.parts.seen.iter().map(|seen| match seen.part {
            Part::Lamp(lamp) => lit(seen.chain, lamp..lamp + 1),
            Part::Node(number) => {
                let node = &self.tree.nodes[number as usize];
                lit(seen.chain, node.first..node.first + node.count)
            }
        });
        parts.sum()
    }

    /// How many luminaires and images a cut holds.
    pub(super) fn count(&self, cut: &Cut) -> usize {
        let count = |part| match part {
            Part::Lamp(_) => 1,
            Part::Node(number) => self.tree.nodes[number as usize].count as usize,
        };
        cut.parts.seen.iter().map(|seen| count(seen.part)).sum()
    }

    /// An unbiased estimate of what a cluster gives, by one of its lamps: chosen in proportion to what it
    /// is expected to give among some that a comb over their power brings.
    fn lit_by_one_of(
        &self,
        node: u32,
        view: &View,
        at: &SurfacePoint,
        [shift, pick]: [f64; 2],
    ) -> Rgb {
        let node: &Node = &self.tree.nodes[node as usize];
        let lamps: [u32; CHOICE] =
            std::array::from_fn(|k| self.tree.member(node, (k as f64 + shift) / CHOICE as f64));
        let share = |lamp: u32| {
            let lamp = &self.tree.lamps[lamp as usize];
            view.lamp_weight(lamp) / lamp.peak_cd
        };
        let shares = lamps.map(share);
        let total: f64 = shares.iter().sum();
        let Some(k) = drawn(&shares, pick * total) else { return Rgb::BLACK };
        let peak_cd = self.tree.lamps[lamps[k] as usize].peak_cd;
        let chance = CHOICE as f64 * (peak_cd / node.peak_cd) * (shares[k] / total);
        self.lit_by_lamp(view, lamps[k], at) / chance
    }

    /// Direct illuminance from one lamp in a view.
    pub(super) fn lit_by_lamp(&self, view: &View, lamp: u32, at: &SurfacePoint) -> Rgb {
        let chain: &[u32] = &self.chains[view.chain];
        if !chain.is_empty() && !self.images.has(lamp, view.chain) {
            return Rgb::BLACK;
        }
        let lamp = &self.tree.lamps[lamp as usize];
        let kind = &self.tree.kinds[lamp.kind as usize];
        let Some(reaching) = view.reaching(lamp.position, &kind.frame) else {
            return Rgb::BLACK;
        };
        let planes = chain.iter().map(|&p| &self.mirrors.planes[p as usize]);
        let target = Target::Point(planes.clone().fold(lamp.position, |p, plane| plane.image(p)));
        let share = self.visibility(chain, at, target, None);
        if share.is_black() {
            return Rgb::BLACK;
        }
        let candela = source::intensity(self.scene, kind.luminaire).intensity_cd(reaching.local);
        let colour = planes.fold(lamp.colour, |colour, plane| colour * plane.reflectance);
        colour * share * (candela * reaching.per_cd)
    }
}
