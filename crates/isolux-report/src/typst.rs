//! A report in the markup of Typst: code alone, with all text in string literals, so that no text is taken for markup.

use crate::document::{Block, Cell, Cover, Document, Key, Picture, Section, Table};
use crate::report::{Attachment, Image};
use crate::words::Words;
use isolux::map::Verdict;
use std::fmt::Write;

const PREAMBLE: &str = include_str!("report.typ");

/// The source, and the files that it names.
pub(crate) fn written(document: &Document) -> (String, Vec<Attachment>) {
    let mut sheet = Sheet { source: String::new(), files: Vec::new() };
    let words = document.words;
    let cover = &document.cover;
    let _ = writeln!(
        sheet.source,
        "#let title = {}\n#let lang = {}\n#let foot = {}\n#let page-word = {}\n#let contents-word = {}\n{PREAMBLE}",
        literal(&cover.title),
        literal(words.code),
        literal(&document.foot),
        literal(words.page),
        literal(words.contents)
    );
    sheet.cover(cover, words);
    document.sections.iter().for_each(|section| sheet.section(section));
    (sheet.source, sheet.files)
}

struct Sheet {
    source: String,
    files: Vec<Attachment>,
}

impl Sheet {
    fn line(&mut self, text: &str) {
        self.source.push_str(text);
        self.source.push('\n');
    }

    fn cover(&mut self, cover: &Cover, words: &Words) {
        let picture = cover.picture.as_ref().map_or("none".to_owned(), |of| self.image(of));
        let keys: String = cover.keys.iter().map(|of| key(of, words) + ", ").collect();
        let facts = pairs(&cover.facts);
        let remarks = cover.remarks.as_deref().map_or("none".to_owned(), literal);
        let subtitle = literal(&cover.subtitle);
        self.line(&format!(
            "#cover(subtitle: {subtitle}, picture: {picture}, keys: ({keys}), facts: {facts}, remarks: {remarks})"
        ));
    }

    fn section(&mut self, section: &Section) {
        self.line(&format!("#section({})", literal(&section.title)));
        section.blocks.iter().for_each(|block| self.block(block));
    }

    fn block(&mut self, block: &Block) {
        let text = match block {
            Block::Heading(title) => format!("#heading(level: 2, {})", literal(title)),
            Block::Text(said) => format!("#par({})", literal(said)),
            Block::Facts(facts) => format!("#facts({})", pairs(facts)),
            Block::Table(of) => table(of),
            Block::Picture(of) => {
                let drawn = self.image(of);
                format!("#shown({drawn}, {})", literal(&of.caption))
            }
            Block::Pictures(all) => {
                let shown = |of: &Picture| {
                    let drawn = self.image(of);
                    format!("({drawn}, {}), ", literal(&of.caption))
                };
                format!("#side-by-side(({}))", all.iter().map(shown).collect::<String>())
            }
            Block::List(items) => {
                let items: Vec<String> = items.iter().map(|item| literal(item)).collect();
                format!("#list({})", items.join(", "))
            }
        };
        self.line(&text);
    }

    /// Keeps the file of a picture, and gives the call that shows it.
    fn image(&mut self, of: &Picture) -> String {
        let (end, bytes) = match &of.image {
            Image::Svg(text) => ("svg", text.as_bytes()),
            Image::Png(bytes) => ("png", bytes.as_slice()),
        };
        let name = format!("picture-{}.{end}", self.files.len());
        self.files.push(Attachment { name: name.clone(), bytes: bytes.to_vec() });
        format!("image({}, alt: {}, width: 100%)", literal(&name), literal(&of.alternative))
    }
}

/// A string literal of Typst.
fn literal(text: &str) -> String {
    let mut literal = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => literal.push_str("\\\""),
            '\\' => literal.push_str("\\\\"),
            c if c.is_control() && !c.is_whitespace() => literal.push('\u{fffd}'),
            c => literal.push(c),
        }
    }
    literal.push('"');
    literal
}

fn pairs(facts: &[(String, String)]) -> String {
    let pair =
        |(name, value): &(String, String)| format!("({}, {}), ", literal(name), literal(value));
    format!("({})", facts.iter().map(pair).collect::<String>())
}

fn key(of: &Key, words: &Words) -> String {
    let verdict = of.verdict.map_or("none".to_owned(), |v| badge(v, words.verdict(v)));
    let [title, value, about] = [&of.title, &of.value, &of.about].map(|text| literal(text));
    format!("({title}, {value}, {about}, {verdict})")
}

fn badge(verdict: Verdict, word: &str) -> String {
    let kind = match verdict {
        Verdict::Met => "met",
        Verdict::NotMet => "not-met",
        Verdict::Undecided => "undecided",
    };
    format!("badge({}, {})", literal(kind), literal(word))
}

fn table(of: &Table) -> String {
    let columns: Vec<String> = of
        .columns
        .iter()
        .map(|column| format!("({}, {})", literal(&column.title), column.is_number))
        .collect();
    let cell = |cell: &Cell| match cell {
        Cell::Text(text) => literal(text),
        Cell::Verdict(verdict, word) => badge(*verdict, word),
    };
    let row = |cells: &Vec<Cell>| {
        format!("({}), ", cells.iter().map(|of| cell(of) + ", ").collect::<String>())
    };
    let rows: String = of.rows.iter().map(row).collect();
    format!(
        "#sheet({}, ({}, ), ({rows}), dense: {})",
        literal(&of.caption),
        columns.join(", "),
        of.is_dense
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_no_markup() {
        assert_eq!(literal("a \"b\" \\ #c\u{1}"), "\"a \\\"b\\\" \\\\ #c\u{fffd}\"");
    }
}
