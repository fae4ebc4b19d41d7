//! glTF 2.0 scenes (`.gltf`, `.glb`).
//!
//! What becomes of each part of a file, with formulas and sources, is in the `README.md` of this
//! folder. Files are taken as hostile: memory and time are bounded before a number is believed, and
//! only files beside the scene are opened.

mod accessor;
mod buffers;
mod cameras;
mod coats;
mod compression;
mod container;
mod draco;
mod extensions;
mod finish;
mod glass;
mod ies_profile;
mod instances;
mod limits;
mod luminaires;
mod material;
mod meshes;
mod meshopt;
mod morph;
mod nodes;
mod notes;
mod opened;
mod orientation;
mod pictures;
mod placeholders;
mod primitive;
mod punctual;
mod reading;
mod record;
mod shown;
mod skin;
mod specular_gloss;
mod surfaces;
mod surroundings;
mod texcoord;
mod thinned;
mod topology;
mod unpacked;
mod uri;

use crate::extent::{IMPLAUSIBLE_EXTENT_M, largest_side_m};
use crate::source::read_bytes;
use crate::{Loaded, Problems, Reach};
use buffers::Document;
use container::Container;
pub(crate) use draco::NAME as DRACO;
use gltf_json::Root;
pub(crate) use instances::NAME as INSTANCES;
use isolux::scene::{SceneParts, Shape, UpAxis};
pub(crate) use meshes::Origin;
pub(crate) use meshopt::NAMES as MESHOPT_NAMES;
use nodes::Placed;
use notes::{Flaw, Notes};
pub(crate) use opened::{Elements, Opened};
use std::path::Path;
use surfaces::Surfaces;
use uri::Folder;

/// What is asked of a file beyond what it says.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Reading {
    /// Whether its unit of length is known, so that its size surprises nobody.
    pub(crate) unit_is_known: bool,
    /// Luminance of white in unlit materials, cd/m2; without it they are taken as diffuse.
    pub(crate) unlit_luminance_cd_m2: Option<f64>,
    /// Which files it may name.
    pub(crate) reach: Reach,
}

/// Reads the default scene of a file; on failure, all problems that could be found.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    read_as(path, Reading::default())
}

/// Reads the default scene of a file and the files that it may name.
pub fn read_with(path: &Path, reach: Reach) -> Result<Loaded<SceneParts>, Problems> {
    read_as(path, Reading { reach, ..Reading::default() })
}

/// Reads a file of which something is asked.
pub(crate) fn read_as(path: &Path, reading: Reading) -> Result<Loaded<SceneParts>, Problems> {
    let mut notes = Notes::new(path);
    let bytes = read_bytes(path, limits::BUFFER_BYTES)?;
    let container = or_fail(container::open(&bytes), &mut notes)?;
    let (document, placed) = open((path, reading.reach), &container, &mut notes)?;
    let (value, _) = resolve(&document, &placed, (path, reading), &mut notes);
    notes.check()?;
    Ok(Loaded { value, warnings: notes.into_warnings() })
}

/// The file as written, with its data unpacked, and the nodes of its scene.
fn open<'a>(
    (path, reach): (&Path, Reach),
    container: &Container<'a>,
    notes: &mut Notes,
) -> Result<(Document<'a>, Vec<Placed>), Problems> {
    let root = or_fail(record::parse(container.json), notes)?;
    extensions::check(&root, notes);
    let placed = nodes::place(&root, notes);
    let mut document = Document::load(root, Folder::of(path, reach), container.binary, notes);
    notes.check()?;
    compression::unpack(&mut document, notes);
    notes.check()?;
    Ok((document, placed))
}

fn or_fail<T>(result: Result<T, Flaw>, notes: &mut Notes) -> Result<T, Problems> {
    match notes.accept(result) {
        Some(value) => Ok(value),
        None => Err(notes.take_problems()),
    }
}

/// From the file as written to the scene and where its shapes come from, with what cannot be resolved noted.
fn resolve(
    document: &Document,
    placed: &[Placed],
    (path, reading): (&Path, Reading),
    notes: &mut Notes,
) -> (SceneParts, Vec<Origin>) {
    let mut surfaces = Surfaces::new(document, reading.unlit_luminance_cd_m2);
    let (origins, shapes): (Vec<Origin>, Vec<Shape>) =
        meshes::shapes(document, placed, &mut surfaces, notes).into_iter().unzip();
    let largest_m = largest_side_m(&shapes);
    if largest_m > IMPLAUSIBLE_EXTENT_M && !reading.unit_is_known {
        notes.warn(Flaw::new(
            format!("glTF is in metres; so read, it is {largest_m:.0} m large"),
            "if it was exported in another unit, scale its root node, or set the unit at the export",
        ));
    }
    let mut luminaires = luminaires::luminaires(document, placed, notes);
    luminaires.extend(surroundings::surroundings(document, &mut surfaces, notes));
    let cameras = cameras::cameras(document, placed, notes);
    let (materials, textures) = surfaces.into_parts();
    let parts = SceneParts {
        name: scene_name(&document.root, path),
        up: UpAxis::Y,
        shapes,
        materials,
        textures,
        luminaires,
        fittings: Vec::new(),
        maintenance: None,
        groups: Vec::new(),
        cameras,
        grids: Vec::new(),
    };
    (parts, origins)
}

/// The name of the scene, else of the file.
fn scene_name(root: &Root, path: &Path) -> String {
    let scene = root.scene.and_then(|scene| root.scenes.get(scene.value()));
    let of_file = || path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    scene.and_then(|scene| scene.name.clone()).unwrap_or_else(of_file)
}
