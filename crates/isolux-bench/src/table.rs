//! The report as people read it.

use crate::building::Build;
use crate::leaks::Misses;
use crate::rates::{Query, Rates};
use crate::report::{Effort, Report, SceneReport};
use crate::statistics::Spread;
use comfy_table::{CellAlignment, LineStyle, Table, TableStyle};

const HEADER: [&str; 5] = ["scene", "measured", "isolux", "Embree robust", "isolux : Embree"];
/// One line, under the header.
const RULED: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

type Row = [String; 5];

/// The table under a line about the machine and one about Embree.
pub(crate) fn render(report: &Report, embree_missing: Option<&str>) -> String {
    let mut table = Table::new();
    table.load_style(RULED);
    table.set_header(HEADER);
    table.add_rows(report.scenes.iter().flat_map(scene_rows));
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!(
        "{}\n{}\n\n{}",
        machine_line(report),
        embree_line(report, embree_missing),
        table.trim_fmt()
    )
}

fn machine_line(report: &Report) -> String {
    let machine = &report.machine;
    let load = machine.load.map_or(String::new(), |load| format!(", load {load:.1}"));
    let Effort { rays, turns, .. } = report.effort;
    format!(
        "{}: {}, {} cores{load}, {}; medians of {turns} turns of {rays} rays, CPU time (quartiles)",
        report.date, machine.processor, machine.cores, machine.compiler
    )
}

fn embree_line(report: &Report, missing: Option<&str>) -> String {
    match (&report.embree_version, missing) {
        (Some(version), _) => format!("Embree {version}, robust, one ray a call, medium quality"),
        (None, Some(why)) => format!("NO EMBREE, isolux alone is measured: {why}"),
        (None, None) => "NO EMBREE, isolux alone is measured".to_owned(),
    }
}

fn scene_rows(scene: &SceneReport) -> Vec<Row> {
    let name = format!("{}, {}", scene.name, scene.triangles);
    let row = |[measured, isolux, embree, ratio]: [String; 4]| {
        [name.clone(), measured, isolux, embree, ratio]
    };
    let rates = scene.rates.iter().flat_map(rate_rows);
    rates.chain(build_rows(scene)).chain(leak_rows(scene)).map(row).collect()
}

fn rate_rows(rates: &Rates) -> Vec<[String; 4]> {
    let query = match rates.query {
        Query::ClosestHit => "closest hit",
        Query::AnyHit => "any hit",
    };
    let threads = rates.threads;
    let plural = if threads == 1 { "" } else { "s" };
    let mut rows = vec![[
        format!("{query}, {threads} thread{plural}, Mrays/s"),
        format!("{:.2}", rates.isolux_mrays_per_s.median),
        optional(rates.embree_mrays_per_s, |s| format!("{:.2}", s.median)),
        optional(rates.ratio, with_quartiles),
    ]];
    rows.push([
        format!("{query}, {threads} thread{plural}, rays together"),
        format!("{:.2}", rates.together_mrays_per_s.median),
        optional(rates.embree_mrays_per_s, |s| format!("{:.2}", s.median)),
        optional(rates.together_ratio, with_quartiles),
    ]);
    if threads > 1 {
        let scaling = format!("{query}, {threads} threads to one");
        rows.push([scaling, with_quartiles(rates.scaling), String::new(), String::new()]);
    } else {
        let hits = format!("{query}, rays that hit, %");
        let differing = optional(rates.differing, |n| format!("{n} differ"));
        rows.push([hits, format!("{:.1}", 100.0 * rates.hit_share), differing, String::new()]);
    }
    rows
}

fn build_rows(scene: &SceneReport) -> Vec<[String; 4]> {
    let row = |measured: &str, value: fn(&Build) -> f64| {
        let isolux = value(&scene.isolux_build);
        let embree = scene.embree_build.as_ref().map(value);
        [
            measured.to_owned(),
            format!("{isolux:.1}"),
            optional(embree, |value| format!("{value:.1}")),
            optional(embree, |value| format!("{:.2}", isolux / value)),
        ]
    };
    vec![
        row("build, all threads, ms", |b| b.best_ms),
        row("bytes a triangle", |b| b.bytes_per_triangle),
        row("bytes a triangle without the mesh", |b| b.tree_bytes_per_triangle),
    ]
}

fn leak_rows(scene: &SceneReport) -> Vec<[String; 4]> {
    let leaks = &scene.leaks;
    let row = |query: &str, value: fn(Misses) -> u64| {
        [
            format!("{query}, misses of {:.0e} at edges", leaks.rays as f64),
            value(leaks.isolux).to_string(),
            optional(leaks.embree, |misses| value(misses).to_string()),
            String::new(),
        ]
    };
    vec![row("closest hit", |m| m.closest_hit), row("any hit", |m| m.any_hit)]
}

fn with_quartiles(spread: Spread) -> String {
    let Spread { median, quartiles: [low, high] } = spread;
    format!("{median:.2} ({low:.2} to {high:.2})")
}

/// Unknown stays empty.
fn optional<T>(value: Option<T>, show: impl FnOnce(T) -> String) -> String {
    value.map_or_else(String::new, show)
}
