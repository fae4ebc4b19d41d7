//! The study for readers: one file of HTML, Markdown, a table for programs, and graphs. All are pure functions of a [`Study`].

mod contents;
mod csv;
mod document;
mod graph;
mod html;
mod markdown;
mod quantity;
#[cfg(test)]
mod tests;

use crate::study::Study;
use document::{Block, graph_file};
use html::Attached;

/// A graph as a file of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GraphFile {
    /// Its name, as [`markdown`] has it.
    pub name: String,
    /// What is in it.
    pub svg: String,
}

/// One file that needs nothing beside it: text, tables, graphs, and pictures, which `picture` gives as PNG by names of files. A picture that it does not
/// give is left out with a sentence.
pub fn html(study: &Study, picture: &dyn Fn(&str) -> Option<Vec<u8>>) -> String {
    let table = csv(study);
    let json = serde_json::to_string(study).ok();
    let mut attached = vec![Attached {
        name: "study.csv",
        media: "text/csv",
        text: &table,
        says: "one row a map, with units in the names of columns",
    }];
    attached.extend(json.as_deref().map(|text| Attached {
        name: "study.json",
        media: "application/json",
        text,
        says: "the study as it was measured",
    }));
    html::written(&contents::document(study), picture, &attached)
}

/// The same text and tables; graphs and pictures are named as files beside it.
pub fn markdown(study: &Study) -> String {
    markdown::written(&contents::document(study))
}

/// All figures, one row a map, with units in the names of columns. What is not known is an empty field; errors and distances are shares, not hundredths.
pub fn csv(study: &Study) -> String {
    csv::csv(study)
}

/// The graphs that [`markdown`] names.
pub fn graphs(study: &Study) -> Vec<GraphFile> {
    let document = contents::document(study);
    let blocks = document.sections.iter().flat_map(|section| &section.blocks);
    let graphs = blocks.filter_map(|block| match block {
        Block::Graphs(graphs) => Some(graphs),
        _ => None,
    });
    let file =
        |of: &graph::Graph| Some(GraphFile { name: graph_file(&of.id), svg: graph::file(of)? });
    graphs.flatten().filter_map(file).collect()
}
