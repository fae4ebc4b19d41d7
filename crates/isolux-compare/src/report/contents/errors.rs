//! Tables of maps: what they took, what they tell, and by how much they are wrong.

use crate::metric::figure_of_merit;
use crate::report::document::{Block, Column, Group, Table, numbers, words};
use crate::report::quantity::{UNKNOWN, count, known, list, number, percent};
use crate::study::{
    CaseStudy, Convergence, Distances, ERROR_OF_LVS, Measured, Point, Series, time_to_error_s,
};

/// A column of a table and what stands in it.
struct Field<T: ?Sized> {
    title: &'static str,
    text: fn(&T) -> String,
}

const fn field<T: ?Sized>(title: &'static str, text: fn(&T) -> String) -> Field<T> {
    Field { title, text }
}

/// What a map took.
const WORK: [Field<Point>; 4] = [
    field("Allowed, s", |p| number(p.asked_s)),
    field("Took, s", |p| number(p.time_s)),
    field("Rays", |p| count(p.rays)),
    field("Receivers", |p| count(p.receivers)),
];

/// What it tells of itself.
const TOLD: [Field<Point>; 5] = [
    field("Told error, %", |p| known(p.reported.error, percent)),
    field("of it noise, %", |p| known(p.reported.noise, percent)),
    field("Told of the bare map, %", |p| known(p.reported.bare, percent)),
    field("Not yet shot, %", |p| known(p.reported.unshot, percent)),
    field("Filtered, %", |p| known(p.reported.filtered, percent)),
];

/// What others find.
const FOUND: [Field<Point>; 10] = [
    field("Audited error, %", |p| known(p.audited, |of| percent(of.error))),
    field("its interval of 95 %", |p| {
        known(p.audited, |of| format!("{} to {}", percent(of.low), percent(of.high)))
    }),
    field("Audit contradicts", |p| known(p.audited, |of| yes(of.contradicts))),
    field("Measured error, %", |p| known(measured(p), |of| percent(of.error))),
    field("over a grid, %", |p| known(measured(p), |of| percent(of.grid))),
    field("Intervals that hold, %", |p| known(measured(p).and_then(|of| of.covered), percent)),
    field("Told over true", |p| known(measured(p).and_then(|of| of.told_over_true), number)),
    field("Merit by measured error, 1/s", |p| {
        known(merit(p, measured(p).map(|of| of.error)), number)
    }),
    field("Merit by told error, 1/s", |p| known(merit(p, p.reported.error), number)),
    field("Finish foreseen at last, s", |p| {
        known(p.predictions.last(), |of| {
            format!(
                "{} ({} to {})",
                number(of.finish_s),
                number(of.earliest_s),
                number(of.latest_s)
            )
        })
    }),
];

/// How far its picture is from others.
const PICTURE: [Field<Distances>; 4] = [
    field("L2, %", |of| known(of.rgb.mean, percent)),
    field("ΔE*ab", |of| number(of.cie1976.mean)),
    field("ΔE*94", |of| number(of.cie1994.mean)),
    field("ΔE00", |of| number(of.ciede2000.mean)),
];

fn measured(point: &Point) -> Option<&Measured> {
    point.measured.as_ref()
}

/// The figure of merit of a map by one of its errors.
pub(in crate::report) fn merit(point: &Point, error: Option<f64>) -> Option<f64> {
    figure_of_merit(error?, point.time_s)
}

fn yes(is_so: bool) -> String {
    if is_so { "yes" } else { "no" }.to_owned()
}

/// The last map of every system.
pub(super) fn last_maps(case: &CaseStudy) -> Vec<Block> {
    let fields: Vec<&Field<Point>> = WORK[1..].iter().chain(&TOLD).chain(&FOUND).collect();
    let row = |series: &Series| -> Option<Vec<String>> {
        let last = series.points.last()?;
        let mut row = vec![series.system.title().to_owned()];
        row.extend(orders(series));
        row.extend(fields.iter().map(|field| (field.text)(last)));
        row.extend(PICTURE.iter().map(|of| known(last.from_reference.as_ref(), of.text)));
        Some(row)
    };
    let mut columns = vec![words("System")];
    columns.extend(
        ["Time to 2.8 %, s", "Order of measured error", "Order of told error"].map(numbers),
    );
    columns.extend(fields.iter().map(|field| numbers(field.title)));
    columns.extend(PICTURE.iter().map(|of| numbers(format!("From reference: {}", of.title))));
    let rows = case.series.iter().filter_map(row).collect();
    shown(Table::plain("The last map of every system", columns, rows))
}

/// When the error of the study's LVS is reached, of CUBE, and how fast errors fall.
fn orders(series: &Series) -> [String; 3] {
    let error = |point: &Point| measured(point).map(|of| of.error);
    let is_cube = |point: &Point| measured(point).is_some_and(|of| of.points.len() > 1);
    let points = if series.points.iter().any(is_cube) { series.points.as_slice() } else { &[] };
    let order = |of: &dyn Fn(&Point) -> Option<f64>| {
        let known: Vec<(f64, f64)> =
            series.points.iter().filter_map(|point| Some((point.time_s, of(point)?))).collect();
        Convergence::of(&known).map(|found| found.order)
    };
    [
        known(time_to_error_s(points, error, ERROR_OF_LVS), number),
        known(order(&error), number),
        known(order(&|point| point.reported.error), number),
    ]
}

/// What the last maps read at the points of the study.
pub(super) fn places(case: &CaseStudy) -> Vec<Block> {
    let last = |series: &Series| {
        let points = series.points.last()?.measured.as_ref()?.points.clone();
        (!points.is_empty()).then(|| (series.system.title().to_owned(), points))
    };
    let read: Vec<_> = case.series.iter().filter_map(last).collect();
    let Some((_, first)) = read.first() else { return Vec::new() };
    let mut columns = vec![words("Point")];
    columns.extend(first.iter().map(|point| numbers(point.name.to_string())));
    let mut rows = vec![vec!["right value".to_owned()]];
    rows[0].extend(first.iter().map(|point| lux(point.expected_lx)));
    for (title, points) in &read {
        let mut row = vec![title.clone()];
        row.extend(
            points.iter().map(|p| format!("{} ± {}", lux(p.measured_lx), lux(p.standard_error_lx))),
        );
        rows.push(row);
    }
    let caption = "Illuminance at the points of the study, lx, with standard errors as told";
    vec![Block::Table(Table::plain(caption, columns, rows))]
}

/// Tenths of a lux.
fn lux(value: f64) -> String {
    if value.is_finite() { format!("{value:.1}") } else { UNKNOWN.to_owned() }
}

/// Every map of a scene: errors, and pictures.
pub(super) fn every_map(case: &CaseStudy) -> Vec<Block> {
    let fields: Vec<&Field<Point>> = WORK.iter().chain(&TOLD).chain(&FOUND).collect();
    let columns: Vec<Column> = fields.iter().map(|field| numbers(field.title)).collect();
    let errors = by_system("Every map", columns, case, |point| {
        fields.iter().map(|field| (field.text)(point)).collect()
    });
    let mut columns = vec![numbers("Took, s")];
    for from in ["From last", "From reference"] {
        columns.extend(PICTURE.iter().map(|of| numbers(format!("{from}: {}", of.title))));
    }
    let pictures = by_system("Every picture: means over its pixels", columns, case, |point| {
        let mut row = vec![number(point.time_s)];
        for distances in [&point.from_last, &point.from_reference] {
            row.extend(PICTURE.iter().map(|of| known(distances.as_ref(), of.text)));
        }
        row
    });
    let has_pictures = |point: &Point| point.from_last.is_some() || point.from_reference.is_some();
    let mut points = case.series.iter().flat_map(|series| &series.points);
    let mut blocks = shown(errors);
    if points.any(has_pictures) {
        blocks.extend(shown(pictures));
    }
    blocks
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
