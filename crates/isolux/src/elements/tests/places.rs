//! Places of a triangle and the elements they are in.

use super::*;
use isolux_geometry::Point;
use std::collections::BTreeSet;

/// Barycentric weights inside and on the rim of a triangle.
fn places() -> Vec<[f64; 2]> {
    let key = Key::new(21);
    let inside = (0..40).map(|k| {
        let [a, b] = [0, 1].map(|n| key.with(2 * k + n).uniform());
        if a + b > 1.0 { [1.0 - a, 1.0 - b] } else { [a, b] }
    });
    let rim = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.25, 0.75], [0.0, 0.3]];
    rim.into_iter().chain(inside).collect()
}

/// Sides of triangles that carry a map.
fn sides(scene: &Scene, elements: &Elements) -> Vec<(u32, bool)> {
    let all = (0..scene.triangle_count()).flat_map(|t| [(t, false), (t, true)]);
    all.filter(|&(t, back)| elements.locate(t, back, 0.3, 0.3).is_some()).collect()
}

fn linear(p: Point) -> f64 {
    3.0 + 2.0 * p.x - 5.0 * p.y + 0.5 * p.z
}

#[test]
fn the_element_found_holds_the_place() {
    for (name, scene, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let leaves: BTreeSet<(u32, bool, [u32; 3])> =
            elements.elements().iter().map(|e| (e.triangle, e.back, e.vertices)).collect();
        for (triangle, back) in sides(&scene, &elements) {
            for [u, v] in places() {
                let found = elements.locate(triangle, back, u, v).unwrap();
                let vertices = found.map(|(vertex, _)| vertex);
                assert!(leaves.contains(&(triangle, back, vertices)), "{name}: no leaf");
                // Differences of weights are exact or lose half an ulp of one at each level.
                assert!(found.iter().all(|&(_, w)| w > -1e-14), "{name}: {found:?}");
                let sum: f64 = found.iter().map(|&(_, w)| w).sum();
                assert!((sum - 1.0).abs() < 1e-14, "{name}: {sum}");
            }
        }
    }
}

#[test]
fn a_linear_function_is_read_exactly_on_every_level() {
    for (name, scene, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let vertices = elements.vertices();
        for level in [0, 1, 4, 20, 100, u32::MAX] {
            for (triangle, back) in sides(&scene, &elements) {
                for [u, v] in places() {
                    let found = elements.locate_above(level, triangle, back, u, v).unwrap();
                    let read: f64 =
                        found.iter().map(|&(k, w)| w * linear(vertices[k as usize].position)).sum();
                    let expected = linear(scene.triangle(triangle).point(u, v));
                    // A dozen roundings of numbers up to ten.
                    assert!((read - expected).abs() < 1e-13, "{name} {level}: {read} {expected}");
                }
            }
        }
    }
}

#[test]
fn a_coarser_level_is_what_there_was() {
    let scene = scene(vec![uneven_patch(3)], vec![grey()]);
    let mut subdivision = Subdivision::new(&scene);
    bisect_at_random(&mut subdivision, 5, 30);
    let (coarse, level) = (subdivision.elements(), subdivision.node_count() as u32);
    bisect_at_random(&mut subdivision, 6, 60);
    let fine = subdivision.elements();
    for (triangle, back) in sides(&scene, &fine) {
        for [u, v] in places() {
            let then = coarse.locate(triangle, back, u, v);
            assert_eq!(fine.locate_above(level, triangle, back, u, v), then);
        }
    }
}

#[test]
fn sides_without_a_map_and_triangles_that_are_not_there_have_no_place() {
    let (_, scene, subdivision) = every_kind().remove(0);
    let elements = subdivision.elements();
    assert_eq!(elements.locate(0, true, 0.3, 0.3), None);
    assert_eq!(elements.locate(scene.triangle_count(), false, 0.3, 0.3), None);
    assert_eq!(elements.locate(u32::MAX, false, 0.3, 0.3), None);
}

#[test]
fn weights_that_are_no_weights_end_somewhere() {
    let (_, _, subdivision) = every_kind().remove(3);
    let elements = subdivision.elements();
    for u in [f64::NAN, f64::INFINITY, -1e30, 1e30, -1e-7] {
        assert!(elements.locate(0, false, u, 0.5).is_some());
    }
}
