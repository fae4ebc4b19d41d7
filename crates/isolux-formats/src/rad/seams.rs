//! Holes of polygons that turn the way of their outline.
//!
//! Radiance takes a point as inside of a polygon if a way out of it crosses the outline an odd number of times. A hole that a seam joins to
//! the outline is one whichever way it turns; some programs write it turning as the outline does.

use crate::polygon::area_vector;
use isolux::geometry::{Point, Vector};

/// The same corners with every hole turning against what it lies in.
pub(super) fn with_holes(mut corners: Vec<Point>) -> Vec<Point> {
    for (from, to) in loops(&corners) {
        let (inner, rest) = (&corners[from..to], [&corners[..=from], &corners[to + 1..]].concat());
        let (turn, turn_of_rest) = (area_vector(inner), area_vector(&rest));
        let middle = corners[from + 1].lerp(corners[from + 2], 0.5);
        if turn.dot(turn_of_rest) > 0.0 && holds(&rest, middle, turn_of_rest) {
            corners[from + 1..to].reverse();
        }
    }
    corners
}

/// Pairs of corners in one place with three or more corners between, the shortest way first.
fn loops(corners: &[Point]) -> Vec<(usize, usize)> {
    let count = corners.len();
    let all = (0..count).flat_map(|from| (from + 3..count).map(move |to| (from, to)));
    let mut found: Vec<(usize, usize)> =
        all.filter(|&(from, to)| corners[from] == corners[to]).collect();
    found.sort_by_key(|(from, to)| (to - from, *from));
    found
}

/// Whether an outline goes around a point, seen along the largest component of its normal.
fn holds(outline: &[Point], point: Point, normal: Vector) -> bool {
    let [x, y, z] = [normal.x, normal.y, normal.z].map(f64::abs);
    let (u, v) = if z >= x && z >= y {
        (0, 1)
    } else if x >= y {
        (1, 2)
    } else {
        (2, 0)
    };
    let flat = |p: Point| [p.to_vector().component(u), p.to_vector().component(v)];
    let [px, py] = flat(point);
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    let crosses = |(a, b): &(&Point, &Point)| {
        let ([ax, ay], [bx, by]) = (flat(**a), flat(**b));
        (ay > py) != (by > py) && px < ax + (py - ay) / (by - ay) * (bx - ax)
    };
    ends.filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[[f64; 2]]) -> f64 {
        let points = corners.iter().map(|&[x, y]| Point::new(x, 3.0, y)).collect();
        0.5 * area_vector(&with_holes(points)).length()
    }

    /// A wall of 16 with a window of 4 in it, as SketchUp's exporter writes it; and with the window turned.
    #[test]
    fn a_window_is_a_hole_whichever_way_it_turns() {
        let around = [[0.0, 4.0], [0.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
        let window = [[1.0, 3.0], [1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]];
        let mut turned = window;
        turned.reverse();
        for window in [window, turned] {
            let wall = [&[around[0]][..], &window, &around].concat();
            assert_eq!(area(&wall), 12.0);
        }
        // A pane beside, joined by a seam, adds to the area.
        let beside = window.map(|[x, y]| [x + 5.0, y]);
        assert_eq!(area(&[&[around[0]][..], &beside, &around].concat()), 20.0);
        assert_eq!(area(&around), 16.0);
    }
}
