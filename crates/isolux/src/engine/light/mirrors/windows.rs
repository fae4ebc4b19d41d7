//! The mirrors that an image is seen through.

use super::planar::{Ball, Plane};
use crate::ablation::without;
use isolux_geometry::Point;

/// Balls around the mirrors of a chain, as images seen by a receiver: each is reflected by the
/// mirrors that light meets after it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Windows(Vec<Ball>);

impl Windows {
    /// The windows of the image in one more mirror.
    pub(crate) fn and(&self, mirror: &Plane, tolerance_m: f64) -> Self {
        let image = |ball: &Ball| Ball { centre: mirror.image(ball.centre), ..*ball };
        Self(self.0.iter().map(image).chain([mirror.ball(tolerance_m)]).collect())
    }

    /// Whether some straight path from a place to a ball may pass through all windows; `false` is certain.
    pub(crate) fn may_show(&self, from: Point, ball: Ball) -> bool {
        without("mirror-windows") || self.0.iter().all(|window| may_overlap(from, *window, ball))
    }
}

/// Whether the cones around two balls have a direction in common.
fn may_overlap(from: Point, a: Ball, b: Ball) -> bool {
    let [to_a, to_b] = [a, b].map(|ball| ball.centre - from);
    let [away_a, away_b] = [to_a.length(), to_b.length()];
    if away_a <= a.radius_m || away_b <= b.radius_m {
        return true;
    }
    // The angle between the axes is compared with the sum of the half angles, each below a right angle, by cosines.
    let [sin_a, sin_b] = [a.radius_m / away_a, b.radius_m / away_b];
    let cos = |sin: f64| (1.0 - sin * sin).max(0.0).sqrt();
    to_a.dot(to_b) / (away_a * away_b) >= cos(sin_a) * cos(sin_b) - sin_a * sin_b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_overlap_as_far_as_their_half_angles_reach() {
        let ball = |x: f64, y: f64, radius_m: f64| Ball { centre: Point::new(x, y, 0.0), radius_m };
        let overlap = |a: Ball, b: Ball| may_overlap(Point::ORIGIN, a, b);
        // Half angles of 30 degrees each.
        for (degrees, expected) in [(0.0, true), (59.0, true), (61.0, false), (180.0, false)] {
            let (s, c) = libm::sincos(f64::to_radians(degrees));
            assert_eq!(overlap(ball(2.0, 0.0, 1.0), ball(4.0 * c, 4.0 * s, 2.0)), expected);
        }
        // From inside a ball everything is seen.
        assert!(overlap(ball(0.5, 0.0, 1.0), ball(-9.0, 0.0, 0.1)));
        // The second ball may be a point.
        assert!(overlap(ball(2.0, 0.0, 1.0), ball(3.0, 1.7, 0.0)));
        assert!(!overlap(ball(2.0, 0.0, 1.0), ball(3.0, 1.8, 0.0)));
    }
}
