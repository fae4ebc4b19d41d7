//! Planes through what was gathered.

use crate::engine::IndirectReading;
use crate::engine::mesh::corrected;
use crate::units::Rgb;

/// Planes lean by no more than what the spread of their places tells: this share of it is added both ways.
const STIFFNESS: f64 = 0.1;
/// Sum of the shares of a plane, taken as positive, beyond which it is a guess.
const MOST_SHARES: f64 = 3.0;

/// A texel that was gathered, near another.
pub(super) struct Node {
    /// In the order of squares.
    pub(super) index: usize,
    /// From that, texels.
    pub(super) off: [f64; 2],
    pub(super) weight: f64,
    pub(super) reading: IndirectReading,
    /// Square of how it differed from what was expected, lx2.
    pub(super) squared: f64,
}

impl Node {
    /// Square of the distance, texels squared.
    pub(super) fn away_squared(&self) -> f64 {
        self.off[0] * self.off[0] + self.off[1] * self.off[1]
    }
}

/// Light of a plane.
pub(super) struct Continued {
    pub(super) reading: IndirectReading,
    /// Squares of differences, each as far as the plane leans on where it was found, lx2.
    pub(super) squared: f64,
    /// How far from the texel the middle of what it was continued from is, texels.
    pub(super) beyond: f64,
}

/// The value at nought of a plane through weighted readings.
pub(super) fn plane(about: &[Node]) -> Option<Continued> {
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
    let (mut lx, mut mean_lx, mut error_lx, mut noise) = (Rgb::BLACK, Rgb::BLACK, 0.0, 0.0);
    let (mut squared, mut shares) = (0.0, 0.0);
    for Node { off, weight, reading, squared: of_node, .. } in about {
        let along = lean[0] * (off[0] - mean[0]) + lean[1] * (off[1] - mean[1]);
        let share = weight / total * (1.0 - along);
        lx += reading.lx * share;
        mean_lx += reading.lx * (weight / total);
        error_lx += share.abs() * reading.error_lx;
        noise += share * share * reading.noise_lx * reading.noise_lx;
        squared += share.abs() * of_node;
        shares += share.abs();
    }
    let reading =
        IndirectReading { lx: corrected(mean_lx, lx - mean_lx), error_lx, noise_lx: noise.sqrt() };
    (shares <= MOST_SHARES).then_some(Continued {
        reading,
        squared,
        beyond: libm::hypot(mean[0], mean[1]),
    })
}
