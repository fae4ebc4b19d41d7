//! The analytic cases of CIE 171:2006.

use super::systems;
use crate::case::cie171::left_out;
use crate::report::document::{Block, Column, Group, Section, Table, numbers, words};
use crate::report::quantity::{UNKNOWN, fixed, known, percent};
use crate::study::{Analytic, Found, Study, System};

/// Digits behind the point of illuminances in lux.
const OF_LUX: usize = 2;

/// What systems find; `None` where nothing was run.
pub(super) fn section(study: &Study) -> Option<Section> {
    let all = &study.analytic;
    let mut asked: Vec<System> =
        all.iter().flat_map(|case| &case.found).map(|found| found.system).collect();
    asked.sort_by_key(|&system| systems::number(system));
    asked.dedup();
    if asked.is_empty() {
        return None;
    }
    let folded = vec![Block::Table(readings(all, &asked))];
    Some(Section {
        id: "cie171".to_owned(),
        title: "CIE 171:2006: the analytic cases".to_owned(),
        blocks: vec![
            Block::Text(HOW.to_owned()),
            Block::Table(worst(all, &asked)),
            Block::Folded("Every reading of these cases".to_owned(), folded),
            Block::Table(missing()),
        ],
    })
}

const HOW: &str = "The standard tests lighting programs by scenes whose illuminance can be derived. These cases follow its sections 5.2 to 5.14 [7]; rooms are \
                   its room of 4 m × 4 m × 3 m where that is known, and every right value is derived anew, in closed form or by quadrature. Each system is asked \
                   for 0.5 % and has a few seconds; other renderers make one good effort. An accuracy is that of a whole scene: dim places, as those that a bright ground \
                   outside lights, may err by more, as their standard errors show (every reading, below). Light that comes straight from lamps and skies is \
                   read alike by all systems of isolux. “isolux validate --case NAME” judges every reading by its standard error.";

/// The greatest relative difference of each.
fn worst(all: &[Analytic], asked: &[System]) -> Table {
    let row = |case: &Analytic| {
        let places = case.expected_lx.len().to_string();
        let first = [format!("{} {}", case.number, case.title), case.name.clone(), places];
        let cells = asked.iter().map(|&system| {
            known(of(case, system).and_then(|found| found.worst(&case.expected_lx)), percent)
        });
        first.into_iter().chain(cells).collect()
    };
    let systems = asked.iter().map(|system| numbers(system.title()));
    let columns: Vec<Column> =
        [words("Case"), words("Name"), numbers("Places")].into_iter().chain(systems).collect();
    let caption = "The greatest relative difference from the right values, %";
    Table::plain(caption, columns, all.iter().map(row).collect())
}

/// All values.
fn readings(all: &[Analytic], asked: &[System]) -> Table {
    let group = |case: &Analytic| {
        let row = |(place, right_lx): (usize, &f64)| {
            let cells = asked.iter().map(|&system| {
                of(case, system).map_or_else(|| UNKNOWN.to_owned(), |found| read(found, place))
            });
            let first = [(place + 1).to_string(), fixed(*right_lx, OF_LUX)];
            first.into_iter().chain(cells).collect()
        };
        Group {
            title: Some(case.name.clone()),
            rows: case.expected_lx.iter().enumerate().map(row).collect(),
        }
    };
    let systems = asked.iter().map(|system| numbers(system.title()));
    Table {
        caption: "Illuminance, lx, with standard errors as reported".to_owned(),
        columns: [numbers("Place"), numbers("Right value")].into_iter().chain(systems).collect(),
        groups: all.iter().map(group).collect(),
    }
}

fn read(found: &Found, place: usize) -> String {
    let Some(lx) = found.values_lx.get(place).copied().flatten() else {
        return UNKNOWN.to_owned();
    };
    let error = found.standard_errors_lx.get(place).copied().flatten();
    let error = error.map(|error| format!(" ± {}", fixed(error, OF_LUX)));
    format!("{}{}", fixed(lx, OF_LUX), error.unwrap_or_default())
}

fn of(case: &Analytic, system: System) -> Option<&Found> {
    case.found.iter().find(|found| found.system == system)
}

fn missing() -> Table {
    let row = |of: &crate::case::cie171::LeftOut| {
        [of.number, of.part, of.reason].map(str::to_owned).to_vec()
    };
    Table::plain(
        "What of these sections is not here",
        ["Section", "Part", "Why"].map(words).to_vec(),
        left_out().iter().map(row).collect(),
    )
}
