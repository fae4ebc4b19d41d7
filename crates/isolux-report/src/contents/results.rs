//! What is required and what was found.

use super::emergency;
use super::least::{LEAST_LX, LEAST_RATIO};
use crate::document::{Block, Cell, Section, Table, numbers, row, words};
use crate::report::{Area, Report, Requirement};
use crate::words::{Words, fill};
use isolux::map::{Figure, Verdict};
use isolux::scene::{Condition, GridQuantity};

/// `None` of a report without grids.
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    if report.areas.is_empty() && report.emergency.is_none() {
        return None;
    }
    let says = &language.results;
    let of_areas = report.areas.iter().flat_map(|area| &area.requirements).map(|of| of.verdict);
    let of_emergency = report.emergency.iter().flat_map(|emergency| &emergency.requirements);
    let all: Vec<Verdict> = of_areas.chain(of_emergency.map(|of| of.verdict)).collect();
    let count = all.len();
    let mut blocks = Vec::new();
    if count == 0 {
        blocks.push(Block::Text(says.none.to_owned()));
    } else {
        let met = all.iter().filter(|verdict| **verdict == Verdict::Met).count();
        let sentence = match met == count {
            true => says.all_met.to_owned(),
            false => fill(says.some_met, &[("met", &met.to_string()), ("all", &count.to_string())]),
        };
        blocks.push(Block::Text(sentence));
        blocks.push(Block::Table(requirements(report, language)));
        blocks.push(Block::Text(says.lead.to_owned()));
    }
    if !report.areas.is_empty() {
        blocks.push(Block::Table(figures(&report.areas, language)));
    }
    Some(Section { id: "results", title: says.title.to_owned(), blocks })
}

fn requirements(report: &Report, language: &Words) -> Table {
    let says = &language.results;
    let columns = [says.area, says.requirement, says.found, says.result];
    let rows = report.areas.iter().flat_map(|area| {
        area.requirements.iter().map(|requirement| requirement_row(area, requirement, language))
    });
    let rows = rows.chain(emergency::rows(report, language));
    Table {
        caption: says.caption.to_owned(),
        columns: columns.into_iter().map(words).collect(),
        rows: rows.collect(),
        is_dense: false,
    }
}

fn requirement_row(area: &Area, of: &Requirement, language: &Words) -> Vec<Cell> {
    let source = of.source.as_ref().map_or(String::new(), |source| format!(" ({source})"));
    let required = format!("{}{source}", condition(&of.condition, language));
    let found = found(of.condition.of, of.figure, language);
    let likely = match of.verdict {
        Verdict::Undecided => {
            let share = format!("{:.0} %", 100.0 * of.probability);
            format!("{}, {}", language.undecided, language.results.likely.replace("{}", &share))
        }
        verdict => language.verdict(verdict).to_owned(),
    };
    vec![area.name.clone().into(), required.into(), found.into(), Cell::Verdict(of.verdict, likely)]
}

/// A condition, as `Em ≥ 500 lx`.
fn condition(of: &Condition, language: &Words) -> String {
    let sign = if of.is_least { "\u{2265}" } else { "\u{2264}" };
    let bound = language.local(&of.bound.to_string());
    format!("{} {sign} {bound}{}", symbol(of.of), of.of.unit())
}

fn found(quantity: GridQuantity, figure: Figure, language: &Words) -> String {
    format!("{}{}", language.figure(figure, least(quantity)), quantity.unit())
}

/// The symbol, with the index that it has in print.
fn symbol(quantity: GridQuantity) -> &'static str {
    match quantity {
        GridQuantity::Uniformity => "U\u{2080}",
        other => other.symbol(),
    }
}

const fn least(quantity: GridQuantity) -> f64 {
    match quantity {
        GridQuantity::Mean | GridQuantity::Least | GridQuantity::Greatest => LEAST_LX,
        GridQuantity::Uniformity | GridQuantity::Diversity => LEAST_RATIO,
        GridQuantity::GlareRating => 0.05,
    }
}

fn figures(areas: &[Area], language: &Words) -> Table {
    let [area, rest @ ..] = language.results.columns;
    let columns = [words(area)].into_iter().chain(rest.into_iter().map(numbers)).collect();
    let of = |area: &Area| {
        let cells = match &area.figures {
            Some(f) => [
                (GridQuantity::Mean, f.mean_lx),
                (GridQuantity::Least, f.least_lx),
                (GridQuantity::Greatest, f.greatest_lx),
                (GridQuantity::Uniformity, f.uniformity),
                (GridQuantity::Diversity, f.diversity),
            ]
            .map(|(quantity, figure)| language.figure(figure, least(quantity))),
            None => [const { String::new() }; 5].map(|_| language.unknown.to_owned()),
        };
        row([area.name.clone()].into_iter().chain(cells))
    };
    Table {
        caption: language.results.figures.to_owned(),
        columns,
        rows: areas.iter().map(of).collect(),
        is_dense: false,
    }
}
