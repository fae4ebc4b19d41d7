//! `isolux export` of light for engines: which kind of file, and for whom.

use crate::console::{print, print_json};
use crate::exported::Exported;
use crate::failure::{Failure, Outcome};
use crate::flags::{ExportFlags, LayoutName, TargetName};
use crate::lightmap_export::{self, LightmapFile};
use crate::lightmap_files::Kind;
use crate::vertex_export;
use isolux_formats::lightmap::{Target, Way};

/// A kind of file for engines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Geometry and colours of its vertices.
    Vertices,
    /// Light as texels.
    Lightmap(LightmapFile),
}

impl Wanted {
    /// By extension and flags; nothing where the file is of another kind.
    pub(crate) fn of(flags: &ExportFlags) -> Result<Option<Self>, Failure> {
        let refused =
            |why: &str| Err(Failure::bad_input(format!("{}: {why}", flags.output.display())));
        let extension = flags.output.extension().map(|e| e.to_string_lossy().to_lowercase());
        let is_texels = flags.layout.layout == LayoutName::Texels;
        let has_density = flags.layout.texels_per_meter.is_some();
        let is_coloured = extension.as_deref() == Some("glb") && !is_texels;
        if flags.white.is_some() && !is_coloured {
            return refused("--white is for colours of vertices in a .glb; leave it out");
        }
        let is_lightmap = is_texels || matches!(extension.as_deref(), Some("exr" | "ktx2"));
        if flags.lux && !is_coloured {
            return refused("--lux is for light at vertices in a .glb; leave it out");
        }
        if flags.without_dark && !is_lightmap {
            return refused(
                "--without-dark is for lightmaps; add --layout texels, or leave it out",
            );
        }
        if let Some(why) = speaks_against_onto(flags, is_coloured || !is_lightmap, &extension) {
            return refused(why);
        }
        match extension.as_deref() {
            Some("exr") => Ok(Some(Self::Lightmap(LightmapFile::Alone(Kind::Exr)))),
            Some("ktx2") => Ok(Some(Self::Lightmap(LightmapFile::Alone(Kind::Ktx2)))),
            Some("glb") if is_texels => Ok(Some(Self::Lightmap(LightmapFile::Glb))),
            Some("glb") if has_density => {
                refused("--texels-per-meter is for lightmaps; add --layout texels, or leave it out")
            }
            Some("glb") => Ok(Some(Self::Vertices)),
            _ if is_texels || has_density || flags.target != TargetName::Viewer => refused(
                "--layout texels, --texels-per-meter and --target are for engines; end the name in .glb, or for \
                 lightmaps in .exr or .ktx2, or leave them out",
            ),
            _ => Ok(None),
        }
    }

    /// Writes it and prints what was written.
    pub(crate) fn write(self, flags: &ExportFlags, json: bool) -> Result<Outcome, Failure> {
        let Some(exported) = self.exported(flags)? else { return Ok(Outcome::Interrupted) };
        if json {
            print_json(&exported.facts)?
        } else {
            print(&exported.text)?
        }
        Ok(Outcome::Done)
    }

    /// Writes it; `None` if the user stopped that.
    pub(crate) fn exported(self, flags: &ExportFlags) -> Result<Option<Exported>, Failure> {
        let target = target(flags.target);
        match self {
            Self::Vertices => vertex_export::run(flags, target).map(Some),
            Self::Lightmap(file) => lightmap_export::run(flags, (file, target)),
        }
    }
}

/// What keeps a lightmap from being written onto a scene.
fn speaks_against_onto(
    flags: &ExportFlags,
    is_no_lightmap: bool,
    extension: &Option<String>,
) -> Option<&'static str> {
    let is_glb = extension.as_deref() == Some("glb");
    let has_way = target(flags.target).way() == Way::Lightmap;
    match &flags.onto {
        None if flags.without_lights => {
            Some("--without-lights is for --onto; add that, or leave it out")
        }
        Some(_) if is_no_lightmap || !is_glb => Some(
            "--onto writes a scene again with its lightmap; add --layout texels, and end the name in .glb",
        ),
        Some(_) if !has_way => Some(
            "--onto leaves materials as they are, and of them only those for three and bevy may have a lightmap beside; add \
             --target three (texels in lx) or --target bevy (E / pi), or leave --onto out",
        ),
        _ => None,
    }
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
