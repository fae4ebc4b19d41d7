//! What observers see.

use crate::document::{Block, Section, Table, numbers, row, words};
use crate::report::{Glare, Report};
use crate::words::Words;

/// Below this there is no glare (CIE 117).
const NO_GLARE: f64 = 10.0;
/// Nobody reads a rating finer than this.
const LEAST: f64 = 0.05;

/// `None` without observers.
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    if report.glare.is_empty() {
        return None;
    }
    let says = &language.glare;
    let [observer, place, direction, background, rating] = says.columns;
    let table = Table {
        caption: says.caption.to_owned(),
        columns: vec![
            words(observer),
            words(place),
            words(direction),
            numbers(background),
            numbers(rating),
        ],
        rows: report.glare.iter().map(|of| row(cells(of, language))).collect(),
        is_dense: false,
    };
    let blocks = vec![Block::Text(says.lead.to_owned()), Block::Table(table)];
    Some(Section { id: "glare", title: says.title.to_owned(), blocks })
}

fn cells(of: &Glare, language: &Words) -> [String; 5] {
    let list = |of: [f64; 3]| of.map(|v| language.fixed(v, 2)).join("; ");
    let rating = match of.rating {
        None => language.glare.none.to_owned(),
        Some(rating) if rating.high < NO_GLARE => language.glare.below.to_owned(),
        Some(rating) => language.figure(rating, LEAST),
    };
    [
        of.observer.name.clone(),
        list(of.observer.position_m),
        list(of.observer.direction),
        language.number(of.background_cd_m2, 3),
        rating,
    ]
}
