//! Spheres and discs as triangles.

use isolux::geometry::{Direction, Vector};
use isolux::scene::Shape;
use std::f64::consts::TAU;

/// Smooth sphere of radius one about the origin, or its octant x, y, z >= 0. Vertices lie on the
/// sphere; `segments` of them make the equator, half as many steps lead from pole to pole.
///
/// `segments` must be a multiple of four, so that the coordinate planes hold vertices.
pub(crate) fn unit_sphere(segments: u32, octant: bool, inward: bool) -> Shape {
    let (around, down) =
        if octant { (segments / 4, segments / 4) } else { (segments, segments / 2) };
    let positions: Vec<[f64; 3]> = (0..=down)
        .flat_map(|ring| (0..=around).map(move |step| on_sphere(ring, step, segments)))
        .collect();
    let side = if inward { -1.0 } else { 1.0 };
    let normals = positions.iter().map(|p| p.map(|c| side * c)).collect();
    let mut triangles = Vec::new();
    for ring in 0..down {
        for step in 0..around {
            let north = ring * (around + 1) + step;
            let south = north + around + 1;
            if ring > 0 {
                triangles.push([north, south, north + 1]);
            }
            if ring + 1 < down || octant {
                triangles.push([south, south + 1, north + 1]);
            }
        }
    }
    let mut shape = Shape { positions, normals: Some(normals), triangles, ..Shape::default() };
    if inward {
        turn_inside_out(&mut shape);
    }
    shape
}

/// Disc of radius one about the origin, facing a direction.
pub(crate) fn unit_disc(segments: u32, normal: Direction) -> Shape {
    let (u, v) = normal.frame();
    let rim = (0..segments).map(|step| {
        let (s, c) = sincos_of_turn(step, segments);
        <[f64; 3]>::from(u * c + v * s)
    });
    let positions = std::iter::once([0.0; 3]).chain(rim).collect();
    let triangles = (0..segments).map(|k| [0, 1 + k, 1 + (k + 1) % segments]).collect();
    Shape { positions, triangles, ..Shape::default() }
}

/// A shape whose front is on the other side, its normals too.
pub(crate) fn inside_out(mut shape: Shape) -> Shape {
    turn_inside_out(&mut shape);
    shape.normals.iter_mut().flatten().for_each(|n| *n = n.map(|c| -c));
    shape
}

/// Turns the front of every triangle to the other side.
pub(crate) fn turn_inside_out(shape: &mut Shape) {
    shape.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
}

fn on_sphere(ring: u32, step: u32, segments: u32) -> [f64; 3] {
    let (sin_theta, cos_theta) = sincos_of_turn(ring, segments);
    let (s, c) = sincos_of_turn(step, segments);
    <[f64; 3]>::from(Vector::new(sin_theta * c, sin_theta * s, cos_theta))
}

/// Of `k` parts of `n` of a full turn; exact at quarters.
pub(crate) fn sincos_of_turn(k: u32, n: u32) -> (f64, f64) {
    match (4 * (k % n)) % n {
        0 => [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][(4 * (k % n) / n) as usize],
        _ => libm::sincos(TAU * f64::from(k % n) / f64::from(n)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::{Point, Triangle};

    fn triangles(shape: &Shape) -> impl Iterator<Item = Triangle> + '_ {
        shape
            .triangles
            .iter()
            .map(|t| Triangle { corners: t.map(|k| Point::from(shape.positions[k as usize])) })
    }

    /// Area, and whether all face the given side of the origin.
    fn area(shape: &Shape, side: f64) -> f64 {
        triangles(shape)
            .map(|t| {
                let facing = t.area_vector().dot(t.centroid().to_vector());
                assert!(facing * side > 0.0, "{t:?}");
                t.area()
            })
            .sum()
    }

    #[test]
    fn area_approaches_the_sphere_from_below_with_the_square_of_the_step() {
        let missing = |n: u32| 1.0 - area(&unit_sphere(n, false, false), 1.0) / (2.0 * TAU);
        assert!(missing(32) > 0.0 && missing(32) < 0.02);
        let order = libm::log2(missing(32) / missing(64));
        assert!((order - 2.0).abs() < 0.05, "{order}");
    }

    #[test]
    fn octant_is_an_eighth_with_exact_borders() {
        let octant = unit_sphere(16, true, true);
        let whole = area(&unit_sphere(16, false, false), 1.0);
        // Sums of a few hundred rounded terms.
        assert!((8.0 * area(&octant, -1.0) - whole).abs() < 1e-12);
        for p in &octant.positions {
            assert!(p.iter().all(|&c| c >= 0.0), "{p:?}");
        }
        for axis in 0..3 {
            assert!(octant.positions.iter().filter(|p| p[axis] == 0.0).count() >= 5);
        }
        assert_eq!(octant.normals.unwrap()[0], [-0.0, -0.0, -1.0]);
    }

    #[test]
    fn disc_faces_its_normal() {
        let normal = Vector::new(1.0, -2.0, 0.5).direction().unwrap();
        let disc = unit_disc(64, normal);
        let total = triangles(&disc).fold(Vector::ZERO, |sum, t| sum + t.area_vector() * 0.5);
        // Area of a regular polygon of 64 corners.
        let expected = 32.0 * libm::sin(TAU / 64.0);
        assert!((total - normal * expected).length() < 1e-12);
    }
}
