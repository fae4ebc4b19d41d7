//! Lines of equal value within one square, by marching squares (Lorensen and Cline 1987, in two dimensions).

/// A piece of a line within one square.
pub(crate) type Segment = [[f64; 2]; 2];

/// Where a level crosses the unit square with the given corner values, clockwise from the top left.
pub(crate) fn crossings(values: [f64; 4], level: f64) -> impl Iterator<Item = Segment> {
    const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let above = values.map(|v| v >= level);
    let on_edge = move |k: usize| {
        let next = (k + 1) % 4;
        let share = (level - values[k]) / (values[next] - values[k]);
        let mix = |axis: usize| CORNERS[k][axis] + share * (CORNERS[next][axis] - CORNERS[k][axis]);
        [mix(0), mix(1)]
    };
    let crossed: Vec<usize> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).collect();
    // At a saddle the mean decides which opposite corners are joined.
    let joined = 0.25 * values.iter().sum::<f64>() >= level;
    let pairs = match crossed.as_slice() {
        [] => vec![],
        [a, b] => vec![[*a, *b]],
        _ if above[0] == joined => vec![[0, 1], [2, 3]],
        _ => vec![[3, 0], [1, 2]],
    };
    pairs.into_iter().map(move |pair| pair.map(on_edge))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_between_two_rows_crosses_in_proportion() {
        let found: Vec<Segment> = crossings([0.0, 0.0, 10.0, 10.0], 2.5).collect();
        assert_eq!(found, [[[1.0, 0.25], [0.0, 0.25]]]);
    }

    #[test]
    fn a_level_outside_crosses_nothing() {
        assert_eq!(crossings([1.0, 2.0, 3.0, 4.0], 5.0).count(), 0);
        assert_eq!(crossings([1.0; 4], 1.0).count(), 0);
    }

    #[test]
    fn a_saddle_is_crossed_twice() {
        let found: Vec<Segment> = crossings([3.0, 0.0, 3.0, 0.0], 1.0).collect();
        // The mean 1.5 joins the high corners, so each line cuts off a low one.
        assert_eq!(found.len(), 2);
        for [a, b] in found {
            let cut = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            assert!((cut[0] > 0.5) != (cut[1] > 0.5), "{cut:?}");
        }
    }
}
