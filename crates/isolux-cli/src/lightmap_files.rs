//! Lightmaps as files.

use crate::failure::Failure;
use crate::output::OutputPath;
use crate::source::bad_file;
use isolux::lightmap::Lightmap;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::lightmap::{LightmapFileError, Target, Way, write_exr, write_ktx2};
use isolux_formats::map_glb::{Preview, TexelFile, write_texels};
use isolux_formats::onto::{Onto, OntoError};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Pages that are looked for: the largest lightmaps have a few.
const MOST_LOOKED_FOR: u32 = 64;
/// What stands within so many bytes of every lightmap.
const OURS: &[u8] = b"isolux";
const HEADER_BYTES: u64 = 8192;

/// A lightmap alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// In 32-bit floats.
    Exr,
    /// In shared exponents.
    Ktx2,
}

impl Kind {
    /// Its extension.
    pub(crate) const fn extension(self) -> &'static str {
        match self {
            Self::Exr => "exr",
            Self::Ktx2 => "ktx2",
        }
    }
}

/// What a `.glb` with a lightmap is.
#[derive(Clone, Copy)]
pub(crate) enum Made<'a> {
    /// A map, with all that belongs to it.
    Map,
    /// The geometry of the scene.
    Export,
    /// A scene of somebody's, with all that it has.
    Onto(&'a Onto),
}

/// Writes a `.glb` and the lightmaps beside it.
pub(crate) fn glb(
    lightmap: &Lightmap,
    (scene, map): (&Scene, &IlluminationMap),
    (output, target, made): (&OutputPath, Target, Made<'_>),
) -> Result<Vec<String>, Failure> {
    let preview = Preview::automatic(scene, map);
    let with_record = matches!(made, Made::Map);
    let file = TexelFile { scene, map, lightmap, preview, target, with_record };
    let unwritable = |error| unwritable(output.path(), &error);
    let bytes = match made {
        Made::Map | Made::Export => write_texels(&file).map_err(unwritable)?,
        Made::Onto(onto) => onto.write(&file).map_err(|error| match error {
            OntoError::Scene(problems) => bad_file(problems),
            OntoError::File(error) => unwritable(error),
            other => Failure::Refused(other.to_string()),
        })?,
    };
    output.write(&bytes)?;
    let mut files = vec![output.path().display().to_string()];
    for &kind in beside(target) {
        let path = output.path().with_extension(kind.extension());
        files.extend(pages(lightmap, &path, (kind, target))?);
    }
    Ok(files)
}

/// What is written beside a `.glb`.
pub(crate) fn beside(target: Target) -> &'static [Kind] {
    match target.way() {
        Way::Lightmap => &[Kind::Exr, Kind::Ktx2],
        _ => &[Kind::Exr],
    }
}

/// Writes every page; all but the first have their number in their name.
pub(crate) fn pages(
    lightmap: &Lightmap,
    path: &Path,
    (kind, target): (Kind, Target),
) -> Result<Vec<String>, Failure> {
    let convention = target.convention();
    let mut files = Vec::new();
    for page in 0..lightmap.layout.pages {
        let path = numbered(path, page);
        let bytes = match kind {
            Kind::Ktx2 => write_ktx2(lightmap, page, &convention).map(|file| file.bytes),
            Kind::Exr => write_exr(lightmap, page, &convention),
        };
        let bytes = bytes.map_err(|error| unwritable(&path, &error))?;
        OutputPath::check(&path, kind.extension())?.write(&bytes)?;
        files.push(path.display().to_string());
    }
    Ok(files)
}

/// `lightmap.exr`, `lightmap-1.exr`, and so on.
fn numbered(path: &Path, page: u32) -> PathBuf {
    if page == 0 {
        return path.to_owned();
    }
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{page}."));
    name.push(path.extension().unwrap_or_default());
    path.with_file_name(name)
}

/// Lightmaps of an earlier bake that stay beside a `.glb`, other than those written just now.
pub(crate) fn older(glb: &Path, written: &[String]) -> Vec<String> {
    let kinds = [Kind::Exr, Kind::Ktx2].into_iter();
    let pages = kinds.flat_map(|kind| {
        let path = glb.with_extension(kind.extension());
        // Pages are numbered without a gap, but for those that somebody has removed.
        (0..MOST_LOOKED_FOR).map(move |page| numbered(&path, page))
    });
    let is_older = |path: &PathBuf| !written.contains(&path.display().to_string()) && is_ours(path);
    pages.filter(is_older).map(|path| path.display().to_string()).collect()
}

/// Whether isolux has written a picture: it says so in its header.
fn is_ours(path: &Path) -> bool {
    let mut header = Vec::new();
    let read =
        std::fs::File::open(path).and_then(|file| file.take(HEADER_BYTES).read_to_end(&mut header));
    read.is_ok() && header.windows(OURS.len()).any(|part| part == OURS)
}

fn unwritable(path: &Path, error: &LightmapFileError) -> Failure {
    Failure::Refused(format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn older_lightmaps_are_ours_and_not_written_just_now() {
        let home = tempfile::tempdir().unwrap();
        let path = |name: &str| home.path().join(name);
        for (name, contents) in [
            ("map.exr", "v/1..isolux..string"),
            ("map-1.exr", "isolux"),
            ("map-2.exr", "of another program"),
            ("map.ktx2", "KTXwriter isolux 1.0"),
            ("other.exr", "isolux"),
        ] {
            std::fs::write(path(name), contents).unwrap();
        }
        let shown = |name: &str| path(name).display().to_string();
        let found = older(&path("map.glb"), &[shown("map.exr")]);
        assert_eq!(found, [shown("map-1.exr"), shown("map.ktx2")]);
    }
}
