//! The figures of a grid as people read them.

use super::asked::Asked;
use super::result::GridResult;
use crate::console::{facts, table};
use crate::maintained::Maintained;
use crate::quantity::{show_share, significant};
use crate::shown::name;
use isolux::map::Figure;
use isolux::units::to_error;

/// A figure in lux with its interval.
pub(super) fn lux(figure: Figure) -> String {
    interval(figure, rounded)
}

/// A luminance in cd/m2 with its interval.
pub(super) fn cd_m2(figure: Figure) -> String {
    interval(figure, rounded)
}

/// A ratio with its interval.
pub(super) fn ratio(figure: Figure) -> String {
    interval(figure, part)
}

/// A number in or at the ends of an interval, to half the width of it.
fn rounded(of: Figure, value: f64) -> String {
    to_error(value, 0.5 * (of.high - of.low))
}

/// A ratio has two digits behind the point at most, as standards write their limits.
fn part(of: Figure, value: f64) -> String {
    to_error(value, (0.5 * (of.high - of.low)).max(0.02))
}

fn interval(of: Figure, written: fn(Figure, f64) -> String) -> String {
    let [value, low, high] = [of.value, of.low, of.high].map(|number| written(of, number));
    if low == value && high == value { value } else { format!("{value} ({low} to {high})") }
}

/// What people read: of one grid a list, of several tables; before it what is read, if that is not the usual.
pub(super) fn text(results: &[GridResult], light: Maintained, asked: &Asked) -> String {
    let mut text = if asked.is_planar() { String::new() } else { format!("{}\n", asked.title()) };
    text += &figures(results, light);
    for result in results {
        let Some(modelling) = &result.modelling else { continue };
        let [good, known] = modelling.good();
        let name = name(&result.read.grid.name);
        text +=
            &format!("{name}: {}; {good} of {known} points from 0.3 to 0.6\n", modelling.text());
    }
    text
}

fn figures(results: &[GridResult], light: Maintained) -> String {
    let row = |result: &GridResult| row(result, light);
    if let [result] = results {
        return facts(&HEADER.into_iter().zip(row(result)).collect::<Vec<_>>());
    }
    table(&HEADER, &results.iter().map(row).collect::<Vec<_>>())
}

const HEADER: [&str; 11] = [
    "grid",
    "Em, lx",
    "Emin, lx",
    "Emax, lx",
    "U0",
    "Ud",
    "points",
    "spacing, m",
    "direct, lx",
    "indirect, lx",
    "values",
];

/// In the order of the header.
fn row(result: &GridResult, light: Maintained) -> Vec<String> {
    let grid = &result.read.grid;
    let mut row = vec![name(&grid.name)];
    row.extend(match &result.read.figures {
        Some(f) => [
            lux(f.mean_lx),
            lux(f.least_lx),
            lux(f.greatest_lx),
            ratio(f.uniformity),
            ratio(f.diversity),
        ],
        None => ["-"; 5].map(str::to_owned),
    });
    let (counts, sides_m) = (grid.counts(), grid.sides_m());
    let cell_m = [0, 1].map(|k| significant(sides_m[k] / f64::from(counts[k]), 2));
    row.push(format!("{} x {}", counts[0], counts[1]));
    row.push(format!("{} x {}", cell_m[0], cell_m[1]));
    row.extend(match &result.read.figures {
        Some(f) => [f.direct_lx, f.indirect_lx].map(|lx| rounded(f.mean_lx, lx)),
        None => ["-", "-"].map(str::to_owned),
    });
    row.push(match grid.maintenance_factor {
        1.0 => light.text(),
        factor => format!("maintained, {} of the initial ones", show_share(factor)),
    });
    row
}
