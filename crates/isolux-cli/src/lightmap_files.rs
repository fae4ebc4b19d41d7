//! Lightmaps as files.

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::{ExportFlags, LayoutName, TargetName};
use crate::lightmap::Planned;
use crate::map_file;
use crate::output::OutputPath;
use isolux::lightmap::Lightmap;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::lightmap::{LightmapFileError, Target, Way, write_exr, write_ktx2};
use isolux_formats::map_glb::{Preview, TexelFile, write_texels};
use std::path::{Path, PathBuf};

/// A kind of file with a lightmap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Geometry and lightmap.
    Glb,
    /// The lightmap in 32-bit floats.
    Exr,
    /// The lightmap in shared exponents.
    Ktx2,
}

impl Kind {
    /// By extension and flags; nothing where no lightmap is asked for.
    pub(crate) fn of(flags: &ExportFlags) -> Result<Option<Self>, Failure> {
        let extension = flags.output.extension().map(|e| e.to_string_lossy().to_lowercase());
        let is_texels = flags.layout.layout == LayoutName::Texels;
        let kind = match extension.as_deref() {
            Some("exr") => Some(Self::Exr),
            Some("ktx2") => Some(Self::Ktx2),
            Some("glb") if is_texels => Some(Self::Glb),
            Some("glb") => {
                return Err(Failure::bad_input(format!(
                    "{}: the map is a .glb with its light at vertices already; add --layout texels for a lightmap",
                    flags.output.display()
                )));
            }
            _ => None,
        };
        let is_for_lightmaps = is_texels
            || flags.layout.texels_per_meter.is_some()
            || flags.target != TargetName::Viewer;
        match kind {
            None if is_for_lightmaps => Err(Failure::bad_input(format!(
                "{}: --layout texels, --texels-per-meter and --target are for lightmaps; end the name in .glb, \
                 .exr or .ktx2, or leave them out",
                flags.output.display()
            ))),
            kind => Ok(kind),
        }
    }

    const fn extension(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Exr => "exr",
            Self::Ktx2 => "ktx2",
        }
    }
}

/// Bakes and writes what `export` was asked for.
pub(crate) fn run(flags: &ExportFlags, kind: Kind, json: bool) -> Result<Outcome, Failure> {
    let output = OutputPath::check(&flags.output, kind.extension())?;
    output.differs_from(&flags.map)?;
    let target = target(flags.target);
    if kind == Kind::Glb {
        for beside in beside(target) {
            OutputPath::check(&flags.output.with_extension(beside), beside)?;
        }
    }
    let (scene, map) = map_file::read(&flags.map)?;
    let planned = Planned::new(&flags.layout, &scene, flags.max_memory)?;
    let Some(baked) = planned.bake(&scene, &map)? else { return Ok(Outcome::Interrupted) };
    let report = if kind == Kind::Glb {
        baked.write(&scene, &map, (&output, target, false))?
    } else {
        let files = pages(&baked.lightmap, output.path(), (kind, target))?;
        baked.report(target, files)
    };
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(Outcome::Done)
}

/// Writes a `.glb` and the lightmaps beside it.
pub(crate) fn glb(
    lightmap: &Lightmap,
    (scene, map): (&Scene, &IlluminationMap),
    (output, target, with_record): (&OutputPath, Target, bool),
) -> Result<Vec<String>, Failure> {
    let preview = Preview::automatic(scene, map);
    let file = TexelFile { scene, map, lightmap, preview, target, with_record };
    let bytes = write_texels(&file).map_err(|error| unwritable(output.path(), &error))?;
    output.write(&bytes)?;
    let mut files = vec![output.path().display().to_string()];
    for extension in beside(target) {
        let kind = if *extension == "exr" { Kind::Exr } else { Kind::Ktx2 };
        let path = output.path().with_extension(extension);
        files.extend(pages(lightmap, &path, (kind, target))?);
    }
    Ok(files)
}

/// What is written beside a `.glb`.
fn beside(target: Target) -> &'static [&'static str] {
    match target.way() {
        Way::Lightmap => &["exr", "ktx2"],
        _ => &["exr"],
    }
}

/// Writes every page; all but the first have their number in their name.
fn pages(
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
            _ => write_exr(lightmap, page, &convention),
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

fn unwritable(path: &Path, error: &LightmapFileError) -> Failure {
    Failure::Refused(format!("{}: {error}", path.display()))
}

fn target(name: TargetName) -> Target {
    match name {
        TargetName::Viewer => Target::Viewer,
        TargetName::Three => Target::Three,
        TargetName::Godot => Target::Godot,
        TargetName::Unity => Target::Unity,
        TargetName::Blender => Target::Blender,
        TargetName::Bevy => Target::Bevy,
    }
}
