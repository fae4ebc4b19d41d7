//! What of a luminous polygon is seen through an opening or above a plane, and what it gives.
//!
//! All edges of sight are planes through the place that looks: those through the edges of an opening and
//! that of the surface itself. A convex polygon cut by them stays a polygon (Sutherland and Hodgman 1974),
//! and Lambert's formula holds for what is left.

use super::panel::unit;
use crate::lambert::polygon_illuminance_lx;
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::quadrature::GaussRule;

/// The part of a polygon on the side of a plane to which `normal` points.
fn cut(polygon: &[Point], on: Point, normal: Vector) -> Vec<Point> {
    let height = |p: Point| (p - on).dot(normal);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (h_a, h_b) = (height(a), height(b));
        if h_a >= 0.0 {
            kept.push(a);
        }
        if (h_a > 0.0 && h_b < 0.0) || (h_a < 0.0 && h_b > 0.0) {
            kept.push(a.lerp(b, h_a / (h_a - h_b)));
        }
    }
    kept
}

/// The part of a polygon that is seen from a place within a convex outline.
pub(super) fn within(polygon: &[Point], outline: &[Point], from: Point) -> Vec<Point> {
    let sum = outline.iter().fold(Vector::ZERO, |sum, &p| sum + (p - from));
    let mut kept = polygon.to_vec();
    for (k, &a) in outline.iter().enumerate() {
        let b = outline[(k + 1) % outline.len()];
        let normal = (a - from).cross(b - from);
        kept = cut(&kept, from, if normal.dot(sum) < 0.0 { -normal } else { normal });
    }
    kept
}

/// The part of a polygon above the surface of a place.
pub(super) fn above(polygon: &[Point], at: ProbePoint) -> Vec<Point> {
    cut(polygon, at.position, at.normal.to_vector())
}

/// Illuminance from what of a polygon lies above the surface of a place, by Lambert's formula.
/// Corners turn counter-clockwise seen from the luminous side, on which the place must be.
pub(super) fn lambert_lx(luminance_cd_m2: f64, polygon: &[Point], at: ProbePoint) -> f64 {
    let seen = above(polygon, at);
    polygon_illuminance_lx(luminance_cd_m2, &seen, at.position, at.normal)
}

/// Illuminance from a polygon whose luminance differs from place to place, as the place `at` sees it:
/// `Int L cos(theta) cos(theta') / r^2 dA` by Gauss quadrature of `points` each way over the
/// triangles of a fan.
pub(super) fn gathered_lx(
    polygon: &[Point],
    at: ProbePoint,
    points: usize,
    luminance_cd_m2: impl Fn(Point) -> f64,
) -> f64 {
    let seen = above(polygon, at);
    let rule = GaussRule::new(points);
    (2..seen.len())
        .map(|k| {
            let [a, b, c] = [seen[0], seen[k - 1], seen[k]];
            let doubled = (b - a).cross(c - a);
            if doubled.length() == 0.0 {
                return 0.0;
            }
            let (facing, normal) = (unit(doubled), at.normal.to_vector());
            // Coordinates that collapse in the first corner: the area element is `s` times that of the square.
            doubled.length()
                * rule.integrate(0.0, 1.0, |s| {
                    s * rule.integrate(0.0, 1.0, |t| {
                        let place = a + ((b - a) + (c - b) * t) * s;
                        let way = place - at.position;
                        let r2 = way.length_squared();
                        let cosines = way.dot(normal) * way.dot(facing).abs() / (r2 * r2);
                        luminance_cd_m2(place) * cosines
                    })
                })
        })
        // The sum of nothing has a sign.
        .fold(0.0, |sum, part| sum + part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::QUADRATURE;
    use isolux::geometry::Normal;

    fn lid() -> Vec<Point> {
        // Its light goes down.
        [(0.0, 0.0), (0.0, 4.0), (3.0, 4.0), (3.0, 0.0)]
            .map(|(x, y)| Point::new(x, y, 5.0))
            .to_vec()
    }

    fn hole() -> Vec<Point> {
        [(1.0, 1.0), (2.5, 1.0), (2.5, 2.0), (1.0, 2.0)]
            .map(|(x, y)| Point::new(x, y, 2.0))
            .to_vec()
    }

    #[test]
    fn what_is_seen_is_what_rays_through_the_hole_meet() {
        let from = Point::new(0.7, 1.8, 0.2);
        let seen = within(&lid(), &hole(), from);
        let area = |p: &[Point]| {
            let fan = (2..p.len()).map(|k| (p[k - 1] - p[0]).cross(p[k] - p[0]));
            0.5 * fan.fold(Vector::ZERO, |sum, v| sum + v).length()
        };
        // Rays through a fine grid of the hole, and the magnification from its plane to the lid.
        let (steps, scale) = (400, (5.0 - 0.2) / (2.0 - 0.2));
        let met = (0..steps * steps).filter(|k| {
            let share = |n: i32| (f64::from(n) + 0.5) / f64::from(steps);
            let through = Point::new(1.0 + 1.5 * share(k % steps), 1.0 + share(k / steps), 2.0);
            let place = from + (through - from) * scale;
            (0.0..=3.0).contains(&place.x) && (0.0..=4.0).contains(&place.y)
        });
        let by_rays = met.count() as f64 / f64::from(steps * steps) * 1.5 * scale * scale;
        // Cells on the edges of what is seen are counted whole or not at all.
        let edges = 4.0 / f64::from(steps);
        assert!((area(&seen) / by_rays - 1.0).abs() < edges, "{} {by_rays}", area(&seen));
    }

    #[test]
    fn quadrature_of_even_luminance_is_lamberts_formula() {
        let normal = Vector::new(0.8, 0.1, 0.3).normal().unwrap();
        for normal in [Normal::Z, normal] {
            let at = ProbePoint { position: Point::new(0.7, 1.8, 0.2), normal };
            let seen = within(&lid(), &hole(), at.position);
            let (found, expected) =
                (gathered_lx(&seen, at, 32, |_| 7.0), lambert_lx(7.0, &seen, at));
            assert!((found / expected - 1.0).abs() < QUADRATURE, "{found} {expected}");
        }
    }

    #[test]
    fn nothing_is_seen_past_the_hole_or_below_the_surface() {
        let at = ProbePoint { position: Point::new(0.7, 1.8, 0.2), normal: -Normal::Z };
        assert_eq!(lambert_lx(7.0, &lid(), at), 0.0);
        assert!(within(&lid(), &hole(), Point::new(9.0, 1.8, 1.9)).len() < 3);
    }
}
