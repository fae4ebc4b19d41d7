//! What a plane cuts of a scene, and what lies closely behind it.

use super::frame::{Place, Plane};
use isolux::geometry::{Point, Triangle};
use isolux::scene::Scene;
use std::collections::HashMap;

/// The section is taken so far before the plane of a grid, m: a grid that lies on a surface does not cut it.
const BEFORE_M: f64 = 1e-3;
/// Surfaces that face the way of the grid and lie at most so far behind it are outlined, m: tables, not the floor.
const BEHIND_M: f64 = 0.5;
/// Cosine of the largest angle between them.
const FACES: f64 = 0.999;

/// A piece of an outline.
pub(super) type Piece = [Place; 2];

/// The outlines of what a plane cuts.
#[derive(Debug, Default)]
pub(super) struct Section {
    /// With the front of surfaces on the right.
    pub(super) pieces: Vec<Piece>,
    /// Edges of what lies closely behind.
    pub(super) behind: Vec<Piece>,
}

/// A place by its bits: both triangles at an edge are cut at the same.
fn key(place: Place) -> [u64; 2] {
    // Without the sign of zero.
    place.map(|coordinate| (coordinate + 0.0).to_bits())
}

impl Section {
    pub(super) fn of(scene: &Scene, plane: &Plane) -> Self {
        let triangles = || (0..scene.triangle_count()).map(|index| scene.triangle(index));
        let mut pieces: Vec<Piece> =
            triangles().filter_map(|triangle| cut(&triangle, plane)).collect();
        pieces.retain(|[a, b]| key(*a) != key(*b));
        Self {
            pieces,
            behind: edges(triangles().filter(|triangle| is_behind(triangle, plane)), plane),
        }
    }

    /// Pieces of what is at least so long, m: walls, which keep light apart, not the backs of chairs.
    pub(super) fn barriers(&self, least_m: f64) -> Vec<Piece> {
        let groups = groups(&self.pieces);
        let mut bounds: HashMap<usize, (Place, Place)> = HashMap::new();
        for (group, place) in
            groups.iter().zip(&self.pieces).flat_map(|(g, piece)| piece.map(|p| (*g, p)))
        {
            let (low, high) = bounds.entry(group).or_insert((place, place));
            for k in 0..2 {
                low[k] = low[k].min(place[k]);
                high[k] = high[k].max(place[k]);
            }
        }
        let is_long = |group: &usize| {
            let (low, high) = bounds[group];
            (high[0] - low[0]).hypot(high[1] - low[1]) >= least_m
        };
        groups
            .iter()
            .zip(&self.pieces)
            .filter(|(g, _)| is_long(g))
            .map(|(_, piece)| *piece)
            .collect()
    }

    /// Solid things cut: the ring around each, and rings of rooms in it.
    pub(super) fn solids(&self) -> Vec<Vec<Vec<Place>>> {
        let (solid, hollow): (Vec<Vec<Place>>, Vec<Vec<Place>>) =
            rings(&self.pieces).into_iter().partition(|ring| area_m2(ring) > 0.0);
        let mut solids: Vec<Vec<Vec<Place>>> = Vec::new();
        for ring in solid {
            let size_m2 = area_m2(&ring);
            let within = |hole: &&Vec<Place>| -area_m2(hole) < size_m2 && encloses(&ring, hole[0]);
            let holes: Vec<Vec<Place>> = hollow.iter().filter(within).cloned().collect();
            solids.push([vec![ring], holes].concat());
        }
        solids
    }
}

/// Where a triangle crosses the plane, its front on the right.
fn cut(triangle: &Triangle, plane: &Plane) -> Option<Piece> {
    let heights = triangle.corners.map(|corner| plane.height_m(corner) - BEFORE_M);
    let ends: Vec<Place> = (0..3)
        .map(|k| [k, (k + 1) % 3])
        .filter(|[a, b]| (heights[*a] >= 0.0) != (heights[*b] >= 0.0))
        .map(|[a, b]| {
            // Always from below, so that both triangles at an edge meet in the same place.
            let [a, b] = if heights[a] < heights[b] { [a, b] } else { [b, a] };
            let share = heights[a] / (heights[a] - heights[b]);
            let [from, to] = [a, b].map(|corner| plane.foot(triangle.corners[corner]));
            [0, 1].map(|k| from[k] + share * (to[k] - from[k]))
        })
        .collect();
    let &[a, b] = ends.as_slice() else { return None };
    let front = plane.along(triangle.area_vector());
    let is_right = (b[1] - a[1]) * front[0] - (b[0] - a[0]) * front[1] >= 0.0;
    Some(if is_right { [a, b] } else { [b, a] })
}

fn is_behind(triangle: &Triangle, plane: &Plane) -> bool {
    let near = |corner: &Point| (-BEHIND_M..BEFORE_M).contains(&plane.height_m(*corner));
    let faces = |normal: isolux::geometry::Normal| plane.facing(normal.to_vector()) > FACES;
    triangle.corners.iter().all(near) && triangle.normal().is_some_and(faces)
}

/// Edges that one of the triangles has and no other.
fn edges(triangles: impl Iterator<Item = Triangle>, plane: &Plane) -> Vec<Piece> {
    let mut seen: HashMap<[[u64; 2]; 2], (usize, Piece)> = HashMap::new();
    let mut order = 0;
    for triangle in triangles {
        let corners = triangle.corners.map(|corner| plane.foot(corner));
        for k in 0..3 {
            let piece = [corners[k], corners[(k + 1) % 3]];
            let mut ends = piece.map(key);
            ends.sort_unstable();
            order += 1;
            if seen.remove(&ends).is_none() {
                seen.insert(ends, (order, piece));
            }
        }
    }
    let mut left: Vec<(usize, Piece)> = seen.into_values().collect();
    left.sort_by_key(|(order, _)| *order);
    left.into_iter().map(|(_, piece)| piece).collect()
}

/// Of every piece the first of those that it meets, or that they meet.
fn groups(pieces: &[Piece]) -> Vec<usize> {
    let mut joined: Vec<usize> = (0..pieces.len()).collect();
    let root = |joined: &[usize], mut index: usize| {
        while joined[index] != index {
            index = joined[index];
        }
        index
    };
    let mut known: HashMap<[u64; 2], usize> = HashMap::new();
    for (index, end) in pieces.iter().enumerate().flat_map(|(k, piece)| piece.map(|end| (k, end))) {
        let other = root(&joined, *known.entry(key(end)).or_insert(index));
        let own = root(&joined, index);
        joined[own.max(other)] = own.min(other);
        joined[index] = own.min(other);
    }
    (0..pieces.len()).map(|index| root(&joined, index)).collect()
}

/// Closed rings of pieces that go on where others end.
fn rings(pieces: &[Piece]) -> Vec<Vec<Place>> {
    let mut from: HashMap<[u64; 2], Vec<usize>> = HashMap::new();
    for (index, piece) in pieces.iter().enumerate() {
        from.entry(key(piece[0])).or_default().push(index);
    }
    let mut is_used = vec![false; pieces.len()];
    let mut closed = Vec::new();
    for first in 0..pieces.len() {
        let (mut ring, mut next) = (Vec::new(), Some(first));
        while let Some(index) = next.filter(|&index| !is_used[index]) {
            is_used[index] = true;
            ring.push(pieces[index][0]);
            let end = key(pieces[index][1]);
            if end == key(pieces[first][0]) {
                closed.push(std::mem::take(&mut ring));
                break;
            }
            next = from.get(&end).and_then(|those| those.iter().copied().find(|&k| !is_used[k]));
        }
    }
    closed.retain(|ring| ring.len() > 2);
    closed
}

/// Positive counter-clockwise.
fn area_m2(ring: &[Place]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    0.5 * ring.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
}

fn encloses(ring: &[Place], [s, t]: Place) -> bool {
    let next = ring.iter().cycle().skip(1);
    let is_crossed = |(a, b): &(&Place, &Place)| {
        (a[1] <= t) != (b[1] <= t) && a[0] + (t - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > s
    };
    ring.iter().zip(next).filter(is_crossed).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pieces of a ring of straight sides.
    fn ring(corners: &[Place]) -> Vec<Piece> {
        (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]]).collect()
    }

    #[test]
    fn rooms_are_hollow_and_furniture_is_solid() {
        let outer = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]];
        let room = [[1.0, 1.0], [1.0, 8.0], [8.0, 8.0], [8.0, 1.0]];
        let shelf = [[2.0, 2.0], [3.0, 2.0], [3.0, 3.0], [2.0, 3.0]];
        let of = |rings: &[&[Place]]| {
            let pieces = rings.iter().flat_map(|corners| ring(corners)).collect();
            Section { pieces, behind: vec![] }.solids()
        };
        assert!(of(&[&room]).is_empty());
        let found = of(&[&outer, &room, &shelf]);
        let counts: Vec<usize> = found.iter().map(Vec::len).collect();
        // The walls with a hole; the shelf, which is smaller than the room around it.
        assert_eq!(counts, [2, 1]);
    }

    #[test]
    fn what_is_short_is_no_barrier() {
        let chair = [[1.0, 1.0], [1.3, 1.0], [1.3, 1.05], [1.0, 1.05]];
        let mut pieces = ring(&chair);
        pieces.extend([[[0.0, 0.0], [0.4, 0.0]], [[0.8, 0.0], [0.4, 0.0]]]);
        let found = Section { pieces, behind: vec![] }.barriers(0.7);
        assert_eq!(found, [[[0.0, 0.0], [0.4, 0.0]], [[0.8, 0.0], [0.4, 0.0]]]);
    }

    #[test]
    fn open_sheets_are_not_solid() {
        let mut pieces = ring(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        pieces.pop();
        assert!(Section { pieces, behind: vec![] }.solids().is_empty());
    }
}
