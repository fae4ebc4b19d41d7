//! What reports say, whatever their format.

mod case;
mod errors;
mod foreseen;
mod graphs;
mod kinds;
mod methods;
mod opening;
mod pictures;
mod systems;
mod theory;

pub(super) use errors::merit;

use super::document::{Document, Section};
use crate::study::Study;

/// The report of a study.
pub(super) fn document(study: &Study) -> Document {
    let mut sections: Vec<Section> = vec![opening::tested_again(study), opening::compared(study)];
    sections.extend(study.cases.iter().map(case::section));
    sections.push(theory::section());
    sections.extend(pictures::section(study));
    sections.push(methods::section());
    sections.push(methods::sources());
    Document { title: opening::TITLE.to_owned(), lead: opening::lead(study), sections }
}
