//! STL geometry, of text or binary.
//!
//! STL names no unit, no axis and no material: lengths are read as metres, +z as up, and surfaces as
//! grey 0.5 on both sides, unless a `scene.toml` that refers to the file says otherwise. In it each
//! solid is a part, to which a material is assigned by its name. Corners at the same place are one
//! vertex. The front of a facet is where its corners turn counter-clockwise; where the normal written
//! beside them disagrees, a warning says so.
//!
//! The reader is our own: files are taken as hostile, and messages name line or triangle.

mod binary;
mod record;
mod resolve;
mod text;

use crate::bare::{self, Kind, Reading};
use crate::findings::Findings;
use crate::{Loaded, Problems, source};
use isolux::scene::SceneParts;
use std::path::Path;

const MOST_BYTES: u64 = 1 << 30;

/// Reads an STL file.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    read_as(path, &bare::ALONE)
}

/// Reads an STL file of which something is known.
pub(crate) fn read_as(path: &Path, reading: &Reading) -> Result<Loaded<SceneParts>, Problems> {
    let bytes = source::read_bytes(path, MOST_BYTES)?;
    let mut findings = Findings::new(path);
    let solids = if binary::is_binary(&bytes) {
        binary::parse(&bytes, &mut findings)
    } else {
        text::parse(&source::decoded(bytes), &mut findings)
    };
    if findings.has_problems() {
        return findings.finish(SceneParts::default());
    }
    let parts = resolve::parts(solids, &mut findings);
    let scene = bare::scene(parts, &Kind("STL"), reading, &mut findings);
    findings.finish(scene)
}
