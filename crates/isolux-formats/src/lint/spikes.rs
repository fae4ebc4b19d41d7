//! Single values that stick out of their neighbourhood: slips of a pen or of a sensor.

use super::finding::Finding;
use super::table::Table;

/// A spike is this many times as high as all of its neighbours, a hole so many times as low.
const FACTOR: f64 = 3.0;
/// Only values of this share of the greatest count.
const SHARE: f64 = 0.02;
/// More are only counted.
const MOST_SHOWN: usize = 5;

pub(super) fn findings(table: &Table) -> Vec<Finding> {
    let most = table.most();
    let mut found = Vec::new();
    let mut unlisted = 0;
    for row in 0..table.rows() {
        for column in 1..table.columns() - 1 {
            let Some(what) = odd(table, row, column, SHARE * most) else { continue };
            if found.len() == MOST_SHOWN {
                unlisted += 1;
                continue;
            }
            let place = table.place(row, column);
            let value = table.at(row, column);
            found.push(Finding::warning(
                table.line(row, column),
                format!(
                    "a {what} at {place}: {value} between {}",
                    neighbours_text(table, row, column)
                ),
                "check the value against the report of the measurement",
            ));
        }
    }
    if unlisted > 0 {
        let what = format!("{unlisted} further spikes and holes");
        found.push(Finding::warning(0, what, "mend those above first"));
    }
    found
}

/// Whether a value is a spike or a hole among its neighbours in both angles.
fn odd(table: &Table, row: usize, column: usize, floor: f64) -> Option<&'static str> {
    let value = table.at(row, column);
    let near: Vec<f64> = neighbours(table, row, column);
    let (least, most) = (
        near.iter().copied().fold(f64::INFINITY, f64::min),
        near.iter().copied().fold(0.0, f64::max),
    );
    if value > floor && value > FACTOR * most {
        return Some("spike");
    }
    (least > floor && FACTOR * value < least).then_some("hole")
}

/// Of one plane alone there are two; a border row has three.
fn neighbours(table: &Table, row: usize, column: usize) -> Vec<f64> {
    let mut near = vec![table.at(row, column - 1), table.at(row, column + 1)];
    near.extend(row.checked_sub(1).map(|above| table.at(above, column)));
    near.extend((row + 1 < table.rows()).then(|| table.at(row + 1, column)));
    near
}

fn neighbours_text(table: &Table, row: usize, column: usize) -> String {
    let list: Vec<String> = neighbours(table, row, column).iter().map(f64::to_string).collect();
    list.join(", ")
}
