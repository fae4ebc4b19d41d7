//! A scene that others have made, written again with a lightmap: the same glTF document, to which vertices are added where
//! charts part, places in the lightmap, and its pages.
//!
//! Lists of the document keep their order, so that numbers in extensions that nobody here knows stay right: new things follow
//! the old, or take the place of what they replace.

mod corners;
mod error;
mod groups;
mod links;
mod matching;
mod materials;
mod options;
mod origins;
mod placing;
mod references;
mod store;
mod vertices;
mod warnings;
mod written;

use crate::gltf::Opened;
use crate::lightmap::Target;
use crate::map_glb::TexelFile;
use crate::{Loaded, Problem, Problems};
pub use error::OntoError;
use isolux::elements::carries_map;
use isolux::scene::Scene;
use matching::Matched;
pub use options::Options;
use references::list;
use std::path::Path;

/// A scene as somebody's file has it, found in the scene of a map.
pub struct Onto {
    opened: Opened,
    matched: Matched,
    /// The set of texture coordinates that is to be that of the lightmap.
    set: u32,
    options: Options,
}

impl Onto {
    /// Opens a glTF file of which a map was made, to write it for a target; refused is what is known to fail before anything is
    /// baked.
    pub fn open(
        path: &Path,
        scene: &Scene,
        (target, options): (Target, Options),
    ) -> Result<Loaded<Self>, Problems> {
        crate::source::check_present(path)?;
        let opened = Opened::open(path, options.reach)?;
        check_form(&opened)?;
        let matched = matching::find(&opened, scene)?;
        let set = set_of(&opened, &matched, (scene, target))?;
        let warnings = warnings::of(&opened, matched.others, options);
        Ok(Loaded { value: Self { opened, matched, set, options }, warnings })
    }

    /// The bytes of the `.glb`. The same file and lightmap give the same bytes.
    pub fn write(&self, file: &TexelFile<'_>) -> Result<Vec<u8>, OntoError> {
        written::bytes((&self.opened, &self.matched), (self.set, self.options), file)
    }
}

/// The set of texture coordinates that is to be that of the lightmap.
fn set_of(
    opened: &Opened,
    matched: &Matched,
    (scene, target): (&Scene, Target),
) -> Result<u32, Problem> {
    let carries =
        |triangle: u32| [false, true].iter().any(|&back| carries_map(scene, triangle, back));
    let shapes = opened.shapes.iter().zip(&matched.triangles);
    let lit = shapes.filter(|(_, triangles)| triangles.iter().flatten().any(|&t| carries(t)));
    materials::set_of(opened, lit.map(|((origin, _), _)| *origin), target)
}

/// Whether all parts that may be changed are objects, as glTF wants: readers let lists pass for them.
fn check_form(opened: &Opened) -> Result<(), Problem> {
    const LISTS: [&str; 9] = [
        "accessors",
        "bufferViews",
        "buffers",
        "images",
        "materials",
        "meshes",
        "nodes",
        "samplers",
        "textures",
    ];
    let wrong = |place: String| opened.problem(place, "is no object", "export the file again");
    for name in LISTS {
        for (index, value) in list(&opened.json, name).enumerate() {
            let place = format!("{name}[{index}]");
            let parts = list(value, "primitives")
                .flat_map(|p| std::iter::once(p).chain(list(p, "targets")));
            if !value.is_object() || parts.into_iter().any(|part| !part.is_object()) {
                return Err(wrong(place));
            }
        }
    }
    match opened.json.get("extras") {
        Some(extras) if !extras.is_object() => {
            let what = "is no object, so that nothing can be noted there";
            Err(opened.problem("extras", what, "make it an object, or remove it"))
        }
        _ => Ok(()),
    }
}
