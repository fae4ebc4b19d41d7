//! Which sides carry a map, and which of their vertices are one.

use super::*;
use crate::scene::{Body, Dielectric, Gloss};
use isolux_geometry::Vector;

fn vertex_count(shapes: Vec<Shape>) -> usize {
    Subdivision::new(&scene(shapes, vec![grey()])).vertex_count()
}

/// Two unit squares on either side of the y axis, with an angle between their normals; they share
/// positions, not vertices.
fn folded(degrees: f64) -> Vec<Shape> {
    let (s, c) = libm::sincos(degrees.to_radians());
    let right = mesh(
        &[[0.0, 0.0, 0.0], [c, 0.0, s], [c, 1.0, s], [0.0, 1.0, 0.0]],
        &[[0, 1, 2], [0, 2, 3]],
    );
    let left = mesh(
        &[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
        &[[0, 1, 2], [0, 2, 3]],
    );
    vec![left, right]
}

#[test]
fn coplanar_neighbours_share_vertices_and_creases_do_not() {
    for (name, shapes, expected) in [
        ("one square", vec![square()], 4),
        ("two coplanar squares of two shapes", folded(0.0), 6),
        ("half a degree", folded(0.5), 6),
        ("two degrees", folded(2.0), 8),
        ("a cube", vec![cube()], 24),
        ("a cube without creases", vec![smooth_cube()], 8),
    ] {
        assert_eq!(vertex_count(shapes), expected, "{name}");
    }
}

#[test]
fn zero_and_minus_zero_are_one_place() {
    let shifted = folded(0.0).into_iter().map(|mut shape| {
        shape.positions.iter_mut().flatten().filter(|c| **c == 0.0).for_each(|c| *c = -0.0);
        shape
    });
    let mixed: Vec<Shape> = folded(0.0).into_iter().take(1).chain(shifted.skip(1)).collect();
    assert_eq!(vertex_count(mixed), 6);
}

/// Roots and vertices of a square of a material.
fn sides(material: Material) -> (usize, usize) {
    let subdivision = Subdivision::new(&scene(vec![square()], vec![material]));
    (subdivision.node_count(), subdivision.vertex_count())
}

#[test]
fn sides_carry_a_map_where_light_can_be_measured() {
    let finish = |diffuse: f64, mirror: f64| Finish {
        mirror: Rgb::grey(mirror),
        ..Finish::diffuse(Rgb::grey(diffuse))
    };
    let gloss = Finish { gloss: Some(Gloss { f0: Rgb::grey(0.9), alpha: 0.1 }), ..Finish::BLACK };
    let glass = Dielectric { ior: 1.5, transmittance: Rgb::WHITE, thin: true };
    let shining = |diffuse: f64| Finish { luminance_cd_m2: Rgb::grey(1e4), ..finish(diffuse, 0.0) };
    for (name, material, expected) in [
        ("paint in front", grey(), (2, 4)),
        ("paint on both sides", Material::two_sided("m", finish(0.5, 0.0)), (4, 8)),
        ("black in front", Material::one_sided("m", Finish::BLACK), (2, 4)),
        ("mirror", Material::two_sided("m", finish(0.0, 0.9)), (0, 0)),
        ("mirror that scatters a little", Material::one_sided("m", finish(0.1, 0.8)), (2, 4)),
        ("gloss", Material::one_sided("m", gloss), (2, 4)),
        ("lamp", Material::one_sided("m", shining(0.0)), (0, 0)),
        ("lamp that reflects a little", Material::one_sided("m", shining(0.1)), (2, 4)),
        ("glass", Material { name: "m".into(), body: Body::Dielectric(glass) }, (0, 0)),
    ] {
        assert_eq!(sides(material), expected, "{name}");
    }
}

#[test]
fn sides_of_a_sheet_face_apart() {
    let sheet = Material::two_sided("m", Finish::diffuse(Rgb::grey(0.5)));
    let scene = scene(vec![square()], vec![sheet]);
    let elements = Subdivision::new(&scene).elements();
    for element in elements.elements() {
        let up = if element.back { -1.0 } else { 1.0 };
        for v in element.vertices {
            let normal = elements.vertices()[v as usize].normal.to_vector();
            assert_eq!(normal, Vector::new(0.0, 0.0, up), "{element:?}");
        }
    }
}

#[test]
fn receivers_lie_in_an_element_at_their_vertex_off_the_border() {
    const SHARE: f64 = 0.01;
    for (name, scene, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let receivers = subdivision.receivers(SHARE);
        assert_eq!(receivers.len(), elements.vertices().len());
        for (receiver, vertex) in receivers.iter().zip(elements.vertices()) {
            let triangle = scene.triangle(receiver.triangle);
            let [u, v] = triangle.barycentric(receiver.point);
            // Rounding of a barycentric weight of a sliver of 1e-5: its height divides.
            assert!(u.min(v).min(1.0 - u - v) > -1e-10, "{name}: {receiver:?}");
            let moved = (receiver.point - vertex.position).length();
            let longest = (0..3)
                .map(|k| (triangle.corners[k] - triangle.corners[(k + 1) % 3]).length())
                .fold(0.0, f64::max);
            assert!(moved <= SHARE * longest, "{name}");
            assert_eq!(receiver.normal, vertex.normal);
        }
    }
}

#[test]
fn receivers_of_the_square_are_pulled_in_at_the_border_alone() {
    let mut subdivision = Subdivision::new(&scene(vec![square()], vec![grey()]));
    subdivision.bisect_to(0.3, usize::MAX);
    let elements = subdivision.elements();
    for (receiver, vertex) in subdivision.receivers(0.01).iter().zip(elements.vertices()) {
        let p = vertex.position;
        let on_border = [p.x, p.y].iter().any(|&c| c == 0.0 || c == 1.0);
        assert_eq!(receiver.point != p, on_border, "{p:?}");
        let r = receiver.point;
        assert!(r.x > 0.0 && r.x < 1.0 && r.y > 0.0 && r.y < 1.0, "{r:?}");
    }
}
