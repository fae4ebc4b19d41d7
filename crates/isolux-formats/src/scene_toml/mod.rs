//! `scene.toml`, the native scene description. Its keys are explained in `docs/book/scenes.md`.

mod aim;
mod cameras;
mod chromaticity;
mod context;
mod geometry;
mod grids;
mod import;
mod inline;
mod library;
mod luminaires;
mod materials;
mod orientation;
mod parse;
mod photometry;
mod placement;
mod quantity;
mod record;
mod resolve;
mod shapes;
mod spans;
mod sphere;
mod write;

use crate::{Loaded, Problem, Problems, source};
use isolux::scene::SceneParts;
use std::path::Path;

pub use write::{NamedPhotometry, SceneFile, write};

const MOST_BYTES: u64 = 64 << 20;

/// Reads a scene and all files it names, which must lie in its directory tree; on failure, all
/// problems with line and column.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    let text = text_of(path)?;
    let mut context = context::Context::new(path, &text);
    let file = parse::parse(&text, &mut context);
    let parts = resolve::resolve(file, &mut context);
    context.finish(parts)
}

/// The text of a file.
fn text_of(path: &Path) -> Result<String, Problem> {
    let bytes = source::read_bytes(path, MOST_BYTES)?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        Problem::new(path, format!("line {line}"), "is not UTF-8", "save the file as UTF-8")
    })?;
    Ok(text.to_owned())
}
