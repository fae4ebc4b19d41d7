//! How well both sides of seams agree.

use isolux_geometry::Point;

/// How far apart the two sides of seams are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
