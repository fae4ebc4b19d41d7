//! A year of daylight.

use crate::document::{Block, Cell, Picture, Section, Table, words};
use crate::report::{DaylightArea, Report};
use crate::words::{Words, fill};
use isolux::map::{Figure, Verdict};

/// Nobody reads finer than this.
const LEAST_PERCENT: f64 = 0.05;
const LEAST_LX: f64 = 0.5;

/// `None` without a year.
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    let year = report.daylight.as_ref()?;
    let says = &language.daylight;
    let [from, to] = year.hours.map(|hour| hour.to_string());
    let places = [
        ("place", &*year.place),
        ("from", &from),
        ("to", &to),
        ("ground", &language.share(year.ground_reflectance)),
        ("paths", &year.paths.to_string()),
    ];
    let mut blocks = vec![Block::Text(fill(says.lead, &places))];
    blocks.extend(year.areas.iter().flat_map(|area| of_area(area, language)));
    blocks.push(Block::Text(says.not_in.to_owned()));
    Some(Section { id: "daylight", title: says.title.to_owned(), blocks })
}

fn of_area(area: &DaylightArea, language: &Words) -> Vec<Block> {
    let says = &language.daylight;
    let mut blocks = vec![Block::Heading(area.name.clone())];
    blocks.extend(area.plan.as_ref().map(|plan| {
        Block::Picture(Picture {
            image: plan.clone(),
            alternative: language.areas.plan_shows.to_owned(),
            caption: fill(says.plan, &[("name", &area.name)]),
        })
    }));
    blocks.push(Block::Table(Table {
        caption: fill(says.caption, &[("name", &area.name)]),
        columns: says.columns.into_iter().map(words).collect(),
        rows: rows(area, language),
        is_dense: false,
    }));
    blocks
}

fn rows(area: &DaylightArea, language: &Words) -> Vec<Vec<Cell>> {
    let says = &language.daylight;
    let percent = |of: Figure| language.percent(of, LEAST_PERCENT);
    let lux = |of: Figure| format!("{} lx", language.figure(of, LEAST_LX));
    let told = |name: &str, found: String| {
        vec![Cell::Text(name.to_owned()), found.into(), String::new().into()]
    };
    let judged = |name: &str, found: String, verdict: Verdict| {
        let word = language.verdict(verdict).to_owned();
        vec![Cell::Text(name.to_owned()), found.into(), Cell::Verdict(verdict, word)]
    };
    let mut rows = vec![
        told(says.factor_mean, percent(area.factor_mean)),
        told(says.sky_component, percent(area.sky_component)),
        told(says.factor_median, percent(area.factor_median)),
        told(says.factor_95, percent(area.factor_95)),
        told(says.target_half, lux(area.target_lx[0])),
        told(says.target_95, lux(area.target_lx[1])),
    ];
    let levels = says.en_17037.into_iter().zip(area.en_17037);
    rows.extend(levels.map(|(level, verdict)| judged(level, String::new(), verdict)));
    rows.push(told(says.autonomy, percent(area.autonomy)));
    rows.push(told(says.spatial, percent(area.spatial_autonomy)));
    let targets = [says.spatial_55, says.spatial_75].into_iter().zip(area.spatial_autonomy_reaches);
    rows.extend(targets.map(|(target, verdict)| judged(target, String::new(), verdict)));
    let exposed = format!("{} %", language.fixed(100.0 * area.sunlight_exposure, 0));
    rows.push(judged(says.exposure, exposed, area.sunlight_acceptable));
    rows.extend(says.useful.into_iter().zip(area.useful).map(|(n, of)| told(n, percent(of))));
    rows
}
