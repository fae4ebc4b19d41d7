//! From a file to a scene and its map.

use super::arrays::{self, Arrays};
use super::bytes::View;
use super::container;
use super::record::{self, Record, VERSIONS};
use super::{Fault, lightmap_arrays, scene_arrays, value_arrays};
use crate::{Loaded, Problem, Problems, source};
use isolux::lightmap::Lightmap;
use isolux::map::{IlluminationMap, Provenance};
use isolux::scene::{Scene, SceneParts, SceneProblem};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Longest file that can be a map: the container counts in 32 bits.
const MOST_BYTES: u64 = u32::MAX as u64;
const DAMAGED: &str = "does not match its checksum: the file was damaged or written anew";
const REMEDY: &str = "compute the map again, or take an unchanged copy of it";
const NOT_A_MAP_REMEDY: &str = "solve it first, or take the file that `solve` wrote";

/// All of a map file.
#[derive(Clone, Debug)]
pub struct MapFile {
    /// The scene.
    pub scene: Scene,
    /// Its map.
    pub map: IlluminationMap,
    /// The same as texels, if it was baked.
    pub lightmap: Option<Lightmap>,
}

/// Reads a map and its scene. Files of any origin are safe to read; one that another program has
/// written anew is recognized by its checksum and refused.
pub fn read(path: &Path) -> Result<Loaded<(Scene, IlluminationMap)>, Problems> {
    let MapFile { scene, map, .. } = file(path, false)?;
    Ok(Loaded { value: (scene, map), warnings: Vec::new() })
}

/// The same with its texels, if it has any.
pub fn read_with_texels(path: &Path) -> Result<Loaded<MapFile>, Problems> {
    Ok(Loaded { value: file(path, true)?, warnings: Vec::new() })
}

fn file(path: &Path, with_texels: bool) -> Result<MapFile, Problems> {
    let problem = |fault: Fault| Problem::new(path, fault.place, fault.what, REMEDY);
    source::check_present(path)?;
    let bytes = contents(path).map_err(|error| Problem::unreadable(path, &error))?;
    if !bytes.starts_with(container::MAGIC) {
        let what = "is no illumination map: it is not a binary glTF file";
        return Err(Problem::new(path, "", what, NOT_A_MAP_REMEDY).into());
    }
    let chunks = container::unpack(&bytes).map_err(|what| problem(Fault::new("", what)))?;
    check_version(path, chunks.json)?;
    let document: Document<Extras<&RawValue>> = serde_json::from_slice(chunks.json)
        .map_err(|error| problem(Fault::new("JSON chunk", error.to_string())))?;
    let Extras { isolux: record, isolux_blake3 } = document.extras;
    // Maps of before have no checksum of their record.
    if isolux_blake3.is_some_and(|expected| expected != record::checksum(record)) {
        return Err(problem(Fault::new("extras.isolux", DAMAGED)).into());
    }
    let record: Record = serde_json::from_str(record.get())
        .map_err(|error| problem(Fault::new("extras.isolux", error.to_string())))?;
    let Record { arrays: table, arrays_blake3, scene, provenance, lightmap, .. } = record;
    let arrays = Arrays { binary: chunks.binary, views: &document.buffer_views, table: &table };
    check_sum(&arrays, &arrays_blake3).map_err(problem)?;
    let parts = scene_arrays::read(scene, &arrays).map_err(problem)?;
    let scene = assemble(path, parts)?;
    let map = map(&arrays, &scene, provenance).map_err(problem)?;
    let texels = lightmap.filter(|_| with_texels);
    let lightmap = texels.map(|record| lightmap_arrays::read(record, &arrays, &scene)).transpose();
    Ok(MapFile { lightmap: lightmap.map_err(problem)?, scene, map })
}

fn check_sum(arrays: &Arrays<'_>, expected: &str) -> Result<(), Fault> {
    let found = arrays::checksum(arrays.table, |view| arrays.view(view));
    if found.as_deref() == Some(expected) {
        return Ok(());
    }
    Err(Fault::new("extras.isolux.arrays", DAMAGED))
}

fn assemble(path: &Path, parts: SceneParts) -> Result<Scene, Problems> {
    Scene::assemble(parts).map_err(|found| {
        let problem = |p: SceneProblem| Problem::new(path, p.place.to_string(), p.what, p.remedy);
        Problems(found.into_iter().map(problem).collect())
    })
}

fn map(
    arrays: &Arrays<'_>,
    scene: &Scene,
    provenance: Provenance,
) -> Result<IlluminationMap, Fault> {
    let elements = value_arrays::read_elements(arrays, scene.triangle_count() as usize)?;
    let values = value_arrays::read_values(arrays, elements.vertices().len())?;
    Ok(IlluminationMap { elements, values, provenance })
}

/// Whether a file is a map and not a plain glTF scene; `false` where it cannot be read.
pub fn is_map(path: &Path) -> bool {
    notes(path).is_some_and(|notes| notes.contains_key("isolux"))
}

/// Whether a file was written by [`super::write_vertices`] or [`super::write_texels`] without a map in it: it can be
/// made again from its map.
pub fn is_export(path: &Path) -> bool {
    let has = |notes: &HashMap<String, IgnoredAny>, name: &str| notes.contains_key(name);
    notes(path).is_some_and(|notes| {
        !has(&notes, "isolux") && (has(&notes, "isolux_vertices") || has(&notes, "isolux_lightmap"))
    })
}

/// What a file has in `extras`, by name, be it there twice or not.
fn notes(path: &Path) -> Option<HashMap<String, IgnoredAny>> {
    let json = json_chunk(path).ok()?;
    serde_json::from_slice(&json).ok().map(|document: Document<_>| document.extras)
}

fn json_chunk(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = open(path)?;
    let mut prefix = [0; container::PREFIX_BYTES];
    file.read_exact(&mut prefix)?;
    let length = container::json_length(&prefix).map_err(io::Error::other)?;
    let mut json = Vec::new();
    file.take(length as u64).read_to_end(&mut json)?;
    Ok(json)
}

fn contents(path: &Path) -> io::Result<Vec<u8>> {
    let file = open(path)?;
    let length = file.metadata()?.len();
    if length > MOST_BYTES {
        return Err(io::Error::other(format!("{length} bytes are more than a .glb file can have")));
    }
    let mut bytes = Vec::with_capacity(length as usize);
    file.take(length).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn open(path: &Path) -> io::Result<File> {
    // A pipe or a device has no end that one could rely on.
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    File::open(path)
}

/// What is read of the document; the rest is for viewers.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Document<E> {
    #[serde(default)]
    buffer_views: Vec<View>,
    extras: E,
}

/// `extras` of a map.
#[derive(Deserialize)]
struct Extras<T> {
    isolux: T,
    #[serde(default, deserialize_with = "some")]
    isolux_blake3: Option<String>,
}

/// What is there, and is no `null`.
fn some<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    String::deserialize(from).map(Some)
}

/// What of `extras` tells the version.
#[derive(Deserialize)]
struct Versioned {
    isolux: Version,
}

#[derive(Deserialize)]
struct Version {
    format_version: u32,
}

fn check_version(path: &Path, json: &[u8]) -> Result<(), Problem> {
    let version = serde_json::from_slice::<Document<Versioned>>(json).map_err(|_| {
        let what = "is missing: this is no illumination map";
        Problem::new(path, "extras.isolux", what, NOT_A_MAP_REMEDY)
    })?;
    let found = version.extras.isolux.format_version;
    if VERSIONS.contains(&found) {
        return Ok(());
    }
    let (oldest, newest) = VERSIONS.into_inner();
    let what =
        format!("the map has format {found}; this version reads formats {oldest} to {newest}");
    let remedy = "use the version of isolux that wrote it, or compute the map again";
    Err(Problem::new(path, "extras.isolux.format_version", what, remedy))
}
