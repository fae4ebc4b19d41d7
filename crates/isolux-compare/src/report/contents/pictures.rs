//! Table 2: pictures at times that double.

use super::names;
use crate::report::document::{Block, Picture, Pictures, Section};
use crate::report::quantity::{asked, count, number, percent_sign, seconds};
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
    let mut times_s: Vec<f64> = scene
        .series
        .iter()
        .flat_map(|series| &series.points)
        .filter(|point| point.picture.is_some())
        .map(|point| point.asked_s)
        .collect();
    times_s.sort_by(f64::total_cmp);
    times_s.dedup();
    if times_s.is_empty() {
        return Vec::new();
    }
    let row = |&asked_s: &f64| {
        let cells = scene.series.iter().map(|series| cell(scene, series, asked_s)).collect();
        (asked(asked_s), cells)
    };
    let mut blocks = vec![Block::Heading(names::name(scene))];
    blocks.extend(reference(scene).map(Block::Picture));
    blocks.push(Block::Pictures(Pictures {
        caption: format!(
            "Table 2. {} by system, and by the time aimed at, all with the same exposure",
            names::name(scene)
        ),
        first: "Aimed at",
        columns: scene.series.iter().map(|series| series.system.title().to_owned()).collect(),
        rows: times_s.iter().map(row).collect(),
    }));
    blocks
}

/// The picture that others are compared with.
fn reference(scene: &CaseStudy) -> Option<Picture> {
    let of = scene.reference.as_ref()?;
    let told = of.told.map(|told| format!(", reported error {}", percent_sign(told)));
    Some(Picture {
        file: of.picture.clone(),
        shows: format!("{}. The reference picture", names::name(scene)),
        figures: vec![format!("{}{}", seconds(of.time_s), told.unwrap_or_default())],
    })
}

fn cell(scene: &CaseStudy, series: &Series, asked_s: f64) -> Option<Picture> {
    let point = series.points.iter().find(|point| point.asked_s == asked_s)?;
    Some(Picture {
        file: point.picture.clone()?,
        shows: format!(
            "{}, {}, after {}",
            names::name(scene),
            series.system.title(),
            seconds(point.time_s)
        ),
        figures: figures(point),
    })
}

fn figures(point: &Point) -> Vec<String> {
    let told = point.reported.error.map(|error| format!("reported error {}", percent_sign(error)));
    let unshot = point.reported.unshot.map(|share| format!("not yet shot {}", percent_sign(share)));
    let rays = point.rays.map(|rays| format!(", {} rays", count(rays)));
    let mut figures = vec![format!("{}{}", seconds(point.time_s), rays.unwrap_or_default())];
    figures.extend([told, unshot].into_iter().flatten());
    figures.extend(point.from_reference.iter().flat_map(far));
    figures
}

fn far(of: &Distances) -> Vec<String> {
    let rgb = of.rgb.mean.map(|share| format!("L2 from reference {}", percent_sign(share)));
    let cie1994 = format!("ΔE*94 from reference {}", number(of.cie1994.mean));
    rgb.into_iter().chain([cie1994]).collect()
}
