//! What size a scene plausibly has.

use isolux::scene::Shape;

/// A scene wider than this many metres was more likely written in centimetres or millimetres.
pub(crate) const IMPLAUSIBLE_EXTENT_M: f64 = 100.0;

/// The longest side of the box around shapes, m; zero of nothing.
pub(crate) fn largest_side_m(shapes: &[Shape]) -> f64 {
    let side = |axis: usize| {
        let all = shapes.iter().flat_map(|shape| &shape.positions).map(|p| p[axis]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    (0..3).map(side).fold(0.0, f64::max)
}
