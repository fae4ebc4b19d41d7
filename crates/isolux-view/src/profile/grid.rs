//! Tables over three numbers.

use super::curve::within;
use super::error::ProfileError;

/// Triples at the corners of a grid over the unit cube, multilinear between.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    /// Corners along each side, at least two.
    counts: [usize; 3],
    /// In parts of 65535, the last number running fastest.
    corners: Vec<[u16; 3]>,
}

impl Grid {
    /// A table with a triple for each corner.
    pub(super) fn new(counts: [u8; 3], values: &[u16]) -> Result<Self, ProfileError> {
        let counts = counts.map(usize::from);
        let (corners, rest) = values.as_chunks::<3>();
        let fits = counts.iter().all(|c| *c >= 2)
            && rest.is_empty()
            && corners.len() == counts.iter().product::<usize>();
        let grid = Self { counts, corners: corners.to_vec() };
        fits.then_some(grid).ok_or_else(|| ProfileError::Tables("size of a grid".to_owned()))
    }

    /// The triple at a place; one outside of the cube is taken as the nearest inside.
    pub(super) fn at(&self, place: [f64; 3]) -> [f64; 3] {
        let place = [0, 1, 2].map(|k| within(place[k]) * (self.counts[k] - 1) as f64);
        let low = [0, 1, 2].map(|k| (place[k] as usize).min(self.counts[k] - 2));
        let part = [0, 1, 2].map(|k| place[k] - low[k] as f64);
        let mut sum = [0.0; 3];
        for step in 0..8_usize {
            let far = [step >> 2 & 1, step >> 1 & 1, step & 1];
            let share = |k: usize| if far[k] == 1 { part[k] } else { 1.0 - part[k] };
            let weight = share(0) * share(1) * share(2);
            let corner = self.corner([0, 1, 2].map(|k| low[k] + far[k]));
            sum = [0, 1, 2].map(|k| sum[k] + weight * corner[k]);
        }
        sum
    }

    fn corner(&self, [i, j, k]: [usize; 3]) -> [f64; 3] {
        let index = (i * self.counts[1] + j) * self.counts[2] + k;
        self.corners[index].map(|v| f64::from(v) / f64::from(u16::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_hit_and_between_is_linear() {
        // Numbers along the sides, of 3, 2 and 2 corners.
        let mut values = Vec::new();
        for (i, j, k) in
            (0..3).flat_map(|i| (0..2).flat_map(move |j| (0..2).map(move |k| (i, j, k))))
        {
            values.extend([i * 32767, j * 65535, k * 65535]);
        }
        let grid = Grid::new([3, 2, 2], &values).unwrap();
        for place in [[0.0; 3], [0.5, 1.0, 0.0], [0.25, 0.5, 0.125], [0.9, 0.1, 1.0]] {
            for (got, expected) in grid.at(place).into_iter().zip(place) {
                // The middle of three corners is half a part of 65535 too low.
                assert!((got - expected).abs() < 1.0 / 65535.0, "{got} for {expected}");
            }
        }
        assert_eq!(grid.at([f64::NAN, -3.0, 7.0]), grid.at([0.0, 0.0, 1.0]));
    }

    #[test]
    fn sizes_must_fit() {
        for (counts, numbers) in [([1, 2, 2], 12), ([2, 2, 2], 23), ([2, 2, 2], 27), ([0, 0, 0], 0)]
        {
            assert!(Grid::new(counts, &vec![0; numbers]).is_err(), "{counts:?}, {numbers}");
        }
    }
}
