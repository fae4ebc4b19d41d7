//! What users should know of a scene with its light baked in.

use super::options::Options;
use super::references::{has_extension, list};
use crate::gltf::{DRACO, INSTANCES, MESHOPT_NAMES, Opened};
use crate::{Problem, counted};
use serde_json::Value;

/// Extensions of nodes that are luminaires.
pub(super) const LIGHTS: [&str; 2] = ["KHR_lights_punctual", "EXT_lights_ies"];

/// Extensions of primitives that do not count on the order of vertices.
const OF_PRIMITIVES: [&str; 4] =
    [DRACO, "KHR_materials_variants", "EXT_mesh_features", "EXT_structural_metadata"];

type Warn<'a> = dyn FnMut(&str, String, &str) + 'a;

/// All of it.
pub(super) fn of(opened: &Opened, others: usize, options: Options) -> Vec<Problem> {
    let mut found = Vec::new();
    let mut warn = |place: &str, what: String, remedy: &str| {
        found.push(opened.problem(place, what, remedy));
    };
    of_light(&opened.json, (others, options), &mut warn);
    of_geometry(&opened.json, &mut warn);
    found
}

/// What is lit otherwise than one may think.
fn of_light(document: &Value, (others, options): (usize, Options), warn: &mut Warn<'_>) {
    let is_light = |node: &&Value| {
        LIGHTS.iter().any(|name| node.get("extensions").is_some_and(|e| e.get(*name).is_some()))
    };
    let lights = list(document, "nodes").filter(is_light).count();
    if lights > 0 && !options.without_lights {
        let what = format!(
            "{}, with light that is in the lightmap, too: who shows both shows it twice",
            counted(lights, "luminaire stays", "luminaires stay")
        );
        warn("", what, "switch them off there, or add --without-lights");
    }
    if others > 0 {
        let others = counted(others, "triangle", "triangles");
        let what = format!(
            "the map has {others} besides those of this file: of other files, or taken out since"
        );
        warn("", what, "solve the scene anew if something was taken out, as it is in the light");
    }
    let has = |key: &str, wanted: &dyn Fn(&Value) -> bool| {
        list(document, "materials").any(|m| m.get(key).is_some_and(wanted))
    };
    if has("doubleSided", &|value| value == true) {
        let what = "surfaces of doubleSided materials are there once for each side, as each has light of its own";
        warn(
            "materials",
            what.to_owned(),
            "make those one-sided of which the back is never seen, and solve again",
        );
    }
    if has("occlusionTexture", &|_| true) {
        let what = "occlusion maps darken the lightmap, which has their shadows already";
        warn("materials", what.to_owned(), "switch them off there (three.js: aoMapIntensity = 0)");
    }
    if list(document, "nodes").any(|node| node.get("skin").is_some()) {
        let what = "skins keep the light of the pose in the file when they move".to_owned();
        warn("nodes", what, "light what moves in the engine");
    }
}

/// What is stored otherwise than it was.
fn of_geometry(document: &Value, warn: &mut Warn<'_>) {
    if has_extension(document, INSTANCES) {
        let what = format!("copies of {INSTANCES} become nodes, as each has light of its own");
        warn("nodes", what, "keep in mind that the file becomes larger");
    }
    let primitives = list(document, "meshes").flat_map(|mesh| list(mesh, "primitives"));
    let extensions = primitives.filter_map(|p| p.get("extensions")?.as_object());
    if let Some(name) =
        extensions.flat_map(|e| e.keys()).find(|name| !OF_PRIMITIVES.contains(&name.as_str()))
    {
        let what =
            format!("{name} of primitives stays as it is, though their vertices are others now");
        warn("meshes", what, "look whether it still serves");
    }
    if MESHOPT_NAMES.into_iter().chain([DRACO]).any(|name| has_extension(document, name)) {
        let what = "compressed geometry is stored unpacked".to_owned();
        warn("", what, "compress the new file again, say by `gltf-transform`");
    }
}
