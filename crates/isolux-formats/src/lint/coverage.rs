//! Whether the angles cover the light, finely enough.

use super::finding::Finding;
use super::table::Table;
use crate::ies::PhotometricType;
use isolux::photometry::PhotometricWeb;

/// Light of this share of the greatest intensity at the end of the angles is cut off there.
const CUT_SHARE: f64 = 0.05;
/// An error of the flux by interpolation above this share is worth a word.
const COARSE_SHARE: f64 = 0.01;

pub(super) fn findings(table: &Table) -> Vec<Finding> {
    let mut found = cut_off(table);
    found.extend(coarse(table));
    found
}

/// Light that ends where the angles end.
fn cut_off(table: &Table) -> Vec<Finding> {
    let (rows, columns) = (table.rows(), table.columns());
    let is_c = table.photometric_type == PhotometricType::C;
    // Beyond 0 and 180 there is nothing; angles of types A and B from 0 on are mirrored there.
    let ends = |angles: &[f64]| {
        let (first, last) = (angles.first().copied(), angles.last().copied());
        [first.filter(|a| *a != 0.0), last.filter(|a| *a != 180.0 || !is_c)]
    };
    let mut found = Vec::new();
    let mut check = |angle: Option<f64>, line: usize, most: f64| {
        if let Some(angle) = angle.filter(|_| most > CUT_SHARE * table.most()) {
            let percent = 100.0 * most / table.most();
            found.push(Finding::warning(
                line,
                format!(
                    "the table ends at {angle} degrees with {percent:.0} % of the greatest intensity; \
                     beyond is dark"
                ),
                "get a file with all angles that have light",
            ));
        }
    };
    for (angle, column) in ends(&table.along_deg).into_iter().zip([0, columns - 1]) {
        let most = (0..rows).map(|row| table.at(row, column)).fold(0.0, f64::max);
        check(angle, table.along_line, most);
    }
    if !is_c {
        for (angle, row) in ends(&table.across_deg).into_iter().zip([0, rows - 1]) {
            let most = (0..columns).map(|column| table.at(row, column)).fold(0.0, f64::max);
            check(angle, table.across_line, most);
        }
    }
    found
}

/// Interpolation is of second order: what the flux loses without every second angle is three times what
/// it may lack with all of them.
fn coarse(table: &Table) -> Option<Finding> {
    let columns = table.columns();
    if columns < 5 || columns.is_multiple_of(2) {
        return None;
    }
    let all = ring_flux(table, 1);
    let half = ring_flux(table, 2);
    let error = ((all - half) / (3.0 * all)).abs();
    (all > 0.0 && error > COARSE_SHARE).then(|| {
        Finding::note(
            table.along_line,
            format!(
                "the beam changes much between angles: the flux is known to about {:.0} %",
                100.0 * error
            ),
            "get a file with finer angles",
        )
    })
}

/// Flux of every `step`th column, the mean over the rows; up to a factor.
fn ring_flux(table: &Table, step: usize) -> f64 {
    let mean = |column: usize| (0..table.rows()).map(|row| table.at(row, column)).sum::<f64>();
    let columns: Vec<usize> = (0..table.columns()).step_by(step).collect();
    // Angles of type A are counted from the pole below the aim, those of type B turn about it.
    let from_pole = match table.photometric_type {
        PhotometricType::C => 0.0,
        PhotometricType::A => 90.0,
        PhotometricType::B => return trapezoids(table, &columns, mean),
    };
    let angles = columns.iter().map(|&k| table.along_deg[k] + from_pole).collect();
    let candela = columns.iter().map(|&k| mean(k)).collect();
    PhotometricWeb::new(vec![0.0], angles, candela).map_or(0.0, |web| web.luminous_flux_lm())
}

fn trapezoids(table: &Table, columns: &[usize], mean: impl Fn(usize) -> f64) -> f64 {
    let area = |pair: &[usize]| {
        let width = table.along_deg[pair[1]] - table.along_deg[pair[0]];
        0.5 * width * (mean(pair[0]) + mean(pair[1]))
    };
    columns.windows(2).map(area).sum()
}
