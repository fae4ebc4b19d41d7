//! What the figures rest on.

use super::cover::values;
use crate::document::{Block, Cell, Section, Table, numbers, row, words};
use crate::report::{Area, Report, Severity, Surface};
use crate::words::{Words, fill};

#[expect(clippy::unnecessary_wraps, reason = "sections of a report may be missing")]
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    let says = &language.assumptions;
    let mut list = Vec::new();
    // Where all grids have a factor of their own no value of theirs is initial.
    let is_factored = |area: &Area| area.maintenance_factor != 1.0;
    if report.areas.is_empty() || !report.areas.iter().all(is_factored) {
        list.push(values(report.scene.maintenance, language));
    }
    let factors = report.areas.iter().filter(|area| area.maintenance_factor != 1.0);
    list.extend(factors.map(|area| {
        let factor = language.fixed(area.maintenance_factor, 2);
        fill(says.grid_factor, &[("name", &area.name), ("factor", &factor)])
    }));
    list.extend([says.as_given, says.empty].map(str::to_owned));
    let area = language.number(report.scene.surface_m2, 3);
    let reflectance = language.fixed(report.scene.mean_reflectance, 2);
    let places = [("area", &*area), ("reflectance", &reflectance)];
    let blocks = vec![
        Block::List(list),
        Block::Heading(says.surfaces.to_owned()),
        Block::Table(surfaces(&report.surfaces, language)),
        Block::Text(fill(says.mean_reflectance, &places)),
        Block::Heading(says.findings.to_owned()),
        findings(report, language),
    ];
    Some(Section { id: "assumptions", title: says.title.to_owned(), blocks })
}

fn surfaces(all: &[Surface], language: &Words) -> Table {
    let says = &language.assumptions;
    let [name, area, diffuse, specular] = says.surfaces_columns;
    let of = |surface: &Surface| -> Vec<Cell> {
        let diffuse = surface
            .reflectance
            .map_or(says.glass.to_owned(), |reflectance| language.fixed(reflectance, 2));
        row([
            surface.name.clone(),
            language.number(surface.area_m2, 3),
            diffuse,
            language.fixed(surface.specular, 2),
        ])
    };
    Table {
        caption: says.surfaces_caption.to_owned(),
        columns: vec![words(name), numbers(area), numbers(diffuse), numbers(specular)],
        rows: all.iter().map(of).collect(),
        is_dense: false,
    }
}

fn findings(report: &Report, language: &Words) -> Block {
    let says = &language.assumptions;
    if report.findings.is_empty() {
        return Block::Text(says.no_findings.to_owned());
    }
    let line = |finding: &crate::report::Finding| {
        let severity = match finding.severity {
            Severity::Warning => says.warning,
            Severity::Note => says.note,
        };
        format!("{severity}: {}", finding.text)
    };
    let foreign = Some(says.findings_language.to_owned()).filter(|text| !text.is_empty());
    Block::List(report.findings.iter().map(line).chain(foreign).collect())
}
