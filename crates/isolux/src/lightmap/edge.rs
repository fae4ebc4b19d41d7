//! Edges of sides, and the pairs of them that are seams.

use isolux_geometry::{Normal, Point};

/// As elements have it: normals within one degree belong to one smooth surface.
pub(super) const CREASE_COS: f64 = 0.999_847_7;
/// Nearer than this in texels, both sides of an edge lie in the same place: inside a chart.
const SAME_TEXELS: f64 = 1e-3;

/// An edge and where its two sides lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seam {
    /// Ends of the edge, m.
    pub(super) ends: [Point; 2],
    /// Of both sides: the page, and both ends in texels.
    pub(super) sides: [(u32, [[f64; 2]; 2]); 2],
}

/// An edge of a side; ends in the order of their coordinates.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) ends: [Point; 2],
    pub(super) normals: [Normal; 2],
    pub(super) page: u32,
    pub(super) texels: [[f64; 2]; 2],
}

/// Whether both lie in the same place, inside a chart.
pub(super) fn is_inside(a: &Edge, b: &Edge) -> bool {
    let near = |p: [f64; 2], q: [f64; 2]| {
        (p[0] - q[0]).abs() < SAME_TEXELS && (p[1] - q[1]).abs() < SAME_TEXELS
    };
    a.page == b.page && (0..2).all(|end| near(a.texels[end], b.texels[end]))
}
