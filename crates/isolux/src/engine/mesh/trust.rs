//! Elements where the interpolated light of a map is trusted; elsewhere readers gather.
//!
//! Most of the interpolation error of indirect light lies in little of the area: along edges, at contacts, on small
//! surfaces between furniture. Resolving it takes elements without end. A reader that has the scene gathers there
//! with a few hundred rays. A map therefore stores the error expected of every element, and the error above which
//! elements are not trusted.

use super::detail::LeafError;
use crate::elements::Elements;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The errors of trusted elements, as shares of the expected error, to try where more error is found than expected.
/// With the least, readers of the hall gather on four fifths of its surface, with all of it on three fifths.
const ERROR_SHARES: [f64; 3] = [0.7, 0.5, 0.35];

/// The elements where readers interpolate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Trust {
    /// Elements whose expected error is at most this, lx, and that nothing stands close to.
    UpTo(f64),
    /// All elements, except in gaps.
    AllButGaps,
}

impl Trust {
    /// Whether an element with this expected error is trusted.
    pub(crate) fn includes(self, expected_lx: f64, is_beset: bool) -> bool {
        match self {
            Self::UpTo(lx) => !is_beset && expected_lx <= lx,
            Self::AllButGaps => true,
        }
    }

    /// The largest error of trusted elements, lx.
    pub(crate) const fn up_to_lx(self) -> f64 {
        match self {
            Self::UpTo(lx) => lx,
            Self::AllButGaps => f64::INFINITY,
        }
    }
}

/// Limits on the error of trusted elements, lx, the greatest first: the expected one, then those that reduce the
/// error of trusted elements to shares of that.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct TrustLevels([f64; 1 + ERROR_SHARES.len()]);

impl TrustLevels {
    /// The trust of readers unless check points show otherwise.
    pub(crate) const fn foreseen(self) -> Trust {
        Trust::UpTo(self.0[0])
    }

    /// The least trust that readers may have.
    pub(crate) const fn least(self) -> Trust {
        Trust::UpTo(self.0[ERROR_SHARES.len()])
    }

    /// All levels of trust except the least, the greatest first.
    pub(crate) fn all_but_least(self) -> impl Iterator<Item = Trust> {
        self.0.into_iter().take(ERROR_SHARES.len()).map(Trust::UpTo)
    }
}

/// The elements that readers may trust, worst first: those that nothing stands close to.
#[derive(Debug)]
pub(crate) struct WorstElements {
    /// The error of each element, lx, its area, m2, and its contribution to the sum of squares, lx2 m2.
    of_leaves: Vec<(f64, f64, f64)>,
    /// The sum of their squared errors, lx2 m2.
    squared: f64,
    /// The area of all elements, m2.
    area_m2: f64,
}

impl WorstElements {
    pub(crate) fn of(errors: &[LeafError]) -> Self {
        let mut worst: Vec<&LeafError> = errors.iter().filter(|e| !e.is_beset).collect();
        worst.par_sort_unstable_by(|a, b| b.error.total_cmp(&a.error).then(a.node.cmp(&b.node)));
        Self {
            squared: worst.iter().map(|e| e.squared()).sum(),
            of_leaves: worst.iter().map(|e| (e.error, e.area_m2, e.squared())).collect(),
            area_m2: errors.iter().map(|e| e.area_m2).sum(),
        }
    }

    /// The error, lx, above which elements are left out. The root mean square error of the others over the surface is
    /// then at most `goal`, with the weights of dim rooms, or the elements left out make up `most_share` of the area.
    /// Infinite if none need be left out. Elements that something stands close to do not count, since no reader
    /// trusts them.
    pub(crate) fn limit(&self, goal: f64, most_share: f64) -> f64 {
        let Self { of_leaves, squared, area_m2 } = self;
        let mut left = *squared;
        let (mut out_m2, mut worst_left_out) = (0.0, None);
        for &(error, own_m2, own_squared) in of_leaves {
            let is_enough = left <= goal * goal * area_m2;
            if is_enough || out_m2 + own_m2 > most_share * area_m2 {
                // The limit lies between two errors, so that rounding does not confuse them.
                return worst_left_out.map_or(f64::INFINITY, |out: f64| 0.5 * (out + error));
            }
            out_m2 += own_m2;
            left -= own_squared;
            worst_left_out = Some(error);
        }
        f64::INFINITY
    }
}

impl TrustLevels {
    /// The levels of trust from the limit expected before any check.
    pub(crate) fn of(worst: &WorstElements, foreseen_lx: f64) -> Self {
        let trusted = worst.of_leaves.iter().filter(|(error, ..)| *error <= foreseen_lx);
        let squared: f64 = trusted.map(|(.., squared)| squared).sum();
        let error_lx = (squared / worst.area_m2.max(f64::MIN_POSITIVE)).sqrt();
        let mut all = [foreseen_lx; 1 + ERROR_SHARES.len()];
        for (limit, share) in all[1..].iter_mut().zip(ERROR_SHARES) {
            *limit = worst.limit(share * error_lx, 1.0).min(foreseen_lx);
        }
        Self(all)
    }
}

/// The root mean square error over all the surface that selected elements contribute.
pub(crate) fn error_of(errors: &[LeafError], some: impl Fn(&LeafError) -> bool) -> f64 {
    let area_m2: f64 = errors.iter().map(|e| e.area_m2).sum();
    let squared: f64 = errors.iter().filter(|e| some(e)).map(LeafError::squared).sum();
    if area_m2 > 0.0 { (squared / area_m2).sqrt() } else { 0.0 }
}

/// The error at each vertex: that of the worst element there, so that the least over the vertices of an element is at
/// least its own error. Finer elements have the error of the coarser one that contains them. If readers cannot see
/// that something stands close to an element, the error is above the limit of trust.
pub(crate) fn at_vertices(elements: &Elements, errors: &[LeafError], trust: Trust) -> Vec<f64> {
    let mut worst = vec![0.0_f64; elements.vertices().len()];
    for error in errors {
        let told = match trust {
            Trust::UpTo(lx) if error.is_beset_afar => 2.0 * lx,
            Trust::UpTo(_) | Trust::AllButGaps => 0.0,
        };
        elements.visit_below(error.node, &mut |corners| {
            for vertex in corners {
                let worst = &mut worst[vertex as usize];
                *worst = worst.max(error.error).max(told);
            }
        });
    }
    worst
}

/// An error above that of every element, if some are beset in a way that readers cannot see; infinite otherwise.
pub(crate) fn above_all(errors: &[LeafError]) -> f64 {
    if !errors.iter().any(|e| e.is_beset_afar) {
        return f64::INFINITY;
    }
    let greatest = errors.iter().map(|e| e.error).fold(0.0, f64::max);
    greatest.max(f64::from(f32::MIN_POSITIVE)) * (1.0 + 1e-3)
}
