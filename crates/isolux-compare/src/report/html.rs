//! A report as one file of HTML, which needs nothing beside it and is well-formed XML, too.

use super::document::{Block, Column, Document, Group, Picture, Pictures, Section, Source, Table};
use super::graph;
use super::graph::Graph;
use super::quantity::UNKNOWN;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use isolux::units::escape_markup as escape;

const STYLE: &str = include_str!("report.css");
const SCRIPT: &str = include_str!("report.js");

/// Files that a report holds: their names, kinds and texts.
pub(super) struct Attached<'a> {
    pub(super) name: &'a str,
    pub(super) media: &'a str,
    pub(super) text: &'a str,
    /// What is in it.
    pub(super) says: &'a str,
}

/// Where pictures come from, by names of files.
type Read<'a> = &'a dyn Fn(&str) -> Option<Vec<u8>>;

/// The whole report.
pub(super) fn written(document: &Document, read: Read, attached: &[Attached]) -> String {
    let title = escape(&document.title);
    let sections: String = document.sections.iter().map(|of| section(of, read)).collect();
    format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<meta name=\"color-scheme\" content=\"light dark\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}{}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<p class=\"lead\">{}</p>\n{}</header>\n<main>\n\
         {sections}{}</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        graph::css(),
        escape(&document.lead),
        contents(document),
        data(attached),
    )
}

fn contents(document: &Document) -> String {
    let item = |section: &Section| {
        format!("<li><a href=\"#{}\">{}</a></li>\n", escape(&section.id), escape(&section.title))
    };
    let items: String = document.sections.iter().map(item).collect();
    format!(
        "<nav aria-label=\"Contents\">\n<ul>\n{items}<li><a href=\"#data\">Data</a></li>\n</ul>\n</nav>\n"
    )
}

fn section(section: &Section, read: Read) -> String {
    format!(
        "<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n",
        escape(&section.id),
        escape(&section.title),
        blocks(&section.blocks, read)
    )
}

fn blocks(all: &[Block], read: Read) -> String {
    all.iter().map(|of| block(of, read)).collect()
}

fn block(block: &Block, read: Read) -> String {
    match block {
        Block::Heading(title) => format!("<h3>{}</h3>\n", escape(title)),
        Block::Text(said) => format!("<p>{}</p>\n", escape(said)),
        Block::Table(of) => table(of),
        Block::Graphs(graphs) => {
            format!(
                "<div class=\"graphs\">\n{}</div>\n",
                graphs.iter().map(figure).collect::<String>()
            )
        }
        Block::Picture(of) => alone(of, read),
        Block::Pictures(of) => pictures(of, read),
        Block::Folded(title, inside) => format!(
            "<details>\n<summary>{}</summary>\n{}</details>\n",
            escape(title),
            blocks(inside, read)
        ),
        Block::Sources(sources) => {
            format!(
                "<ol class=\"sources\">\n{}</ol>\n",
                sources.iter().map(source).collect::<String>()
            )
        }
    }
}

fn source(source: &Source) -> String {
    let address = source.address.map(|address| {
        let address = escape(address);
        format!(" <a href=\"{address}\">{address}</a>")
    });
    format!("<li>{}{}</li>\n", escape(source.text), address.unwrap_or_default())
}

fn figure(of: &Graph) -> String {
    let (title, says) = (escape(&of.title), escape(&of.description));
    let drawing = graph::element(of).unwrap_or_else(|| format!("<p>{title} cannot be drawn.</p>"));
    format!("<figure>\n{drawing}\n<figcaption><b>{title}.</b> {says}</figcaption>\n</figure>\n")
}

/// A table that scrolls where it is wider than the page; one of words has its cells one below the other on a phone.
fn table(table: &Table) -> String {
    let caption = escape(&table.caption);
    let head: String = table.columns.iter().map(head).collect();
    let bodies: String = table.groups.iter().map(|of| group(of, &table.columns)).collect();
    let class =
        if table.columns.iter().any(|column| column.is_number) { "" } else { " class=\"words\"" };
    let table = format!(
        "<table{class}>\n<caption><span>{caption}</span></caption>\n<thead>\n<tr>{head}</tr>\n</thead>\n{bodies}</table>\n"
    );
    scrolled(&caption, &table)
}

fn scrolled(label: &str, inside: &str) -> String {
    format!(
        "<div class=\"scroll\" role=\"region\" aria-label=\"{label}\" tabindex=\"0\">\n{inside}</div>\n"
    )
}

fn head(column: &Column) -> String {
    format!("<th scope=\"col\"{}>{}</th>", class(column), escape(&column.title))
}

fn class(column: &Column) -> &'static str {
    if column.is_number { " class=\"number\"" } else { "" }
}

fn group(group: &Group, columns: &[Column]) -> String {
    let title = group.title.as_ref().map(|title| {
        format!(
            "<tr class=\"group\"><th colspan=\"{}\" scope=\"colgroup\">{}</th></tr>\n",
            columns.len(),
            escape(title)
        )
    });
    let rows: String = group.rows.iter().map(|cells| row(cells, columns)).collect();
    format!("<tbody>\n{}{rows}</tbody>\n", title.unwrap_or_default())
}

/// The first cell of a row says what the others are of, if it is no number.
fn row(cells: &[String], columns: &[Column]) -> String {
    let cell = |(k, (text, column)): (usize, (&String, &Column))| {
        let (text, title) = (escape(text), escape(&column.title));
        match (k, column.is_number) {
            (0, false) => format!("<th scope=\"row\">{text}</th>"),
            (_, false) => format!("<td data-title=\"{title}\">{text}</td>"),
            (_, true) => format!("<td class=\"number\">{text}</td>"),
        }
    };
    let cells: String = cells.iter().zip(columns).enumerate().map(cell).collect();
    format!("<tr>{cells}</tr>\n")
}

fn pictures(of: &Pictures, read: Read) -> String {
    let (caption, first) = (escape(&of.caption), escape(of.first));
    let head: String = of
        .columns
        .iter()
        .map(|title| format!("<th scope=\"col\">{}</th>", escape(title)))
        .collect();
    let row = |(title, cells): &(String, Vec<Option<Picture>>)| {
        let cells: String = cells.iter().map(|cell| picture(cell.as_ref(), read)).collect();
        format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", escape(title))
    };
    let rows: String = of.rows.iter().map(row).collect();
    let table = format!(
        "<table class=\"pictures\">\n<caption><span>{caption}</span></caption>\n<thead>\n<tr><th scope=\"col\">{first}</th>{head}</tr>\n</thead>\n<tbody>\n{rows}</tbody>\n\
         </table>\n"
    );
    scrolled(&caption, &table)
}

fn picture(of: Option<&Picture>, read: Read) -> String {
    let Some(of) = of else { return format!("<td>{UNKNOWN}</td>") };
    format!("<td>{}<p>{}</p></td>", image(of, read), figures(of))
}

/// A picture that stands for itself.
fn alone(of: &Picture, read: Read) -> String {
    format!(
        "<figure class=\"alone\">\n{}\n<figcaption><b>{}.</b> {}</figcaption>\n</figure>\n",
        image(of, read),
        escape(&of.shows),
        figures(of)
    )
}

fn image(of: &Picture, read: Read) -> String {
    let shows = escape(&of.shows);
    match read(&of.file) {
        Some(png) => format!("<img alt=\"{shows}\" src=\"{}\"/>", data_uri("image/png", &png)),
        None => format!("<p>{shows}: {} is not at hand.</p>", escape(&of.file)),
    }
}

fn figures(of: &Picture) -> String {
    let figures: Vec<String> = of.figures.iter().map(|figure| escape(figure)).collect();
    figures.join("<br/>")
}

fn data(attached: &[Attached]) -> String {
    let link = |of: &Attached| {
        let name = escape(of.name);
        let uri = data_uri(of.media, of.text.as_bytes());
        format!("<li><a download=\"{name}\" href=\"{uri}\">{name}</a>: {}</li>\n", escape(of.says))
    };
    let links: String = attached.iter().map(link).collect();
    format!(
        "<section id=\"data\">\n<h2>Data</h2>\n<p>This page holds all figures. Errors and distances are shares there, times are seconds.</p>\n\
         <ul>\n{links}</ul>\n</section>\n"
    )
}

fn data_uri(media: &str, bytes: &[u8]) -> String {
    format!("data:{media};base64,{}", STANDARD.encode(bytes))
}
