//! Triangles as seen from a point.

use super::chi_square::misfit;
use super::squares;
use crate::sampling::SphericalTriangle;
use isolux_geometry::{Point, Triangle, Vector};
use std::f64::consts::PI;

fn solid_angle_sr(from: Point, corners: [Point; 3]) -> f64 {
    SphericalTriangle::new(from, corners).map_or(0.0, |t| t.solid_angle_sr)
}

fn points(corners: [[f64; 3]; 3]) -> [Point; 3] {
    corners.map(Point::from)
}

/// Girard's theorem: the angles of the spherical triangle less pi.
fn girard_sr(from: Point, corners: [Point; 3]) -> f64 {
    let at = corners.map(|p| p - from);
    let angle = |k: usize| {
        let (a, b, c) = (at[k], at[(k + 1) % 3], at[(k + 2) % 3]);
        let (ab, ac) = (a.cross(b), a.cross(c));
        libm::atan2(ab.cross(ac).length(), ab.dot(ac))
    };
    angle(0) + angle(1) + angle(2) - PI
}

#[test]
fn solid_angles_known_in_closed_form() {
    let octant = points([[1.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 0.2]]);
    assert!((solid_angle_sr(Point::ORIGIN, octant) - 0.5 * PI).abs() < 1e-15 * 4.0);
    // Half a face of a cube from its centre.
    let half_face = points([[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, 1.0]]);
    assert!((solid_angle_sr(Point::ORIGIN, half_face) - PI / 3.0).abs() < 1e-15 * 4.0);
    // A huge triangle just below: almost the whole hemisphere. Beyond its edges, a million heights
    // away, the strip up to the horizon has a millionth of a turn each.
    let plane = points([[-1e6, -1e6, -1.0], [2e6, -1e6, -1.0], [-1e6, 2e6, -1.0]]);
    let missing = 2.0 * PI - solid_angle_sr(Point::ORIGIN, plane);
    assert!(missing > 0.0 && missing < 1e-5, "{missing}");
}

#[test]
fn a_closed_surface_fills_the_sphere() {
    let corner = [[3.0, 0.2, -1.0], [-2.0, 2.5, -1.5], [-1.0, -3.0, -0.7], [0.3, 0.1, 4.0]];
    for from in [[0.0, 0.0, 0.0], [0.1, -0.4, 1.0], [0.28, 0.1, 3.6]] {
        let faces =
            [[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|f| f.map(|k: usize| corner[k]));
        let sum: f64 = faces.map(|f| solid_angle_sr(from.into(), points(f))).iter().sum();
        assert!((sum - 4.0 * PI).abs() < 1e-13, "{from:?}: {sum}");
    }
}

#[test]
fn solid_angles_agree_with_girard() {
    for k in 0..200 {
        let at: Vec<[f64; 2]> = squares(100 + k, 5).collect();
        let p = |i: usize, z: f64| Point::new(4.0 * at[i][0] - 2.0, 4.0 * at[i][1] - 2.0, z);
        let corners = [p(0, 1.0), p(1, 1.0 + at[3][0]), p(2, 1.0 + at[3][1])];
        let (found, expected) =
            (solid_angle_sr(Point::ORIGIN, corners), girard_sr(Point::ORIGIN, corners).max(0.0));
        // Girard's formula loses digits to the subtraction of pi, and the angles theirs where two
        // corners are seen close together.
        assert!((found - expected).abs() < 1e-12, "{corners:?}: {found} {expected}");
    }
}

/// Small and far triangles look flat: area times cosine over distance squared, with an error of the
/// square of the size over the distance, and the rounding of a triple product, which is relative to
/// one, not to the small solid angle.
#[test]
fn small_triangles_are_flat() {
    for size in [1e-2, 1e-3, 1e-4, 1e-5] {
        for tilt in [0.0, 0.7, 1.5] {
            let (s, c) = libm::sincos(tilt);
            let corner = |x: f64, y: f64| Point::new(size * x, size * y * c, 1.0 + size * y * s);
            // About its centroid, so that the first order cancels.
            let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 2.0)];
            let flat = Triangle { corners }.area() * c;
            let found = solid_angle_sr(Point::ORIGIN, corners);
            let allowed = 20.0 * size * size + 8.0 * f64::EPSILON / flat;
            assert!((found / flat - 1.0).abs() < allowed, "{size} {tilt}: {found} {flat}");
        }
    }
}

/// Even parts of a triangle: each gets its share of the directions.
fn check_uniform(name: &str, from: Point, corners: [Point; 3], parts: usize) {
    let spherical = SphericalTriangle::new(from, corners).unwrap();
    let triangle = Triangle { corners };
    let n = parts as f64;
    // A lattice cell of weights (i, j) / n is two triangles, one of them outside on the hypotenuse.
    let at = |i: usize, j: usize| triangle.point(i as f64 / n, j as f64 / n);
    let (mut shares, mut cells) = (Vec::new(), vec![None; 2 * parts * parts]);
    for (i, j) in (0..parts).flat_map(|i| (0..parts - i).map(move |j| (i, j))) {
        let lower = [at(i, j), at(i + 1, j), at(i, j + 1)];
        let upper = [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        for (half, part) in
            [lower, upper].into_iter().enumerate().take(1 + usize::from(i + j + 1 < parts))
        {
            cells[2 * (i * parts + j) + half] = Some(shares.len());
            shares.push(solid_angle_sr(from, part) / spherical.solid_angle_sr);
        }
    }
    let whole: f64 = shares.iter().sum();
    assert!((whole - 1.0).abs() < 1e-6, "{name}: the parts make {whole}");
    let mut counts = vec![0; shares.len()];
    for square in squares(7, 40_000) {
        let direction = spherical.sample(square).unwrap().to_vector();
        let normal = triangle.area_vector();
        let t = (corners[0] - from).dot(normal) / direction.dot(normal);
        let [u, v] = triangle.barycentric(from + direction * t);
        // Weights outside by rounding, larger where the triangle is seen small or at grazing.
        let least = u.min(v).min(1.0 - u - v);
        assert!(t > 0.0 && least > -1e-6, "{name}: weights {u} {v} outside");
        let (u, v) = (u.max(0.0) * n, v.max(0.0) * n);
        let (i, j) = ((u as usize).min(parts - 1), (v as usize).min(parts - 1));
        let half = usize::from((u - i as f64) + (v - j as f64) > 1.0);
        let cell = cells[2 * (i * parts + j) + half].or(cells[2 * (i * parts + j)]);
        counts[cell.unwrap()] += 1;
    }
    let found = misfit(&shares, &counts);
    assert!(found < 1.0, "{name}: {found}");
}

#[test]
fn directions_are_uniform() {
    let right = points([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let octant = points([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    let sliver = points([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.5, 1e-3, 1.0]]);
    for (name, from, corners) in [
        ("octant", Point::ORIGIN, octant),
        ("from a height of its size", Point::new(0.3, 0.3, 1.0), right),
        ("from behind", Point::new(0.3, 0.3, -1.0), right),
        ("from close by", Point::new(0.2, 0.2, 0.01), right),
        ("at grazing", Point::new(3.0, 0.5, 0.02), right),
        ("from beyond a corner", Point::new(-1.0, -1.0, 0.1), right),
        ("from far", Point::new(100.0, 50.0, 80.0), right),
        ("from 10,000 times its size", Point::new(1.0, 2.0, 1e4), right),
        ("a sliver", Point::ORIGIN, sliver),
    ] {
        for turn in 0..3 {
            let mut turned = corners;
            turned.rotate_left(turn);
            check_uniform(name, from, turned, 6);
        }
    }
}

#[test]
fn what_is_not_seen_has_no_solid_angle() {
    let corners = points([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let line = points([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0]]);
    for (name, from, corners) in [
        ("in its plane", Point::new(2.0, 2.0, 0.0), corners),
        ("on a corner", Point::ORIGIN, corners),
        ("on the line of an edge", Point::new(3.0, 0.0, 0.0), corners),
        ("a triangle without area", Point::ORIGIN, line),
        ("a triangle that is a point", Point::ORIGIN, [Point::new(1.0, 1.0, 1.0); 3]),
    ] {
        let found = SphericalTriangle::new(from, corners);
        assert!(found.is_none(), "{name}: {found:?}");
    }
}

#[test]
fn from_inside_itself_a_triangle_is_not_seen() {
    let corners = points([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    for from in [Point::new(0.25, 0.25, 0.0), Point::new(0.5, 0.0, 0.0)] {
        assert!(SphericalTriangle::new(from, corners).is_none(), "{from:?}");
    }
}

#[test]
fn corners_of_the_square_are_directions_to_it() {
    let corners = points([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
    let spherical = SphericalTriangle::new(Point::ORIGIN, corners).unwrap();
    let last = 1.0 - f64::EPSILON / 2.0;
    for square in [[0.0, 0.0], [last, 0.0], [0.0, last], [last, last]] {
        let Vector { x, y, z } = spherical.sample(square).unwrap().to_vector();
        // Digits are lost where a difference of cosines near one is taken: half of them.
        let inside = x / z > -1e-7 && y / z > -1e-7 && (x + y) / z < 1.0 + 1e-7;
        assert!(inside, "{square:?}: {x} {y} {z}");
    }
}
