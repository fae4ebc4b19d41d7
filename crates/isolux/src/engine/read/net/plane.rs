//! Weighted least-squares planes through gathered texels.

use crate::engine::IndirectReading;
use crate::engine::mesh::corrected;
use crate::units::Rgb;

/// The regularization of a plane's slope: the share of the total variance of the texels' places that is added
/// in both directions.
const STIFFNESS: f64 = 0.1;
/// The largest sum of absolute weights of a plane; beyond it the value is a guess.
const MOST_SHARES: f64 = 3.0;

/// A gathered texel near another.
pub(super) struct Node {
    /// Its index in the order of the net.
    pub(super) index: usize,
    /// Its offset from the other, texels.
    pub(super) off: [f64; 2],
    pub(super) weight: f64,
    pub(super) reading: IndirectReading,
    /// The square of its difference from its prediction, lx2.
    pub(super) squared: f64,
}

impl Node {
    /// The square of the distance, texels squared.
    pub(super) fn away_squared(&self) -> f64 {
        self.off[0] * self.off[0] + self.off[1] * self.off[1]
    }
}

/// The light of a plane at a texel.
pub(super) struct Continued {
    pub(super) reading: IndirectReading,
    /// The squared differences of the texels, weighted by the absolute weights of the plane, lx2.
    pub(super) squared: f64,
    /// The distance of the texel from the weighted centroid of the others, texels.
    pub(super) beyond: f64,
}

/// The value of a plane through weighted readings at the texel itself.
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
    // A row of texels says nothing of the slope across it, so the plane is level in that direction.
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
