//! Luminous boxes: closed surfaces that shine from both sides, with nothing inside.
//!
//! What shines inside of them comes to nothing else, but would count: as flux, and as light that errors are relative to.

use super::AreaLuminaire;
use isolux_geometry::{Point, TriangleMesh};
use std::collections::HashMap;
use std::ops::Range;

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
}

/// Leaves out those that have anything in the box about them: other surfaces, or places.
fn keep_empty(mesh: &TriangleMesh, places: &[Point], closed: &mut Vec<Closed>) {
    let mut owner = vec![None; mesh.len()];
    for (number, part) in (0..).zip(&*closed) {
        part.triangles.iter().for_each(|&triangle| owner[triangle as usize] = Some(number));
    }
    let mut empty = Boxes::about(closed);
    for triangle in 0..mesh.len() as u32 {
        empty.remove_overlapping(bounds(mesh, triangle), owner[triangle as usize]);
    }
    places.iter().for_each(|&at| empty.remove_overlapping((at, at), None));
    let mut is_empty = empty.is_left.into_iter();
    closed.retain(|_| is_empty.next() == Some(true));
}

/// The boxes about closed surfaces, in a binary tree. A box that was removed is not looked at again, so that many boxes at one place
/// take no longer than as many side by side.
struct Boxes<'a> {
    closed: &'a [Closed],
    /// The numbers of the boxes, by the order of the leaves.
    order: Vec<u32>,
    /// The branches, each before those of its first half, and those before the ones of its second half.
    branches: Vec<Branch>,
    /// By number, whether the box was not removed.
    is_left: Vec<bool>,
}

/// Some boxes in their order.
#[derive(Clone, Copy)]
struct Branch {
    low: Point,
    high: Point,
    /// How many of the boxes were not removed.
    left: u32,
}

impl<'a> Boxes<'a> {
    fn about(closed: &'a [Closed]) -> Self {
        let order = (0..closed.len() as u32).collect();
        let nowhere = Branch { low: Point::ORIGIN, high: Point::ORIGIN, left: 0 };
        let branches = vec![nowhere; (2 * closed.len()).saturating_sub(1)];
        let mut made = Self { closed, order, branches, is_left: vec![true; closed.len()] };
        if !closed.is_empty() {
            made.branch_off(0, 0..closed.len());
        }
        made
    }

    /// Fills a branch with the boxes of a part of the order, which is sorted into halves.
    fn branch_off(&mut self, branch: usize, part: Range<usize>) {
        let boxes = || self.order[part.clone()].iter().map(|&k| &self.closed[k as usize]);
        let first = &self.closed[self.order[part.start] as usize];
        let (low, high) = boxes().fold((first.low, first.high), |(low, high), of| {
            (low.lesser(of.low), high.greater(of.high))
        });
        self.branches[branch] = Branch { low, high, left: part.len() as u32 };
        if part.len() > 1 {
            let size = high - low;
            let axis =
                if size.x >= size.y.max(size.z) { 0 } else { 1 + usize::from(size.z > size.y) };
            let middle = |&k: &u32| {
                let of = &self.closed[k as usize];
                [of.low.x + of.high.x, of.low.y + of.high.y, of.low.z + of.high.z][axis]
            };
            let half = part.len() / 2;
            self.order[part.clone()]
                .select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
            self.branch_off(branch + 1, part.start..part.start + half);
            self.branch_off(branch + 2 * half, part.start + half..part.end);
        }
    }

    /// Removes the boxes that overlap this one, but for the one of a number.
    fn remove_overlapping(&mut self, (low, high): (Point, Point), but: Option<u32>) {
        if !self.branches.is_empty() {
            self.remove_of(0, 0..self.order.len(), (low, high), but);
        }
    }

    /// Removes boxes of a branch. Returns how many.
    fn remove_of(
        &mut self,
        branch: usize,
        part: Range<usize>,
        (low, high): (Point, Point),
        but: Option<u32>,
    ) -> u32 {
        let Branch { low: own_low, high: own_high, left } = self.branches[branch];
        if left == 0 || !overlap((low, high), (own_low, own_high)) {
            return 0;
        }
        let removed = if part.len() == 1 {
            let number = self.order[part.start];
            let is_other = but != Some(number);
            self.is_left[number as usize] &= !is_other;
            u32::from(is_other)
        } else {
            let half = part.len() / 2;
            let (first, second) = (part.start..part.start + half, part.start + half..part.end);
            self.remove_of(branch + 1, first, (low, high), but)
                + self.remove_of(branch + 2 * half, second, (low, high), but)
        };
        self.branches[branch].left -= removed;
        removed
    }
}

/// Whether two boxes have some inside in common.
fn overlap((low, high): (Point, Point), (other_low, other_high): (Point, Point)) -> bool {
    low.x < other_high.x
        && high.x > other_low.x
        && low.y < other_high.y
        && high.y > other_low.y
        && low.z < other_high.z
        && high.z > other_low.z
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Key;

    fn any_box(number: u64, size_m: f64) -> (Point, Point) {
        let key = Key::new(7).with(number);
        let [low, side] = [0, 3].map(|first| [0, 1, 2].map(|k| key.with(first + k).uniform()));
        let low = Point::from(low);
        (low, low + Point::from(side).to_vector() * size_m)
    }

    #[test]
    fn boxes_are_removed_by_whatever_overlaps_them() {
        let none = || Closed {
            triangles: Vec::new(),
            back_is_inside: true,
            low: Point::ORIGIN,
            high: Point::ORIGIN,
        };
        for count in [0, 1, 2, 3, 100] {
            let of = |number: u64| {
                let (low, high) = any_box(number, 0.3);
                Closed { low, high, ..none() }
            };
            let closed: Vec<Closed> = (0..count).map(of).collect();
            let mut boxes = Boxes::about(&closed);
            let mut expected = vec![true; closed.len()];
            for number in 0..40 {
                let (low, high) = any_box(1000 + number, 0.1);
                let but = number.is_multiple_of(2).then_some(number as u32);
                boxes.remove_overlapping((low, high), but);
                for (k, part) in (0..).zip(&closed) {
                    let is_met = overlap((low, high), (part.low, part.high)) && but != Some(k);
                    expected[k as usize] &= !is_met;
                }
                assert_eq!(boxes.is_left, expected, "of {count} after {number}");
            }
        }
    }
}
