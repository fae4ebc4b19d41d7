//! Where the coordinates of the ray kernel count from: near the scene, wherever that lies.

use isolux_geometry::Point;

/// The origin for surfaces with these corners, axis by axis: a multiple of a step, which is a power of two and two to four
/// times as long as the longest side of the box around them. Where the middle of the box lies within a step of zero it is
/// zero, else the multiple nearest to the middle. No coordinate that counts from there is larger than that of the world, nor
/// than five sides: what `f32` holds exactly in the world it holds there, too.
pub(super) fn of(corners: impl Iterator<Item = Point>) -> Point {
    let around = corners.fold(None, |around: Option<(Point, Point)>, p| {
        let (low, high) = around.unwrap_or((p, p));
        Some((low.lesser(p), high.greater(p)))
    });
    let Some((low, high)) = around else { return Point::ORIGIN };
    let size = high - low;
    let longest_m = size.x.max(size.y).max(size.z);
    if longest_m <= 0.0 {
        return Point::ORIGIN;
    }
    let (_, exponent) = libm::frexp(2.0 * longest_m);
    let step_m = libm::ldexp(1.0, exponent);
    let origin = |low: f64, high: f64| {
        let steps = 0.5 * (low + high) / step_m;
        if steps.abs() < 1.0 { 0.0 } else { steps.round() * step_m }
    };
    Point::new(origin(low.x, high.x), origin(low.y, high.y), origin(low.z, high.z))
}

#[cfg(test)]
mod tests {
    use super::of;
    use isolux_geometry::Point;
    use proptest::prelude::*;

    fn of_box(low: [f64; 3], size: [f64; 3]) -> Point {
        let low = Point::from(low);
        of([low, low + isolux_geometry::Vector::from(size)].into_iter())
    }

    #[test]
    fn scenes_near_the_origin_keep_it() {
        let room = [4.0, 3.0, 5.0];
        for low in [[0.0; 3], [-2.0, -1.5, -2.5], [4.0, 3.0, 5.0], [-12.0, 9.0, 0.0]] {
            assert_eq!(of_box(low, room), Point::ORIGIN, "{low:?}");
        }
        assert_eq!(of_box([1e5, 0.0, 0.0], [0.0; 3]), Point::ORIGIN);
        assert_eq!(of(std::iter::empty()), Point::ORIGIN);
    }

    #[test]
    fn far_away_it_is_a_multiple_of_a_power_of_two() {
        let far = of_box([3000.0, -3000.0, 0.0], [4.0, 3.0, 5.0]);
        assert_eq!(far, Point::new(3008.0, -3008.0 + 16.0, 0.0));
        assert_eq!(
            of_box([3e6, 0.0, 0.0], [1000.0, 1000.0, 0.0]),
            Point::new(3_000_320.0, 0.0, 0.0)
        );
    }

    proptest! {
        /// What a file stores as `f32` comes to the kernel without a change.
        #[test]
        fn stored_coordinates_stay_exact(
            low in -1e6_f32..1e6,
            size in 1e-3_f32..100.0,
            share in 0.0_f32..1.0,
        ) {
            let at = low + share * size;
            let high = low + size;
            prop_assume!(high > low && at <= high);
            let origin = of([low, high].map(|x| Point::new(f64::from(x), 0.0, 0.0)).into_iter()).x;
            let local = f64::from(at) - origin;
            prop_assert_eq!(f64::from(local as f32), local);
            prop_assert!(local.abs() <= f64::from(at).abs());
            prop_assert!(local.abs() <= 5.0 * f64::from(high - low));
        }
    }
}
