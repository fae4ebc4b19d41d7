//! Pictures of where last maps err.

use super::folder::Folder;
use super::kept;
use super::pictures::Viewer;
use super::plan::Case;
use crate::failure::Failure;
use crate::render;
use isolux_compare::Readings;
use isolux_compare::study::{CaseStudy, Errors, Series, System, limit};
use isolux_view::{Size, differences};
use std::collections::BTreeMap;

/// Pictures of few cells are enlarged to about so many pixels a side.
const SIDE: u32 = 320;

/// Where a map errs.
pub(crate) enum Wrong {
    /// As it was found; `None` where nothing is known.
    Known(Option<Errors>),
    /// To be found of a map that was kept under this name.
    Kept(String),
}

/// Draws the errors of all last maps with the same colours: of the right values where they are known, else of the map of the reference.
pub(crate) fn tell(
    study: &mut CaseStudy,
    last: &BTreeMap<System, Wrong>,
    (case, viewer): (&Case, Option<&Viewer>),
    folder: &Folder,
) -> Result<(), Failure> {
    let found = |series: &Series| match last.get(&series.system) {
        Some(Wrong::Known(errors)) => Ok(errors.clone()),
        Some(Wrong::Kept(stem)) => of(stem, (case, viewer), folder),
        None => Ok(None),
    };
    let all = study.series.iter().map(found).collect::<Result<Vec<_>, Failure>>()?;
    let known: Vec<Errors> = all.iter().flatten().cloned().collect();
    let Some(limit) = limit(&known) else { return Ok(()) };
    study.error_limit = Some(limit);
    for (series, errors) in study.series.iter_mut().zip(&all) {
        let Some(errors) = errors else { continue };
        let name = format!("pictures/{}-{}-errors.png", case.stem(), series.system.name());
        let size = Size::new(errors.width, errors.height).map_err(Failure::bad_input)?;
        let drawn = differences(size, &errors.shares, limit)
            .and_then(|drawn| drawn.enlarged((SIDE / errors.width).max(1)))
            .map_err(Failure::bad_input)?;
        render::write(&folder.output(&name, "png")?, &drawn)?;
        series.error_picture = Some(name);
    }
    Ok(())
}

fn of(
    stem: &str,
    (case, viewer): (&Case, Option<&Viewer>),
    folder: &Folder,
) -> Result<Option<Errors>, Failure> {
    let (scene, map) = kept::map(folder, stem)?;
    match viewer {
        None => {
            let readings = Readings::of_map(&case.name, &scene, &map).and_then(Result::ok);
            Ok(readings.and_then(|readings| Errors::of(&case.name, &readings)))
        }
        Some(viewer) => viewer.errors(&scene, &map).map(Some),
    }
}
