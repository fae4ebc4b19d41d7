//! What a report says, in order.

mod accuracy;
mod areas;
mod assumptions;
mod cover;
mod daylight;
mod emergency;
mod glare;
mod least;
mod luminaires;
mod results;
mod views;

use crate::document::{Block, Document, Section};
use crate::report::Report;
use crate::words::{Language, Words};

/// The report in a language.
pub(crate) fn document(report: &Report, language: Language) -> Document {
    let words = language.words();
    let sections = [
        results::section(report, words),
        areas::section(report, words),
        emergency::section(report, words),
        luminaires::section(report, words),
        daylight::section(report, words),
        glare::section(report, words),
        views::section(report, words),
        accuracy::section(report, words),
        assumptions::section(report, words),
        Some(definitions(report, words)),
    ];
    Document {
        words,
        cover: cover::cover(report, words),
        sections: sections.into_iter().flatten().collect(),
        foot: words.cover.foot.to_owned(),
    }
}

fn definitions(report: &Report, words: &Words) -> Section {
    let of_a_year: &[_] = match report.daylight {
        Some(_) => words.definitions_daylight,
        None => &[],
    };
    let all = words
        .definitions
        .iter()
        .chain(of_a_year)
        .map(|(name, is)| ((*name).to_owned(), (*is).to_owned()));
    Section {
        id: "definitions",
        title: words.definitions_title.to_owned(),
        blocks: vec![Block::Facts(all.collect())],
    }
}
