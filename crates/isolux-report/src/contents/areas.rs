//! Calculation grids: plans, facts, values.

use super::least::LEAST_LX;
use crate::document::{Block, Picture, Section, Table, numbers, row, words};
use crate::report::{Area, Budget, BudgetLine, Maintenance, Report, UncertainInput};
use crate::words::{Words, fill};

/// Columns of values that a page takes.
const MOST_COLUMNS: usize = 20;
/// Values that a table takes.
const MOST_VALUES: usize = 800;

/// `None` of a report without grids.
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    let maintenance = report.scene.maintenance;
    let blocks: Vec<Block> =
        report.areas.iter().flat_map(|area| blocks(area, maintenance, language)).collect();
    let title = language.areas.title.to_owned();
    (!blocks.is_empty()).then_some(Section { id: "grids", title, blocks })
}

fn blocks(area: &Area, maintenance: Maintenance, language: &Words) -> Vec<Block> {
    let says = &language.areas;
    let mut blocks = vec![Block::Heading(area.name.clone())];
    blocks.extend(area.plan.as_ref().map(|plan| {
        Block::Picture(Picture {
            image: plan.clone(),
            alternative: says.plan_shows.to_owned(),
            caption: fill(says.plan, &[("name", &area.name)]),
        })
    }));
    blocks.push(Block::Facts(facts(area, maintenance, language)));
    match &area.figures {
        None => blocks.push(Block::Text(says.nothing.to_owned())),
        Some(of) => {
            let half = of.mean_lx.half_width().max(LEAST_LX);
            let [mean, direct, indirect] = [of.mean_lx.value, of.direct_lx, of.indirect_lx]
                .map(|lx| language.to_error(lx, half));
            let places = [("mean", &*mean), ("direct", &direct), ("indirect", &indirect)];
            blocks.push(Block::Text(fill(says.sentence, &places)));
            blocks.push(values(area, language));
            blocks.extend(area.budget.iter().flat_map(|of| budget(of, language)));
        }
    }
    blocks
}

fn facts(area: &Area, maintenance: Maintenance, language: &Words) -> Vec<(String, String)> {
    let says = &language.areas;
    let metres = |m: f64| language.fixed(m, 2);
    let [x, y] = area.counts;
    let cell_m = [0, 1].map(|k| metres(area.sides_m[k] / f64::from(area.counts[k])));
    let points = fill(
        says.points_are,
        &[("x", &x.to_string()), ("y", &y.to_string()), ("dx", &cell_m[0]), ("dy", &cell_m[1])],
    );
    let [u, v] = area.sides_m.map(metres);
    let mut facts =
        vec![(says.size.to_owned(), format!("{u} x {v} m")), (says.points.to_owned(), points)];
    if area.border_m > 0.0 {
        facts.push((says.border.to_owned(), format!("{} m", metres(area.border_m))));
    }
    if let Some(height_m) = area.height_m {
        facts.push((says.height.to_owned(), format!("{} m", metres(height_m))));
    }
    let factor = match (area.maintenance_factor, maintenance) {
        (1.0, Maintenance::Initial) => says.factor_none.to_owned(),
        (1.0, Maintenance::Maintained { .. }) => says.factor_in_luminaires.to_owned(),
        (factor, _) => language.fixed(factor, 2),
    };
    facts.push((says.factor.to_owned(), factor));
    if area.outside > 0 {
        facts.push((says.outside.to_owned(), area.outside.to_string()));
    }
    facts
}

/// What the mean may be off by.
fn budget(of: &Budget, language: &Words) -> [Block; 2] {
    let says = &language.budget;
    let source = |line: &BudgetLine| match &line.source {
        UncertainInput::Calculation => says.calculation.to_owned(),
        UncertainInput::Flux(None) => says.flux.to_owned(),
        UncertainInput::Flux(Some(name)) => fill(says.flux_of, &[("name", name)]),
        UncertainInput::Maintenance => says.maintenance.to_owned(),
        UncertainInput::Reflectance(name) => fill(says.reflectance, &[("name", name)]),
        UncertainInput::OtherReflectances => says.other_reflectances.to_owned(),
    };
    let line = |line: &BudgetLine| {
        row([
            source(line),
            line.input.map_or(language.unknown.to_owned(), |share| language.share(share)),
            language.number(line.half_lx, 2),
            format!("{} %", language.fixed(100.0 * line.share, 0)),
        ])
    };
    let [first, rest @ ..] = says.columns;
    let table = Table {
        caption: says.caption.to_owned(),
        columns: [words(first)].into_iter().chain(rest.into_iter().map(numbers)).collect(),
        rows: of.lines.iter().map(line).collect(),
        is_dense: false,
    };
    let mean = language.figure(of.with_inputs_lx, LEAST_LX);
    [Block::Table(table), Block::Text(fill(says.together, &[("mean", &mean)]))]
}

/// The values as they lie on the plan: the last row of points on top.
fn values(area: &Area, language: &Words) -> Block {
    let says = &language.areas;
    let [across, along] = area.counts.map(|count| count as usize);
    if across > MOST_COLUMNS || across * along > MOST_VALUES {
        return Block::Text(says.too_many.to_owned());
    }
    let value = |lx: &Option<f64>| match lx {
        Some(lx) => language.to_error(*lx, area.error_lx.max(if *lx < 10.0 { 0.05 } else { 0.5 })),
        None => language.unknown.to_owned(),
    };
    let rows = area.values_lx.chunks(across.max(1)).enumerate().rev();
    let rows =
        rows.map(|(j, of)| row([(j + 1).to_string()].into_iter().chain(of.iter().map(value))));
    let columns = (1..=across).map(|i| numbers(&i.to_string()));
    let error = language.to_error(area.error_lx, area.error_lx);
    Block::Table(Table {
        caption: fill(says.values_caption, &[("error", &error)]),
        columns: [words(says.row)].into_iter().chain(columns).collect(),
        rows: rows.collect(),
        is_dense: true,
    })
}
