//! A distribution over luminaires, shared by many close places that each draw one luminaire.
//!
//! A cut of the light tree for every place takes ten times as long as the shadow ray that it serves. Places close to
//! each other see nearly the same luminaires. One distribution over clusters, built for all of them, brings a few
//! candidates to each place. One candidate is drawn in proportion to its unoccluded light there (resampled importance
//! sampling: Talbot, Cline, Egbert 2005). The estimate has no bias for any distribution that leaves no luminaire out.

use super::super::lighting::{Lighting, drawn};
use super::super::tree::cut::Part;
use super::super::tree::lobe::turned;
use super::super::tree::{Lamp, Node};
use crate::ablation::without;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::units::Rgb;
use isolux_geometry::Point;

/// Number of candidates, evenly spaced over the distribution.
const CANDIDATES: usize = 8;

/// Radius of a cluster over its distance, up to which it is one part of the distribution.
const TIGHT_RADIUS_RATIO: f64 = 0.4;

/// The smallest expected light of a cluster, as a share of its light at the highest intensity.
/// Other places may see it from another side.
const LEAST_LIGHT_SHARE: f64 = 0.03;

/// Clusters and single luminaires, by chain of mirrors, with the running sums of their expected light.
pub(crate) struct NearbyLuminaires {
    place: Point,
    parts: Vec<(usize, Part)>,
    sums: Vec<f64>,
}

/// Position, size and highest intensity of a cluster or a luminaire.
#[derive(Clone, Copy)]
struct Extent {
    centre: Point,
    radius_m: f64,
    peak_cd: f64,
}

/// A luminaire that may be drawn, by a chain of mirrors.
#[derive(Clone, Copy)]
struct Candidate {
    chain: usize,
    lamp: u32,
    /// Its probability in the distribution.
    chance: f64,
}

impl Lighting<'_> {
    /// The distribution for places within `reach_m` of a place; `None` where the light tree is empty.
    pub(crate) fn about(&self, place: Point, reach_m: f64) -> Option<NearbyLuminaires> {
        if self.tree.lamps.is_empty() || without("nearby-luminaires") {
            return None;
        }
        let mut about = NearbyLuminaires { place, parts: Vec::new(), sums: vec![0.0] };
        let mut waiting = Vec::new();
        for chain in 0..self.chains.len() {
            let (from, reflectance) = self.image_of(place, chain);
            waiting.push(0_u32);
            while let Some(number) = waiting.pop() {
                let node = &self.tree.nodes[number as usize];
                let distance_m = (node.centre - from).length().max(reach_m);
                let weight =
                    |extent: Extent| reflectance * self.expected(node, extent, from, reach_m);
                if node.radius_m <= TIGHT_RADIUS_RATIO * distance_m {
                    let Node { centre, radius_m, peak_cd, .. } = *node;
                    about.push(
                        chain,
                        Part::Node(number),
                        weight(Extent { centre, radius_m, peak_cd }),
                    );
                } else if let Some(second) = node.second {
                    waiting.extend([second, number + 1]);
                } else {
                    for lamp in node.first..node.first + node.count {
                        let of = &self.tree.lamps[lamp as usize];
                        let &Lamp { position: centre, peak_cd, .. } = of;
                        let extent = Extent { centre, radius_m: self.tree.radius_m(of), peak_cd };
                        about.push(chain, Part::Lamp(lamp), weight(extent));
                    }
                }
            }
        }
        (about.total() > 0.0).then_some(about)
    }

    /// A place as reflected back to the luminaires by a chain of mirrors, and the reflectance of the chain.
    fn image_of(&self, place: Point, chain: usize) -> (Point, f64) {
        let planes = self.chains[chain].iter().map(|&p| &self.mirrors.planes[p as usize]);
        planes.rev().fold((place, 1.0), |(point, left), plane| {
            (plane.image(point), left * plane.reflectance.max_channel())
        })
    }

    /// Expected light of a cluster, or of a part of it, about a place, for any direction that a receiver faces.
    fn expected(&self, node: &Node, part: Extent, from: Point, reach_m: f64) -> f64 {
        let to = part.centre - from;
        let extent_m = (part.radius_m + reach_m).max(f64::MIN_POSITIVE);
        let distance_m = to.length().max(extent_m);
        let local = match node.kind {
            Some(kind) => turned(&self.tree.kinds[kind as usize].frame, -to),
            None => -to,
        };
        let shape = self.tree.lobes.towards(node.lobe, extent_m / distance_m, local);
        part.peak_cd * shape.max(LEAST_LIGHT_SHARE) / (distance_m * distance_m)
    }

    /// An unbiased estimate of the direct illuminance at a place by one shadow ray, or two if there
    /// are sources outside the light tree.
    ///
    /// A place has its own cut if a luminaire is nearer to it than the place of the distribution
    /// is, as on a ceiling close above. That luminaire would give far more than the distribution
    /// expects. For other places every luminaire is at least half as far away as from the place of
    /// the distribution, so its light is at most a few times the expected.
    pub(crate) fn estimate_by(
        &self,
        about: &NearbyLuminaires,
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Rgb {
        let away_m = (at.point - about.place).length();
        if self.tree.nearest_m(at.point, away_m) < away_m {
            return self.estimate(at, dice);
        }
        let [shift, pick] = dice.pair();
        let candidates: [Candidate; CANDIDATES] =
            std::array::from_fn(|k| self.candidate(about, (k as f64 + shift) / CANDIDATES as f64));
        let ratio = |&Candidate { chain, lamp, chance }: &Candidate| {
            let is_there = self.chains[chain].is_empty() || self.images.has(lamp, chain);
            let view = self.view(chain, at, 0.0).filter(|_| is_there);
            view.map_or(0.0, |v| v.lamp_weight(&self.tree.lamps[lamp as usize])) / chance
        };
        let ratios = candidates.each_ref().map(ratio);
        let total: f64 = ratios.iter().sum();
        let lit = drawn(&ratios, pick * total).and_then(|k| {
            let Candidate { chain, lamp, chance } = candidates[k];
            let view = self.view(chain, at, 0.0)?;
            let share = CANDIDATES as f64 * chance * ratios[k] / total;
            Some(self.lit_by_lamp(&view, lamp, at, dice) / share)
        });
        lit.unwrap_or(Rgb::BLACK) + self.estimate_of_others(at, dice)
    }

    /// The candidate at a place from 0 to 1 on a distribution.
    fn candidate(&self, about: &NearbyLuminaires, place: f64) -> Candidate {
        let sum = place * about.total();
        let k = about.sums.partition_point(|&s| s <= sum).clamp(1, about.parts.len()) - 1;
        let (from, weight) = (about.sums[k], about.sums[k + 1] - about.sums[k]);
        let (chain, part) = about.parts[k];
        let chance = weight / about.total();
        match part {
            Part::Lamp(lamp) => Candidate { chain, lamp, chance },
            Part::Node(number) => {
                let node = &self.tree.nodes[number as usize];
                let inside = ((sum - from) / weight).clamp(0.0, 1.0);
                let lamp = self.tree.member(node, inside);
                let of_node = self.tree.lamps[lamp as usize].peak_cd / node.peak_cd;
                Candidate { chain, lamp, chance: chance * of_node }
            }
        }
    }
}

impl NearbyLuminaires {
    fn push(&mut self, chain: usize, part: Part, weight: f64) {
        if weight > 0.0 {
            self.parts.push((chain, part));
            self.sums.push(self.total() + weight);
        }
    }

    fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }
}
