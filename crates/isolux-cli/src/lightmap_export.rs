//! `isolux export` of lightmaps.

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::{ExportFlags, LayoutName, TargetName};
use crate::lightmap::Planned;
use crate::lightmap_files::{self, Kind};
use crate::map_file;
use crate::output::OutputPath;
use isolux_formats::lightmap::Target;

/// A kind of file with a lightmap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Geometry and lightmap.
    Glb,
    /// The lightmap alone.
    Alone(Kind),
}

impl Wanted {
    /// By extension and flags; nothing where no lightmap is asked for.
    pub(crate) fn of(flags: &ExportFlags) -> Result<Option<Self>, Failure> {
        let extension = flags.output.extension().map(|e| e.to_string_lossy().to_lowercase());
        let is_texels = flags.layout.layout == LayoutName::Texels;
        let kind = match extension.as_deref() {
            Some("exr") => Some(Self::Alone(Kind::Exr)),
            Some("ktx2") => Some(Self::Alone(Kind::Ktx2)),
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
            Self::Alone(kind) => kind.extension(),
        }
    }
}

/// Bakes and writes what `export` was asked for.
pub(crate) fn run(flags: &ExportFlags, wanted: Wanted, json: bool) -> Result<Outcome, Failure> {
    let output = OutputPath::check(&flags.output, wanted.extension())?;
    output.differs_from(&flags.map)?;
    let target = target(flags.target);
    if wanted == Wanted::Glb {
        for extension in lightmap_files::beside(target).iter().map(|kind| kind.extension()) {
            OutputPath::check(&flags.output.with_extension(extension), extension)?;
        }
    }
    let (scene, map) = map_file::read(&flags.map)?;
    let planned = Planned::new(&flags.layout, &scene, flags.max_memory)?;
    let Some(baked) = planned.bake(&scene, &map)? else { return Ok(Outcome::Interrupted) };
    let report = match wanted {
        Wanted::Glb => baked.write(&scene, &map, (&output, target, false))?,
        Wanted::Alone(kind) => {
            let files = lightmap_files::pages(&baked.lightmap, output.path(), (kind, target))?;
            baked.report(target, files)
        }
    };
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(Outcome::Done)
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
