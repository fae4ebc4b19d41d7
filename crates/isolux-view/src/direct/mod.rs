//! Direct light of a view: evaluated in the middles of few pixels, and interpolated between them where it is smooth.
//!
//! Light is evaluated at the corners and in the middle of squares of 8 x 8 pixels. Where the middle differs from what the
//! corners predict, or where a square shows more than one piece of surface, squares half as wide follow, and in the end
//! single pixels. Squares beside one that differs are split, too, so that a narrow shadow is followed along all of its
//! length once it is found anywhere. Pixels across the edge of a shadow are left to their cells.

mod evened;
mod node;
mod square;

use crate::image::Surface;
use crate::middles::{Middles, on_side};
use crate::trace::SurfacePoint;
use evened::evened;
use isolux::engine::{MapReader, ShadowRays};
use isolux::map::IlluminationMap;
use isolux::units::Rgb;
use node::{DEVIATIONS, Node};
use rayon::prelude::*;
use square::{Square, WIDEST};
use std::collections::BTreeSet;

/// The difference from a prediction that is accepted, as a share of all light: half of what is seen (Weber's fraction is
/// 1 to 2 % in good light).
const SMOOTH: f64 = 0.01;
/// The fewest shadow rays of a place.
const FEWEST_RAYS: usize = 16;
/// The most shadow rays of a place for each pixel of the square that it tells of.
const RAYS_A_PIXEL: usize = 4;
/// The most shadow rays of a place that tells of the smallest squares.
const MOST_RAYS_OF_PIXELS: usize = 32;

/// Direct light at the middles of pixels.
pub(crate) struct DirectField<'a> {
    middles: &'a Middles,
    /// Direct light without caustics, lx; `None` across the edges of shadows.
    light: Vec<Option<Rgb>>,
}

/// Squares of one size.
#[derive(Default)]
struct Sorted {
    /// Those with smooth light on one piece of surface.
    smooth: Vec<Square>,
    /// Those whose light is not smooth.
    uneven: Vec<Square>,
    /// Those that show several pieces of surface.
    mixed: Vec<Square>,
}

struct Builder<'a> {
    middles: &'a Middles,
    evaluate: &'a (dyn Fn(usize, ShadowRays) -> Node + Sync),
    nodes: Vec<Option<Node>>,
    smooth: BTreeSet<Square>,
}

impl<'a> DirectField<'a> {
    /// Evaluates the direct light of a view by the random numbers of a round; `watch` is told the share that is done.
    pub(crate) fn new(
        middles: &'a Middles,
        (reader, map): (&MapReader<'_>, &IlluminationMap),
        round: u64,
        mut watch: impl FnMut(f64),
    ) -> Self {
        let evaluate = |number: usize, rays: ShadowRays| {
            let at = middles.place(number);
            let Some(stored) = map.interpolate(at.triangle, at.back, at.u, at.v) else {
                return Node::DARK;
            };
            let (lx, noise_lx) = reader.direct_for_picture(on_side(at), round, rays);
            let about_lx = (stored.indirect_lx + stored.caustic_lx).luminance() + lx.luminance();
            Node { lx, noise_lx, about_lx }
        };
        let (smooth, nodes) = (BTreeSet::new(), vec![None; middles.count()]);
        let mut builder = Builder { middles, evaluate: &evaluate, nodes, smooth };
        let mut left = builder.widest();
        let mut size = WIDEST;
        while size > 1 {
            watch(0.5 / size as f64);
            left = builder.split(left, size);
            size /= 2;
        }
        let number = |square: &Square| middles.at(square.at, square.path);
        builder.evaluate_all(left.iter().filter_map(number).collect(), 1);
        Self { middles, light: builder.light() }
    }

    /// Direct light of a place in a pixel, lx; `None` where it is to be evaluated there.
    pub(crate) fn at(&self, (at, surface): (&SurfacePoint, &Surface)) -> Option<Rgb> {
        self.light[self.middles.standing(at, surface)?]
    }
}

impl Builder<'_> {
    fn widest(&self) -> Vec<Square> {
        let mut all: Vec<Square> = (0..self.middles.count())
            .map(|number| {
                let &SurfacePoint { pixel, path, .. } = self.middles.place(number);
                let at = self.middles.row_and_column(pixel).map(|at| at / WIDEST);
                Square { path, size: WIDEST, at }
            })
            .collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Tests squares of a size, and those of which parts turn out to be uneven; returns the squares half as wide that are
    /// left to test.
    fn split(&mut self, squares: Vec<Square>, size: usize) -> Vec<Square> {
        let mut halves = BTreeSet::new();
        let mut waiting = squares;
        while !waiting.is_empty() {
            let Sorted { smooth, uneven, mixed } = self.sorted(&waiting);
            self.smooth.extend(smooth);
            let mut reopened = BTreeSet::new();
            for square in &uneven {
                for near in square.about() {
                    if self.smooth.remove(&near) {
                        halves.extend(near.parts());
                    } else if let Some(whole) = near.wider().find(|w| self.smooth.contains(w)) {
                        self.smooth.remove(&whole);
                        reopened.extend(whole.parts_of(size));
                    }
                }
            }
            halves.extend(uneven.iter().chain(&mixed).flat_map(Square::parts));
            waiting = reopened.into_iter().collect();
        }
        halves.into_iter().collect()
    }

    fn sorted(&mut self, squares: &[Square]) -> Sorted {
        let are_whole: Vec<Option<[usize; 5]>> =
            squares.par_iter().map(|square| self.whole(square)).collect();
        let mut asked: Vec<usize> = are_whole.iter().flatten().flatten().copied().collect();
        asked.sort_unstable();
        asked.dedup();
        self.evaluate_all(asked, squares[0].size);
        let mut sorted = Sorted::default();
        for (square, whole) in squares.iter().zip(are_whole) {
            match whole {
                None if self.is_seen(square) => sorted.mixed.push(*square),
                None => {}
                Some(numbers) if self.is_smooth(numbers) => sorted.smooth.push(*square),
                Some(_) => sorted.uneven.push(*square),
            }
        }
        sorted
    }

    fn evaluate_all(&mut self, mut numbers: Vec<usize>, size: usize) {
        numbers.retain(|&number| self.nodes[number].is_none());
        let most = (RAYS_A_PIXEL * size * size).max(MOST_RAYS_OF_PIXELS);
        let rays = ShadowRays { fewest: FEWEST_RAYS, most };
        let found: Vec<Node> =
            numbers.par_iter().map(|&number| (self.evaluate)(number, rays)).collect();
        for (number, node) in numbers.into_iter().zip(found) {
            self.nodes[number] = Some(node);
        }
    }

    /// Whether a pixel of a square shows anything by its way.
    fn is_seen(&self, square: &Square) -> bool {
        let ends = square.ends(self.middles);
        let mut pixels = ends.into_iter().flat_map(Square::pixels);
        pixels.any(|at| self.middles.at(at, square.path).is_some())
    }

    /// The places at the corners and in the middle of a square, if all of it shows one piece of surface.
    fn whole(&self, square: &Square) -> Option<[usize; 5]> {
        let ends @ [[top, left], [bottom, right]] = square.ends(self.middles)?;
        let number = |at: [usize; 2]| self.middles.at(at, square.path);
        let first = number([top, left])?;
        let is_one = |other: usize| self.middles.are_one_piece(first, other);
        if !Square::pixels(ends).all(|at| number(at).is_some_and(is_one)) {
            return None;
        }
        let middle = [usize::midpoint(top, bottom), usize::midpoint(left, right)];
        let [b, c, d] = [[top, right], [bottom, left], [bottom, right]].map(number);
        Some([first, b?, c?, d?, number(middle)?])
    }

    /// Whether the middle of a square is as its corners predict.
    fn is_smooth(&self, numbers: [usize; 5]) -> bool {
        let Some([a, b, c, d, middle]) = self.known(numbers) else { return false };
        let expected = (a.lx + b.lx + c.lx + d.lx) * 0.25;
        let of_corners = [a, b, c, d].map(|node| node.noise_lx * node.noise_lx);
        let variance = middle.noise_lx * middle.noise_lx + of_corners.iter().sum::<f64>() / 16.0;
        let off_lx = (middle.lx - expected).luminance().abs();
        off_lx <= SMOOTH * middle.about_lx.max(expected.luminance()) + DEVIATIONS * variance.sqrt()
    }

    fn known(&self, numbers: [usize; 5]) -> Option<[Node; 5]> {
        let [a, b, c, d, middle] = numbers.map(|number| self.nodes[number]);
        Some([a?, b?, c?, d?, middle?])
    }

    /// Light at all places.
    fn light(self) -> Vec<Option<Rgb>> {
        let mut light = self.nodes.clone();
        let squares: Vec<Square> = self.smooth.iter().copied().collect();
        let continued: Vec<(usize, Node)> =
            squares.par_iter().flat_map_iter(|square| self.continued(square)).collect();
        for (number, node) in continued {
            light[number].get_or_insert(node);
        }
        evened(self.middles, light)
    }

    /// Light at the pixels of a smooth square: bilinear between its corners, and a tent for what is left in the middle.
    fn continued(&self, square: &Square) -> Vec<(usize, Node)> {
        let Some(numbers) = self.whole(square) else { return Vec::new() };
        let Some(nodes) = self.known(numbers) else { return Vec::new() };
        let [a, b, c, d, middle] = nodes.map(|node| node.lx);
        let beside_lx =
            nodes.map(|node| node.about_lx - node.lx.luminance()).iter().sum::<f64>() / 5.0;
        let Some(ends @ [first, last]) = square.ends(self.middles) else { return Vec::new() };
        let place =
            |at: usize, k: usize| (at - first[k]) as f64 / ((last[k] - first[k]).max(1)) as f64;
        let at_middle = [0, 1].map(|k| place(usize::midpoint(first[k], last[k]), k));
        let bilinear =
            |[v, u]: [f64; 2]| (a * (1.0 - u) + b * u) * (1.0 - v) + (c * (1.0 - u) + d * u) * v;
        let more = middle - bilinear(at_middle);
        let tent = |x: f64, top: f64| {
            if top <= 0.0 {
                1.0
            } else if x <= top {
                x / top
            } else {
                (1.0 - x) / (1.0 - top)
            }
        };
        Square::pixels(ends)
            .filter_map(|pixel| {
                let at = [place(pixel[0], 0), place(pixel[1], 1)];
                let number = self.middles.at(pixel, square.path)?;
                let share = tent(at[0], at_middle[0]) * tent(at[1], at_middle[1]);
                let lx = bilinear(at) + more * share;
                Some((number, Node { lx, noise_lx: 0.0, about_lx: beside_lx + lx.luminance() }))
            })
            .collect()
    }
}
