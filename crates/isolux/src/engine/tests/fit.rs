//! Values of best fit.

use super::*;
use crate::elements::{Elements, Subdivision};
use crate::engine::mesh::{Carriers, Fit};
use isolux_geometry::Point;

/// A floor of 4 m by 3 m in many elements, some of them finer.
fn floor() -> (Subdivision, Elements) {
    let shapes = vec![rectangle([0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], 0)];
    let scene = scene(shapes, vec![painted(Rgb::WHITE)], vec![]);
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(0.5, 1 << 20);
    let corner: Vec<u32> = subdivision
        .leaves()
        .filter(|&node| subdivision.triangle(node).point(1.0 / 3.0, 1.0 / 3.0).x < 1.0)
        .collect();
    corner.into_iter().for_each(|node| subdivision.bisect(node));
    let elements = subdivision.elements();
    (subdivision, elements)
}

/// Mean and root mean square of the error of a piecewise linear function over the surface.
fn errors(subdivision: &Subdivision, values: &[Rgb], truth: impl Fn(Point) -> f64) -> [f64; 2] {
    const N: u32 = 12;
    let (mut area, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for leaf in subdivision.leaves() {
        let (triangle, vertices) = (subdivision.triangle(leaf), subdivision.node(leaf).0.vertices);
        for (i, j) in (0..N).flat_map(|i| (0..N - i).map(move |j| (i, j))) {
            let [u, v] = [i, j].map(|k| (f64::from(k) + 1.0 / 3.0) / f64::from(N));
            let [a, b, c] = vertices.map(|k| values[k as usize].luminance());
            let error = a * (1.0 - u - v) + b * u + c * v - truth(triangle.point(u, v));
            let weight = triangle.area();
            area += weight;
            sum += weight * error;
            squares += weight * error * error;
        }
    }
    [sum / area, (squares / area).sqrt()]
}

fn fitted(truth: impl Fn(Point) -> f64 + Copy) -> [[f64; 2]; 2] {
    let (subdivision, elements) = floor();
    let vertices = elements.vertices();
    let values: Vec<Rgb> = vertices.iter().map(|v| Rgb::grey(truth(v.position))).collect();
    let fit = Fit::new(&elements, vertices.len(), |_| true, &Carriers::all());
    let fitted = fit.apply(&values);
    [errors(&subdivision, &values, truth), errors(&subdivision, &fitted, truth)]
}

#[test]
fn planes_are_left_alone() {
    let [_, [_, rms]] = fitted(|p| 3.0 + 0.5 * p.x - 2.0 * p.y);
    assert!(rms < 1e-12, "{rms}");
}

/// A concave function: its interpolation is too small everywhere. A fit has no mean error and 0.42 of
/// the scatter.
#[test]
fn what_is_concave_is_not_too_dark() {
    let [[mean, rms], [fitted_mean, fitted_rms]] = fitted(|p| 9.0 - p.x * p.x - 0.7 * p.y * p.y);
    assert!(mean < -0.5 * rms);
    assert!(fitted_mean.abs() < 0.2 * mean.abs(), "{fitted_mean} of {mean}");
    assert!(fitted_rms < 0.65 * rms, "{fitted_rms} of {rms}");
}

/// Across a jump second differences are no curvature: no value leaves the range of those about it, so that none becomes negative.
#[test]
fn jumps_are_not_overshot() {
    let (_, elements) = floor();
    let vertices = elements.vertices();
    let value = |p: Point| if p.x + 0.3 * p.y > 1.3 { 100.0 } else { 0.0 };
    let values: Vec<Rgb> = vertices.iter().map(|v| Rgb::grey(value(v.position))).collect();
    let fitted = Fit::new(&elements, vertices.len(), |_| true, &Carriers::all()).apply(&values);
    // The luminance of a grey is rounded.
    assert!(fitted.iter().all(|v| (0.0..=100.0).contains(&v.0[0])));
    assert!(fitted != values);
}

/// Nothing is known of hidden vertices: their elements and those beside them tell nothing.
#[test]
fn hidden_vertices_have_no_influence() {
    let (_, elements) = floor();
    let vertices = elements.vertices();
    let known: Vec<bool> = vertices.iter().map(|v| v.position.x < 2.0).collect();
    let fit = Fit::new(
        &elements,
        vertices.len(),
        |corners| corners.iter().all(|&v| known[v as usize]),
        &Carriers::all(),
    );
    let values = |hidden: f64| -> Vec<Rgb> {
        let value = |(k, v): (usize, &crate::elements::Vertex)| {
            if known[k] { v.position.x * v.position.x } else { hidden }
        };
        vertices.iter().enumerate().map(|at| Rgb::grey(value(at))).collect()
    };
    let [a, b] = [0.0, 1e9].map(|hidden| fit.apply(&values(hidden)));
    assert!((0..vertices.len()).filter(|&k| known[k]).all(|k| a[k] == b[k]));
}
