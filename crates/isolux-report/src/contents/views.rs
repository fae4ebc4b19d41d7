//! Pictures.

use crate::document::{Block, Picture, Section};
use crate::report::{Report, View};
use crate::words::{Words, fill};

/// `None` without pictures. The cover has the first one.
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    let blocks: Vec<Block> = report.views.iter().map(|view| pictures(view, language)).collect();
    let title = language.views.title.to_owned();
    (!blocks.is_empty()).then_some(Section { id: "pictures", title, blocks })
}

fn pictures(view: &View, language: &Words) -> Block {
    let says = &language.views;
    let of = |pattern: &str, image: &crate::report::Image| {
        let caption = fill(pattern, &[("name", &view.name)]);
        Picture { image: image.clone(), alternative: caption.clone(), caption }
    };
    let chart = view.chart.as_ref().map(|chart| of(says.chart, chart));
    Block::Pictures([Some(of(says.picture, &view.picture)), chart].into_iter().flatten().collect())
}
