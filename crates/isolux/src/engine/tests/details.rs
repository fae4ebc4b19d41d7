//! Details: what tells where elements are too coarse.

use super::*;
use crate::elements::Subdivision;
use crate::engine::mesh::{Carriers, Details, LeafError, Refinement, refine_worst};

fn patch(edge_m: f64) -> Subdivision {
    let shape = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0);
    let scene = scene(vec![shape], vec![painted(Rgb::grey(0.5))], vec![]);
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(edge_m, usize::MAX);
    subdivision
}

fn errors_of(subdivision: &Subdivision, f: impl Fn(Point) -> Option<f64>) -> Vec<LeafError> {
    let elements = subdivision.elements();
    let values: Vec<Option<f64>> = elements.vertices().iter().map(|v| f(v.position)).collect();
    let carriers = Carriers::all();
    let details = Details::of(subdivision, &elements, &values, &carriers, |_, _| false);
    details.leaf_errors(|_| None, |_| false, |_, _| false)
}

/// Root mean square over the surface.
fn rms(errors: &[LeafError]) -> f64 {
    let area: f64 = errors.iter().map(|e| e.area_m2).sum();
    (errors.iter().map(LeafError::squared).sum::<f64>() / area).sqrt()
}

/// The interpolation error itself, by places inside the elements.
fn true_rms(subdivision: &Subdivision, f: impl Fn(Point) -> f64) -> f64 {
    let (mut area, mut sum) = (0.0, 0.0);
    for leaf in subdivision.leaves() {
        let triangle = subdivision.triangle(leaf);
        let [a, b, c] = triangle.corners.map(&f);
        let n = 12;
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            let (u, v) = (
                (f64::from(i) + 1.0 / 3.0) / f64::from(n),
                (f64::from(j) + 1.0 / 3.0) / f64::from(n),
            );
            let error = f(triangle.point(u, v)) - (a * (1.0 - u - v) + b * u + c * v);
            sum += triangle.area() * error * error;
            area += triangle.area();
        }
    }
    (sum / area).sqrt()
}

fn until(least_edge_m: f64, max_vertices: usize) -> Refinement {
    Refinement { wanted: 0.0, least_edge_m, max_vertices }
}

#[test]
fn a_linear_function_has_no_error() {
    let errors = errors_of(&patch(0.2), |p| Some(3.0 * p.x - p.y + 5.0));
    assert!(rms(&errors) < 1e-14, "{}", rms(&errors));
    let area: f64 = errors.iter().map(|e| e.area_m2).sum();
    assert!((area - 1.0).abs() < 1e-14);
}

#[test]
fn errors_of_smooth_functions_are_told_on_the_safe_side() {
    // The estimate must do for kinks and shadow borders too, so of smooth functions it says up to three
    // times too much; and eight times for a saddle along the legs of the elements, which errs on
    // every second edge alone.
    type Named = (&'static str, fn(Point) -> f64, f64);
    let functions: [Named; 3] = [
        ("parabola", |p| p.x * p.x, 3.0),
        ("saddle", |p| p.x * p.y, 9.0),
        ("inverse square", |p| 1.0 / (0.1 + p.x * p.x + p.y * p.y), 3.0),
    ];
    for (name, f, most) in functions {
        for edge_m in [0.3, 0.15, 0.08] {
            let subdivision = patch(edge_m);
            let told = rms(&errors_of(&subdivision, |p| Some(f(p))));
            let ratio = told / true_rms(&subdivision, f);
            assert!(ratio > 1.0 && ratio < most, "{name} {edge_m}: {ratio}");
        }
    }
}

#[test]
fn errors_fall_with_the_square_of_the_size() {
    let of = |edge_m| rms(&errors_of(&patch(edge_m), |p| Some(p.x * p.x + 2.0 * p.y * p.y)));
    let ratio = of(0.3) / of(0.3 / 4.0);
    assert!((ratio - 16.0).abs() < 2.0, "{ratio}");
}

#[test]
fn elements_at_hidden_vertices_are_uncertain_as_their_value() {
    let subdivision = patch(0.3);
    let errors = errors_of(&subdivision, |p| (p.x < 0.5).then_some(8.0));
    for error in errors {
        let middle = subdivision.triangle(error.node).corners;
        let known = middle.iter().filter(|p| p.x < 0.5).count();
        match known {
            0 | 3 => assert_eq!(error.error, 0.0),
            _ => assert!(error.error > 0.0 && error.error < 8.0),
        }
    }
}

#[test]
fn the_worst_are_bisected_and_the_others_are_not() {
    let mut subdivision = patch(0.3);
    let step = |p: Point| Some(if p.x < 0.26 { 10.0 } else { 0.0 });
    for _ in 0..4 {
        let errors = errors_of(&subdivision, step);
        assert!(refine_worst(
            &mut subdivision,
            &mut Carriers::all(),
            &errors,
            until(1e-3, usize::MAX)
        ));
    }
    let size = |low: f64, high: f64| {
        let inside = |&n: &u32| {
            let x = subdivision.triangle(n).centroid().x;
            x > low && x < high
        };
        let lengths: Vec<f64> =
            subdivision.leaves().filter(inside).map(|n| subdivision.longest_edge_m(n)).collect();
        lengths.iter().sum::<f64>() / lengths.len() as f64
    };
    assert!(size(0.24, 0.28) < 0.2 * size(0.6, 1.0), "{} {}", size(0.24, 0.28), size(0.6, 1.0));
}

#[test]
fn refinement_ends_at_its_bounds() {
    let mut subdivision = patch(0.3);
    let before = subdivision.vertex_count();
    let bend = |p: Point| Some(p.x * p.x);
    let errors = errors_of(&subdivision, bend);
    assert!(
        !refine_worst(&mut subdivision, &mut Carriers::all(), &errors, until(1.0, usize::MAX)),
        "all edges are short enough"
    );
    assert!(
        !refine_worst(&mut subdivision, &mut Carriers::all(), &errors, until(1e-3, before)),
        "there are vertices enough"
    );
    let none = errors_of(&subdivision, |_| Some(1.0));
    assert!(
        !refine_worst(&mut subdivision, &mut Carriers::all(), &none, until(1e-3, usize::MAX)),
        "there is no error"
    );
    assert_eq!(subdivision.vertex_count(), before);
    assert!(refine_worst(
        &mut subdivision,
        &mut Carriers::all(),
        &errors,
        until(1e-3, before + 10)
    ));
    // The last element marked is bisected whole, with what that takes.
    assert!(subdivision.vertex_count() <= before + 30);
}
