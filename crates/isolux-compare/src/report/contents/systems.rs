//! The systems in words.

use crate::report::document::{Block, Table, words};
use crate::study::{Study, System};

/// All systems of a study, each once, in the order of reports.
pub(super) fn of(study: &Study) -> Vec<System> {
    let mut systems: Vec<System> = Vec::new();
    let series = study.cases.iter().flat_map(|case| &case.series);
    for series in series.filter(|series| !series.points.is_empty()) {
        if !systems.contains(&series.system) {
            systems.push(series.system);
        }
    }
    systems.sort_by_key(|&system| number(system));
    systems
}

/// The number of a system, by which it looks alike in all graphs.
pub(super) fn number(system: System) -> usize {
    System::ALL.iter().position(|&other| other == system).unwrap_or(System::ALL.len())
}

/// What each system does, and for which of the study it stands.
pub(super) fn table(systems: &[System]) -> Block {
    let row = |&system: &System| {
        vec![system.title().to_owned(), does(system).to_owned(), stands_for(system).to_owned()]
    };
    Block::Table(Table::plain(
        "Systems",
        vec![words("System"), words("What it does"), words("Stands for")],
        systems.iter().map(row).collect(),
    ))
}

fn does(system: System) -> &'static str {
    match system {
        System::Hybrid => {
            "Direct light is evaluated where it is read; indirect light is gathered by rays over a map that is solved for as a fixed point."
        }
        System::Forward => {
            "Particles fly from luminaires and are counted where they land; where the map shows noise, it is filtered."
        }
        System::ForwardUnfiltered => "The same without filter.",
        System::Radiosity => {
            "Patches shoot their light, the brightest first; an ambient term stands for light that is not yet shot."
        }
        System::RadiosityWithoutAmbient => "The same without ambient term.",
        System::RadiosityDiffuse => {
            "The same with ambient term, in the scene without mirrors, gloss and glass."
        }
        System::Cache => {
            "Indirect light is gathered at few places, where it is asked for, and interpolated between them."
        }
        System::Radiance => {
            "rtrace of another program: light is gathered at the points judged alone, with a cache of its own; no map is made."
        }
        System::Mitsuba => {
            "Another program: paths from the points judged alone, or particles to a camera that sees them; no map is made."
        }
        System::LuxCore => "Another program: light maps of rectangles, baked by paths.",
    }
}

fn stands_for(system: System) -> &'static str {
    match system {
        System::Hybrid => "isolux by default; there was none like it in the study",
        System::Forward => "Inspirer 5.30 of the study",
        System::ForwardUnfiltered => "Inspirer 5.30 without filter",
        System::Radiosity => "LVS 3.1.1 of the study, but with specular exchange",
        System::RadiosityWithoutAmbient => {
            "LVS 3.1.1 without ambient term, but with specular exchange"
        }
        System::RadiosityDiffuse => "LVS 3.1.1 of the study",
        System::Cache => "Radiance, which the study leaves out",
        System::Radiance => "itself",
        System::Mitsuba | System::LuxCore => "itself; there was none like it in the study",
    }
}
