//! Luminous boxes: closed surfaces that shine from both sides, with nothing inside.
//!
//! What shines inside of them comes to nothing else, but would count: as flux, and as light that errors are relative to.

use super::AreaLuminaire;
use isolux_geometry::{Point, TriangleMesh};
use std::collections::HashMap;

/// By what share of its size a box is smaller than what it bounds: what touches it from outside is not inside.
const WITHIN: f64 = 1e-4;

/// Emitting surfaces but for those inside of closed surfaces that shine outside, too, and have nothing in them, neither surfaces nor any
/// of some places. A scene that is nothing but such a surface is meant to be lit inside. `shines` is asked of triangles and sides.
pub(super) fn without_insides(
    mesh: &TriangleMesh,
    places: &[Point],
    shines: impl Fn(u32, bool) -> bool,
    found: Vec<AreaLuminaire>,
) -> Vec<AreaLuminaire> {
    let of_backs = found.iter().filter(|area| area.back).flat_map(|area| &area.triangles);
    let of_both: Vec<u32> = of_backs.copied().filter(|&triangle| shines(triangle, false)).collect();
    if of_both.is_empty() {
        return found;
    }
    let mut closed = Closed::about(mesh, &of_both);
    closed.retain(|part| part.triangles.len() < mesh.len());
    keep_empty(mesh, places, &mut closed);
    let mut inside = vec![None; mesh.len()];
    for part in &closed {
        part.triangles.iter().for_each(|&t| inside[t as usize] = Some(part.back_is_inside));
    }
    let is_inside = |t: &u32, back: bool| inside[*t as usize] == Some(back) && shines(*t, !back);
    let is_seen = |area: &AreaLuminaire| !area.triangles.iter().all(|t| is_inside(t, area.back));
    found.into_iter().filter(is_seen).collect()
}

/// A closed surface: every edge belongs to two triangles, which turn the same way about it.
struct Closed {
    triangles: Vec<u32>,
    /// Whether its triangles face outwards.
    back_is_inside: bool,
    /// The box about it, a little smaller.
    low: Point,
    high: Point,
}

impl Closed {
    /// Those that some triangles are part of.
    fn about(mesh: &TriangleMesh, some: &[u32]) -> Vec<Self> {
        let beside = neighbours(mesh);
        let mut is_met = vec![false; beside.len()];
        let mut closed = Vec::new();
        for &first in some {
            if std::mem::replace(&mut is_met[first as usize], true) {
                continue;
            }
            let (mut triangles, mut next, mut is_closed) = (vec![first], 0, true);
            while let Some(&triangle) = triangles.get(next) {
                next += 1;
                for neighbour in beside[triangle as usize] {
                    let Some(neighbour) = neighbour else {
                        is_closed = false;
                        continue;
                    };
                    if !std::mem::replace(&mut is_met[neighbour as usize], true) {
                        triangles.push(neighbour);
                    }
                }
            }
            if is_closed {
                closed.push(Self::of(mesh, triangles));
            }
        }
        closed
    }

    fn of(mesh: &TriangleMesh, triangles: Vec<u32>) -> Self {
        let (mut low, mut high) = bounds(mesh, triangles[0]);
        let origin = low;
        let mut volume = 0.0;
        for &triangle in &triangles {
            let [a, b, c] = mesh.triangle(triangle).corners.map(|corner| corner - origin);
            volume += a.dot(b.cross(c));
            let (own_low, own_high) = bounds(mesh, triangle);
            (low, high) = (low.lesser(own_low), high.greater(own_high));
        }
        let within = (high - low) * WITHIN;
        Self { triangles, back_is_inside: volume > 0.0, low: low + within, high: high - within }
    }

    fn contains(&self, at: Point) -> bool {
        self.overlaps(at, at)
    }

    fn overlaps(&self, low: Point, high: Point) -> bool {
        let axis =
            |low: f64, high: f64, own_low: f64, own_high: f64| low < own_high && high > own_low;
        axis(low.x, high.x, self.low.x, self.high.x)
            && axis(low.y, high.y, self.low.y, self.high.y)
            && axis(low.z, high.z, self.low.z, self.high.z)
    }
}

/// Leaves out those that have anything in the box about them: other surfaces, or places.
fn keep_empty(mesh: &TriangleMesh, places: &[Point], closed: &mut Vec<Closed>) {
    closed.sort_by(|a, b| a.low.x.total_cmp(&b.low.x));
    let widest = closed.iter().map(|part| part.high.x - part.low.x).fold(0.0, f64::max);
    let mut owner = vec![usize::MAX; mesh.len()];
    for (number, part) in closed.iter().enumerate() {
        part.triangles.iter().for_each(|&triangle| owner[triangle as usize] = number);
    }
    let mut is_empty = vec![true; closed.len()];
    for triangle in 0..mesh.len() as u32 {
        let (low, high) = bounds(mesh, triangle);
        let first = closed.partition_point(|part| part.low.x < low.x - widest);
        let others = closed.iter().enumerate().skip(first);
        for (number, part) in others.take_while(|(_, part)| part.low.x < high.x) {
            if owner[triangle as usize] != number && part.overlaps(low, high) {
                is_empty[number] = false;
            }
        }
    }
    for &at in places {
        closed.iter().zip(&mut is_empty).for_each(|(part, empty)| *empty &= !part.contains(at));
    }
    let mut is_empty = is_empty.into_iter();
    closed.retain(|_| is_empty.next() == Some(true));
}

/// Of every triangle those beyond its edges; none where an edge has no other triangle, more, or one that turns the other way.
fn neighbours(mesh: &TriangleMesh) -> Vec<[Option<u32>; 3]> {
    let mut points: HashMap<[u64; 3], u32> = HashMap::new();
    let mut number = |at: Point| {
        // Both zeros are the same place.
        let key = [at.x, at.y, at.z].map(|c| (c + 0.0).to_bits());
        let next = points.len() as u32;
        *points.entry(key).or_insert(next)
    };
    let corners: Vec<[u32; 3]> = (0..mesh.len() as u32)
        .map(|triangle| mesh.triangle(triangle).corners.map(&mut number))
        .collect();
    let edge = |corners: &[u32; 3], k: usize| (corners[k], corners[(k + 1) % 3]);
    let mut of_edges: HashMap<(u32, u32), Option<u32>> = HashMap::new();
    for (triangle, corners) in (0..).zip(&corners) {
        for k in 0..3 {
            let one = of_edges.entry(edge(corners, k));
            one.and_modify(|of| *of = None).or_insert(Some(triangle));
        }
    }
    let beyond = |corners: &[u32; 3], k: usize| {
        let (from, to) = edge(corners, k);
        let is_alone = of_edges[&(from, to)].is_some();
        of_edges.get(&(to, from)).copied().flatten().filter(|_| is_alone)
    };
    corners.iter().map(|corners| [0, 1, 2].map(|k| beyond(corners, k))).collect()
}

fn bounds(mesh: &TriangleMesh, triangle: u32) -> (Point, Point) {
    let [a, b, c] = mesh.triangle(triangle).corners;
    (a.lesser(b).lesser(c), a.greater(b).greater(c))
}
