//! Tables that give part of the circle, completed by their mirror planes.

use serde::{Deserialize, Serialize};

/// What a file leaves unsaid because the luminaire repeats it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Symmetry {
    /// Every plane is given.
    None,
    /// One plane stands for all.
    Axial,
    /// The plane C0-C180 is a mirror; C0 to C180 are given.
    AboutC0C180,
    /// The plane C90-C270 is a mirror; C90 to C270 are given.
    AboutC90C270,
    /// Both are mirrors; C0 to C90 are given.
    AboutBoth,
}

impl Symmetry {
    /// The whole circle from the part given: planes in degrees from 0 to below 360, each with its
    /// row of intensities.
    ///
    /// Rows of planes outside the given part keep their place; where a mirror lands on a plane that
    /// exists, the plane that exists stays.
    pub(super) fn complete(self, rows: Vec<(f64, Vec<f64>)>) -> Vec<(f64, Vec<f64>)> {
        match self {
            Self::None => rows,
            Self::Axial => rows.into_iter().take(1).map(|(_, row)| (0.0, row)).collect(),
            Self::AboutC0C180 => reflect(rows, |c| 360.0 - c),
            Self::AboutC90C270 => reflect(rows, |c| 180.0 - c),
            Self::AboutBoth => reflect(reflect(rows, |c| 180.0 - c), |c| 360.0 - c),
        }
    }
}

fn reflect(rows: Vec<(f64, Vec<f64>)>, image: impl Fn(f64) -> f64) -> Vec<(f64, Vec<f64>)> {
    let turn = |c: f64| {
        if c >= 360.0 {
            c - 360.0
        } else if c < 0.0 {
            c + 360.0
        } else {
            c
        }
    };
    let mirrored: Vec<_> = rows.iter().map(|(c, row)| (turn(image(*c)), row.clone())).collect();
    let mut whole: Vec<_> =
        rows.into_iter().map(|(c, row)| (turn(c), row)).chain(mirrored).collect();
    // Stable: what was given comes before what was mirrored onto it, and is kept.
    whole.sort_by(|a, b| a.0.total_cmp(&b.0));
    whole.dedup_by(|later, earlier| later.0 == earlier.0);
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(symmetry: Symmetry, given: &[f64], expected: &[(f64, f64)]) {
        let rows = given.iter().map(|&c| (c, vec![c])).collect();
        let whole: Vec<_> = symmetry.complete(rows).into_iter().map(|(c, r)| (c, r[0])).collect();
        assert_eq!(whole, expected, "{symmetry:?}");
    }

    #[test]
    fn every_symmetry_fills_the_circle() {
        check(Symmetry::None, &[0.0, 120.0], &[(0.0, 0.0), (120.0, 120.0)]);
        check(Symmetry::Axial, &[0.0], &[(0.0, 0.0)]);
        check(
            Symmetry::AboutC0C180,
            &[0.0, 60.0, 180.0],
            &[(0.0, 0.0), (60.0, 60.0), (180.0, 180.0), (300.0, 60.0)],
        );
        check(
            Symmetry::AboutC90C270,
            &[90.0, 120.0, 180.0, 270.0],
            &[
                (0.0, 180.0),
                (60.0, 120.0),
                (90.0, 90.0),
                (120.0, 120.0),
                (180.0, 180.0),
                (270.0, 270.0),
            ],
        );
        check(
            Symmetry::AboutBoth,
            &[0.0, 30.0, 90.0],
            &[
                (0.0, 0.0),
                (30.0, 30.0),
                (90.0, 90.0),
                (150.0, 30.0),
                (180.0, 0.0),
                (210.0, 30.0),
                (270.0, 90.0),
                (330.0, 30.0),
            ],
        );
    }
}
