//! Emergency lighting.

use super::least::{LEAST_LX, LEAST_RATIO};
use crate::document::{Block, Cell, Section, Table, words};
use crate::report::{EmergencyCriterion, EmergencyRequirement, Report};
use crate::words::{Words, fill};

/// The finest that people read of illuminances of few lux, and of the ratio of the greatest to the least.
const LEAST_DIM_LX: f64 = LEAST_LX / 10.0;
const LEAST_SPREAD: f64 = LEAST_RATIO * 10.0;

/// `None` of a report without areas of emergency lighting.
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    let count = report.emergency.as_ref()?.luminaires;
    let says = &language.emergency;
    let of = &language.results;
    let columns = [of.area, of.requirement, of.found, of.result];
    let table = Table {
        caption: says.caption.to_owned(),
        columns: columns.into_iter().map(words).collect(),
        rows: rows(report, language).collect(),
        is_dense: false,
    };
    let lead = fill(says.lead, &[("count", &count.to_string())]);
    let blocks = vec![Block::Text(lead), Block::Table(table)];
    Some(Section { id: "emergency", title: says.title.to_owned(), blocks })
}

/// A row for each requirement.
pub(super) fn rows<'a>(
    report: &'a Report,
    language: &'a Words,
) -> impl Iterator<Item = Vec<Cell>> + 'a {
    let all = report.emergency.iter().flat_map(|emergency| &emergency.requirements);
    all.map(|of| cells(of, language))
}

fn cells(of: &EmergencyRequirement, language: &Words) -> Vec<Cell> {
    let says = &language.emergency;
    let bound = language.local(&of.bound.to_string());
    let at_least = |symbol: &str, unit: &str| format!("{symbol} \u{2265} {bound}{unit}");
    let spread = || format!("Emax/Emin \u{2264} {bound}");
    let (condition, place, least, unit) = match of.criterion {
        EmergencyCriterion::CentreLine => {
            (at_least("Emin", " lx"), says.centre_line, LEAST_DIM_LX, " lx")
        }
        EmergencyCriterion::MiddleHalf => {
            (at_least("Emin", " lx"), says.middle_half, LEAST_DIM_LX, " lx")
        }
        EmergencyCriterion::CentreLineSpread => (spread(), says.centre_line, LEAST_SPREAD, ""),
        EmergencyCriterion::OpenArea => (at_least("Emin", " lx"), says.core, LEAST_DIM_LX, " lx"),
        EmergencyCriterion::OpenAreaSpread => (spread(), says.core, LEAST_SPREAD, ""),
        EmergencyCriterion::HighRiskMean => {
            (at_least("Em", " lx"), says.high_risk, LEAST_DIM_LX, " lx")
        }
        EmergencyCriterion::HighRiskUniformity => {
            (at_least("U\u{2080}", ""), says.high_risk, LEAST_RATIO, "")
        }
    };
    let found = match of.figure.value.is_finite() {
        true => format!("{}{unit}", language.figure(of.figure, least)),
        false => says.dark.to_owned(),
    };
    let verdict = Cell::Verdict(of.verdict, language.verdict(of.verdict).to_owned());
    vec![of.area.clone().into(), format!("{condition} {place}").into(), found.into(), verdict]
}
