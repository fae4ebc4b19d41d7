//! The form factor of a triangle as seen from a point, in closed form.

use isolux_geometry::{Point, Vector};
use std::f64::consts::PI;

/// The form factor F of a triangle without obstacles: the share of the cosine-weighted view of a receiver. A
/// surface of exitance M in the triangle causes the illuminance F M. Exact (Lambert 1760, "Photometria";
/// Baum, Rushmeier, Winget 1989); the part below the receiver's horizon is clipped first. Both sides of the
/// triangle count.
pub(super) fn form_factor(from: Point, normal: Vector, corners: [Point; 3]) -> f64 {
    let corners = corners.map(|corner| corner - from);
    let (polygon, count) = above_horizon(normal, corners);
    if count < 3 {
        return 0.0;
    }
    let mut sum = 0.0;
    for k in 0..count {
        let (a, b) = (polygon[k], polygon[(k + 1) % count]);
        let cross = a.cross(b);
        let length = cross.length();
        // An edge in line with the receiver contributes nothing.
        if length > 0.0 {
            sum += cross.dot(normal) / length * libm::atan2(length, a.dot(b));
        }
    }
    sum.abs() / (2.0 * PI)
}

/// The part of a triangle above the plane through the origin, with at most four corners.
fn above_horizon(normal: Vector, corners: [Vector; 3]) -> ([Vector; 4], usize) {
    let heights = corners.map(|corner| corner.dot(normal));
    let mut kept = [Vector::ZERO; 4];
    let mut count = 0;
    let mut keep = |corner: Vector| {
        kept[count] = corner;
        count += 1;
    };
    for k in 0..3 {
        let next = (k + 1) % 3;
        if heights[k] >= 0.0 {
            keep(corners[k]);
        }
        if (heights[k] >= 0.0) != (heights[next] >= 0.0) {
            let share = heights[k] / (heights[k] - heights[next]);
            keep(corners[k] + (corners[next] - corners[k]) * share);
        }
    }
    (kept, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: Vector = Vector::new(0.0, 0.0, 1.0);

    fn square(corners: [Point; 4]) -> f64 {
        let [a, b, c, d] = corners;
        form_factor(Point::ORIGIN, UP, [a, b, c]) + form_factor(Point::ORIGIN, UP, [a, c, d])
    }

    /// The form factor from an element to a parallel rectangle with a corner above it: Siegel and Howell,
    /// "Thermal Radiation Heat Transfer".
    fn parallel(a: f64, b: f64, c: f64) -> f64 {
        let (x, y) = (a / c, b / c);
        let term = |x: f64, y: f64| x / (1.0 + x * x).sqrt() * libm::atan(y / (1.0 + x * x).sqrt());
        (term(x, y) + term(y, x)) / (2.0 * PI)
    }

    #[test]
    fn a_rectangle_overhead_is_as_in_the_books() {
        for (a, b, c) in [(1.0, 1.0, 1.0), (3.0, 0.5, 2.0), (10.0, 10.0, 0.01)] {
            let at = |x: f64, y: f64| Point::new(x, y, c);
            let found = square([at(0.0, 0.0), at(a, 0.0), at(a, b), at(0.0, b)]);
            // Sums of angles have a few rounding errors.
            assert!((found - parallel(a, b, c)).abs() < 1e-12, "{a} {b} {c}: {found}");
        }
    }

    #[test]
    fn what_lies_below_the_horizon_is_cut_off() {
        // A very large wall fills half of the hemisphere; its lower half does not count.
        let at = |y: f64, z: f64| Point::new(1e-3, y, z);
        let found = square([at(-1e6, -1e6), at(1e6, -1e6), at(1e6, 1e6), at(-1e6, 1e6)]);
        assert!((found - 0.5).abs() < 1e-8, "{found}");
        let below = Triangle3::at(-1.0);
        assert_eq!(form_factor(Point::ORIGIN, UP, below.0), 0.0);
    }

    struct Triangle3([Point; 3]);

    impl Triangle3 {
        fn at(z: f64) -> Self {
            Self([Point::new(0.0, 0.0, z), Point::new(1.0, 0.0, z), Point::new(0.0, 1.0, z)])
        }
    }

    #[test]
    fn parts_make_the_whole() {
        let [a, b, c] = Triangle3::at(0.2).0;
        let middle = a.lerp(b, 0.3);
        let whole = form_factor(Point::new(0.1, 0.1, 0.0), UP, [a, b, c]);
        let parts = form_factor(Point::new(0.1, 0.1, 0.0), UP, [a, middle, c])
            + form_factor(Point::new(0.1, 0.1, 0.0), UP, [middle, b, c]);
        assert!((whole - parts).abs() < 1e-14, "{whole} {parts}");
    }
}
