//! Wavefront OBJ geometry with MTL materials.
//!
//! OBJ names no unit and no axis: lengths are read as metres and +y as up (a `scene.toml` that
//! refers to the file can say otherwise). MTL was made for pictures; what of it has a photometric
//! meaning is read as follows, and the rest is left out with a warning.
//!
//! | MTL | is read as |
//! |---|---|
//! | `Kd` | diffuse reflectance (linear), times `map_Kd` where given |
//! | `Ke` | luminance in cd/m2, from both sides |
//! | `Ks` with `illum` 3 or 5 | mirror reflectance, as far as `Kd` leaves room |
//! | `illum` 6, 7 | solid glass of index `Ni`, transmitting `Tf` |
//! | `illum` 4, 9, or `d` below 1 | a thin pane transmitting `Tf`, or else `1 - d` |
//!
//! Colours may be given as `xyz`; as `spectral` they are left out, as is every other line that says nothing here, with a warning.
//! Colours of vertices are read as reflectance of faces without a material, only where a `scene.toml` asks for them.
//!
//! What would make most coloured surfaces of a file invisible by this letter is read as opaque, with a
//! warning, because no writer means it; `meaning.rs` says what. A library that is missing is looked for
//! in other cases of letters, and then under the name of the OBJ file.
//!
//! Surfaces reflect on both sides, because orientation in OBJ files is not to be relied on; of faces
//! with the same corners and material one is kept.

mod copies;
mod libraries;
mod lines;
mod material;
mod meaning;
mod mtl;
mod paint;
mod parse;
mod reading;
mod record;
mod resolve;

use crate::findings::Findings;
use crate::{Loaded, Problems, Reach, counted, source};
use isolux::scene::SceneParts;
pub use meaning::Materials;
pub(crate) use reading::Reading;
use std::path::Path;

const MOST_BYTES: u64 = 1 << 30;

/// Reads an OBJ file and the materials and textures it names, which must lie in its directory tree.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    read_with(path, Materials::AsMeant, Reach::Inside)
}

/// Reads an OBJ file and its materials as meant or as written, and the files that it may name.
pub fn read_with(
    path: &Path,
    materials: Materials,
    reach: Reach,
) -> Result<Loaded<SceneParts>, Problems> {
    let alone = Reading {
        unit_is_known: false,
        is_replaced: &|_| false,
        materials,
        vertex_colours: false,
        reach,
    };
    read_as(path, &alone)
}

/// Reads an OBJ file of which something is known.
pub(crate) fn read_as(path: &Path, reading: &Reading) -> Result<Loaded<SceneParts>, Problems> {
    let text = source::read_text(path, MOST_BYTES)?;
    let mut findings = Findings::new(path);
    let file = parse::parse(&text, &mut findings);
    drop(text);
    tell_of_colours(&file, reading, &mut findings);
    let materials = material::read_libraries(&file, reading, &mut findings);
    if findings.has_problems() {
        return findings.finish(SceneParts::default());
    }
    if !reading.unit_is_known {
        resolve::warn_of_units(&file, &mut findings);
    }
    let parts = resolve::resolve(&file, materials, reading, &mut findings);
    findings.finish(parts)
}

/// A warning of colours that nobody asks for, or a problem where there are none of those asked for.
fn tell_of_colours(file: &record::ObjFile, reading: &Reading, findings: &mut Findings) {
    match (file.colours.count, reading.vertex_colours) {
        (0, true) => {
            findings.problem("", "its vertices have no colours", "remove `vertex_colours`");
        }
        (1.., false) => {
            let vertices = counted(file.colours.count, "vertex", "vertices");
            let what = format!("the colours of {vertices} are not used");
            let remedy = "to read them as diffuse reflectance of faces without a material, refer to the file from a \
                          scene.toml with `vertex_colours = true`";
            findings.warning(lines::place(file.colours.first_line), what, remedy);
        }
        _ => {}
    }
}
