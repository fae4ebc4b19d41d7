//! The first page.

use super::least::{LEAST_LX, LEAST_RATIO};
use crate::document::{Cover, Key, Picture};
use crate::report::{Area, DaylightArea, Emergency, Maintenance, Report};
use crate::words::{Words, fill};
use isolux::map::Verdict;

/// Grids whose figures stand on the cover.
const MOST_KEYS: usize = 3;

pub(super) fn cover(report: &Report, words: &Words) -> Cover {
    let says = &words.cover;
    let project = &report.project;
    let [x, y, z] = report.scene.size_m.map(|m| words.number(m, 3));
    let mut facts = Vec::new();
    let mut fact = |name: &str, value: Option<String>| {
        facts.extend(value.map(|value| (name.to_owned(), value)));
    };
    fact(says.client, project.client.clone());
    fact(says.author, project.author.clone());
    fact(says.date, project.date.clone());
    fact(says.scene, Some(report.scene.name.clone()).filter(|name| *name != project.title));
    fact(says.size, Some(format!("{x} x {y} x {z} m")));
    let skies = report.scene.skies.join(", ");
    fact(says.sky, Some(skies).filter(|skies| !skies.is_empty()));
    fact(says.software, Some(report.software.clone()));
    let subtitle = match report.daylight {
        Some(_) => says.subtitle_daylight,
        None => says.subtitle,
    };
    let picture = report.views.first().map(|view| Picture {
        image: view.picture.clone(),
        alternative: format!("{}: {}", says.picture, view.name),
        caption: String::new(),
    });
    Cover {
        title: project.title.clone(),
        subtitle: subtitle.to_owned(),
        facts,
        picture,
        remarks: project.remarks.clone(),
        keys: keys(report, words),
    }
}

fn keys(report: &Report, words: &Words) -> Vec<Key> {
    let years = report.daylight.iter().flat_map(|year| &year.areas);
    let daylight = years.map(|area| daylight(area, words));
    let areas = report.areas.iter().filter_map(|area| electric(area, words));
    let emergency = report.emergency.as_ref().and_then(|of| emergency(of, words));
    areas.take(MOST_KEYS).chain(emergency).chain(daylight.take(MOST_KEYS)).collect()
}

/// `None` where nothing is required.
fn emergency(of: &Emergency, words: &Words) -> Option<Key> {
    let verdicts = || of.requirements.iter().map(|requirement| requirement.verdict);
    let met = verdicts().filter(|verdict| *verdict == Verdict::Met).count();
    let mut areas: Vec<&str> = of.requirements.iter().map(|of| of.area.as_str()).collect();
    areas.dedup();
    Some(Key {
        title: words.emergency.title.to_owned(),
        value: format!("{met} / {}", of.requirements.len()),
        about: format!("EN 1838: {}", areas.join(", ")),
        verdict: Some(verdicts().reduce(Verdict::and)?),
    })
}

fn electric(area: &Area, words: &Words) -> Option<Key> {
    let figures = area.figures?;
    let mean = words.figure(figures.mean_lx, LEAST_LX);
    let uniformity = words.figure(figures.uniformity, LEAST_RATIO);
    let verdicts = area.requirements.iter().map(|requirement| requirement.verdict);
    Some(Key {
        title: area.name.clone(),
        value: format!("{mean} lx"),
        about: format!("{}, {} {uniformity}", words.cover.mean, words.cover.uniformity),
        verdict: verdicts.reduce(Verdict::and),
    })
}

fn daylight(area: &DaylightArea, words: &Words) -> Key {
    Key {
        title: area.name.clone(),
        value: words.percent(area.factor_median, 0.05),
        about: format!("{}, EN 17037", words.cover.median_factor),
        verdict: Some(area.en_17037[0]),
    }
}

/// What values contain, in a sentence.
pub(super) fn values(maintenance: Maintenance, words: &Words) -> String {
    let says = &words.assumptions;
    match maintenance {
        Maintenance::Initial => says.initial.to_owned(),
        Maintenance::Maintained { least, greatest } if least == greatest => {
            fill(says.maintained, &[("factor", &words.fixed(least, 2))])
        }
        Maintenance::Maintained { least, greatest } => {
            let [least, greatest] = [least, greatest].map(|factor| words.fixed(factor, 2));
            fill(says.maintained_range, &[("least", &least), ("greatest", &greatest)])
        }
    }
}
