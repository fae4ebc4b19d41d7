//! What reports say, whatever their format.

mod analytic;
mod case;
mod costs;
mod errors;
mod foreseen;
mod graphs;
mod kinds;
mod methods;
mod names;
mod opening;
mod pictures;
mod systems;
mod theory;
mod wrong;

use super::document::{Block, Document, Section};
use crate::study::Study;

/// The report of a study.
pub(super) fn document(study: &Study) -> Document {
    let mut sections: Vec<Section> = vec![opening::tested_again(study), opening::compared(study)];
    sections.extend(study.cases.iter().map(case::section));
    sections.extend(analytic::section(study));
    sections.extend(costs::section(&study.costs));
    sections.push(theory::section());
    sections.extend(pictures::section(study));
    sections.push(methods::section());
    sections.push(methods::sources());
    number_graphs(&mut sections);
    Document { title: opening::TITLE.to_owned(), lead: opening::lead(study), sections }
}

/// Numbers graphs all through the report, so that they can be cited.
fn number_graphs(sections: &mut [Section]) {
    let blocks = sections.iter_mut().flat_map(|section| &mut section.blocks);
    let graphs = blocks.filter_map(|block| match block {
        Block::Graphs(graphs) => Some(graphs),
        _ => None,
    });
    for (number, graph) in (1..).zip(graphs.flatten()) {
        graph.title = format!("Graph {number}. {}", graph.title);
    }
}
