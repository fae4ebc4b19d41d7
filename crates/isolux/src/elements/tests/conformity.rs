//! No T-vertices, no area lost, no angle spoiled.

use super::*;
use crate::elements::Vertex;
use crate::scene::Body;
use isolux_geometry::{Point, Triangle};
use std::collections::{BTreeMap, BTreeSet};

type Edge = [u32; 2];

fn edges([a, b, c]: [u32; 3]) -> [Edge; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

/// How many of the triangles lie on each edge, coincident ones counted once.
fn edge_counts(triangles: impl Iterator<Item = [u32; 3]>) -> BTreeMap<Edge, usize> {
    let mut counts = BTreeMap::new();
    let sorted = |mut corners: [u32; 3]| {
        corners.sort_unstable();
        corners
    };
    let different: BTreeSet<[u32; 3]> = triangles.map(sorted).collect();
    different.into_iter().flat_map(edges).for_each(|e| *counts.entry(e).or_default() += 1);
    counts
}

/// For every edge of the input and all parts of it, how many triangles of the input lie on it. By
/// the parents of the vertices, which come in the order they were made.
fn input_edges(subdivision: &Subdivision, vertices: &[Vertex]) -> BTreeMap<Edge, usize> {
    let roots = (0..subdivision.node_count() as u32)
        .filter(|&n| subdivision.node(n).1.depth == 0)
        .map(|n| subdivision.node(n).0.vertices);
    let mut known = edge_counts(roots);
    for (middle, vertex) in vertices.iter().enumerate() {
        let Some([a, b]) = vertex.parents else { continue };
        let middle = middle as u32;
        if let Some(&count) = known.get(&[a.min(b), a.max(b)]) {
            known.insert([a, middle], count);
            known.insert([b, middle], count);
        }
    }
    known
}

#[test]
fn elements_on_an_edge_share_it_whole() {
    for (name, _, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let on_input = input_edges(&subdivision, elements.vertices());
        let leaves = elements.elements().into_iter().map(|e| e.vertices);
        for (edge, count) in edge_counts(leaves) {
            // Inside a triangle of the input two elements meet, on its edges as many as triangles.
            let expected = on_input.get(&edge).copied().unwrap_or(2);
            assert_eq!(count, expected, "{name}: edge {edge:?}");
        }
    }
}

#[test]
fn areas_are_conserved() {
    for (name, scene, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let roots = Subdivision::new(&scene).elements();
        // Two roundings of a cross product an element, of a few hundred elements.
        let tolerance = 1e-12 * area_m2(&roots);
        assert!((area_m2(&elements) - area_m2(&roots)).abs() < tolerance, "{name}");
        let of_vertices: f64 = elements.vertices().iter().map(|v| v.area_m2).sum();
        assert!((of_vertices - area_m2(&roots)).abs() < tolerance, "{name}");
        assert!(elements.vertices().iter().all(|v| v.area_m2 > 0.0), "{name}");
    }
}

#[test]
fn elements_tile_each_triangle_and_turn_its_way() {
    for (name, scene, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let at = |v: u32| elements.vertices()[v as usize].position;
        let mut sums = BTreeMap::new();
        for element in elements.elements() {
            let leaf = Triangle { corners: element.vertices.map(at) };
            let root = scene.triangle(element.triangle);
            // As an oriented area, so that one turned around would be missed twice.
            let share =
                leaf.area_vector().dot(root.area_vector()) / root.area_vector().length_squared();
            *sums.entry((element.triangle, element.back)).or_insert(0.0) += share;
        }
        for (side, sum) in sums {
            assert!((sum - 1.0_f64).abs() < 1e-9, "{name} {side:?}: {sum}");
        }
    }
}

fn least_angle(triangle: &Triangle) -> f64 {
    let p = triangle.corners;
    let angle = |k: usize| {
        let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
        libm::atan2(a.cross(b).length(), a.dot(b))
    };
    angle(0).min(angle(1)).min(angle(2))
}

#[test]
fn angles_stay_above_half_the_least() {
    // Rosenberg, Stenger (1975): a lower bound on the angles constructed by bisecting triangles.
    for (name, scene, subdivision) in every_kind() {
        for leaf in subdivision.leaves() {
            let root = scene.triangle(subdivision.node(leaf).1.triangle);
            let (found, least) = (least_angle(&subdivision.triangle(leaf)), least_angle(&root));
            assert!(found > 0.5 * least * (1.0 - 1e-6), "{name}: {found} of {least}");
        }
    }
}

#[test]
fn bisection_to_a_length_leaves_no_longer_edge() {
    for (name, scene, _) in every_kind() {
        let mut subdivision = Subdivision::new(&scene);
        subdivision.bisect_to(0.2, usize::MAX);
        let longest =
            subdivision.leaves().map(|n| subdivision.longest_edge_m(n)).fold(0.0, f64::max);
        assert!(longest > 0.05 && longest <= 0.2, "{name}: {longest}");
        let mut bounded = Subdivision::new(&scene);
        bounded.bisect_to(0.2, 40);
        // The last bisection may need others before it.
        assert!(bounded.vertex_count() < 40 + 10, "{name}: {}", bounded.vertex_count());
    }
}

#[test]
fn a_bisected_element_is_no_leaf_and_its_children_are() {
    let (_, _, mut subdivision) = every_kind().remove(3);
    let leaf = subdivision.leaves().nth(7).unwrap();
    subdivision.bisect(leaf);
    let split = subdivision.node(leaf).0.split.unwrap();
    let leaves: BTreeSet<u32> = subdivision.leaves().collect();
    assert!(!leaves.contains(&leaf));
    for child in [split.first_child, split.first_child + 1] {
        assert!(leaves.contains(&child));
        let (parent, child) = (subdivision.node(leaf).1, subdivision.node(child).1);
        assert_eq!(
            (child.triangle, child.back, child.depth),
            (parent.triangle, parent.back, parent.depth + 1)
        );
    }
    // Of an element that is split already nothing changes.
    let before = subdivision.node_count();
    subdivision.bisect(leaf);
    assert_eq!(subdivision.node_count(), before);
}

#[test]
fn the_same_bisections_give_the_same_elements() {
    for ((name, _, a), (_, _, b)) in every_kind().into_iter().zip(every_kind()) {
        assert_eq!(a.elements(), b.elements(), "{name}");
    }
}

#[test]
fn new_vertices_are_the_middles_of_their_edges() {
    for (name, _, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let vertices = elements.vertices();
        for (k, vertex) in vertices.iter().enumerate() {
            let Some([a, b]) = vertex.parents else { continue };
            assert!((a as usize) < k && (b as usize) < k, "{name}: {k} of {a} {b}");
            let [a, b]: [Point; 2] = [a, b].map(|v| vertices[v as usize].position);
            assert_eq!(vertex.position, a.lerp(b, 0.5), "{name}");
        }
    }
}

/// A wall on a slab, whose lower side, seen from inside of the wall, lies upon the slab.
#[test]
fn where_solids_touch_borders_stay_borders() {
    let strip = [[0.0, 0.0, 0.0], [0.2, 0.0, 0.0], [0.2, 1.0, 0.0], [0.0, 1.0, 0.0]];
    // Its front faces down.
    let below = mesh(&strip, &[[0, 2, 1], [0, 3, 2]]);
    let finish = Finish::diffuse(Rgb::grey(0.5));
    let body = Body::Opaque { front: finish.clone(), back: finish };
    let two_sided = Material { name: "wall".into(), body };
    let scene = scene(vec![square(), below], vec![two_sided]);
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(0.1, 10_000);
    let (vertices, border) = (subdivision.vertices(), subdivision.border_vertices());
    let mut ends = vec![false; vertices.len()];
    subdivision.border_edges().into_iter().flatten().for_each(|end| ends[end as usize] = true);
    assert_eq!(border, ends, "bisection keeps them");
    let is_rim = |p: Point| [p.x, p.y].iter().any(|&c| c == 0.0 || c == 1.0);
    let of_slab = |k: usize| vertices[k].normal.to_vector().z > 0.0 && vertices[k].position.x < 0.2;
    let some: Vec<usize> = (0..vertices.len()).filter(|&k| of_slab(k)).collect();
    assert!(some.len() > 40, "{}", some.len());
    for k in some {
        let at = vertices[k].position;
        assert!(border[k] || !is_rim(at), "{at:?}");
    }
    // In the middle of the slab elements are all around.
    let inside = (0..vertices.len()).filter(|&k| vertices[k].position.x > 0.3);
    for k in inside {
        let at = vertices[k].position;
        assert_eq!(border[k], is_rim(at), "{at:?}");
    }
}

#[test]
fn surfaces_on_each_other_are_as_many_elements_as_a_surface_of_their_size_has() {
    let shapes: Vec<Shape> = (0..500).map(|_| square()).collect();
    let scene = scene(shapes, vec![grey()]);
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(1e-3, 2000);
    // The last bisection splits all 500 at once.
    assert!(subdivision.node_count() <= 4 * 2000 + 4 * 500, "{}", subdivision.node_count());
    assert_eq!(subdivision.leaves().count() % 500, 0, "all are divided alike");
    let area_m2: f64 = subdivision.leaves().map(|leaf| subdivision.triangle(leaf).area()).sum();
    assert!((area_m2 - 500.0).abs() < 1e-9, "{area_m2}");
}
