//! Linear maps of three numbers.

/// A matrix of three rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Matrix3(pub(crate) [[f64; 3]; 3]);

impl Matrix3 {
    pub(crate) const IDENTITY: Self = Self::diagonal([1.0; 3]);

    /// A factor for each number.
    pub(crate) const fn diagonal([a, b, c]: [f64; 3]) -> Self {
        Self([[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]])
    }

    /// The matrix that takes the three unit vectors to `columns`.
    pub(crate) fn of_columns(columns: [[f64; 3]; 3]) -> Self {
        Self([0, 1, 2].map(|row| columns.map(|column| column[row])))
    }

    /// The image of a vector.
    pub(crate) fn apply(&self, v: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// The matrix that does `other` first and this one then.
    pub(crate) fn after(&self, other: &Self) -> Self {
        let column = |k: usize| self.apply(other.0.map(|row| row[k]));
        Self::of_columns([column(0), column(1), column(2)])
    }

    /// This map by a share, and the identity by the rest.
    pub(crate) fn mixed_with_identity(&self, share: f64) -> Self {
        let one = Self::diagonal([1.0 - share; 3]);
        Self([0, 1, 2].map(|r| [0, 1, 2].map(|c| share * self.0[r][c] + one.0[r][c])))
    }

    /// The inverse; `None` where there is none within the range of floating-point numbers.
    pub(crate) fn inverse(&self) -> Option<Self> {
        let [a, b, c] = self.0;
        let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = a[0] * cofactors[0][0] + a[1] * cofactors[0][1] + a[2] * cofactors[0][2];
        let inverse = Self::of_columns(cofactors.map(|row| row.map(|v| v / determinant)));
        inverse.is_finite().then_some(inverse)
    }

    /// Whether all entries are numbers.
    pub(crate) fn is_finite(&self) -> bool {
        self.0.as_flattened().iter().all(|v| v.is_finite())
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inverse_takes_back() {
        let m = Matrix3([[2.0, 1.0, 0.5], [0.0, 3.0, -1.0], [4.0, 0.0, 1.0]]);
        let back = m.inverse().unwrap();
        for v in [[1.0, 0.0, 0.0], [0.2, -3.0, 7.0]] {
            for (got, expected) in back.apply(m.apply(v)).into_iter().zip(v) {
                // A few dozen roundings of numbers up to 20.
                assert!((got - expected).abs() < 1e-13, "{got} for {expected}");
            }
        }
        assert_eq!(m.after(&Matrix3::IDENTITY), m);
    }

    #[test]
    fn what_flattens_has_no_inverse() {
        let flat = Matrix3([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 0.0, 1.0]]);
        let unknown = Matrix3::diagonal([f64::NAN, 1.0, 1.0]);
        let tiny = Matrix3::diagonal([1e-200; 3]);
        for none in [flat, unknown, tiny, Matrix3([[0.0; 3]; 3])] {
            assert_eq!(none.inverse(), None, "{none:?}");
        }
    }
}
