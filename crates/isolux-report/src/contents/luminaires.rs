//! The luminaire schedule.

use crate::document::{Block, Picture, Section, Table, numbers, row, words};
use crate::report::{Luminaire, LuminousBody, Report};
use crate::words::{Words, fill};

/// Luminaires whose places are told.
const MOST_PLACES: usize = 120;

#[expect(clippy::unnecessary_wraps, reason = "sections of a report may be missing")]
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    let says = &language.luminaires;
    let all = &report.luminaires;
    let blocks = match all.is_empty() {
        true => vec![Block::Text(says.none.to_owned())],
        false => blocks(all, language),
    };
    Some(Section { id: "luminaires", title: says.title.to_owned(), blocks })
}

fn blocks(all: &[Luminaire], language: &Words) -> Vec<Block> {
    let says = &language.luminaires;
    let mut blocks = vec![Block::Table(schedule(all, language))];
    if all.iter().any(|of| of.power_w.is_none()) {
        blocks.push(Block::Text(says.power_unknown.to_owned()));
    }
    let diagrams: Vec<Picture> = all
        .iter()
        .enumerate()
        .filter_map(|(k, of)| {
            let kind = letter(k);
            Some(Picture {
                image: of.diagram.clone()?,
                alternative: says.diagram_shows.to_owned(),
                caption: fill(says.diagram, &[("type", &kind)]),
            })
        })
        .collect();
    if !diagrams.is_empty() {
        blocks.push(Block::Pictures(diagrams));
    }
    let places: usize = all.iter().map(|of| of.positions_m.len()).sum();
    blocks.push(match places > MOST_PLACES {
        true => Block::Text(fill(says.positions_too_many, &[("most", &MOST_PLACES.to_string())])),
        false => Block::Table(positions(all, language)),
    });
    blocks
}

/// A, B, ..., Z, AA, ...
fn letter(k: usize) -> String {
    let last = char::from(b'A' + (k % 26) as u8).to_string();
    if k < 26 { last } else { letter(k / 26 - 1) + &last }
}

fn schedule(all: &[Luminaire], language: &Words) -> Table {
    let says = &language.luminaires;
    let [kind, name, numbered @ ..] = says.columns;
    let columns = [words(kind), words(name)].into_iter().chain(numbered.into_iter().map(numbers));
    let known = |value: Option<f64>, digits: usize| {
        value.map_or(language.unknown.to_owned(), |value| language.number(value, digits))
    };
    let mut rows: Vec<_> = all
        .iter()
        .enumerate()
        .map(|(k, of)| {
            let count = of.positions_m.len() as f64;
            row([
                letter(k),
                described(of, language),
                of.positions_m.len().to_string(),
                known(Some(of.flux_lm), 4),
                known(of.power_w, 3),
                known(of.power_w.map(|w| of.flux_lm / w), 3),
                known(Some(count * of.flux_lm), 4),
                known(of.power_w.map(|w| count * w), 3),
            ])
        })
        .collect();
    let count = |of: &Luminaire| of.positions_m.len() as f64;
    let power: Option<f64> = all.iter().map(|of| of.power_w.map(|w| count(of) * w)).sum();
    let flux: f64 = all.iter().map(|of| count(of) * of.flux_lm).sum();
    let number: usize = all.iter().map(|of| of.positions_m.len()).sum();
    rows.push(row([
        String::new(),
        says.total.to_owned(),
        number.to_string(),
        String::new(),
        String::new(),
        known(power.map(|w| flux / w), 3),
        known(Some(flux), 4),
        known(power, 3),
    ]));
    Table { caption: says.caption.to_owned(), columns: columns.collect(), rows, is_dense: false }
}

fn described(of: &Luminaire, language: &Words) -> String {
    let says = &language.luminaires;
    let body = match of.body {
        LuminousBody::Point => says.point.to_owned(),
        LuminousBody::Area(m2) => fill(says.area, &[("area", &language.number(m2, 2))]),
        LuminousBody::Surface(m2, cd_m2) => {
            let [area, luminance] = [(m2, 2), (cd_m2, 3)].map(|(v, n)| language.number(v, n));
            fill(says.surface, &[("area", &area), ("luminance", &luminance)])
        }
    };
    let maker = of.manufacturer.as_ref().map_or(String::new(), |maker| format!("{maker}: "));
    format!("{maker}{} ({body})", of.name)
}

fn positions(all: &[Luminaire], language: &Words) -> Table {
    let says = &language.luminaires;
    let [kind, number, x, y, z] = says.positions_columns;
    let rows = all.iter().enumerate().flat_map(|(k, of)| {
        of.positions_m.iter().enumerate().map(move |(number, place)| {
            let [x, y, z] = place.map(|m| language.fixed(m, 2));
            row([letter(k), (number + 1).to_string(), x, y, z])
        })
    });
    Table {
        caption: says.positions.to_owned(),
        columns: vec![words(kind), numbers(number), numbers(x), numbers(y), numbers(z)],
        rows: rows.collect(),
        is_dense: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_have_letters() {
        assert_eq!([0, 25, 26, 27, 52].map(letter), ["A", "Z", "AA", "AB", "BA"]);
    }
}
