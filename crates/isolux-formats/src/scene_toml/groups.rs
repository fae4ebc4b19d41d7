//! Light groups by name.

use super::record::SceneFile;
use isolux::scene::{Luminaire, SceneParts};
use std::collections::HashMap;

/// A luminaire and the name of its group.
pub(super) type Grouped = (Option<String>, Luminaire);

/// The group of light that names none.
const UNGROUPED: &str = "ungrouped";

/// Light groups by name. Without any named group there is no list at all.
#[derive(Debug, Default)]
pub(super) struct Groups {
    pub(super) names: Vec<String>,
    index_of: HashMap<String, u32>,
}

impl Groups {
    /// The declared groups, after one for light without group if there is such light.
    pub(super) fn new(file: &SceneFile, scene: &SceneParts) -> Self {
        let mut groups = Self::default();
        let of_luminaires = file.luminaires.iter().map(|l| l.get_ref().group.as_deref());
        let of_sky = file.sky.iter().flat_map(|sky| sky.get_ref().groups());
        let names: Vec<Option<&str>> = of_luminaires.chain(of_sky).collect();
        let any_named = !file.groups.is_empty() || names.iter().any(Option::is_some);
        if any_named && (names.contains(&None) || shines_without_group(scene)) {
            groups.index(UNGROUPED);
        }
        for group in &file.groups {
            groups.index(group.name.get_ref());
        }
        groups
    }

    /// Adds luminaires that were made elsewhere, each to its group.
    pub(super) fn put(&mut self, made: Vec<Grouped>, luminaires: &mut Vec<Luminaire>) {
        luminaires.extend(made.into_iter().map(|(name, luminaire)| {
            let group = name.map_or(0, |name| self.index(&name));
            Luminaire { group, ..luminaire }
        }));
    }

    pub(super) fn index(&mut self, name: &str) -> u32 {
        if let Some(&known) = self.index_of.get(name) {
            return known;
        }
        let index = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.index_of.insert(name.to_owned(), index);
        index
    }
}

/// Whether there is light already, which no group was said of.
fn shines_without_group(scene: &SceneParts) -> bool {
    !scene.luminaires.is_empty() || scene.shapes.iter().any(|shape| emits(scene, shape.material))
}

/// Adds luminaires to a finished scene, and their groups to its groups.
pub(super) fn put(parts: &mut SceneParts, made: Vec<Grouped>) {
    let mut groups = Groups::default();
    for name in &parts.groups {
        groups.index(name);
    }
    let (any_named, any_unnamed) =
        (made.iter().any(|(name, _)| name.is_some()), made.iter().any(|(name, _)| name.is_none()));
    let is_first = groups.names.is_empty();
    if any_named && is_first && (any_unnamed || shines_without_group(parts)) {
        groups.index(UNGROUPED);
    }
    // Where there are groups already, light without one goes where such light goes.
    let other = (!is_first && any_unnamed).then(|| groups.index(UNGROUPED));
    let first = parts.luminaires.len();
    groups.put(made.clone(), &mut parts.luminaires);
    for ((name, _), luminaire) in made.iter().zip(&mut parts.luminaires[first..]) {
        luminaire.group = if name.is_none() { other.unwrap_or(0) } else { luminaire.group };
    }
    parts.groups = groups.names;
}

fn emits(scene: &SceneParts, material: u32) -> bool {
    let Some(material) = scene.materials.get(material as usize) else { return false };
    [false, true].iter().any(|&back| material.finish(back).is_some_and(|f| f.is_emitter()))
}
