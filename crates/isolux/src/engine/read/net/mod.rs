//! Adaptive gathering of indirect light on a net of texels, with interpolation between them.
//!
//! Indirect light is smooth along most of a surface, and gathering it costs most of a lightmap or a picture.
//! So where the map is not trusted, light is gathered at one texel of every wide square (as a rule 8 x 8),
//! then of every square half as wide. The second readings are compared with the values that the first
//! predict. Where these differ by more than allowed, noise aside, squares of 2 x 2 follow, and in the end
//! every texel.
//!
//! A texel between gets the value of a plane through the gathered texels about it (moving least squares). Its
//! error counts half of the differences found there, or at the texels that the plane depends on, since
//! differences at least halve from net to net. Light is not interpolated past obstacles. The texels
//! of a picture are its pixels.

mod plane;
mod sight;

use super::map_reader::IndirectReading;
use plane::{Continued, Node, plane};
use rayon::prelude::*;
use sight::Parted;
use std::collections::HashMap;
use std::ops::Range;

/// The factor on differences from one net to the next, twice as fine. Differences shrink to a quarter where
/// light is smooth, to a half at a kink.
const SHRINK: f64 = 0.5;
/// The weight of the mean difference of a square in each of its parts, in differences.
const OF_SQUARE: f64 = 2.0;
/// The allowed interpolation error, as a share of the error that a reading has anyway.
const OF_ERROR: f64 = 0.5;
/// The number of texels in a plane that smooths light.
const SMOOTHED_OVER: f64 = 12.0;
/// The largest factor on that number for noisy light.
const MOST_SMOOTHED: f64 = 8.0;
/// The share of the texels left out by a net that refinement is expected to gather.
const REFINED: f64 = 0.5;

/// The fineness of a net.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// The number of texels across the widest squares, a power of two from 4 to 256.
    pub widest: usize,
    /// The number of texels across the finest squares: 1, or a smaller power of two than `widest`.
    pub finest: usize,
    /// The allowed interpolation error as a share of the light, if that is more than half of the error of a
    /// reading.
    pub of_light: f64,
    /// The relative noise above which a texel, gathered or not, is smoothed in the end by a plane through
    /// many of its nearest. A picture shows noise that an interval only states.
    pub smoothed_above: f64,
    /// The relative noise that smoothing aims at, with planes through several times as many texels at most.
    pub smoothed_to: f64,
}

impl Fineness {
    /// The fineness for lightmaps: as good as readings, except that visible spots are smoothed.
    pub const TEXELS: Self =
        Self { widest: 8, finest: 1, of_light: 0.0, smoothed_above: 0.05, smoothed_to: 0.02 };
    /// The fineness for pictures, whose pixels are many and where steps of a few per cent are invisible.
    pub const PIXELS: Self =
        Self { widest: 16, finest: 2, of_light: 0.02, smoothed_above: 0.0, smoothed_to: 0.005 };

    /// The distance beyond which texels do not count, texels: one and a half times the widest squares.
    fn reach(&self) -> f64 {
        1.5 * self.widest as f64
    }

    /// The distance below which the weight of texels hardly grows, texels. One texel alone makes no plane.
    fn soft(&self) -> f64 {
        0.25 * self.widest as f64
    }

    /// The distance of a texel from the centroid of its plane beyond which one texel of its square is
    /// gathered, to measure the error there; in texels.
    fn beyond(&self) -> f64 {
        0.1875 * self.widest as f64
    }

    /// The largest distance of a texel from the centroid of its plane, texels.
    fn most_beyond(&self) -> f64 {
        0.3125 * self.widest as f64
    }

    /// The steps of gathering, in order.
    fn steps(&self) -> impl Iterator<Item = Step> + use<> {
        let (half, finest) = (self.widest / 2, self.finest);
        let refined = std::iter::successors(Some(half / 2), move |size| Some(size / 2))
            .take_while(move |&size| size >= finest);
        [Step::Squares(half), Step::Rims(half)].into_iter().chain(refined.map(Step::Refined))
    }
}

/// A texel whose indirect light is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// The caller's number of the texel.
    pub number: usize,
    /// Column and row.
    pub at: [usize; 2],
    /// The kind of the texel. Light is interpolated only among texels of one kind: of one piece of surface.
    pub kind: u64,
}

/// The state of a wanted texel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Light {
    /// Neither gathered nor interpolated yet.
    Waiting,
    /// Gathered, but the map knows no light there.
    Unknown,
    /// Gathered; with the squared difference from the predicted value and the noise in it, if a value was
    /// predicted.
    Gathered(IndirectReading, Option<Difference>),
    /// Interpolated from others.
    Continued(IndirectReading),
}

/// The result at a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filled {
    /// The caller's number of the texel.
    pub number: usize,
    /// Its light; `None` where the map knows none.
    pub reading: Option<IndirectReading>,
    /// Whether its light was gathered there, not interpolated from others.
    pub is_gathered: bool,
}

/// The square of a difference and the variance of its noise, lx2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Difference {
    squared: f64,
    noise: f64,
}

/// Whether two texels, by the caller's numbers, see each other.
pub type Sight<'a> = Box<dyn Fn(usize, usize) -> bool + Sync + 'a>;

/// A net over the wanted texels.
pub struct Net<'a> {
    fineness: Fineness,
    sight: Sight<'a>,
    /// The texels ordered by their widest squares, then by the squares within.
    wanted: Vec<Wanted>,
    /// The state of each texel.
    light: Vec<Light>,
    /// The texels of each widest square.
    squares: Vec<Range<usize>>,
    /// The gathered texels of each widest square.
    nodes: Vec<Vec<usize>>,
    by_place: HashMap<(u64, [usize; 2]), usize>,
    parted: Parted,
    /// Whether fewer texels were gathered than were chosen.
    is_cut_short: bool,
}

/// A step of gathering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// One texel of every square of this width, texels.
    Squares(usize),
    /// One texel of every square of this width that extends too far beyond the gathered texels.
    Rims(usize),
    /// One texel of every square of this width where gathered texels deviate from their predictions.
    Refined(usize),
}

impl<'a> Net<'a> {
    /// An empty net over the texels, which are put in order.
    pub fn new(mut wanted: Vec<Wanted>, fineness: Fineness, sight: Sight<'a>) -> Self {
        let widest = fineness.widest;
        wanted.sort_unstable_by_key(|w| (w.kind, square(w.at, widest), within(w.at), w.number));
        let key = |w: &Wanted| (w.kind, square(w.at, widest));
        let mut squares = Vec::new();
        let mut first = 0;
        for of_square in wanted.chunk_by(|a, b| key(a) == key(b)) {
            squares.push(first..first + of_square.len());
            first += of_square.len();
        }
        let by_place = squares.iter().enumerate().map(|(k, of)| (key(&wanted[of.start]), k));
        let by_place = by_place.collect();
        let parted = Parted::default();
        let (light, nodes) = (vec![Light::Waiting; wanted.len()], vec![Vec::new(); squares.len()]);
        Self {
            fineness,
            sight,
            wanted,
            light,
            squares,
            nodes,
            by_place,
            parted,
            is_cut_short: false,
        }
    }

    /// Gathers light step by step, and interpolates it to all texels. `gather` receives the numbers of the
    /// texels to gather at and the number expected after them. If it returns readings of the first texels
    /// only, it is not called again. Light is then interpolated only to texels where the error of that is
    /// known.
    pub fn fill<E>(
        &mut self,
        mut gather: impl FnMut(&[usize], f64) -> Result<Vec<Option<IndirectReading>>, E>,
    ) -> Result<(), E> {
        let middles = self.squares.iter().map(|square| self.middle(square.clone())).collect();
        let mut one_step = |net: &mut Self, chosen: Vec<usize>, after: f64| {
            if net.is_cut_short {
                return Ok(());
            }
            let numbers: Vec<usize> = chosen.iter().map(|&k| net.wanted[k].number).collect();
            let gathered = gather(&numbers, after)?;
            net.is_cut_short = gathered.len() < numbers.len();
            net.store(&chosen, &gathered);
            Ok(())
        };
        let after = self.foreseen() - self.squares.len() as f64;
        one_step(self, middles, after)?;
        for step in self.fineness.steps() {
            let chosen = self.chosen(step);
            let after = self.foreseen() - chosen.len() as f64;
            one_step(self, chosen, after.max(0.0))?;
        }
        one_step(self, self.left(), 0.0)?;
        self.finish();
        Ok(())
    }

    /// Whether fewer texels were gathered than were chosen.
    pub fn is_cut_short(&self) -> bool {
        self.is_cut_short
    }

    /// The results at all texels.
    pub fn filled(&self) -> impl Iterator<Item = Filled> + '_ {
        self.wanted.iter().zip(&self.light).map(|(wanted, light)| {
            let (reading, is_gathered) = match *light {
                Light::Gathered(reading, _) => (Some(reading), true),
                Light::Continued(reading) => (Some(reading), false),
                Light::Unknown | Light::Waiting => (None, false),
            };
            Filled { number: wanted.number, reading, is_gathered }
        })
    }

    /// The estimated number of texels still to be gathered: one of each square that has none, and a share of
    /// the rest, except where interpolation is known to be good enough.
    pub fn foreseen(&self) -> f64 {
        let parts = self.parts(self.fineness.widest / 2).into_iter();
        let (mut squares, mut waiting) = (0.0, 0.0);
        for part in parts.filter(|part| self.is_rough(part)) {
            let light = &self.light[part.clone()];
            waiting += light.iter().filter(|light| **light == Light::Waiting).count() as f64;
            squares += f64::from(u8::from(!self.has_gathered(&part)));
        }
        let finest = (self.fineness.finest * self.fineness.finest) as f64;
        squares + REFINED * (waiting - squares) / finest
    }

    /// The texels to gather at in a step.
    fn chosen(&self, step: Step) -> Vec<usize> {
        let is_new = |part: &Range<usize>| !self.has_gathered(part);
        match step {
            Step::Squares(size) => self.farthest(self.parts(size).into_iter().filter(is_new)),
            Step::Rims(size) => {
                let parts = self.parts(size).into_par_iter();
                parts.filter_map(|part| self.farthest_out(part)).collect()
            }
            Step::Refined(size) => {
                let rough = self.squares.iter().filter(|square| self.is_rough(square));
                let parts = rough.flat_map(|square| self.split(square.clone(), 4 * size));
                let rough = parts.filter(|part| self.is_rough(part));
                self.farthest(rough.flat_map(|part| self.split(part, size)).filter(is_new))
            }
        }
    }

    /// The texel of each part that is farthest from all gathered or chosen texels. A plane is likely to be
    /// worst there, and the reading there measures its error.
    fn farthest(&self, parts: impl Iterator<Item = Range<usize>>) -> Vec<usize> {
        let mut taken = self.nodes.clone();
        parts
            .map(|part| {
                let mut farthest = (part.start, 0);
                for k in part {
                    let away = self.away(k, &taken);
                    if away > farthest.1 {
                        farthest = (k, away);
                    }
                }
                taken[self.square_of(farthest.0)].push(farthest.0);
                farthest.0
            })
            .collect()
    }

    /// The square of the distance to the nearest taken texel, texels squared.
    fn away(&self, k: usize, taken: &[Vec<usize>]) -> usize {
        let off = |other: usize, c: usize| self.wanted[other].at[c].abs_diff(self.wanted[k].at[c]);
        let taken = self.squares_about(k).flat_map(|square| &taken[square]);
        let away = taken.map(|&other| off(other, 0).pow(2) + off(other, 1).pow(2));
        away.min().unwrap_or(usize::MAX)
    }

    /// The texel of a part farthest from the centroid of its plane, if that is too far.
    fn farthest_out(&self, part: Range<usize>) -> Option<usize> {
        let waiting = part.filter(|&k| self.light[k] == Light::Waiting);
        let beyond = waiting.filter_map(|k| Some((k, self.continued(k)?.beyond)));
        let farthest = beyond.max_by(|(_, a), (_, b)| a.total_cmp(b));
        farthest.filter(|&(_, beyond)| beyond > self.fineness.beyond()).map(|(k, _)| k)
    }

    /// The square of a texel and its neighbours.
    fn squares_about(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        let Wanted { at, kind, .. } = self.wanted[k];
        let [x, y] = square(at, self.fineness.widest);
        let near = |c: usize| c.saturating_sub(1)..c + 2;
        near(y)
            .flat_map(move |y| near(x).map(move |x| [x, y]))
            .filter_map(move |place| self.by_place.get(&(kind, place)).copied())
    }

    fn square_of(&self, k: usize) -> usize {
        self.squares.partition_point(|square| square.end <= k)
    }

    fn parts(&self, size: usize) -> Vec<Range<usize>> {
        self.squares.iter().flat_map(|square| self.split(square.clone(), size)).collect()
    }

    fn split(&self, part: Range<usize>, size: usize) -> Vec<Range<usize>> {
        let mut first = part.start;
        let texels = &self.wanted[part];
        texels
            .chunk_by(|a, b| square(a.at, size) == square(b.at, size))
            .map(|of_square| {
                first += of_square.len();
                first - of_square.len()..first
            })
            .collect()
    }

    fn has_gathered(&self, part: &Range<usize>) -> bool {
        self.light[part.clone()].iter().any(|light| *light != Light::Waiting)
    }

    /// The texel nearest to the centroid of a part.
    fn middle(&self, part: Range<usize>) -> usize {
        let texels = &self.wanted[part.clone()];
        let mean = [0, 1]
            .map(|k| texels.iter().map(|w| w.at[k]).sum::<usize>() as f64 / texels.len() as f64);
        let off = |w: &Wanted| {
            [0, 1].map(|k| w.at[k] as f64 - mean[k]).iter().map(|d| d * d).sum::<f64>()
        };
        let nearest = texels.iter().enumerate().min_by(|(_, a), (_, b)| off(a).total_cmp(&off(b)));
        part.start + nearest.map_or(0, |(k, _)| k)
    }

    /// Whether a part needs more gathered texels before the others can be interpolated.
    fn is_rough(&self, part: &Range<usize>) -> bool {
        if !self.light[part.clone()].contains(&Light::Waiting) {
            return false;
        }
        let Some(found) = self.found_about(part) else { return true };
        let signal = (found.squared - found.noise).max(0.0) * SHRINK * SHRINK;
        let (mut errors_lx, mut lx, mut count) = (0.0, 0.0, 0.0);
        for light in &self.light[part.clone()] {
            if let Light::Gathered(reading, _) = light {
                errors_lx += reading.error_lx;
                lx += reading.lx.luminance();
                count += 1.0;
            }
        }
        let goal_lx =
            (OF_ERROR * errors_lx).max(self.fineness.of_light * lx) / f64::max(count, 1.0);
        signal > goal_lx * goal_lx
    }

    /// The mean difference in a part. The mean of its widest square counts as [`OF_SQUARE`] of its own, since
    /// one or two differences may be small by chance.
    fn found_about(&self, part: &Range<usize>) -> Option<Difference> {
        let (own, count) = self.found(part);
        let (around, count_around) = self.found(&self.squares[self.square_of(part.start)]);
        if count_around == 0.0 {
            return None;
        }
        let mean =
            |own: f64, around: f64| (own + OF_SQUARE * around / count_around) / (count + OF_SQUARE);
        Some(Difference {
            squared: mean(own.squared, around.squared),
            noise: mean(own.noise, around.noise),
        })
    }

    /// The sum of the differences in a part, and their number.
    fn found(&self, part: &Range<usize>) -> (Difference, f64) {
        let differences = self.light[part.clone()].iter().filter_map(|light| match light {
            Light::Gathered(_, difference) => *difference,
            _ => None,
        });
        differences.fold((Difference::default(), 0.0), |(sum, count), difference| {
            let squared = sum.squared + difference.squared;
            (Difference { squared, noise: sum.noise + difference.noise }, count + 1.0)
        })
    }

    /// Stores the readings of a step. None of them predicts another.
    fn store(&mut self, chosen: &[usize], gathered: &[Option<IndirectReading>]) {
        let light: Vec<Light> = chosen
            .par_iter()
            .zip(gathered)
            .map(|(&k, gathered)| match gathered {
                None => Light::Unknown,
                Some(reading) => {
                    let expected = self.continued_in_sight(k);
                    Light::Gathered(
                        *reading,
                        expected.map(|expected| difference(reading, &expected.reading)),
                    )
                }
            })
            .collect();
        for (&k, light) in chosen.iter().zip(light) {
            self.light[k] = light;
            let square = self.square_of(k);
            self.nodes[square].push(k);
        }
        let parted: Vec<(usize, Vec<usize>)> =
            chosen.par_iter().map(|&k| (k, self.parted_from(k))).collect();
        for (k, others) in parted {
            self.parted.add(k, others.into_iter());
        }
    }

    /// The gathered texels about a gathered texel that differ from it and do not see it.
    fn parted_from(&self, k: usize) -> Vec<usize> {
        let Light::Gathered(own, _) = self.light[k] else { return Vec::new() };
        let is_seen = self.seen_from(k);
        let others = self.nodes_about(k).filter(|node| !sight::are_alike(&node.reading, &own));
        others.filter(|node| !is_seen(node)).map(|node| node.index).collect()
    }

    /// The texels that cannot be interpolated, or that see no gathered texel. They are gathered, too.
    fn left(&self) -> Vec<usize> {
        let is_told = |k: usize| self.continued_in_sight(k).is_some_and(|c| self.is_near(&c));
        let is_left = |&k: &usize| self.light[k] == Light::Waiting && !is_told(k);
        (0..self.light.len()).into_par_iter().filter(is_left).collect()
    }

    /// Whether the texel is near enough to the centroid of its plane.
    fn is_near(&self, continued: &Continued) -> bool {
        continued.beyond <= self.fineness.most_beyond()
    }

    /// Interpolates light to the remaining texels, then smooths noisy ones.
    fn finish(&mut self) {
        let parts = self.parts(self.fineness.widest / 2).into_par_iter();
        let continued: Vec<(usize, IndirectReading)> =
            parts.flat_map_iter(|part| self.told_of(part)).collect();
        for (k, reading) in continued {
            self.light[k] = Light::Continued(reading);
        }
        let all = (0..self.light.len()).into_par_iter();
        let smooth: Vec<_> = all.map(|k| self.smoothed(k)).collect();
        for (light, smooth) in self.light.iter_mut().zip(smooth) {
            let Some(smooth) = smooth else { continue };
            match light {
                Light::Gathered(reading, _) | Light::Continued(reading) => *reading = smooth,
                Light::Waiting | Light::Unknown => {}
            }
        }
    }

    /// The light of the remaining texels of a part, as far as it can be interpolated.
    fn told_of(&self, part: Range<usize>) -> Vec<(usize, IndirectReading)> {
        let found = self.found_about(&part);
        if self.is_cut_short && found.is_none() {
            return Vec::new();
        }
        let found = found.map_or(0.0, |found| found.squared);
        let told = |k: usize| {
            let told = self.continued(k).filter(|c| !self.is_cut_short || self.is_near(c));
            let Continued { reading, squared, .. } = told?;
            let left = SHRINK * found.max(squared).sqrt();
            let error_lx = libm::hypot(reading.error_lx, left);
            Some((k, IndirectReading { error_lx, ..reading }))
        };
        part.filter(|&k| self.light[k] == Light::Waiting).filter_map(told).collect()
    }

    /// The light of a noisy texel by a plane through many of its nearest gathered texels; `None` where noise
    /// is low.
    fn smoothed(&self, k: usize) -> Option<IndirectReading> {
        let (Light::Gathered(own, _) | Light::Continued(own)) = self.light[k] else { return None };
        let Fineness { smoothed_above, smoothed_to, .. } = self.fineness;
        if smoothed_above > 0.0 && own.noise_lx <= smoothed_above * own.lx.luminance() {
            return None;
        }
        let mut about: Vec<Node> = self.nodes_about(k).collect();
        about.sort_unstable_by(|a, b| a.away_squared().total_cmp(&b.away_squared()));
        about.truncate((SMOOTHED_OVER * MOST_SMOOTHED) as usize + 1);
        self.keep_seen(k, &mut about);
        let mut by = |count: f64| {
            let last = about.len().checked_sub(1)?.min(count as usize);
            // The last texel has weight zero, so texels that enter or leave at the rim cause no step.
            let reach = about[last].away_squared() + 1.0;
            for node in &mut about[..=last] {
                node.weight = (1.0 - node.away_squared() / reach).max(0.0).powi(2);
            }
            plane(&about[..=last])
        };
        let first = by(SMOOTHED_OVER)?.reading;
        let noise = first.noise_lx / (smoothed_to * first.lx.luminance()).max(f64::MIN_POSITIVE);
        let more = (noise * noise).clamp(1.0, MOST_SMOOTHED);
        let Continued { reading, squared, .. } = by(SMOOTHED_OVER * more)?;
        let error_lx = libm::hypot(reading.error_lx, SHRINK * squared.sqrt());
        Some(IndirectReading { error_lx, ..reading })
    }

    /// The light of a texel by a plane through the gathered texels about it; `None` if they are too few.
    fn continued(&self, k: usize) -> Option<Continued> {
        let mut about: Vec<Node> = self.nodes_about(k).filter(|node| node.weight > 0.0).collect();
        self.keep_seen(k, &mut about);
        plane(&about)
    }

    /// The light of a texel by a plane as [`Net::continued`] gives it; `None` if it sees none of the nearest
    /// gathered texels.
    fn continued_in_sight(&self, k: usize) -> Option<Continued> {
        let about: Vec<Node> = self.nodes_about(k).filter(|node| node.weight > 0.0).collect();
        sight::nearest_seen(&about, self.seen_from(k))?;
        self.continued(k)
    }

    /// Keeps the gathered texels that no obstacle separates from a texel.
    fn keep_seen(&self, k: usize, about: &mut Vec<Node>) {
        let square = |k: usize| square(self.wanted[k].at, self.fineness.widest);
        let are_near = |a: usize, b: usize| {
            let (a, b) = (square(a), square(b));
            (0..2).all(|c| a[c].abs_diff(b[c]) <= 1)
        };
        self.parted.keep_seen(about, self.seen_from(k), are_near);
    }

    /// Whether a texel sees a gathered one.
    fn seen_from(&self, k: usize) -> impl Fn(&Node) -> bool {
        let own = self.wanted[k].number;
        move |node| node.index == k || (self.sight)(own, self.wanted[node.index].number)
    }

    /// The gathered texels about a texel, with their weights.
    fn nodes_about(&self, k: usize) -> impl Iterator<Item = Node> + '_ {
        let at = self.wanted[k].at;
        let (reach, soft) = (self.fineness.reach(), self.fineness.soft());
        let about = self.squares_about(k).flat_map(|square| &self.nodes[square]);
        about.filter_map(move |&other| {
            let Light::Gathered(reading, difference) = self.light[other] else { return None };
            let off = [0, 1].map(|c| self.wanted[other].at[c] as f64 - at[c] as f64);
            let squared = off[0] * off[0] + off[1] * off[1];
            let inside = (1.0 - squared / (reach * reach)).max(0.0);
            let weight = (inside / (squared + soft * soft)).powi(2);
            let squared = difference.map_or(0.0, |difference| difference.squared);
            Some(Node { index: other, off, weight, reading, squared })
        })
    }
}

/// The square of a given width that contains a texel.
fn square(at: [usize; 2], size: usize) -> [usize; 2] {
    at.map(|c| c / size)
}

/// The Morton order of a texel within its widest square, in which every smaller square is contiguous.
fn within([x, y]: [usize; 2]) -> usize {
    (0..8).map(|bit| ((x >> bit & 1) << (2 * bit)) | ((y >> bit & 1) << (2 * bit + 1))).sum()
}

fn difference(found: &IndirectReading, expected: &IndirectReading) -> Difference {
    let off_lx = found.lx.luminance() - expected.lx.luminance();
    let noise = found.noise_lx * found.noise_lx + expected.noise_lx * expected.noise_lx;
    Difference { squared: off_lx * off_lx, noise }
}
