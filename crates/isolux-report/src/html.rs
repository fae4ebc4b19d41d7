//! A report as one file of HTML, which needs nothing beside it and is well-formed XML, too.

use crate::document::{Block, Cell, Column, Cover, Document, Key, Picture, Section, Table};
use crate::report::Image;
use crate::words::Words;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use isolux::map::Verdict;
use isolux::units::escape_markup as escape;

const STYLE: &str = include_str!("report.css");

/// The whole report.
pub(crate) fn written(document: &Document) -> String {
    let words = document.words;
    let title = escape(&document.cover.title);
    let sections: String = document.sections.iter().map(section).collect();
    format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"{}\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n{}{}<main>\n{sections}</main>\n<footer><p>{}</p></footer>\n</body>\n</html>\n",
        words.code,
        cover(&document.cover, words),
        contents(document),
        escape(&document.foot),
    )
}

fn cover(cover: &Cover, words: &Words) -> String {
    let facts = definitions(&cover.facts);
    let remarks =
        cover.remarks.as_ref().map(|text| format!("<p class=\"remarks\">{}</p>\n", escape(text)));
    let picture =
        cover.picture.as_ref().map(|of| format!("<div class=\"hero\">{}</div>\n", image(of)));
    let keys: String = cover.keys.iter().map(|of| key(of, words)).collect();
    format!(
        "<header>\n<p class=\"kind\">{}</p>\n<h1>{}</h1>\n{}<div class=\"keys\">\n{keys}</div>\n{facts}{}</header>\n",
        escape(&cover.subtitle),
        escape(&cover.title),
        picture.unwrap_or_default(),
        remarks.unwrap_or_default(),
    )
}

fn key(key: &Key, words: &Words) -> String {
    let verdict = key.verdict.map(|verdict| badge(verdict, words.verdict(verdict)));
    format!(
        "<div class=\"key\"><p class=\"of\">{}</p><p class=\"value\">{}</p><p class=\"about\">{}</p>{}</div>\n",
        escape(&key.title),
        escape(&key.value),
        escape(&key.about),
        verdict.unwrap_or_default()
    )
}

fn badge(verdict: Verdict, word: &str) -> String {
    let class = match verdict {
        Verdict::Met => "met",
        Verdict::NotMet => "not-met",
        Verdict::Undecided => "undecided",
    };
    format!("<span class=\"badge {class}\">{}</span>", escape(word))
}

fn contents(document: &Document) -> String {
    let item = |section: &Section| {
        format!("<li><a href=\"#{}\">{}</a></li>\n", section.id, escape(&section.title))
    };
    let items: String = document.sections.iter().map(item).collect();
    let title = escape(document.words.contents);
    format!("<nav aria-label=\"{title}\">\n<ol>\n{items}</ol>\n</nav>\n")
}

fn section(section: &Section) -> String {
    let blocks: String = section.blocks.iter().map(block).collect();
    format!(
        "<section id=\"{}\">\n<h2>{}</h2>\n{blocks}</section>\n",
        section.id,
        escape(&section.title)
    )
}

fn block(block: &Block) -> String {
    match block {
        Block::Heading(title) => format!("<h3>{}</h3>\n", escape(title)),
        Block::Text(said) => format!("<p>{}</p>\n", escape(said)),
        Block::Facts(facts) => definitions(facts),
        Block::Table(of) => table(of),
        Block::Picture(of) => figure(of),
        Block::Pictures(all) => {
            format!(
                "<div class=\"pictures\">\n{}</div>\n",
                all.iter().map(figure).collect::<String>()
            )
        }
        Block::List(items) => {
            let items: String =
                items.iter().map(|item| format!("<li>{}</li>\n", escape(item))).collect();
            format!("<ul>\n{items}</ul>\n")
        }
    }
}

fn definitions(facts: &[(String, String)]) -> String {
    let fact = |(name, value): &(String, String)| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", escape(name), escape(value))
    };
    format!("<dl>\n{}</dl>\n", facts.iter().map(fact).collect::<String>())
}

/// A table that scrolls where it is wider than the page.
fn table(table: &Table) -> String {
    let caption = escape(&table.caption);
    let head: String = table.columns.iter().map(head).collect();
    let rows: String = table.rows.iter().map(|cells| row(cells, &table.columns)).collect();
    let class = if table.is_dense { " class=\"dense\"" } else { "" };
    format!(
        "<div class=\"scroll\" role=\"region\" aria-label=\"{caption}\" tabindex=\"0\">\n<table{class}>\n<caption>{caption}</caption>\n\
         <thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n</div>\n"
    )
}

fn head(column: &Column) -> String {
    format!("<th scope=\"col\"{}>{}</th>", class(column), escape(&column.title))
}

fn class(column: &Column) -> &'static str {
    if column.is_number { " class=\"number\"" } else { "" }
}

fn row(cells: &[Cell], columns: &[Column]) -> String {
    let cell = |(k, (cell, column)): (usize, (&Cell, &Column))| {
        let text = match cell {
            Cell::Text(text) => escape(text),
            Cell::Verdict(verdict, said) => badge(*verdict, said),
        };
        let text = if text.is_empty() { escape("\u{a0}") } else { text };
        match (k, column.is_number) {
            (0, false) => format!("<th scope=\"row\">{text}</th>"),
            _ => format!("<td{}>{text}</td>", class(column)),
        }
    };
    let cells: String = cells.iter().zip(columns).enumerate().map(cell).collect();
    format!("<tr>{cells}</tr>\n")
}

fn figure(of: &Picture) -> String {
    format!(
        "<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
        image(of),
        escape(&of.caption)
    )
}

fn image(of: &Picture) -> String {
    let (media, bytes) = match &of.image {
        Image::Svg(text) => ("image/svg+xml", text.as_bytes()),
        Image::Png(bytes) => ("image/png", bytes.as_slice()),
    };
    let data = STANDARD.encode(bytes);
    format!("<img alt=\"{}\" src=\"data:{media};base64,{data}\"/>", escape(&of.alternative))
}
