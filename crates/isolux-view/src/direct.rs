//! Direct light of a view: evaluated in the middles of few pixels, and interpolated between them where it is smooth.
//!
//! Light is evaluated at the corners and in the middle of squares of 8 x 8 pixels. Where the middle differs from what the
//! corners predict, or where a square shows more than one piece of surface, squares half as wide follow, and in the end
//! single pixels. Squares beside one that differs are split, too, so that a narrow shadow is followed along all of its
//! length once it is found anywhere. Pixels across the edge of a shadow are left to their cells.

use crate::image::Surface;
use crate::middles::{Middles, on_side};
use crate::trace::SurfacePoint;
use isolux::engine::{MapReader, ShadowRays};
use isolux::map::IlluminationMap;
use isolux::units::Rgb;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Pixels across the widest squares: a power of two.
const WIDEST: usize = 8;
/// The difference from a prediction that is accepted, as a share of all light: half of what is seen (Weber's fraction is
/// 1 to 2 % in good light).
const SMOOTH: f64 = 0.01;
/// The difference of neighbouring pixels from which the edge of a shadow lies between them, as a share of all light. What
/// differs less is a slope that the middle of a pixel stands for.
const SHARP: f64 = 0.1;
/// The standard deviations up to which a difference may be noise.
const DEVIATIONS: f64 = 2.5;
/// The noise above which the pixels about one are taken into account, as a share of all light.
const NOISY: f64 = 0.003;
/// The pixels up to which those about one are taken into account, the fewest first.
const REACHES: [usize; 3] = [1, 2, 4];
/// What may be left beside a plane, in the noise of pixels. That is known by a factor of about two.
const MOST_LEFT: f64 = 2.0;
/// The fewest pixels of a plane.
const FEWEST_IN_PLANE: f64 = 5.0;
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

/// Direct light at a place.
#[derive(Clone, Copy)]
struct Node {
    lx: Rgb,
    noise_lx: f64,
    /// All light there, lx.
    about_lx: f64,
}

/// A pixel near another, on the same piece of surface.
struct Near {
    /// Columns and rows from the other.
    off: [f64; 2],
    lx: Rgb,
    /// The noise of its own evaluation, lx; zero if it is interpolated.
    noise_lx: f64,
}

/// A square of pixels that are seen by one way over mirrors and panes, with the pixels right and below of it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Square {
    path: u32,
    /// Pixels across.
    size: usize,
    /// Row and column among the squares of its size.
    at: [usize; 2],
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
    /// Evaluates the direct light of a view; `watch` is told the share that is done.
    pub(crate) fn new(
        middles: &'a Middles,
        (reader, map): (&MapReader<'_>, &IlluminationMap),
        mut watch: impl FnMut(f64),
    ) -> Self {
        let evaluate = |number: usize, rays: ShadowRays| {
            let at = middles.place(number);
            let Some(stored) = map.interpolate(at.triangle, at.back, at.u, at.v) else {
                return Node { lx: Rgb::BLACK, noise_lx: 0.0, about_lx: 0.0 };
            };
            let (lx, noise_lx) = reader.direct_for_picture(on_side(at), 0, rays);
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
        builder.evaluate_all(left.iter().filter_map(|square| builder.pixel(square)).collect(), 1);
        Self { middles, light: builder.light() }
    }

    /// Direct light of a place in a pixel, lx; `None` where it is to be evaluated there.
    pub(crate) fn at(&self, (at, surface): (&SurfacePoint, &Surface)) -> Option<Rgb> {
        self.light[self.middles.standing(at, surface)?]
    }
}

impl Builder<'_> {
    fn widest(&self) -> Vec<Square> {
        let width = self.middles.width();
        let mut all: Vec<Square> = (0..self.middles.count())
            .map(|number| {
                let &SurfacePoint { pixel, path, .. } = self.middles.place(number);
                let at = [pixel / width / WIDEST, pixel % width / WIDEST];
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
                for near in self.about(square) {
                    if self.smooth.remove(&near) {
                        halves.extend(near.parts());
                    } else if let Some(whole) = self.smooth_around(&near) {
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
        let [[top, left], [bottom, right]] = self.ends(square);
        let mut pixels = (top..=bottom).flat_map(|y| (left..=right).map(move |x| [y, x]));
        let number =
            |[y, x]: [usize; 2]| self.middles.by_path(y * self.middles.width() + x, square.path);
        pixels.any(|at| number(at).is_some())
    }

    /// The places at the corners and in the middle of a square, if all of it shows one piece of surface.
    fn whole(&self, square: &Square) -> Option<[usize; 5]> {
        let [[top, left], [bottom, right]] = self.ends(square);
        let number = |row: usize, column: usize| {
            self.middles.by_path(row * self.middles.width() + column, square.path)
        };
        if top > bottom || left > right {
            return None;
        }
        let first = number(top, left)?;
        let is_whole = (top..=bottom).all(|row| {
            (left..=right).all(|column| {
                number(row, column).is_some_and(|other| self.middles.are_one_piece(first, other))
            })
        });
        if !is_whole {
            return None;
        }
        let middle = number(usize::midpoint(top, bottom), usize::midpoint(left, right))?;
        Some([first, number(top, right)?, number(bottom, left)?, number(bottom, right)?, middle])
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
        let nodes = numbers.map(|number| self.nodes[number]);
        nodes.iter().all(Option::is_some).then(|| nodes.map(|node| node.unwrap_or(Node::DARK)))
    }

    /// First and last row and column of a square: those of its corners.
    fn ends(&self, square: &Square) -> [[usize; 2]; 2] {
        let first = square.at.map(|at| at * square.size);
        let last = [self.middles.height() - 1, self.middles.width() - 1];
        [first, [0, 1].map(|k| (first[k] + square.size).min(last[k]))]
    }

    /// A square and those around it.
    fn about(&self, square: &Square) -> impl Iterator<Item = Square> + use<> {
        let Square { path, size, at: [row, column] } = *square;
        let near = |at: usize| at.saturating_sub(1)..at + 2;
        let all = near(row).flat_map(move |row| near(column).map(move |column| [row, column]));
        all.map(move |at| Square { path, size, at })
    }

    /// The smooth square that one lies in.
    fn smooth_around(&self, square: &Square) -> Option<Square> {
        let wider = std::iter::successors(Some(*square), |s| {
            (s.size < WIDEST).then(|| Square { size: 2 * s.size, at: s.at.map(|at| at / 2), ..*s })
        });
        wider.skip(1).find(|wider| self.smooth.contains(wider))
    }

    /// The place of a square of one pixel.
    fn pixel(&self, square: &Square) -> Option<usize> {
        let [row, column] = square.at;
        let is_inside = row < self.middles.height() && column < self.middles.width();
        is_inside
            .then(|| self.middles.by_path(row * self.middles.width() + column, square.path))
            .flatten()
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
        let evened: Vec<Option<Node>> =
            (0..light.len()).into_par_iter().map(|number| self.evened(number, &light)).collect();
        let is_sharp = |number: usize| self.is_sharp(number, &evened);
        (0..light.len())
            .into_par_iter()
            .map(|number| evened[number].filter(|_| !is_sharp(number)).map(|node| node.lx))
            .collect()
    }

    /// Light at the pixels of a smooth square: bilinear between its corners, and a tent for what is left in the middle.
    fn continued(&self, square: &Square) -> Vec<(usize, Node)> {
        let Some(numbers) = self.whole(square) else { return Vec::new() };
        let Some(nodes) = self.known(numbers) else { return Vec::new() };
        let [a, b, c, d, middle] = nodes.map(|node| node.lx);
        let beside_lx =
            nodes.map(|node| node.about_lx - node.lx.luminance()).iter().sum::<f64>() / 5.0;
        let [first, last] = self.ends(square);
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
        let pixels = (first[0]..=last[0]).flat_map(|y| (first[1]..=last[1]).map(move |x| [y, x]));
        pixels
            .filter_map(|[y, x]| {
                let at = [place(y, 0), place(x, 1)];
                let number = self.middles.by_path(y * self.middles.width() + x, square.path)?;
                let share = tent(at[0], at_middle[0]) * tent(at[1], at_middle[1]);
                let lx = bilinear(at) + more * share;
                Some((number, Node { lx, noise_lx: 0.0, about_lx: beside_lx + lx.luminance() }))
            })
            .collect()
    }

    /// Light of a pixel with less noise: by a plane through those about, on the widest square where no more than noise is
    /// left beside it.
    fn evened(&self, number: usize, light: &[Option<Node>]) -> Option<Node> {
        let node = light[number]?;
        // Where few rays all met the same, others close by may have met something else.
        let is_noisy = |node: &Node| node.noise_lx > NOISY * node.about_lx;
        if !is_noisy(&node) && !self.beside(number, light).any(|other| is_noisy(&other)) {
            return Some(node);
        }
        let near = self.near(number, light);
        let mut best = node;
        for reach in REACHES {
            let Some(plane) = Plane::through(&near, reach) else { break };
            let noise_lx = plane.noise_lx;
            if plane.residual_lx > MOST_LEFT * noise_lx + NOISY * node.about_lx {
                break;
            }
            best = Node { lx: plane.lx, noise_lx: noise_lx * plane.share, ..node };
        }
        Some(best)
    }

    /// The pixels about one that show the same piece of surface.
    fn near(&self, number: usize, light: &[Option<Node>]) -> Vec<Near> {
        let &SurfacePoint { pixel, path, .. } = self.middles.place(number);
        let (width, height) = (self.middles.width(), self.middles.height());
        let at = [pixel / width, pixel % width];
        let widest = REACHES[REACHES.len() - 1];
        let along = |at: usize, end: usize| at.saturating_sub(widest)..(at + widest + 1).min(end);
        let rows = along(at[0], height);
        let pixels = rows.flat_map(|y| along(at[1], width).map(move |x| [y, x]));
        pixels
            .filter_map(|[y, x]| {
                let other = self.middles.by_path(y * width + x, path)?;
                let Node { lx, noise_lx, .. } =
                    light[other].filter(|_| self.middles.are_one_piece(number, other))?;
                let off = [x as f64 - at[1] as f64, y as f64 - at[0] as f64];
                Some(Near { off, lx, noise_lx })
            })
            .collect()
    }

    /// Light to the four sides of a pixel on the same piece of surface.
    fn beside<'b>(
        &'b self,
        number: usize,
        light: &'b [Option<Node>],
    ) -> impl Iterator<Item = Node> + 'b {
        self.middles.beside(number).filter_map(|other| light[other])
    }

    /// Whether the edge of a shadow lies beside a pixel.
    fn is_sharp(&self, number: usize, light: &[Option<Node>]) -> bool {
        let Some(own) = light[number] else { return false };
        self.beside(number, light).any(|other| {
            let off_lx = (other.lx - own.lx).luminance().abs();
            let by_noise_lx = DEVIATIONS * libm::hypot(own.noise_lx, other.noise_lx);
            off_lx > SHARP * own.about_lx.max(other.about_lx) + by_noise_lx
        })
    }
}

/// A plane through pixels about one.
struct Plane {
    /// Its value in the middle.
    lx: Rgb,
    /// The noise of that, in the noise of single pixels.
    share: f64,
    /// The root mean square of what pixels differ from it by, lx.
    residual_lx: f64,
    /// The root mean square of the noise of pixels, lx.
    noise_lx: f64,
}

impl Plane {
    /// The plane through the pixels within reach; `None` where they are few.
    fn through(near: &[Near], reach: usize) -> Option<Self> {
        let within = || near.iter().filter(|near| near.is_within(reach));
        let count = within().count() as f64;
        if count < FEWEST_IN_PLANE {
            return None;
        }
        let mean = [0, 1].map(|k| within().map(|near| near.off[k]).sum::<f64>() / count);
        let off = |near: &Near| [0, 1].map(|k| near.off[k] - mean[k]);
        let spread = |j: usize, k: usize| {
            within().map(|near| off(near)[j] * off(near)[k]).sum::<f64>() / count
        };
        let (xx, xy, yy) = (spread(0, 0), spread(0, 1), spread(1, 1));
        let determinant = xx * yy - xy * xy;
        if determinant <= 0.0 {
            return None;
        }
        // Weights of the slopes for pixels.
        let lean = |near: &Near| {
            let [x, y] = off(near);
            [yy * x - xy * y, xx * y - xy * x].map(|c| c / (determinant * count))
        };
        let (mut middle, mut slopes, mut noise) = (Rgb::BLACK, [Rgb::BLACK; 2], 0.0);
        for near in within() {
            middle += near.lx / count;
            let [x, y] = lean(near);
            slopes = [slopes[0] + near.lx * x, slopes[1] + near.lx * y];
            noise += near.noise_lx * near.noise_lx / count;
        }
        let at = |[x, y]: [f64; 2]| middle + slopes[0] * x + slopes[1] * y;
        let residual = within().map(|near| (near.lx - at(off(near))).luminance().powi(2));
        let shares = within().map(|near| {
            let [x, y] = lean(near);
            (1.0 / count - mean[0] * x - mean[1] * y).powi(2)
        });
        // Three of the pixels determine the plane.
        let residual_lx = (residual.sum::<f64>() / (count - 3.0)).sqrt();
        Some(Self {
            lx: at([-mean[0], -mean[1]]).map(|lx| lx.max(0.0)),
            share: shares.sum::<f64>().sqrt(),
            residual_lx,
            noise_lx: noise.sqrt(),
        })
    }
}

impl Near {
    fn is_within(&self, reach: usize) -> bool {
        self.off.iter().all(|off| off.abs() <= reach as f64)
    }
}

impl Square {
    /// The four squares half as wide within.
    fn parts(&self) -> impl Iterator<Item = Self> + use<> {
        self.parts_of(self.size / 2)
    }

    /// The squares of a size within.
    fn parts_of(&self, size: usize) -> impl Iterator<Item = Self> + use<> {
        let Self { path, at, .. } = *self;
        let across = self.size / size;
        let within = (0..across).flat_map(move |row| (0..across).map(move |column| [row, column]));
        within.map(move |[row, column]| Self {
            path,
            size,
            at: [at[0] * across + row, at[1] * across + column],
        })
    }
}

impl Node {
    const DARK: Self = Self { lx: Rgb::BLACK, noise_lx: 0.0, about_lx: 0.0 };
}
