//! Illuminance from luminous polygons and discs.

use isolux::geometry::{Normal, Point, Vector};
use std::f64::consts::PI;

/// Illuminance from a polygon of uniform luminance: half the luminance times the sum over edges of
/// the angle they subtend, projected (Lambert 1760, "Photometria"; Baum, Rushmeier, Winget 1989).
/// Corners turn counter-clockwise seen from the luminous side. The polygon must lie wholly above
/// the plane of the receiver, which is not checked.
pub fn polygon_illuminance_lx(
    luminance_cd_m2: f64,
    corners: &[Point],
    at: Point,
    normal: Normal,
) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let sum: f64 = corners
        .iter()
        .zip(next)
        .map(|(&a, &b)| {
            let (a, b) = (a - at, b - at);
            let cross = a.cross(b);
            let length = cross.length();
            let angle_rad = libm::atan2(length, a.dot(b));
            // An edge in line with the receiver subtends nothing.
            if length > 0.0 { cross.dot(normal.to_vector()) / length * angle_rad } else { 0.0 }
        })
        .sum();
    // Seen from the luminous side the corners turn counter-clockwise, about a line of sight that
    // goes the other way.
    -0.5 * luminance_cd_m2 * sum
}

/// Configuration factor of an element facing a parallel disc of radius `r` at distance `h`, its
/// axis `a` aside (Siegel and Howell, "Thermal Radiation Heat Transfer", appendix on factors).
pub fn disc_factor_parallel(r: f64, h: f64, a: f64) -> f64 {
    let sum = h * h + a * a + r * r;
    let root = (sum * sum - 4.0 * a * a * r * r).sqrt();
    0.5 * (1.0 - (sum - 2.0 * r * r) / root)
}

/// Configuration factor of an element perpendicular to a disc of radius `r`, facing its axis, `a`
/// away from it and `h` from its plane, `h > 0` (Siegel and Howell).
pub fn disc_factor_perpendicular(r: f64, h: f64, a: f64) -> f64 {
    let sum = h * h + a * a + r * r;
    let root = (sum * sum - 4.0 * a * a * r * r).sqrt();
    h / (2.0 * a) * (sum / root - 1.0)
}

/// Configuration factor of an element facing a parallel rectangle `a` by `b` at distance `c`, below
/// one of its corners (Siegel and Howell).
pub fn rectangle_factor_parallel(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let term = |x: f64, y: f64| x / (1.0 + x * x).sqrt() * libm::atan(y / (1.0 + x * x).sqrt());
    (term(x, y) + term(y, x)) / (2.0 * PI)
}

/// Configuration factor of an element perpendicular to a rectangle: the element faces the edge of
/// length `b` at distance `c` below one end of it, and the rectangle reaches `a` away (Siegel and Howell).
pub fn rectangle_factor_perpendicular(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / b, c / b);
    let far = 1.0 / (x * x + y * y).sqrt();
    (libm::atan(1.0 / y) - y * far * libm::atan(far)) / (2.0 * PI)
}

/// Corners of a regular polygon of the area of a disc, in a plane of constant z, counter-clockwise
/// seen from below.
pub fn disc_polygon(centre: Point, radius_m: f64, corners: u32) -> Vec<Point> {
    let step_rad = 2.0 * PI / f64::from(corners);
    let scaled_m = radius_m * (step_rad / libm::sin(step_rad)).sqrt();
    (0..corners)
        .map(|k| {
            let (sin, cos) = libm::sincos(-step_rad * f64::from(k));
            centre + Vector::new(scaled_m * cos, scaled_m * sin, 0.0)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{DISC_POLYGON, QUADRATURE};
    use isolux::quadrature::GaussRule;

    const UP: Normal = Normal::Z;

    fn along_x() -> Normal {
        Vector::new(1.0, 0.0, 0.0).normal().unwrap()
    }

    /// A rectangle above the origin whose light goes down: counter-clockwise seen from below.
    fn above(low: [f64; 2], high: [f64; 2], z: f64) -> [Point; 4] {
        [(low[0], low[1]), (low[0], high[1]), (high[0], high[1]), (high[0], low[1])]
            .map(|(x, y)| Point::new(x, y, z))
    }

    #[test]
    fn lambert_agrees_with_known_factors_of_rectangles() {
        for (a, b, c) in [(1.0, 2.0, 0.5), (3.0, 0.4, 1.0), (0.2, 0.2, 2.0)] {
            let facing =
                polygon_illuminance_lx(1.0, &above([0.0; 2], [a, b], c), Point::ORIGIN, UP);
            let expected = PI * rectangle_factor_parallel(a, b, c);
            assert!((facing / expected - 1.0).abs() < QUADRATURE, "{facing} {expected}");
            // Turned by a right angle the element sees the rectangle from its edge outwards.
            let corners = above([0.0; 2], [a, b], c);
            let edge_on = polygon_illuminance_lx(1.0, &corners, Point::ORIGIN, along_x());
            let expected = PI * rectangle_factor_perpendicular(a, b, c);
            assert!((edge_on / expected - 1.0).abs() < QUADRATURE, "{edge_on} {expected}");
        }
    }

    #[test]
    fn lambert_agrees_with_quadrature() {
        let (rule, at) = (GaussRule::new(40), Point::new(0.3, -0.2, 0.1));
        let normal = Vector::new(0.2, 0.1, 1.0).normal().unwrap();
        let by_quadrature = rule.integrate(-0.5, 1.0, |x| {
            rule.integrate(0.2, 0.9, |y| {
                let d = Point::new(x, y, 1.5) - at;
                d.dot(normal.to_vector()) * d.z / d.length_squared().powi(2)
            })
        });
        let found = polygon_illuminance_lx(1.0, &above([-0.5, 0.2], [1.0, 0.9], 1.5), at, normal);
        assert!((found / by_quadrature - 1.0).abs() < QUADRATURE, "{found} {by_quadrature}");
    }

    #[test]
    fn a_polygon_of_many_corners_lights_like_a_disc() {
        let (r, h) = (0.7, 1.2);
        let corners = disc_polygon(Point::new(0.0, 0.0, h), r, 256);
        for a in [0.1, 0.5, 1.5] {
            let at = Point::new(-a, 0.0, 0.0);
            for (normal, factor) in [
                (UP, disc_factor_parallel(r, h, a)),
                (along_x(), disc_factor_perpendicular(r, h, a)),
            ] {
                if normal == UP || a > r {
                    let found = polygon_illuminance_lx(1.0, &corners, at, normal);
                    assert!((found / (PI * factor) - 1.0).abs() < DISC_POLYGON, "{a}");
                }
            }
        }
    }
}
