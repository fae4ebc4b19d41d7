//! Light of pixels without the noise that those about do not share, and the edges of shadows in it.

use super::node::{DEVIATIONS, Node};
use crate::middles::Middles;
use crate::trace::SurfacePoint;
use isolux::units::Rgb;
use rayon::prelude::*;

/// The difference of neighbouring pixels from which the edge of a shadow lies between them, as a share of all light. What
/// differs less is a slope that the middle of a pixel stands for.
const SHARP: f64 = 0.1;
/// The noise above which the pixels about one are taken into account, as a share of all light.
const NOISY: f64 = 0.003;
/// The pixels up to which those about one are taken into account, the fewest first.
const REACHES: [usize; 3] = [1, 2, 4];
/// What may be left beside a plane, in the noise of pixels. That is known by a factor of about two.
const MOST_LEFT: f64 = 2.0;
/// The fewest pixels of a plane.
const FEWEST_IN_PLANE: f64 = 5.0;

/// Light at the middles of pixels.
struct Field<'a> {
    middles: &'a Middles,
    light: Vec<Option<Node>>,
}

/// A pixel near another, on the same piece of surface.
struct Near {
    /// Columns and rows from the other.
    off: [f64; 2],
    lx: Rgb,
    /// The noise of its own evaluation, lx; zero if it is interpolated.
    noise_lx: f64,
}

/// Light with less noise; `None` across the edges of shadows.
pub(super) fn evened(middles: &Middles, light: Vec<Option<Node>>) -> Vec<Option<Rgb>> {
    let noisy = Field { middles, light };
    let light = (0..middles.count()).into_par_iter().map(|number| noisy.evened(number)).collect();
    let even = Field { middles, light };
    let light = (0..middles.count()).into_par_iter();
    light
        .map(|number| even.light[number].filter(|_| !even.is_sharp(number)).map(|node| node.lx))
        .collect()
}

impl Field<'_> {
    /// Light of a pixel with less noise: by a plane through those about, on the widest square where no more than noise is
    /// left beside it.
    fn evened(&self, number: usize) -> Option<Node> {
        let node = self.light[number]?;
        // Where few rays all met the same, others close by may have met something else.
        let is_noisy = |node: &Node| node.noise_lx > NOISY * node.about_lx;
        if !is_noisy(&node) && !self.beside(number).any(|other| is_noisy(&other)) {
            return Some(node);
        }
        let near = self.near(number);
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
    fn near(&self, number: usize) -> Vec<Near> {
        let &SurfacePoint { pixel, path, .. } = self.middles.place(number);
        let own = self.middles.row_and_column(pixel);
        let widest = REACHES[REACHES.len() - 1];
        let near = |other: usize| {
            let Node { lx, noise_lx, .. } =
                self.light[other].filter(|_| self.middles.are_one_piece(number, other))?;
            let [y, x] = self.middles.row_and_column(self.middles.place(other).pixel);
            let off = [x as f64 - own[1] as f64, y as f64 - own[0] as f64];
            Some(Near { off, lx, noise_lx })
        };
        self.middles.within(pixel, widest, path).filter_map(near).collect()
    }

    /// Light to the four sides of a pixel on the same piece of surface.
    fn beside(&self, number: usize) -> impl Iterator<Item = Node> + '_ {
        self.middles.beside(number).filter_map(|other| self.light[other])
    }

    /// Whether the edge of a shadow lies beside a pixel.
    fn is_sharp(&self, number: usize) -> bool {
        let Some(own) = self.light[number] else { return false };
        self.beside(number).any(|other| {
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
