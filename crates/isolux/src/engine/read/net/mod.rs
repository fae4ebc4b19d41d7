//! Indirect light gathered on a net of texels, as fine as it needs to be, and continued between them.
//!
//! Indirect light is smooth along most of a surface, and to gather it costs most of a lightmap, or of a picture. Where the
//! map is not to be trusted it is therefore gathered at one texel of every wide square, of 8 x 8 as a rule, then of every
//! one half as wide; what the second say is compared with what the first made them expect. Where that differs by more than
//! is asked for, noise aside, squares of 2 x 2 follow, and in the end every texel. Between, a plane is laid through the
//! texels about (moving least squares), and half of the differences that were found there, or at the texels that it leans on,
//! counts as error: they shrink at least so much from net to net. The texels of a picture are its pixels.
//! Light is not continued past what stands between.

mod plane;
mod sight;

use super::map_reader::IndirectReading;
use plane::{Continued, Node, plane};
use rayon::prelude::*;
use sight::Parted;
use std::collections::HashMap;
use std::ops::Range;

/// From one net to the next twice as fine differences shrink by this at least: by a quarter where light is smooth,
/// by a half where it has a kink.
const SHRINK: f64 = 0.5;
/// Differences in a square count as much as so many in each of its parts.
const OF_SQUARE: f64 = 2.0;
/// What is left may be this share of the error that a reading has anyway.
const OF_ERROR: f64 = 0.5;
/// Texels that a plane is laid through where light is smoothed, and so many times as many at most where that is noisy.
const SMOOTHED_OVER: f64 = 12.0;
const MOST_SMOOTHED: f64 = 8.0;
/// Of the texels that a net leaves out, those that it will be refined by, as far as can be foreseen: half of them.
const REFINED: f64 = 0.5;

/// How fine a net is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Texels across the widest squares, a power of two from 4 to 256.
    pub widest: usize,
    /// Texels across the finest: 1, or a smaller power of two.
    pub finest: usize,
    /// What is left may be this share of the light, if that is more than half of the error of a reading.
    pub of_light: f64,
    /// In the end texels whose noise is more than this share of their light, those gathered at, too, get the light of a plane through
    /// many of those nearest: a picture shows noise that an interval only states.
    pub smoothed_above: f64,
    /// These have no more noise than this share of the light, if planes through several times as many texels will do.
    pub smoothed_to: f64,
}

impl Fineness {
    /// For lightmaps: as good as readings, but for those that are seen as spots.
    pub const TEXELS: Self =
        Self { widest: 8, finest: 1, of_light: 0.0, smoothed_above: 0.05, smoothed_to: 0.02 };
    /// For pictures, in which pixels are many and steps of a few per cent are not to be seen.
    pub const PIXELS: Self =
        Self { widest: 16, finest: 2, of_light: 0.02, smoothed_above: 0.0, smoothed_to: 0.005 };

    /// Texels farther away than this are not read: half as far again as the widest squares are wide.
    fn reach(&self) -> f64 {
        1.5 * self.widest as f64
    }

    /// Texels nearer than this weigh little more: one alone makes no plane.
    fn soft(&self) -> f64 {
        0.25 * self.widest as f64
    }

    /// Where a plane is continued farther than this beyond the texels that it was laid through, one of a square tells
    /// how far off that is.
    fn beyond(&self) -> f64 {
        0.1875 * self.widest as f64
    }

    /// No plane is continued farther.
    fn most_beyond(&self) -> f64 {
        0.3125 * self.widest as f64
    }

    /// In their order.
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
    /// Its number among those of the caller.
    pub number: usize,
    /// Column and row.
    pub at: [usize; 2],
    /// Light is continued only among texels of the same kind: of one piece of surface.
    pub kind: u64,
}

/// What is known of a texel that is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Light {
    /// Nothing yet.
    Waiting,
    /// It was gathered, and the map knew nothing.
    Unknown,
    /// It was gathered; with the square of how it differed from what was expected, and of what of that is noise.
    Gathered(IndirectReading, Option<Difference>),
    /// It was continued from others.
    Continued(IndirectReading),
}

/// What became of a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filled {
    /// Its number among those of the caller.
    pub number: usize,
    /// Its light; nothing where the map knows none.
    pub reading: Option<IndirectReading>,
    /// Whether that was gathered there, and not continued from others.
    pub is_gathered: bool,
}

/// Squares of a difference and of its noise, lx2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Difference {
    squared: f64,
    noise: f64,
}

/// Whether two texels see each other, by their numbers among those of the caller.
pub type Sight<'a> = Box<dyn Fn(usize, usize) -> bool + Sync + 'a>;

/// A net over the texels that are wanted.
pub struct Net<'a> {
    fineness: Fineness,
    sight: Sight<'a>,
    /// In the order of squares, of each the squares within.
    wanted: Vec<Wanted>,
    /// Of each of them.
    light: Vec<Light>,
    /// The widest squares.
    squares: Vec<Range<usize>>,
    /// Of each square, what was gathered.
    nodes: Vec<Vec<usize>>,
    by_place: HashMap<(u64, [usize; 2]), usize>,
    parted: Parted,
    /// Whether less was gathered than was asked for.
    is_cut_short: bool,
}

/// What comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// One texel of every square of so many texels across.
    Squares(usize),
    /// One of every square of so many texels across whose rim lies beyond what was gathered.
    Rims(usize),
    /// One of every square where texels before disagree.
    Refined(usize),
}

impl<'a> Net<'a> {
    /// Orders the texels.
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

    /// Gathers light, step by step, and continues it to all texels. `gather` is told the numbers of texels to gather at, and
    /// how many more are expected after them. Where it gives readings of the first of them alone no more is asked of it: light is
    /// continued only to where it is known how good that is.
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

    /// Whether less was gathered than was asked for.
    pub fn is_cut_short(&self) -> bool {
        self.is_cut_short
    }

    /// What all texels have come to.
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

    /// How many texels are still to be gathered at, about: one of each square that has none yet, and a share of the rest, as far as it
    /// is not known yet that they can be continued.
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

    /// Of every part, the texel farthest from all that was gathered, or chosen before it: there a plane is most
    /// likely to be off, and there it is told by how much.
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

    /// Square of the distance to the nearest texel that is taken, texels squared.
    fn away(&self, k: usize, taken: &[Vec<usize>]) -> usize {
        let off = |other: usize, c: usize| self.wanted[other].at[c].abs_diff(self.wanted[k].at[c]);
        let taken = self.squares_about(k).flat_map(|square| &taken[square]);
        let away = taken.map(|&other| off(other, 0).pow(2) + off(other, 1).pow(2));
        away.min().unwrap_or(usize::MAX)
    }

    /// The texel of a part that lies farthest beyond what was gathered.
    fn farthest_out(&self, part: Range<usize>) -> Option<usize> {
        let waiting = part.filter(|&k| self.light[k] == Light::Waiting);
        let beyond = waiting.filter_map(|k| Some((k, self.continued(k)?.beyond)));
        let farthest = beyond.max_by(|(_, a), (_, b)| a.total_cmp(b));
        farthest.filter(|&(_, beyond)| beyond > self.fineness.beyond()).map(|(k, _)| k)
    }

    /// The square that a texel lies in, and those around it.
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

    /// The texel nearest to the middle of all of a part.
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

    /// Whether texels there are not yet to be continued from those that were gathered.
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

    /// Mean differences in a part, to which those in the square that it is part of add as much as a few of its own:
    /// one or two may be small by chance.
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

    /// The sum of differences in a part, and how many.
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

    /// Takes in what was gathered in a step: no value of it is expected from another.
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

    /// What was gathered about a texel that was, too, is not like it, and not seen from there.
    fn parted_from(&self, k: usize) -> Vec<usize> {
        let Light::Gathered(own, _) = self.light[k] else { return Vec::new() };
        let is_seen = self.seen_from(k);
        let others = self.nodes_about(k).filter(|node| !sight::are_alike(&node.reading, &own));
        others.filter(|node| !is_seen(node)).map(|node| node.index).collect()
    }

    /// Texels that are left and cannot be continued, or see nothing that was gathered: they are to be gathered, too.
    fn left(&self) -> Vec<usize> {
        let is_told = |k: usize| self.continued_in_sight(k).is_some_and(|c| self.is_near(&c));
        let is_left = |&k: &usize| self.light[k] == Light::Waiting && !is_told(k);
        (0..self.light.len()).into_par_iter().filter(is_left).collect()
    }

    /// Whether a plane is continued no farther than is allowed.
    fn is_near(&self, continued: &Continued) -> bool {
        continued.beyond <= self.fineness.most_beyond()
    }

    /// Continues light to the texels that are left.
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

    /// Light of the texels of a part that are left, as far as it can be continued.
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

    /// Light of a texel by a plane through many of the nearest that were gathered; nothing where it is quiet.
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
            // The last one has no weight, so that who comes and goes at the rim is not to be seen.
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

    /// Light of a texel by a plane through what was gathered about it; nothing if too little was.
    fn continued(&self, k: usize) -> Option<Continued> {
        let mut about: Vec<Node> = self.nodes_about(k).filter(|node| node.weight > 0.0).collect();
        self.keep_seen(k, &mut about);
        plane(&about)
    }

    /// The same; nothing if none of what lies nearest is seen.
    fn continued_in_sight(&self, k: usize) -> Option<Continued> {
        let about: Vec<Node> = self.nodes_about(k).filter(|node| node.weight > 0.0).collect();
        sight::nearest_seen(&about, self.seen_from(k))?;
        self.continued(k)
    }

    /// Keeps what nothing parts from a texel.
    fn keep_seen(&self, k: usize, about: &mut Vec<Node>) {
        let square = |k: usize| square(self.wanted[k].at, self.fineness.widest);
        let are_near = |a: usize, b: usize| {
            let (a, b) = (square(a), square(b));
            (0..2).all(|c| a[c].abs_diff(b[c]) <= 1)
        };
        self.parted.keep_seen(about, self.seen_from(k), are_near);
    }

    /// Whether a texel sees one that was gathered.
    fn seen_from(&self, k: usize) -> impl Fn(&Node) -> bool {
        let own = self.wanted[k].number;
        move |node| node.index == k || (self.sight)(own, self.wanted[node.index].number)
    }

    /// What was gathered about a texel.
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

/// The square of a size that a texel lies in.
fn square(at: [usize; 2], size: usize) -> [usize; 2] {
    at.map(|c| c / size)
}

/// Order within the widest squares, such that every square within is in one piece.
fn within([x, y]: [usize; 2]) -> usize {
    (0..8).map(|bit| ((x >> bit & 1) << (2 * bit)) | ((y >> bit & 1) << (2 * bit + 1))).sum()
}

fn difference(found: &IndirectReading, expected: &IndirectReading) -> Difference {
    let off_lx = found.lx.luminance() - expected.lx.luminance();
    let noise = found.noise_lx * found.noise_lx + expected.noise_lx * expected.noise_lx;
    Difference { squared: off_lx * off_lx, noise }
}
