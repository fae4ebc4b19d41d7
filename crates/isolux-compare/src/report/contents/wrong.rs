//! Where last maps err, as pictures.

use super::names;
use crate::report::document::{Block, Picture, Pictures};
use crate::report::quantity::{percent_sign, seconds};
use crate::study::{CaseStudy, Series};

/// A picture of every system whose last map has one.
pub(super) fn blocks(case: &CaseStudy) -> Vec<Block> {
    let Some(limit) = case.error_limit else { return Vec::new() };
    let known: Vec<&Series> =
        case.series.iter().filter(|series| series.error_picture.is_some()).collect();
    if known.is_empty() {
        return Vec::new();
    }
    let how = format!(
        "Where the last maps err, below, is shown over {}. Red is too bright and blue too dark, in full colour by {} or more; white is right, grey not known.",
        place(case),
        percent_sign(limit)
    );
    let pictures = Pictures {
        caption: "Where the last maps err".to_owned(),
        first: "Map",
        columns: known.iter().map(|series| series.system.title().to_owned()).collect(),
        rows: vec![("Last".to_owned(), known.iter().map(|of| picture(case, of)).collect())],
    };
    vec![Block::Text(how), Block::Pictures(pictures)]
}

fn place(case: &CaseStudy) -> &'static str {
    match case.name.as_str() {
        "cube" => "a face of CUBE",
        "sphere" => {
            "the octant, with azimuth to the right and height upwards in steps of equal area"
        }
        _ => "what the camera sees, as illuminance beside that of the reference",
    }
}

fn picture(case: &CaseStudy, series: &Series) -> Option<Picture> {
    let after = series.points.last().map(|point| seconds(point.time_s));
    Some(Picture {
        file: series.error_picture.clone()?,
        shows: format!("{}, {}, errors of the last map", names::name(case), series.system.title()),
        figures: after.into_iter().collect(),
    })
}
