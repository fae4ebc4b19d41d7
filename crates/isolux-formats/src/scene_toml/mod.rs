//! `scene.toml`, the native scene description. Its keys are explained in `docs/book/scenes.md`.

mod aim;
mod cameras;
mod chromaticity;
mod context;
mod geometry;
mod grids;
mod groups;
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
mod requirements;
mod resolve;
mod shapes;
mod sky;
mod sky_record;
mod spans;
mod text;
mod write;

use crate::obj::Materials;
use crate::reach::Root;
use crate::{Loaded, Problems, Reach};
use isolux::scene::SceneParts;
use isolux::units::Rgb;
use std::path::Path;

pub use sky::{SkyAsked, put_sky};
pub use write::{NamedPhotometry, SceneFile, WriteError, write};

/// Reads a scene and all files it names, which must lie in its directory tree; on failure, all
/// problems with line and column.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    read_with(path, Materials::AsMeant, Reach::Inside)
}

/// Reads a scene whose files of other formats have materials as meant or as written, and the files that it may name.
pub fn read_with(
    path: &Path,
    materials: Materials,
    reach: Reach,
) -> Result<Loaded<SceneParts>, Problems> {
    let text = text::of(path)?;
    let mut context = context::Context::new(path, &text);
    context.materials = materials;
    context.root = Root::of(path, reach);
    let file = parse::parse(&text, &mut context);
    let parts = resolve::resolve(file, &mut context);
    context.finish(parts)
}

/// The colour of light of a correlated colour temperature, of luminance 1, as `cct_k` of a luminaire has it; `None` outside of 1000 to
/// 25 000 K.
pub fn light_of_temperature(kelvin: f64) -> Option<Rgb> {
    chromaticity::RANGE_K.contains(&kelvin).then(|| chromaticity::of_temperature(kelvin))
}
