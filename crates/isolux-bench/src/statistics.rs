//! The middle of many turns.

use serde::Serialize;

/// The median and the quartiles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Spread {
    pub(crate) median: f64,
    pub(crate) quartiles: [f64; 2],
}

/// Of the values as they are, without interpolation; all NaN for no value.
pub(crate) fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_by(f64::total_cmp);
    let at = |share: usize| values.get(values.len() * share / 4).copied().unwrap_or(f64::NAN);
    Spread { median: at(2), quartiles: [at(1), at(3)] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_is_found_in_any_order() {
        let found = spread(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!(found, Spread { median: 3.0, quartiles: [2.0, 4.0] });
        assert!(spread(Vec::new()).median.is_nan());
    }
}
