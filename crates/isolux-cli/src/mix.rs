//! `isolux mix`: luminaires re-dimmed without a new run.

use crate::claim::Claim;
use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::MixFlags;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::report::Report;
use crate::shown::names;
use crate::{groups, map_file};
use isolux::engine::{MixError, MixPart, mix};
use isolux::map::{IlluminationMap, MixedPart};
use isolux::scene::Scene;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// More than so many times its light nobody gives to what is there.
const BRIGHT: f64 = 5.0;

/// Runs the subcommand.
pub(crate) fn run(flags: &MixFlags, json: bool) -> Result<Outcome, Failure> {
    let started = Instant::now();
    let output = OutputPath::check(&flags.output, "glb")?;
    let mut read = Vec::new();
    for asked in &flags.maps {
        warn_if_bright(&asked.path.display().to_string(), asked.dimming);
        read.extend(parts_of(&asked.path, asked.dimming)?);
    }
    for (name, dimming) in &flags.dim {
        warn_if_bright(name, *dimming);
        dim(&mut read, name, *dimming)?;
    }
    for part in &read {
        output.differs_from(&part.path)?;
    }
    let parts: Vec<MixPart<'_>> = read.iter().map(Part::asked).collect();
    let _claim = Claim::of(&output)?;
    let (scene, map) = mix(&parts).map_err(|error| failure(&error, &read))?;
    map_file::write(&output, &scene, &map)?;
    let report = Report::of((&scene, &map), started.elapsed().as_secs_f64(), &output);
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(Outcome::Done)
}

/// Says so where light becomes so many times what it was that a per cent sign may have been forgotten.
fn warn_if_bright(name: &str, dimming: f64) {
    if dimming > BRIGHT {
        let text = format!(
            "{name} is made {dimming} times as bright; {dimming} per cent of it is written {dimming}%"
        );
        note(Note::Warning, text);
    }
}

/// A map to add.
pub(crate) struct Part {
    path: PathBuf,
    /// The scene in it.
    pub(crate) scene: Scene,
    /// The map.
    pub(crate) map: IlluminationMap,
    /// What all of its light is multiplied by.
    pub(crate) dimming: f64,
}

impl Part {
    /// As the engine wants it.
    pub(crate) fn asked(&self) -> MixPart<'_> {
        MixPart { scene: &self.scene, map: &self.map, dimming: self.dimming }
    }
}

/// A map, or, of a sum of groups, the maps beside it that it was made of.
pub(crate) fn parts_of(path: &Path, dimming: f64) -> Result<Vec<Part>, Failure> {
    let (scene, map) = map_file::read(path)?;
    let mixed = &map.provenance.mixed;
    let is_beside = |part: &MixedPart| match &part.groups[..] {
        [group] => groups::path_of(path, group).exists(),
        _ => false,
    };
    if mixed.is_empty() || !mixed.iter().all(is_beside) {
        return Ok(vec![Part { path: path.to_owned(), scene, map, dimming }]);
    }
    let part = |part: &MixedPart| {
        let beside = groups::path_of(path, &part.groups[0]);
        let (scene, map) = map_file::read(&beside)?;
        if map.provenance.scene_hash != part.scene_hash || map.provenance.seed != part.seed {
            return Err(Failure::bad_input(format!(
                "{}: is not the map that {} was made of; solve again with --group, or name the maps of groups \
                 themselves",
                beside.display(),
                path.display()
            )));
        }
        Ok(Part { path: beside, scene, map, dimming: dimming * part.dimming })
    };
    mixed.iter().map(part).collect()
}

/// Dims the parts that hold the light of a group.
fn dim(parts: &mut [Part], group: &str, dimming: f64) -> Result<(), Failure> {
    let mut found = false;
    for part in parts.iter_mut() {
        let groups = lit_groups(&part.scene);
        if !groups.iter().any(|name| name == group) {
            continue;
        }
        if groups.len() > 1 {
            return Err(Failure::bad_input(format!(
                "{}: holds the light of several groups ({}), which cannot be dimmed apart; solve with --group",
                part.path.display(),
                names(groups.iter().map(String::as_str))
            )));
        }
        part.dimming *= dimming;
        found = true;
    }
    if found {
        return Ok(());
    }
    let mut known: Vec<String> = parts.iter().flat_map(|part| lit_groups(&part.scene)).collect();
    known.sort_unstable();
    known.dedup();
    let known = match known.is_empty() {
        true => "no groups".to_owned(),
        false => names(known.iter().map(String::as_str)),
    };
    Err(Failure::bad_input(format!(
        "--dim {group}: no map has the light of that group; there are {known}"
    )))
}

/// The groups whose light a scene has.
pub(crate) fn lit_groups(scene: &Scene) -> Vec<String> {
    let shines = |group: u32| group == 0 && !scene.area_luminaires().is_empty();
    let is_lit = |group: u32| shines(group) || scene.luminaires().iter().any(|l| l.group == group);
    let names = scene.groups().iter().enumerate();
    names.filter(|(k, _)| is_lit(*k as u32)).map(|(_, name)| name.clone()).collect()
}

/// What is wrong with maps that cannot be added.
pub(crate) fn failure(error: &MixError, parts: &[Part]) -> Failure {
    let (number, remedy) = match error {
        MixError::Surfaces(k) => (*k, "add maps of one scene in different light"),
        MixError::Method(k) => (*k, "solve all of them by one method"),
        MixError::Stale(k) => (*k, "solve it again"),
        _ => return Failure::bad_input(format!("{error}; leave light on")),
    };
    Failure::bad_input(format!("{}: {error}; {remedy}", parts[number].path.display()))
}
