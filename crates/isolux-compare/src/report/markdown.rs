//! A report as Markdown: graphs and pictures by names of files.

use super::document::{
    Block, Document, Group, Picture, Pictures, Section, Source, Table, graph_file,
};
use super::quantity::UNKNOWN;

/// The whole report.
pub(super) fn written(document: &Document) -> String {
    let sections: String = document.sections.iter().map(section).collect();
    format!("# {}\n\n{}\n\n{sections}", text(&document.title), text(&document.lead))
}

fn section(section: &Section) -> String {
    format!("## {}\n\n{}", text(&section.title), blocks(&section.blocks))
}

fn blocks(all: &[Block]) -> String {
    all.iter().map(block).collect()
}

fn block(block: &Block) -> String {
    match block {
        Block::Heading(title) => format!("### {}\n\n", text(title)),
        Block::Text(said) => format!("{}\n\n", text(said)),
        Block::Table(of) => table(of),
        Block::Graphs(graphs) => graphs
            .iter()
            .map(|graph| {
                let (title, says) = (text(&graph.title), text(&graph.description));
                format!("![{title}]({})\n\n*{title}.* {says}\n\n", graph_file(&graph.id))
            })
            .collect(),
        Block::Picture(of) => format!("{}\n\n", picture(Some(of))),
        Block::Pictures(of) => pictures(of),
        Block::Folded(title, inside) => format!("### {}\n\n{}", text(title), blocks(inside)),
        Block::Sources(sources) => {
            let lines: String = sources.iter().enumerate().map(source).collect();
            format!("{lines}\n")
        }
    }
}

fn source((number, source): (usize, &Source)) -> String {
    let address = source.address.map(|address| format!(" <{address}>")).unwrap_or_default();
    format!("{}. {}{address}\n", number + 1, text(source.text))
}

fn table(table: &Table) -> String {
    let titles: Vec<&str> = table.columns.iter().map(|column| column.title.as_str()).collect();
    let rules: Vec<&str> =
        table.columns.iter().map(|c| if c.is_number { "---:" } else { "---" }).collect();
    let rows: String = table.groups.iter().map(|of| group(of, table.columns.len())).collect();
    format!("*{}*\n\n{}{}{rows}\n", text(&table.caption), row(&titles), rule(&rules))
}

fn group(group: &Group, columns: usize) -> String {
    let title = group.title.as_ref().map(|title| {
        let mut cells = vec![format!("**{}**", text(title))];
        cells.resize(columns, String::new());
        format!("| {} |\n", cells.join(" | "))
    });
    let rows = group.rows.iter().map(|cells| row(cells));
    title.into_iter().chain(rows).collect()
}

fn row(cells: &[impl AsRef<str>]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| text(cell.as_ref())).collect();
    format!("| {} |\n", cells.join(" | "))
}

fn rule(rules: &[&str]) -> String {
    format!("| {} |\n", rules.join(" | "))
}

fn pictures(of: &Pictures) -> String {
    let titles: Vec<String> =
        std::iter::once(of.first.to_owned()).chain(of.columns.iter().cloned()).collect();
    let rules = vec!["---"; titles.len()];
    let rows: String = of
        .rows
        .iter()
        .map(|(title, cells)| {
            let cells: Vec<String> = cells.iter().map(|cell| picture(cell.as_ref())).collect();
            format!("| {} | {} |\n", text(title), cells.join(" | "))
        })
        .collect();
    format!("*{}*\n\n{}{}{rows}\n", text(&of.caption), row(&titles), rule(&rules))
}

fn picture(of: Option<&Picture>) -> String {
    let Some(of) = of else { return UNKNOWN.to_owned() };
    let figures: Vec<String> = of.figures.iter().map(|figure| text(figure)).collect();
    // A name in angle brackets may hold spaces.
    format!(
        "![{}](<{}>)<br>{}",
        text(&of.shows),
        of.file.replace(['<', '>'], ""),
        figures.join("<br>")
    )
}

/// Text without what Markdown takes for its own.
fn text(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(c, '|' | '*' | '_' | '<' | '>' | '`' | '\\') {
            escaped.push('\\');
        }
        escaped.push(if c == '\n' { ' ' } else { c });
    }
    escaped
}
