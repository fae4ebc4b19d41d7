//! How much a source disturbs by where it is in the field of view, and by its size.

use isolux::geometry::{Direction, Point, Vector};
use isolux::scene::Camera;

/// The position index of Guth for a direction: the luminance that disturbs as much as one in the line of sight, over that. By the
/// formula of Levin (1975) for the diagram of Luckiesh and Guth, which the IES Lighting Handbook has, too. `None` behind the eye.
pub(super) fn position_index(eye: &Camera, towards: Direction) -> Option<f64> {
    let ahead = towards.dot(eye.direction);
    if ahead <= 0.0 {
        return None;
    }
    let sight = eye.direction.to_vector();
    let up = eye.up.to_vector();
    let upright = (up - sight * up.dot(sight)).direction()?;
    let aside = towards.to_vector() - sight * ahead;
    // In the line of sight itself there is no plane, and none is needed.
    let from_vertical_deg = aside
        .direction()
        .map_or(0.0, |aside| libm::acos(aside.dot(upright).abs().min(1.0)).to_degrees());
    let from_sight_deg = libm::acos(ahead.min(1.0)).to_degrees();
    let (tau, sigma) = (from_vertical_deg, from_sight_deg);
    let linear = 35.2 - 0.31889 * tau - 1.22 * libm::exp(-2.0 * tau / 9.0);
    let square = 21.0 + 0.26667 * tau - 0.002_963 * tau * tau;
    Some(libm::exp(linear * 1e-3 * sigma + square * 1e-5 * sigma * sigma))
}

/// Below the line of sight the index grows so much by the tangent of the angle from it, for places within and beyond this tangent; places
/// farther than the last count as there (Iwata and others 1997).
const BELOW: [f64; 2] = [0.8, 1.2];
const BELOW_CHANGES: f64 = 0.6;
const BELOW_ENDS: f64 = 3.0;
/// No place disturbs less.
const LARGEST_INDEX: f64 = 16.0;

/// The position index of daylight glare, as `evalglare` has it: that of Guth above the line of sight, that of Iwata below. `None` behind
/// the eye.
pub(super) fn daylight_position_index(eye: &Camera, towards: Direction) -> Option<f64> {
    let above = position_index(eye, towards)?;
    let sight = eye.direction.to_vector();
    let up = eye.up.to_vector();
    let upright = up - sight * up.dot(sight);
    let index = if towards.to_vector().dot(upright) >= 0.0 {
        above
    } else {
        let ahead = towards.dot(eye.direction);
        let tangent = ((1.0 - ahead * ahead).max(0.0).sqrt() / ahead).min(BELOW_ENDS);
        1.0 + BELOW[usize::from(tangent > BELOW_CHANGES)] * tangent
    };
    Some(index.min(LARGEST_INDEX))
}

/// Solid angle of a triangle, sr (van Oosterom and Strackee 1983).
pub(super) fn triangle_sr(from: Point, corners: [Point; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - from);
    let [la, lb, lc] = [a, b, c].map(Vector::length);
    let volume = a.dot(b.cross(c)).abs();
    let sum = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(volume, sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn eye() -> Camera {
        Camera {
            name: "eye".into(),
            position: Point::ORIGIN,
            direction: Direction::Y,
            up: Direction::Z,
            vertical_fov_rad: 1.0,
        }
    }

    /// CIE 117:1995, table 1, T/R = 0: the formula is within 4 % of it.
    const TABLE: [(f64, f64); 7] =
        [(0.0, 1.0), (0.1, 1.26), (0.2, 1.53), (0.3, 1.9), (0.5, 2.86), (0.7, 4.2), (1.0, 7.0)];

    #[test]
    fn positions_are_those_of_the_table() {
        let at = |across: f64, up: f64| {
            position_index(&eye(), Vector::new(across, 1.0, up).direction().unwrap()).unwrap()
        };
        for (up, expected) in TABLE {
            let found = at(0.0, up);
            assert!((found / expected - 1.0).abs() < 0.04, "{up}: {found}, not {expected}");
        }
        assert!(at(0.5, 0.0) < at(0.0, 0.5), "what is above disturbs less");
        assert!(at(0.3, 0.3) > at(0.1, 0.1));
        assert_eq!(position_index(&eye(), -Direction::Y), None);
    }

    #[test]
    fn below_the_line_of_sight_it_is_that_of_iwata() {
        let at = |across: f64, up: f64| {
            let towards = Vector::new(across, 1.0, up).direction().unwrap();
            daylight_position_index(&eye(), towards).unwrap()
        };
        for (across, up, index) in
            [(0.0, -0.5, 1.4), (0.3, -0.4, 1.4), (0.0, -1.0, 2.2), (4.0, -4.0, 4.6)]
        {
            assert!((at(across, up) - index).abs() < 1e-9, "{across} {up}: {}", at(across, up));
        }
        let above = Vector::new(0.2, 1.0, 0.3).direction().unwrap();
        assert_eq!(daylight_position_index(&eye(), above), position_index(&eye(), above));
        assert_eq!(at(0.0, 8.0), 16.0);
        assert_eq!(daylight_position_index(&eye(), -Direction::Y), None);
    }

    #[test]
    fn an_octant_is_an_eighth_of_the_sphere() {
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Point::from);
        assert!((triangle_sr(Point::ORIGIN, corners) - 0.5 * PI).abs() < 1e-12);
    }
}
