//! How well both sides of seams agree.

use isolux_geometry::Point;
use serde::{Deserialize, Serialize};

/// How far apart the two sides of seams are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Jump {
    /// The largest difference of the photometric value, lx.
    pub largest_lx: f64,
    /// The same as a share of the mean of both sides there.
    pub largest_share: f64,
    /// Where that is, m.
    pub place: Option<Point>,
    /// Root mean square over all seams, lx.
    pub rms_lx: f64,
}

/// What stitching did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SeamReport {
    /// Number of edges at which charts meet and the surface is smooth.
    pub edges: usize,
    /// Those of them at which an edge lies along a part of another.
    pub t_junctions: usize,
    /// Their length, m.
    pub length_m: f64,
    /// Before.
    pub before: Jump,
    /// After.
    pub after: Jump,
    /// The largest change of a known texel, lx.
    pub largest_change_lx: f64,
    /// Root mean square change of known texels at seams, in their standard errors.
    pub rms_change_errors: f64,
    /// Share of known texels at seams that were stopped at twice their standard error.
    pub stopped: f64,
}

impl SeamReport {
    /// Whether all numbers are.
    pub fn is_finite(&self) -> bool {
        let of_jump = |jump: &Jump| [jump.largest_lx, jump.largest_share, jump.rms_lx];
        let own = [self.length_m, self.largest_change_lx, self.rms_change_errors, self.stopped];
        let jumps = [of_jump(&self.before), of_jump(&self.after)];
        own.iter().chain(jumps.as_flattened()).all(|number| number.is_finite())
    }
}
