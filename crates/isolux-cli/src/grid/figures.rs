//! The figures of a grid as people read them.

use super::GridResult;
use crate::console::table;
use crate::quantity::significant;
use crate::rounded::to_error;
use crate::shown::name;
use isolux::map::Figure;
use std::fmt::Write;

/// A figure in lux with its interval.
pub(super) fn lux(figure: Figure) -> String {
    interval(figure, rounded)
}

/// A ratio with its interval.
pub(super) fn ratio(figure: Figure) -> String {
    interval(figure, share)
}

/// A number in or at the ends of an interval, to half the width of it.
fn rounded(of: Figure, value: f64) -> String {
    to_error(value, 0.5 * (of.high - of.low))
}

/// A ratio has two digits behind the point at most, as standards write their limits.
fn share(of: Figure, value: f64) -> String {
    to_error(value, (0.5 * (of.high - of.low)).max(0.02))
}

fn interval(of: Figure, written: fn(Figure, f64) -> String) -> String {
    let [value, low, high] = [of.value, of.low, of.high].map(|number| written(of, number));
    if low == value && high == value { value } else { format!("{value} ({low} to {high})") }
}

/// The table that people read.
pub(super) fn text(results: &[GridResult]) -> String {
    let header = ["grid", "Em, lx", "Emin, lx", "U0", "Emax, lx", "Ud"];
    let row = |result: &GridResult| {
        let mut row = vec![name(&result.read.grid.name)];
        match &result.read.figures {
            Some(f) => row.extend([
                lux(f.mean_lx),
                lux(f.least_lx),
                ratio(f.uniformity),
                lux(f.greatest_lx),
                ratio(f.diversity),
            ]),
            None => row.extend((1..header.len()).map(|_| "-".to_owned())),
        }
        row
    };
    let rows: Vec<Vec<String>> = results.iter().map(row).collect();
    let mut text = table(&header, &rows);
    text.push('\n');
    text += &points(results);
    for result in results.iter().filter(|r| r.read.grid.maintenance_factor != 1.0) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "grid `{}`: maintained values, {} of the initial ones",
            name(&result.read.grid.name),
            significant(result.read.grid.maintenance_factor, 3)
        );
    }
    text
}

/// Where the points are, and the two parts of their mean.
fn points(results: &[GridResult]) -> String {
    let row = |result: &GridResult| {
        let (counts, sides_m) = (result.read.grid.counts(), result.read.grid.sides_m());
        let cell_m = [0, 1].map(|k| significant(sides_m[k] / f64::from(counts[k]), 2));
        let mut row = vec![
            name(&result.read.grid.name),
            format!("{} x {}", counts[0], counts[1]),
            format!("{} x {}", cell_m[0], cell_m[1]),
        ];
        row.extend(match &result.read.figures {
            Some(f) => [f.direct_lx, f.indirect_lx].map(|lx| rounded(f.mean_lx, lx)),
            None => ["-", "-"].map(str::to_owned),
        });
        row
    };
    let rows: Vec<Vec<String>> = results.iter().map(row).collect();
    table(&["grid", "points", "spacing, m", "direct Em, lx", "indirect Em, lx"], &rows)
}
