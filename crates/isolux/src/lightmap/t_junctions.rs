//! Edges that lie along a part of another: a wall in one piece above a skirting in three.

use super::edge::{CREASE_COS, Edge, Seam, is_inside};
use isolux_geometry::{Point, Vector};

/// How far the ends of an edge may lie beside another, as a share of their coordinates: a few roundings of `f32`.
const BESIDE: f64 = 16.0 * f32::EPSILON as f64;
/// Shorter parts that two edges have in common, as a share of the shorter one, are none.
const LEAST_PART: f64 = 1e-3;
/// Any direction that is none of those that buildings have.
const SWEPT: Vector = Vector { x: 0.684, y: 0.509, z: 0.523 };

/// Seams between edges of which none continues smoothly beyond: along what two of them have in common.
/// Coordinates were rounded as counted from `origin`.
pub(super) fn find(mut borders: Vec<Edge>, origin: Point) -> Vec<Seam> {
    let ranges = |edge: &Edge| {
        let along = edge.ends.map(|end| end.to_vector().dot(SWEPT));
        (along[0].min(along[1]), along[0].max(along[1]))
    };
    // Stable: edges at one place stay in the order of the sides.
    borders.sort_by(|a, b| ranges(a).0.total_cmp(&ranges(b).0));
    let mut found = Vec::new();
    for (index, a) in borders.iter().enumerate() {
        let (_, high) = ranges(a);
        let near = borders[index + 1..].iter().take_while(|b| ranges(b).0 <= high);
        found.extend(near.filter_map(|b| common(a, b, origin)));
    }
    found
}

/// What two edges have in common, if they are two sides of one surface there.
fn common(a: &Edge, b: &Edge, origin: Point) -> Option<Seam> {
    let (long, short) = if length(a) >= length(b) { (a, b) } else { (b, a) };
    let along = short.ends.map(|end| share_along(long, end));
    let [from, to] = along.map(|along| along.clamp(0.0, 1.0));
    if (to - from).abs() * length(long) <= LEAST_PART * length(short) {
        return None;
    }
    let is_beside = (0..2).all(|end| {
        let off = short.ends[end] - at(long.ends, along[end]);
        off.length() <= beside_m(long, short, origin)
    });
    // As shares of the short edge, which may reach beyond the long one.
    let of_short = [from, to].map(|place| (place - along[0]) / (along[1] - along[0]));
    let is_smooth = (0..2).all(|end| {
        let normal = |edge: &Edge, share: f64| {
            edge.normals[0].to_vector() * (1.0 - share) + edge.normals[1].to_vector() * share
        };
        let (one, other) = (normal(long, [from, to][end]), normal(short, of_short[end]));
        one.dot(other) >= CREASE_COS * one.length() * other.length()
    });
    if !(is_beside && is_smooth) {
        return None;
    }
    let part = |edge: &Edge, shares: [f64; 2]| {
        let on_page = |share: f64| {
            [0, 1].map(|k| edge.texels[0][k] + share * (edge.texels[1][k] - edge.texels[0][k]))
        };
        Edge {
            ends: shares.map(|share| at(edge.ends, share)),
            texels: shares.map(on_page),
            ..*edge
        }
    };
    let (one, other) = (part(long, [from, to]), part(short, of_short));
    let sides = [(one.page, one.texels), (other.page, other.texels)];
    (!is_inside(&one, &other)).then_some(Seam { ends: one.ends, sides })
}

fn length(edge: &Edge) -> f64 {
    (edge.ends[1] - edge.ends[0]).length()
}

fn at(ends: [Point; 2], share: f64) -> Point {
    ends[0] + (ends[1] - ends[0]) * share
}

/// Where the foot of a point is on the line of an edge.
fn share_along(edge: &Edge, point: Point) -> f64 {
    let whole = edge.ends[1] - edge.ends[0];
    (point - edge.ends[0]).dot(whole) / whole.length_squared()
}

/// Of all ends: where the coordinates of one are zero, those of the others are rounded all the same.
fn beside_m(a: &Edge, b: &Edge, origin: Point) -> f64 {
    let ends = a.ends.iter().chain(&b.ends).map(|&end| end - origin);
    let coordinates = ends.flat_map(<[f64; 3]>::from);
    BESIDE * coordinates.fold(0.0, |largest: f64, x| largest.max(x.abs()))
}
