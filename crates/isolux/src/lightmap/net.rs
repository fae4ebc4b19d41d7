//! Indirect light gathered on a net of texels, as fine as it needs to be, and continued between them.
//!
//! Indirect light is smooth along most of a chart, and to gather it costs most of a lightmap. Where the map is not to be
//! trusted it is therefore gathered at one texel of every square of 8 x 8, then of every 4 x 4; what the second say is
//! compared with what the first made them expect. Where that differs by more than is asked for, noise aside, squares of 2 x 2
//! follow, and in the end every texel. Between, a plane is laid through the texels about (moving least squares), and half of the
//! differences that were found there, or at the texels that it leans on, counts as error: they shrink at least so much from
//! net to net.

use super::places::Place;
use crate::engine::IndirectReading;
use crate::units::Rgb;
use std::collections::HashMap;
use std::ops::Range;

/// Texels across the widest squares.
const WIDEST: usize = 8;
/// From one net to the next twice as fine differences shrink by this at least: by a quarter where light is smooth,
/// by a half where it has a kink.
const SHRINK: f64 = 0.5;
/// Differences in a square count as much as so many in each of its parts.
const OF_SQUARE: f64 = 2.0;
/// What is left may be this share of the error that a reading has anyway.
const OF_ERROR: f64 = 0.5;
/// Planes lean by no more than what the spread of their places tells: this share of it is added both ways.
const STIFFNESS: f64 = 0.1;
/// Texels farther away than this are not read: half as far again as the widest squares are wide.
const REACH: f64 = 12.0;
/// Texels nearer than this weigh little more: one alone makes no plane.
const SOFT: f64 = 2.0;
/// Planes are continued beyond the texels that they were laid through no farther than this, texels; where it is more
/// than the first, one of a square tells how far off that is.
const BEYOND: f64 = 1.5;
const MOST_BEYOND: f64 = 2.5;
/// Sum of the shares of a plane, taken as positive, beyond which it is a guess.
const MOST_SHARES: f64 = 3.0;

/// A texel whose indirect light is wanted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    /// Its number among those that cover something.
    pub(super) number: usize,
    /// Column and row.
    pub(super) at: [usize; 2],
    /// Light is continued only among texels of the same: chart, and whether in a gap.
    pub(super) kind: (u32, bool),
    /// Where to gather.
    pub(super) place: Place,
}

/// What is known of a texel that is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Light {
    /// Nothing yet.
    Waiting,
    /// It was gathered, and the map knew nothing.
    Unknown,
    /// It was gathered; with the square of how it differed from what was expected, and of what of that is noise.
    Gathered(IndirectReading, Option<Difference>),
    /// It was continued from others.
    Continued(IndirectReading),
}

/// Squares of a difference and of its noise, lx2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Difference {
    squared: f64,
    noise: f64,
}

/// A net over the texels that are wanted.
pub(super) struct Net {
    /// In the order of squares, of each the squares within.
    pub(super) wanted: Vec<Wanted>,
    /// Of each of them.
    pub(super) light: Vec<Light>,
    /// The widest squares.
    squares: Vec<Range<usize>>,
    by_place: HashMap<((u32, bool), [usize; 2]), usize>,
}

/// What comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// One texel of every square of so many texels across.
    Squares(usize),
    /// One of every square of so many texels across whose rim lies beyond what was gathered.
    Rims(usize),
    /// The same in those where texels before disagree.
    Refined(usize),
}

impl Step {
    /// In their order.
    pub(super) const ALL: [Self; 5] = [
        Self::Squares(WIDEST),
        Self::Squares(WIDEST / 2),
        Self::Rims(WIDEST / 2),
        Self::Refined(WIDEST / 4),
        Self::Refined(1),
    ];
}

impl Net {
    /// Orders the texels.
    pub(super) fn new(mut wanted: Vec<Wanted>) -> Self {
        wanted.sort_unstable_by_key(|w| (w.kind, square(w.at, WIDEST), within(w.at), w.number));
        let mut squares = Vec::new();
        let mut first = 0;
        for of_square in
            wanted.chunk_by(|a, b| (a.kind, square(a.at, WIDEST)) == (b.kind, square(b.at, WIDEST)))
        {
            squares.push(first..first + of_square.len());
            first += of_square.len();
        }
        let key = |of: &Range<usize>| (wanted[of.start].kind, square(wanted[of.start].at, WIDEST));
        let by_place = squares.iter().enumerate().map(|(k, of)| (key(of), k)).collect();
        Self { light: vec![Light::Waiting; wanted.len()], wanted, squares, by_place }
    }

    /// How many texels will be gathered at in a step and after it: all of its squares, and that share of the rest.
    pub(super) fn foreseen(&self, step: Step, share: f64) -> f64 {
        let waiting = |of: &[Light]| of.iter().filter(|l| **l == Light::Waiting).count() as f64;
        let squares = match step {
            Step::Squares(_) => {
                let all = self.parts(WIDEST / 2);
                all.into_iter().filter(|square| !self.has_gathered(square)).count() as f64
            }
            Step::Rims(_) | Step::Refined(_) => 0.0,
        };
        squares + share * (waiting(&self.light) - squares)
    }

    /// The texels to gather at in a step.
    pub(super) fn chosen(&self, step: Step) -> Vec<usize> {
        let new = |part: &Range<usize>| !self.has_gathered(part);
        match step {
            Step::Squares(WIDEST) => self.squares.iter().map(|s| self.middle(s.clone())).collect(),
            Step::Squares(size) => self.farthest(self.parts(size).into_iter().filter(new)),
            Step::Rims(size) => {
                let parts = self.parts(size).into_iter();
                parts.filter_map(|part| self.farthest_out(part)).collect()
            }
            Step::Refined(size) => {
                let rough = self.squares.iter().filter(|square| self.is_rough(square));
                let parts = rough.flat_map(|square| self.split(square.clone(), 4 * size));
                let rough = parts.filter(|part| self.is_rough(part));
                self.farthest(rough.flat_map(|part| self.split(part, size)).filter(new))
            }
        }
    }

    /// Of every part, the texel farthest from all that was gathered, or chosen before it: there a plane is most
    /// likely to be off, and there it is told by how much.
    fn farthest(&self, parts: impl Iterator<Item = Range<usize>>) -> Vec<usize> {
        let mut is_taken: Vec<bool> = self.light.iter().map(|l| *l != Light::Waiting).collect();
        parts
            .map(|part| {
                let mut farthest = (part.start, 0);
                for k in part {
                    let away = self.away(k, &is_taken);
                    if away > farthest.1 {
                        farthest = (k, away);
                    }
                }
                is_taken[farthest.0] = true;
                farthest.0
            })
            .collect()
    }

    /// Square of the distance to the nearest texel that is taken, texels squared.
    fn away(&self, k: usize, is_taken: &[bool]) -> usize {
        let taken = self.about(k).filter(|&other| is_taken[other]);
        let away = taken.map(|other| {
            let off = [0, 1].map(|c| self.wanted[other].at[c].abs_diff(self.wanted[k].at[c]));
            off[0] * off[0] + off[1] * off[1]
        });
        away.min().unwrap_or(usize::MAX)
    }

    /// The texel of a part that lies farthest beyond what was gathered.
    fn farthest_out(&self, part: Range<usize>) -> Option<usize> {
        let waiting = part.filter(|&k| self.light[k] == Light::Waiting);
        let beyond = waiting.filter_map(|k| Some((k, self.continued(k)?.beyond)));
        let farthest = beyond.max_by(|(_, a), (_, b)| a.total_cmp(b));
        farthest.filter(|&(_, beyond)| beyond > BEYOND).map(|(k, _)| k)
    }

    /// The texels that the light of one may be continued from, and more.
    fn about(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        let Wanted { at, kind, .. } = self.wanted[k];
        let [x, y] = square(at, WIDEST);
        let near = |c: usize| c.saturating_sub(1)..c + 2;
        near(y)
            .flat_map(move |y| near(x).map(move |x| [x, y]))
            .filter_map(move |place| self.by_place.get(&(kind, place)))
            .flat_map(|&number| self.squares[number].clone())
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
        let errors = self.light[part.clone()].iter().filter_map(|light| match light {
            Light::Gathered(reading, _) => Some(reading.error_lx),
            _ => None,
        });
        let (sum, count) =
            errors.fold((0.0, 0.0), |(sum, count), error| (sum + error, count + 1.0));
        let goal_lx = OF_ERROR * sum / f64::max(count, 1.0);
        signal > goal_lx * goal_lx
    }

    /// Mean differences in a part, to which those in the square that it is part of add as much as a few of its own:
    /// one or two may be small by chance.
    fn found_about(&self, part: &Range<usize>) -> Option<Difference> {
        let square = self.squares.partition_point(|square| square.end <= part.start);
        let (own, count) = self.found(part);
        let (around, count_around) = self.found(&self.squares[square]);
        if count_around == 0.0 {
            return None;
        }
        let mean = |own: f64, around: f64| {
            (own + OF_SQUARE * around / count_around) / (count + OF_SQUARE)
        };
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
    pub(super) fn store(&mut self, chosen: &[usize], gathered: &[Option<IndirectReading>]) {
        let light: Vec<Light> = chosen
            .iter()
            .zip(gathered)
            .map(|(&k, gathered)| match gathered {
                None => Light::Unknown,
                Some(reading) => {
                    let expected = self.continued(k);
                    Light::Gathered(
                        *reading,
                        expected.map(|expected| difference(reading, &expected.reading)),
                    )
                }
            })
            .collect();
        for (&k, light) in chosen.iter().zip(light) {
            self.light[k] = light;
        }
    }

    /// Texels that are left and cannot be continued: they are to be gathered, too.
    pub(super) fn left(&self) -> Vec<usize> {
        let is_told = |k: usize| self.continued(k).is_some_and(|c| c.beyond <= MOST_BEYOND);
        let is_left = |&k: &usize| self.light[k] == Light::Waiting && !is_told(k);
        (0..self.light.len()).filter(is_left).collect()
    }

    /// Continues light to the texels that are left.
    pub(super) fn finish(&mut self) {
        let mut continued = Vec::new();
        for part in self.parts(WIDEST / 2) {
            let found = self.found_about(&part);
            let found = found.map_or(0.0, |found| found.squared);
            for k in part.filter(|&k| self.light[k] == Light::Waiting) {
                if let Some(Continued { reading, squared, .. }) = self.continued(k) {
                    let left = SHRINK * found.max(squared).sqrt();
                    let error_lx = libm::hypot(reading.error_lx, left);
                    continued.push((k, IndirectReading { error_lx, ..reading }));
                }
            }
        }
        for (k, reading) in continued {
            self.light[k] = Light::Continued(reading);
        }
    }

    /// Light of a texel by a plane through what was gathered about it; nothing if too little was.
    fn continued(&self, k: usize) -> Option<Continued> {
        let at = self.wanted[k].at;
        let mut about: Vec<Node> = Vec::new();
        for other in self.about(k) {
            let Light::Gathered(reading, difference) = self.light[other] else { continue };
            let off = [0, 1].map(|c| self.wanted[other].at[c] as f64 - at[c] as f64);
            let squared = off[0] * off[0] + off[1] * off[1];
            let inside = (1.0 - squared / (REACH * REACH)).max(0.0);
            if inside > 0.0 {
                let weight = (inside / (squared + SOFT * SOFT)).powi(2);
                let squared = difference.map_or(0.0, |difference| difference.squared);
                about.push(Node { off, weight, reading, squared });
            }
        }
        plane(&about)
    }
}

/// The square of a size that a texel lies in.
fn square(at: [usize; 2], size: usize) -> [usize; 2] {
    at.map(|c| c / size)
}

/// Order within the widest squares, such that every square within is in one piece.
fn within([x, y]: [usize; 2]) -> usize {
    (0..3).map(|bit| ((x >> bit & 1) << (2 * bit)) | ((y >> bit & 1) << (2 * bit + 1))).sum()
}

fn difference(found: &IndirectReading, expected: &IndirectReading) -> Difference {
    let off_lx = found.lx.luminance() - expected.lx.luminance();
    let noise = found.noise_lx * found.noise_lx + expected.noise_lx * expected.noise_lx;
    Difference { squared: off_lx * off_lx, noise }
}

/// A texel that was gathered, near another.
struct Node {
    /// From that, texels.
    off: [f64; 2],
    weight: f64,
    reading: IndirectReading,
    /// Square of how it differed from what was expected, lx2.
    squared: f64,
}

/// Light of a plane.
struct Continued {
    reading: IndirectReading,
    /// Squares of differences, each as far as the plane leans on where it was found, lx2.
    squared: f64,
    /// How far from the texel the middle of what it was continued from is, texels.
    beyond: f64,
}

/// The value at nought of a plane through weighted readings.
fn plane(about: &[Node]) -> Option<Continued> {
    if about.len() < 2 {
        return None;
    }
    let total: f64 = about.iter().map(|node| node.weight).sum();
    let mean =
        [0, 1].map(|k| about.iter().map(|node| node.weight * node.off[k]).sum::<f64>() / total);
    let spread = |j: usize, k: usize| {
        let one = |node: &Node| node.weight * (node.off[j] - mean[j]) * (node.off[k] - mean[k]);
        about.iter().map(one).sum::<f64>() / total
    };
    let (xx, xy, yy) = (spread(0, 0), spread(0, 1), spread(1, 1));
    // A row of places tells nothing of the way across: the plane is level there.
    let stiff = STIFFNESS * (xx + yy);
    let (xx, yy) = (xx + stiff, yy + stiff);
    let determinant = xx * yy - xy * xy;
    let lean = [yy * mean[0] - xy * mean[1], xx * mean[1] - xy * mean[0]].map(|c| c / determinant);
    let (mut lx, mut error_lx, mut noise) = (Rgb::BLACK, 0.0, 0.0);
    let (mut squared, mut shares) = (0.0, 0.0);
    for Node { off, weight, reading, squared: of_node } in about {
        let along = lean[0] * (off[0] - mean[0]) + lean[1] * (off[1] - mean[1]);
        let share = weight / total * (1.0 - along);
        lx += reading.lx * share;
        error_lx += share.abs() * reading.error_lx;
        noise += share * share * reading.noise_lx * reading.noise_lx;
        squared += share.abs() * of_node;
        shares += share.abs();
    }
    let reading = IndirectReading { lx: lx.map(|c| c.max(0.0)), error_lx, noise_lx: noise.sqrt() };
    (shares <= MOST_SHARES).then_some(Continued { reading, squared, beyond: libm::hypot(mean[0], mean[1]) })
}
