//! Decimal numbers that mean exactly what they stand for.

/// Decimals tried.
const MOST_DECIMALS: i32 = 12;

/// The number with the fewest decimals that serves as well as `x`, or `x` itself, or a neighbour of
/// it: where `x` was computed backwards, it may be off by a rounding.
pub(super) fn shortest(x: f64, serves: impl Fn(f64) -> bool) -> f64 {
    let rounded = (0..=MOST_DECIMALS).map(|decimals| to_decimals(x, decimals));
    let beside = [x, x.next_up(), x.next_down()];
    rounded.chain(beside).find(|&candidate| serves(candidate)).unwrap_or(x)
}

pub(super) fn to_millionth(x: f64) -> f64 {
    to_decimals(x, 6)
}

fn to_decimals(x: f64, decimals: i32) -> f64 {
    // Exact up to 1e22, and a division rounds once: the nearest number to the decimal fraction.
    let scale = (0..decimals).fold(1.0, |scale: f64, _| scale * 10.0);
    let rounded = (x * scale).round() / scale;
    // Without the sign of a zero.
    rounded + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_number_that_serves() {
        assert_eq!(shortest(0.1 + 0.2, |x| (x - 0.3).abs() < 1e-9), 0.3);
        assert_eq!(shortest(0.1 + 0.2, |x| x == 0.1 + 0.2), 0.1 + 0.2);
        assert_eq!(shortest(-1e-20, |_| true).to_bits(), 0.0_f64.to_bits());
        assert_eq!(shortest(f64::MAX, |x| x == f64::MAX), f64::MAX);
        let third = 1.0_f64 / 3.0;
        assert_eq!(shortest(third.next_down(), |x| x == third), third);
    }
}
