//! Tables of maps: what they took, what they tell, and by how much they are wrong.

use crate::measure::MeasuredPoint;
use crate::metric::figure_of_merit;
use crate::report::document::{Block, Column, Group, Table, numbers, words};
use crate::report::quantity::{
    ASKED_DIGITS, UNKNOWN, count, fixed, known, list, number, percent, short,
};
use crate::study::{
    CaseStudy, Convergence, Distances, ERROR_OF_LVS, Measured, Point, Series, time_to_error_s,
};

/// A column of a table and what stands in it.
struct Field<T> {
    title: &'static str,
    text: fn(&T) -> String,
}

const fn field<T>(title: &'static str, text: fn(&T) -> String) -> Field<T> {
    Field { title, text }
}

const ALLOWED: Field<Point> = field("Aimed at, s", |p| match p.effort {
    // Other renderers are asked for efforts, not for times.
    Some(_) => UNKNOWN.to_owned(),
    None => short(p.asked_s, ASKED_DIGITS),
});
const ASKED: Field<Point> = field("Asked for, %", |p| known(p.accuracy, percent));
const EFFORT: Field<Point> =
    field("Effort", |p| p.effort.clone().unwrap_or_else(|| UNKNOWN.to_owned()));
const TOOK: Field<Point> = field("Took, s", |p| number(p.time_s));
const RAYS: Field<Point> = field("Rays", |p| known(p.rays, count));
const RECEIVERS: Field<Point> = field("Receivers", |p| known(p.receivers, count));
const TOLD: Field<Point> = field("Reported error, %", |p| known(p.reported.error, percent));
const NOISE: Field<Point> = field("of it noise, %", |p| known(p.reported.noise, percent));
const BARE: Field<Point> =
    field("Reported error of the interpolated map, %", |p| known(p.reported.bare, percent));
const LANDING: Field<Point> =
    field("Light landing over emitted", |p| known(p.landing, |of| fixed(of, OF_LANDING)));
const UNSHOT: Field<Point> = field("Not yet shot, %", |p| known(p.reported.unshot, percent));
const FILTERED: Field<Point> = field("Filtered, %", |p| known(p.reported.filtered, percent));
const FORESEEN: Field<Point> = field("Finish foreseen at last, s", |p| {
    known(p.predictions.last(), |of| {
        format!("{} ({} to {})", number(of.finish_s), number(of.earliest_s), number(of.latest_s))
    })
});
const AUDITED: Field<Point> =
    field("Audited error, %", |p| known(p.audited, |of| percent(of.error)));
const INTERVAL: Field<Point> = field("its interval of 95 %", |p| {
    known(p.audited, |of| format!("{} to {}", percent(of.low), percent(of.high)))
});
const CONTRADICTS: Field<Point> =
    field("Audit contradicts", |p| known(p.audited, |of| yes(of.contradicts)));
const MEASURED: Field<Point> =
    field("Measured error, %", |p| known(measured(p), |of| percent(of.error)));
const GRID: Field<Point> = field("over a grid, %", |p| known(measured(p), |of| percent(of.grid)));
const COVERED: Field<Point> =
    field("Intervals that hold, %", |p| known(measured(p).and_then(|of| of.covered), percent));
const SHARPNESS: Field<Point> =
    field("Reported over true", |p| known(measured(p).and_then(|of| of.told_over_true), number));
const MERIT: Field<Point> = field("Merit by measured error, 1/s", |p| {
    known(merit(p, measured(p).map(|of| of.error)), number)
});
const MERIT_TOLD: Field<Point> =
    field("Merit by reported error, 1/s", |p| known(merit(p, p.reported.error), number));

/// What every map took and tells of itself.
const SAID: [Field<Point>; 12] =
    [ALLOWED, ASKED, EFFORT, TOOK, RAYS, RECEIVERS, TOLD, NOISE, BARE, UNSHOT, FILTERED, FORESEEN];
/// What is found of it.
const FOUND: [Field<Point>; 11] = [
    TOOK,
    AUDITED,
    INTERVAL,
    CONTRADICTS,
    MEASURED,
    GRID,
    COVERED,
    SHARPNESS,
    LANDING,
    MERIT,
    MERIT_TOLD,
];
/// Last maps, of scenes whose right values are known, and of others.
const LAST_EXACT: [Field<Point>; 10] =
    [TOOK, MEASURED, TOLD, AUDITED, UNSHOT, COVERED, SHARPNESS, LANDING, MERIT, RAYS];
const LAST_PRACTICAL: [Field<Point>; 7] = [TOOK, TOLD, AUDITED, UNSHOT, LANDING, MERIT_TOLD, RAYS];

/// How far its picture is from others.
const PICTURE: [Field<Distances>; 4] = [
    field("L2, %", |of| known(of.rgb.mean, percent)),
    field("ΔE*ab", |of| number(of.cie1976.mean)),
    field("ΔE*94", |of| number(of.cie1994.mean)),
    field("ΔE00", |of| number(of.ciede2000.mean)),
];

/// Digits behind the point of orders of convergence, of shares of light, and of illuminances in lux.
const OF_ORDERS: usize = 2;
const OF_LANDING: usize = 4;
const OF_LUX: usize = 1;

fn measured(point: &Point) -> Option<&Measured> {
    point.measured.as_ref()
}

/// The figure of merit of a map by one of its errors.
fn merit(point: &Point, error: Option<f64>) -> Option<f64> {
    figure_of_merit(error?, point.time_s)
}

fn yes(is_so: bool) -> String {
    if is_so { "yes" } else { "no" }.to_owned()
}

/// The last map of every system.
pub(super) fn last_maps(case: &CaseStudy) -> Vec<Block> {
    let mut points = case.series.iter().flat_map(|series| &series.points);
    let is_exact = points.any(|point| point.measured.is_some());
    let columns = if is_exact {
        columns(&LAST_EXACT, &["Order", "Time to 2.8 %, s"])
    } else {
        columns(&LAST_PRACTICAL, &PICTURE.map(|of| of.title))
    };
    let row = if is_exact { last_exact } else { last_practical };
    let rows = case.series.iter().filter_map(row).collect();
    let caption = if is_exact {
        "The last map of every system"
    } else {
        "The last map of every system; L2 and ΔE are distances of its picture from the reference"
    };
    let mut table = Table::plain(caption, columns, rows);
    if case.name == "sphere" {
        // The study has no such time of it.
        table.drop_last();
    }
    shown(table)
}

fn columns(fields: &[Field<Point>], others: &[&str]) -> Vec<Column> {
    let titles = fields.iter().map(|field| field.title).chain(others.iter().copied());
    std::iter::once(words("System")).chain(titles.map(numbers)).collect()
}

fn last(series: &Series, fields: &[Field<Point>]) -> Option<Vec<String>> {
    let last = series.points.last()?;
    let title = series.system.title().to_owned();
    Some(std::iter::once(title).chain(fields.iter().map(|field| (field.text)(last))).collect())
}

/// With how fast the measured error falls, and when it reaches that of the study's LVS.
fn last_exact(series: &Series) -> Option<Vec<String>> {
    let error = |point: &Point| measured(point).map(|of| of.error);
    let known_errors: Vec<(f64, f64)> =
        series.points.iter().filter_map(|point| Some((point.time_s, error(point)?))).collect();
    let order = Convergence::of(&known_errors).map(|found| found.order);
    let mut row = last(series, &LAST_EXACT)?;
    row.push(known(order, |order| fixed(order, OF_ORDERS)));
    row.push(known(time_to_error_s(&series.points, error, ERROR_OF_LVS), number));
    Some(row)
}

/// With how far its picture is from the reference.
fn last_practical(series: &Series) -> Option<Vec<String>> {
    let far = series.points.last()?.from_reference.as_ref();
    let mut row = last(series, &LAST_PRACTICAL)?;
    row.extend(PICTURE.iter().map(|of| known(far, of.text)));
    Some(row)
}

/// What the last maps read at the points of the study.
pub(super) fn places(case: &CaseStudy) -> Vec<Block> {
    let last = |series: &Series| {
        let points = series.points.last()?.measured.as_ref()?.points.clone();
        (!points.is_empty()).then(|| (series.system.title().to_owned(), points))
    };
    let read: Vec<(String, Vec<MeasuredPoint>)> = case.series.iter().filter_map(last).collect();
    let Some((_, first)) = read.first() else { return Vec::new() };
    let columns = first.iter().map(|point| numbers(point.name.to_string()));
    let row = |(title, points): (&str, &[MeasuredPoint]), lux: fn(&MeasuredPoint) -> String| {
        std::iter::once(title.to_owned()).chain(points.iter().map(lux)).collect()
    };
    let right = row(("right value", first.as_slice()), |point| fixed(point.expected_lx, OF_LUX));
    let rows = read.iter().map(|(title, points)| row((title.as_str(), points.as_slice()), read_lx));
    vec![Block::Table(Table::plain(
        "Illuminance at the points of the study, lx, with standard errors as reported",
        std::iter::once(words("Point")).chain(columns).collect(),
        std::iter::once(right).chain(rows).collect(),
    ))]
}

fn read_lx(point: &MeasuredPoint) -> String {
    let error = point.standard_error_lx.map(|error| format!(" ± {}", fixed(error, OF_LUX)));
    format!("{}{}", fixed(point.measured_lx, OF_LUX), error.unwrap_or_default())
}

/// Every map of a scene: what it tells, by how much it errs, and how far pictures are from others.
pub(super) fn every_map(case: &CaseStudy) -> Vec<Block> {
    let of_fields = |caption: &str, fields: &[Field<Point>]| {
        let columns = fields.iter().map(|field| numbers(field.title)).collect();
        let row = |point: &Point| fields.iter().map(|field| (field.text)(point)).collect();
        shown(by_system(caption, columns, case, row))
    };
    let mut blocks = of_fields("Every map: what it took and what it reports", &SAID);
    blocks.extend(of_fields("Every map: by how much it errs", &FOUND));
    let has_pictures = |point: &Point| point.from_last.is_some() || point.from_reference.is_some();
    if case.series.iter().flat_map(|series| &series.points).any(has_pictures) {
        blocks.extend(shown(every_picture(case)));
    }
    blocks
}

fn every_picture(case: &CaseStudy) -> Table {
    let mut columns = vec![numbers(TOOK.title)];
    for from in ["From last", "From reference"] {
        columns.extend(PICTURE.iter().map(|of| numbers(format!("{from}: {}", of.title))));
    }
    by_system("Every picture: means over its pixels", columns, case, |point| {
        let mut row = vec![(TOOK.text)(point)];
        for distances in [&point.from_last, &point.from_reference] {
            row.extend(PICTURE.iter().map(|of| known(distances.as_ref(), of.text)));
        }
        row
    })
}

fn by_system(
    caption: &str,
    columns: Vec<Column>,
    case: &CaseStudy,
    row: impl Fn(&Point) -> Vec<String>,
) -> Table {
    let group = |series: &Series| Group {
        title: Some(series.system.title().to_owned()),
        rows: series.points.iter().map(&row).collect(),
    };
    let groups = case.series.iter().filter(|series| !series.points.is_empty()).map(group);
    Table { caption: caption.to_owned(), columns, groups: groups.collect() }
}

/// A table without what none of its maps knows, and a sentence that says so; nothing of one without rows.
fn shown(table: Table) -> Vec<Block> {
    if table.groups.iter().all(|group| group.rows.is_empty()) {
        return Vec::new();
    }
    let (table, unknown) = table.without_unknown(UNKNOWN);
    let mut blocks = vec![Block::Table(table)];
    if !unknown.is_empty() {
        let names: Vec<String> = unknown.iter().map(|title| format!("“{title}”")).collect();
        blocks.push(Block::Text(format!("Of none of these maps is known: {}.", list(&names))));
    }
    blocks
}
