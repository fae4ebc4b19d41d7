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
    vec![Block::Pictures(Pictures {
        caption: format!(
            "Where the last maps err: {}; red is too bright, blue too dark, by {} or more in full colour, white is right, grey not known",
            place(case),
            percent_sign(limit)
        ),
        columns: known.iter().map(|series| series.system.title().to_owned()).collect(),
        rows: vec![("Last map".to_owned(), known.iter().map(|of| picture(case, of)).collect())],
    })]
}

fn place(case: &CaseStudy) -> &'static str {
    match case.name.as_str() {
        "cube" => "a face of CUBE, place by place",
        "sphere" => "the octant, azimuth to the right and height upwards in steps of equal area",
        _ => "illuminance as the camera sees it, over that of the reference",
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
