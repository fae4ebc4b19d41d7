//! What has to hold on calculation grids.

use super::context::Context;
use super::record::RequirementRecord;
use super::spans::At;
use crate::requirement::requirement;
use isolux::scene::{Requirement, SceneParts};

/// The most requirements of all grids together: those without a name are for every grid.
const MOST_REQUIREMENTS: usize = 100_000;

/// Adds all requirements of the file to the grids that they are for.
pub(super) fn add(
    entries: &[At<RequirementRecord>],
    scene: &mut SceneParts,
    context: &mut Context,
) {
    let mut left = MOST_REQUIREMENTS;
    for entry in entries {
        let record = entry.get_ref();
        let found = read(entry, context);
        let is_named =
            |name: &String| record.grid.as_ref().is_none_or(|grid| grid.get_ref() == name);
        let mut is_for_none = true;
        for grid in scene.grids.iter_mut().filter(|grid| is_named(&grid.name)) {
            is_for_none = false;
            let Some(rest) = left.checked_sub(found.len()) else {
                let what =
                    format!("more than {MOST_REQUIREMENTS} requirements of all grids together");
                return context.problem(&entry.span(), what, "name the `grid` that each is for");
            };
            left = rest;
            grid.requirements.extend(found.iter().cloned());
        }
        if is_for_none && !context.has_problems() {
            let (span, what) = match &record.grid {
                Some(grid) => (grid.span(), format!("there is no grid `{}`", grid.get_ref())),
                None => (entry.span(), "the scene has no grid to require something of".to_owned()),
            };
            context.problem(&span, what, "name a [[grid]] of this file");
        }
    }
}

fn read(entry: &At<RequirementRecord>, context: &mut Context) -> Vec<Requirement> {
    let record = entry.get_ref();
    if record.task.is_none() && record.conditions.is_none() {
        let what = "a requirement without `task` and `conditions`";
        context.problem(&entry.span(), what, "give one: conditions = \"Em >= 500, U0 >= 0.6\"");
    }
    let mut found = Vec::new();
    for (text, is_task) in [(&record.task, true), (&record.conditions, false)] {
        let Some(text) = text else { continue };
        let is_right = text.get_ref().trim_start().starts_with("EN ") == is_task;
        let read = match is_right {
            true => requirement(text.get_ref()),
            false if is_task => {
                Err("a task is a row of a standard; write `EN 12464-1 34.2`".into())
            }
            false => Err("conditions are bounds; a row of a standard is a `task`".into()),
        };
        match read {
            Ok(requirement) => found.push(requirement),
            Err(what) => {
                let (what, remedy) = what.split_once("; ").unwrap_or((&what, "write it so"));
                context.problem(&text.span(), what.to_owned(), remedy.to_owned());
            }
        }
    }
    found
}
