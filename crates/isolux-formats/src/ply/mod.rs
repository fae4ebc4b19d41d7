//! PLY geometry, of text or binary in both byte orders.
//!
//! Of the elements `vertex`, `face` and `tristrips` the usual properties are read: places, normals,
//! texture coordinates, colours, lists of corners. Faces may be concave. All others are stepped over
//! with a warning. PLY names no unit, no axis and no material: lengths are read as metres, +z as up,
//! and surfaces as grey 0.5 on both sides, unless a `scene.toml` that refers to the file says
//! otherwise. Colours of vertices are read as diffuse reflectance only where it asks for them.
//!
//! The reader is our own: files are taken as hostile, and messages name line, vertex or face.

mod body;
mod faces;
mod header;
mod record;
mod resolve;
mod vertices;

use crate::bare::{self, Kind, Reading};
use crate::findings::Findings;
use crate::{Loaded, Problem, Problems, source};
use isolux::scene::SceneParts;
use std::path::Path;

const MOST_BYTES: u64 = 1 << 30;

/// Reads a PLY file.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    read_as(path, &bare::ALONE)
}

/// Reads a PLY file of which something is known.
pub(crate) fn read_as(path: &Path, reading: &Reading) -> Result<Loaded<SceneParts>, Problems> {
    let mut contents = source::read_bytes(path, MOST_BYTES)?;
    if source::is_utf16(&contents) {
        contents = source::decoded(contents).into_bytes();
    }
    let bytes = source::without_mark(&contents);
    let mut findings = Findings::new(path);
    let mesh = match header::parse(bytes) {
        Ok((header, start)) => record::parse(&header, &bytes[start..], &mut findings),
        Err(wrong) => Err(wrong),
    };
    drop(contents);
    let mesh = match mesh {
        Ok(mesh) => mesh,
        Err(wrong) => {
            let remedy = "copy or export it again";
            return Err(Problem::new(path, wrong.place, wrong.what, remedy).into());
        }
    };
    let part = resolve::part(mesh, reading, &mut findings);
    if findings.has_problems() {
        return findings.finish(SceneParts::default());
    }
    let scene = bare::scene(vec![part], &Kind("PLY"), reading, &mut findings);
    findings.finish(scene)
}
