//! Where the interpolated light of a map is to be trusted, and where readers gather afresh.
//!
//! Most of the interpolation error of indirect light lies in little of the area: along edges, at
//! contacts, on small surfaces between furniture. To resolve it takes elements without end; a reader
//! with the scene at hand looks there with a few hundred rays of its own. A map therefore keeps the
//! error expected of every element, and above which of them it is not to be trusted.

use super::detail::LeafError;
use crate::elements::Elements;
use rayon::prelude::*;

/// What elements may be left to err by, as shares of what was foreseen, where more than that is found: with the least, readers of the
/// hall gather on four fifths of its surface, with all of it on three fifths.
const SHARES: [f64; 3] = [0.7, 0.5, 0.35];

/// Where readers interpolate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Trust {
    /// In elements of which no more error is expected than so much, lx, and that nothing stands close before.
    UpTo(f64),
    /// Everywhere but in gaps.
    AllButGaps,
}

impl Trust {
    /// Whether it goes as far as an element of so much error.
    pub(crate) fn includes(self, expected_lx: f64, is_beset: bool) -> bool {
        match self {
            Self::UpTo(lx) => !is_beset && expected_lx <= lx,
            Self::AllButGaps => true,
        }
    }

    /// Up to which error elements are trusted, lx.
    pub(crate) const fn up_to_lx(self) -> f64 {
        match self {
            Self::UpTo(lx) => lx,
            Self::AllButGaps => f64::INFINITY,
        }
    }
}

/// Errors up to which elements are trusted, lx, the greatest first: as foreseen, then so that the others are expected to err by
/// shares of that.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrustLevels([f64; 1 + SHARES.len()]);

impl TrustLevels {
    /// What readers trust, unless check points tell otherwise.
    pub(crate) const fn foreseen(self) -> Trust {
        Trust::UpTo(self.0[0])
    }

    /// As little as readers may be left with.
    pub(crate) const fn least(self) -> Trust {
        Trust::UpTo(self.0[SHARES.len()])
    }

    /// All others, the most first.
    pub(crate) fn all_but_least(self) -> impl Iterator<Item = Trust> {
        self.0.into_iter().take(SHARES.len()).map(Trust::UpTo)
    }
}

/// The elements that readers may trust, worst first: those that are not beset.
#[derive(Debug)]
pub(crate) struct WorstElements {
    /// Error, lx, area, m2, and what that counts for in the sum of squares.
    of_leaves: Vec<(f64, f64, f64)>,
    /// Sum of their squared errors, lx2 m2.
    squared: f64,
    /// Area of all elements, m2.
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

    /// The error above which elements are left out, so that what the others err by in the mean square over the surface is at most
    /// `goal`, what lies in dim rooms counting as much as it does, or so that they make up no more than `most_share` of the area.
    /// Infinite if none need be left out. Those that are beset are not counted: no reader trusts them.
    pub(crate) fn limit(&self, goal: f64, most_share: f64) -> f64 {
        let Self { of_leaves, squared, area_m2 } = self;
        let mut left = *squared;
        let (mut out_m2, mut worst_left_out) = (0.0, None);
        for &(error, own_m2, own_squared) in of_leaves {
            let is_enough = left <= goal * goal * area_m2;
            if is_enough || out_m2 + own_m2 > most_share * area_m2 {
                // Between the two, so that rounding does not take one for the other.
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
    /// Of elements that are trusted up to so much to begin with.
    pub(crate) fn of(worst: &WorstElements, foreseen_lx: f64) -> Self {
        let trusted = worst.of_leaves.iter().filter(|(error, ..)| *error <= foreseen_lx);
        let squared: f64 = trusted.map(|(.., squared)| squared).sum();
        let error_lx = (squared / worst.area_m2.max(f64::MIN_POSITIVE)).sqrt();
        let mut all = [foreseen_lx; 1 + SHARES.len()];
        for (limit, share) in all[1..].iter_mut().zip(SHARES) {
            *limit = worst.limit(share * error_lx, 1.0).min(foreseen_lx);
        }
        Self(all)
    }
}

/// Root mean square over all the surface of the errors of some elements.
pub(crate) fn error_of(errors: &[LeafError], some: impl Fn(&LeafError) -> bool) -> f64 {
    let area_m2: f64 = errors.iter().map(|e| e.area_m2).sum();
    let squared: f64 = errors.iter().filter(|e| some(e)).map(LeafError::squared).sum();
    if area_m2 > 0.0 { (squared / area_m2).sqrt() } else { 0.0 }
}

/// Errors at the vertices: of the worst element at each, so that the least over an element's
/// vertices is its own error or more. Elements have that of the coarser one they are part of; one
/// that readers cannot see to be beset, more than is to be trusted.
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

/// The error above which no element is, if readers could otherwise not be told of those that are
/// beset from afar; infinite if there are none.
pub(crate) fn above_all(errors: &[LeafError]) -> f64 {
    if !errors.iter().any(|e| e.is_beset_afar) {
        return f64::INFINITY;
    }
    let greatest = errors.iter().map(|e| e.error).fold(0.0, f64::max);
    greatest.max(f64::from(f32::MIN_POSITIVE)) * (1.0 + 1e-3)
}
