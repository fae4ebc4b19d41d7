//! Openings in the planes of the surfaces that block an emitter.

use super::super::mirrors::planar::PLANE_TOLERANCE;
use super::super::openings::Opening;
use crate::engine::ray::COPLANAR_COS;
use crate::scene::Scene;
use isolux_geometry::{Normal, Point, Vector};
use std::collections::BTreeMap;

/// The most planes examined; those that block most paths come first.
const MOST_PLANES: usize = 24;
/// The most triangles of a plane whose edges are tried as axes of openings.
const MOST_AXIS_TRIANGLES: usize = 8;

/// The most triangles of a plane whose corners may bound openings.
const MOST_CORNER_TRIANGLES: usize = 256;

/// Distance by which an opening reaches beyond its outermost paths, in mean spacings of the paths along that
/// side. A corner from one such distance inside to two outside takes precedence: the opening then ends there.
const BEYOND_SPACINGS: f64 = 3.0;

/// Allowance for rounding where an opening ends at a corner, as a share of its length.
const CORNER_ROUNDING: f64 = 1e-6;

/// The fewest paths through an opening.
const FEWEST_PATHS: usize = 8;
/// The most openings in front of an emitter, and so in one plane.
pub(super) const MOST_OPENINGS: usize = 16;

/// The largest area of two openings, as a share of the area of one around both, with which they are divided.
const DIVIDED_AREA_SHARE: f64 = 0.95;
/// The smallest gap between two openings, in mean spacings of the paths. One opening has such a gap
/// by chance in one case of thirty.
const LEAST_GAP_SPACINGS: f64 = 8.0;

/// A straight path to a place on an emitter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) from: Point,
    pub(super) to: Point,
}

impl Way {
    pub(super) fn passes(&self, opening: &Opening) -> bool {
        opening.is_passed(self.from, self.to - self.from)
    }
}

/// A plane of surfaces that block an emitter.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    through: Point,
    normal: Normal,
    hits: usize,
    /// Edges that openings in it may be parallel to.
    edges: Vec<Vector>,
    /// Corners at which openings may end.
    corners: Vec<Point>,
}

/// The planes that block the most paths, from the triangle at which each path ends.
pub(super) fn planes(scene: &Scene, stopped_at: impl Iterator<Item = u32>) -> Vec<Plane> {
    let mut hits = BTreeMap::<u32, usize>::new();
    for triangle in stopped_at {
        *hits.entry(triangle).or_default() += 1;
    }
    let mut hits: Vec<(u32, usize)> = hits.into_iter().collect();
    hits.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
    let extent_m = scene.bvh().mesh().bounds().map_or(0.0, |(low, high)| (high - low).length());
    let mut planes = Vec::<Plane>::new();
    for (triangle, hits) in hits {
        let [a, b, c] = scene.triangle(triangle).corners;
        let normal = scene.geometric_normal(triangle);
        let is_alike = |plane: &Plane| {
            plane.normal.dot(normal).abs() >= COPLANAR_COS
                && (a - plane.through).dot(plane.normal.to_vector()).abs()
                    <= PLANE_TOLERANCE * extent_m
        };
        let edges = [b - a, c - b, a - c];
        match planes.iter().position(is_alike) {
            Some(known) => {
                let plane = &mut planes[known];
                plane.hits += hits;
                if plane.corners.len() < 3 * MOST_CORNER_TRIANGLES {
                    plane.corners.extend([a, b, c]);
                }
                if plane.edges.len() < 3 * MOST_AXIS_TRIANGLES {
                    plane.edges.extend(edges);
                }
            }
            None if planes.len() < 4 * MOST_PLANES => {
                let (edges, corners) = (edges.to_vec(), vec![a, b, c]);
                planes.push(Plane { through: a, normal, hits, edges, corners });
            }
            None => {}
        }
    }
    planes.sort_by_key(|plane| std::cmp::Reverse(plane.hits));
    planes.truncate(MOST_PLANES);
    planes
}

impl Plane {
    /// The openings in the plane that explain these free paths.
    pub(super) fn openings(&self, ways: &[Way]) -> Vec<Opening> {
        let normal = self.normal.to_vector();
        let height_m = |p: Point| (p - self.through).dot(normal);
        let crossing = |way: &Way| {
            let [from, to] = [height_m(way.from), height_m(way.to)];
            (from * to < 0.0).then(|| (way.from + (way.to - way.from) * (from / (from - to)), to))
        };
        let all: Vec<(Point, f64)> = ways.iter().filter_map(crossing).collect();
        let upwards = all.iter().filter(|(_, to)| *to > 0.0).count();
        let goes_up = 2 * upwards >= all.len();
        let places = all
            .iter()
            .filter(|(_, to)| (*to > 0.0) == goes_up)
            .map(|(place, _)| *place - self.through);
        let outwards = if goes_up { normal } else { -normal };
        let Some(([first, second], corners)) = self.axes(outwards) else { return Vec::new() };
        let extent = Rectangle::of(&corners);
        let places = places.map(|place| [place.dot(first), place.dot(second)]);
        let places: Vec<[f64; 2]> = places.filter(|&place| extent.has(place)).collect();
        if places.len() < FEWEST_PATHS {
            return Vec::new();
        }
        let boxes = apart(places).into_iter().map(|of| Rectangle::ending(&of, &corners));
        let opening = |of: Rectangle| Opening {
            corner: self.through + first * of.low[0] + second * of.low[1],
            sides: [first * (of.high[0] - of.low[0]), second * (of.high[1] - of.low[1])],
            outwards,
        };
        boxes.map(opening).collect()
    }

    /// Axes of the smallest rectangle around the plane's corners, right-handed with the inward
    /// direction, and the corners in these coordinates.
    fn axes(&self, outwards: Vector) -> Option<([Vector; 2], Vec<[f64; 2]>)> {
        let along = |edge: &Vector| {
            let first = edge.direction()?.to_vector();
            let second = first.cross(outwards);
            let corners = self.corners.iter().map(|&corner| corner - self.through);
            let corners = corners.map(|corner| [corner.dot(first), corner.dot(second)]);
            Some(([first, second], corners.collect()))
        };
        let area = |(_, corners): &(_, Vec<[f64; 2]>)| Rectangle::of(corners).area();
        self.edges.iter().filter_map(along).min_by(|a, b| area(a).total_cmp(&area(b)))
    }
}

/// A rectangle along two axes.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    low: [f64; 2],
    high: [f64; 2],
}

impl Rectangle {
    fn of(places: &[[f64; 2]]) -> Self {
        let mut of = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        for &[x, y] in places {
            of.low = [of.low[0].min(x), of.low[1].min(y)];
            of.high = [of.high[0].max(x), of.high[1].max(y)];
        }
        of
    }

    fn has(&self, [x, y]: [f64; 2]) -> bool {
        (self.low[0]..=self.high[0]).contains(&x) && (self.low[1]..=self.high[1]).contains(&y)
    }

    /// The estimated extent of uniformly spread places: the outermost ones do not lie on its edge.
    fn around(places: &[[f64; 2]]) -> Self {
        let mut of = Self::of(places);
        for axis in 0..2 {
            let beyond = (of.high[axis] - of.low[axis]) / places.len() as f64;
            of.low[axis] -= beyond;
            of.high[axis] += beyond;
        }
        of
    }

    /// The opening that these places lie in, which may end at a corner.
    fn ending(places: &[[f64; 2]], corners: &[[f64; 2]]) -> Self {
        let mut of = Self::around(places);
        for axis in 0..2 {
            let long = of.high[axis] - of.low[axis];
            let beyond = BEYOND_SPACINGS * long / places.len() as f64;
            let end = |from: f64, sign: f64| {
                let away = corners.iter().map(|corner| (corner[axis] - from) * sign);
                let near = away.filter(|away| (-beyond..=2.0 * beyond).contains(away));
                let nearest = near.min_by(|a, b| a.abs().total_cmp(&b.abs()));
                from + sign * nearest.map_or(beyond, |away| away + CORNER_ROUNDING * long)
            };
            let (low, high) = (end(of.low[axis], -1.0), end(of.high[axis], 1.0));
            (of.low[axis], of.high[axis]) = (low, high);
        }
        of
    }

    fn area(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }
}

/// Groups of places, each in one opening.
fn apart(places: Vec<[f64; 2]>) -> Vec<Vec<[f64; 2]>> {
    let mut waiting = vec![places];
    let mut found = Vec::new();
    while let Some(places) = waiting.pop() {
        let whole = Rectangle::around(&places);
        match divided(&places, &whole) {
            Some(halves) if found.len() + waiting.len() + 2 <= MOST_OPENINGS => {
                waiting.extend(halves)
            }
            _ => found.push(places),
        }
    }
    found
}

/// Two groups of places that lie apart; `None` if there are none.
fn divided(places: &[[f64; 2]], whole: &Rectangle) -> Option<[Vec<[f64; 2]>; 2]> {
    let mut best = (DIVIDED_AREA_SHARE * whole.area(), None);
    for axis in 0..2 {
        let mut sorted = places.to_vec();
        sorted
            .sort_by(|a, b| a[axis].total_cmp(&b[axis]).then(a[1 - axis].total_cmp(&b[1 - axis])));
        // The division is at the largest gap.
        let last = sorted.len().checked_sub(FEWEST_PATHS)?;
        let gap = |k: &usize| sorted[*k][axis] - sorted[*k - 1][axis];
        let Some(at) =
            (FEWEST_PATHS..=last).max_by(|a, b| gap(a).total_cmp(&gap(b)).then(b.cmp(a)))
        else {
            continue;
        };
        let long = sorted[sorted.len() - 1][axis] - sorted[0][axis];
        if gap(&at) * (sorted.len() as f64) < LEAST_GAP_SPACINGS * long {
            continue;
        }
        let (first, second) = sorted.split_at(at);
        let area = Rectangle::around(first).area() + Rectangle::around(second).area();
        if area < best.0 {
            best = (area, Some([first.to_vec(), second.to_vec()]));
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Key;

    /// Random places in a rectangle.
    fn spread(key: Key, count: u64, low: [f64; 2], sides: [f64; 2]) -> Vec<[f64; 2]> {
        let at =
            |k: u64, axis: usize| low[axis] + sides[axis] * key.with(k).with(axis as u64).uniform();
        (0..count).map(|k| [at(k, 0), at(k, 1)]).collect()
    }

    #[test]
    fn openings_are_divided_where_they_lie_apart() {
        let openings =
            [([0.0, 1.0], [1.2, 1.0]), ([1.9, 1.0], [1.2, 1.0]), ([0.4, 3.0], [2.0, 0.3])];
        let mut as_they_are = 0;
        for trial in 0..200 {
            let of = |k: usize, (low, sides)| {
                spread(Key::new(trial).with(k as u64), 30 + 10 * k as u64, low, sides)
            };
            let places = openings.iter().enumerate().flat_map(|(k, opening)| of(k, *opening));
            let found = apart(places.collect());
            as_they_are += u32::from(found.len() == openings.len());
            // Some openings are divided by chance, none are joined.
            for part in found {
                let Rectangle { low, high } = Rectangle::of(&part);
                let lies_in = |(corner, sides): &([f64; 2], [f64; 2])| {
                    (0..2).all(|k| corner[k] <= low[k] && high[k] <= corner[k] + sides[k])
                };
                assert!(openings.iter().any(lies_in), "{trial}: {low:?} to {high:?}");
            }
        }
        assert!(as_they_are > 150, "{as_they_are}");
    }

    #[test]
    fn one_opening_is_seldom_divided() {
        let trials = 1000;
        let divided = (0..trials).filter(|&trial| {
            let count = 16 + trial % 100;
            apart(spread(Key::new(trial), count, [0.0; 2], [3.0, 1.0])).len() > 1
        });
        // Gaps of more than eight mean spacings occur once in thirty cases, along two axes.
        assert!(divided.count() < trials as usize / 10);
    }

    #[test]
    fn openings_end_at_corners_that_are_near_and_farther_out_without() {
        let places = spread(Key::new(3), 100, [0.0; 2], [1.0, 2.0]);
        let around = Rectangle::of(&places);
        let ending = Rectangle::ending(&places, &[[0.0, 0.0], [1.0, 0.0], [0.5, 7.0]]);
        for (found, expected) in [(ending.low[0], 0.0), (ending.high[0], 1.0), (ending.low[1], 0.0)]
        {
            assert!((found - expected).abs() < 1e-5, "{ending:?}");
        }
        assert!(around.high[1] < ending.high[1] && ending.high[1] < 2.2, "{ending:?}");
    }
}
