//! Table 2: pictures at times that double.

use super::case;
use crate::report::document::{Block, Picture, Pictures, Section};
use crate::report::quantity::{count, number, percent_sign, seconds};
use crate::study::{CaseStudy, Distances, Point, Series, Study};

/// Pictures of all scenes that have any; `None` if there are none.
pub(super) fn section(study: &Study) -> Option<Section> {
    let blocks: Vec<Block> = study.cases.iter().flat_map(of_case).collect();
    (!blocks.is_empty()).then(|| Section {
        id: "table-2".to_owned(),
        title: "Table 2: pictures at times that double".to_owned(),
        blocks,
    })
}

fn of_case(scene: &CaseStudy) -> Vec<Block> {
    let mut asked: Vec<f64> = scene
        .series
        .iter()
        .flat_map(|series| &series.points)
        .filter(|point| point.picture.is_some())
        .map(|point| point.asked_s)
        .collect();
    asked.sort_by(f64::total_cmp);
    asked.dedup();
    if asked.is_empty() {
        return Vec::new();
    }
    let row = |&asked_s: &f64| {
        let cells = scene.series.iter().map(|series| cell(scene, series, asked_s)).collect();
        (seconds(asked_s), cells)
    };
    let mut blocks = vec![Block::Heading(case::name(scene))];
    blocks.extend(reference(scene).map(Block::Pictures));
    blocks.push(Block::Pictures(Pictures {
        caption: format!(
            "Table 2. {} by system, and by the time allowed, all with the same exposure",
            case::name(scene)
        ),
        columns: scene.series.iter().map(|series| series.system.title().to_owned()).collect(),
        rows: asked.iter().map(row).collect(),
    }));
    blocks
}

/// The picture that others are compared with.
fn reference(scene: &CaseStudy) -> Option<Pictures> {
    let of = scene.reference.as_ref()?;
    let mut figures = vec![seconds(of.time_s)];
    figures.extend(of.told.map(|told| format!("told error {}", percent_sign(told))));
    let picture = Picture {
        file: of.picture.clone(),
        shows: format!("Reference picture of {}", case::name(scene)),
        figures,
    };
    Some(Pictures {
        caption: format!("{}. The reference picture", case::name(scene)),
        columns: vec!["reference".to_owned()],
        rows: vec![(seconds(of.time_s), vec![Some(picture)])],
    })
}

fn cell(scene: &CaseStudy, series: &Series, asked_s: f64) -> Option<Picture> {
    let point = series.points.iter().find(|point| point.asked_s == asked_s)?;
    Some(Picture {
        file: point.picture.clone()?,
        shows: format!(
            "{}, {}, after {}",
            case::name(scene),
            series.system.title(),
            seconds(point.time_s)
        ),
        figures: figures(point),
    })
}

fn figures(point: &Point) -> Vec<String> {
    let told = point.reported.error.map(|error| format!("told error {}", percent_sign(error)));
    let unshot = point.reported.unshot.map(|share| format!("not yet shot {}", percent_sign(share)));
    let far = |of: &Distances| {
        let rgb = of.rgb.mean.map(|share| format!("L2 {}, ", percent_sign(share)));
        let rgb = rgb.unwrap_or_default();
        format!("from reference: {rgb}ΔE*94 {}", number(of.cie1994.mean))
    };
    let mut figures = vec![format!("{}, {} rays", seconds(point.time_s), count(point.rays))];
    figures.extend([told, unshot, point.from_reference.as_ref().map(far)].into_iter().flatten());
    figures
}
