//! Edges at which the surface goes on smoothly and the chart does not.

use super::edge::{CREASE_COS, Edge, Seam, is_inside};
use super::layout::Layout;
use super::t_junctions;
use crate::scene::Scene;
use isolux_geometry::Point;

/// All seams, of whatever objects: first those of edges with the same ends, whose number comes with them, then
/// those of edges that have a part in common.
pub(super) fn find(scene: &Scene, layout: &Layout) -> (Vec<Seam>, usize) {
    let mut edges: Vec<([[u64; 3]; 2], Edge)> = Vec::with_capacity(3 * layout.sides.len());
    for side in &layout.sides {
        let points = scene.triangle(side.triangle).corners;
        let flat = [scene.geometric_normal(side.triangle); 3];
        let normals = scene.corner_normals(side.triangle).unwrap_or(flat);
        let normals = normals.map(|n| if side.back { -n } else { n });
        let texels = layout.corners(side);
        for k in 0..3 {
            let (p, q) = (k, (k + 1) % 3);
            let (p, q) = if key(points[p]) < key(points[q]) { (p, q) } else { (q, p) };
            let edge = Edge {
                ends: [points[p], points[q]],
                normals: [normals[p], normals[q]],
                page: side.page,
                texels: [texels[p], texels[q]],
            };
            edges.push((edge.ends.map(key), edge));
        }
    }
    // Stable: edges at one place stay in the order of the sides.
    edges.sort_by_key(|(key, _)| *key);
    let runs = || edges.chunk_by(|a, b| a.0 == b.0);
    let mut seams: Vec<Seam> = runs().flat_map(pairs).collect();
    let whole = seams.len();
    let origin = scene.bvh().mesh().origin;
    seams.extend(t_junctions::find(runs().flat_map(alone).collect(), origin));
    (seams, whole)
}

/// Coordinates as whole numbers, with one zero.
fn key(point: Point) -> [u64; 3] {
    [point.x, point.y, point.z].map(|c| (c + 0.0).to_bits())
}

/// Each edge with the next that continues it smoothly elsewhere: a chain joins all of them.
fn pairs(run: &[([[u64; 3]; 2], Edge)]) -> Vec<Seam> {
    let mut found = Vec::new();
    for (index, (_, a)) in run.iter().enumerate() {
        let smooth = |(_, b): &&([[u64; 3]; 2], Edge)| is_smooth(a, b);
        if let Some((_, b)) = run[index + 1..].iter().find(smooth).filter(|(_, b)| !is_inside(a, b))
        {
            let sides = [(a.page, a.texels), (b.page, b.texels)];
            found.push(Seam { ends: a.ends, sides });
        }
    }
    found
}

/// Edges that no other continues smoothly.
fn alone(run: &[([[u64; 3]; 2], Edge)]) -> Vec<Edge> {
    let is_alone = |&(index, (_, a)): &(usize, &([[u64; 3]; 2], Edge))| {
        let mut others = run.iter().enumerate().filter(|(other, _)| *other != index);
        a.ends[0] != a.ends[1] && !others.any(|(_, (_, b))| is_smooth(a, b))
    };
    run.iter().enumerate().filter(is_alone).map(|(_, (_, edge))| *edge).collect()
}

fn is_smooth(a: &Edge, b: &Edge) -> bool {
    (0..2).all(|end| a.normals[end].dot(b.normals[end]) >= CREASE_COS)
}
