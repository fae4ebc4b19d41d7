//! `isolux export` of lightmaps.

use crate::clock::Clock;
use crate::exported::Exported;
use crate::failure::Failure;
use crate::flags::{ExportFlags, LayoutFlags};
use crate::lightmap::{Baked, Planned};
use crate::lightmap_files::{self, Kind, Made};
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::source::{bad_file, reach, show_warnings};
use crate::{map_file, memory};
use isolux::lightmap::dark_sides;
use isolux::scene::Scene;
use isolux_formats::Loaded;
use isolux_formats::lightmap::Target;
use isolux_formats::map_glb::MapFile;
use isolux_formats::onto::{Onto, Options};
use std::collections::HashSet;

/// A kind of file with a lightmap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LightmapFile {
    /// Geometry and lightmap.
    Glb,
    /// The lightmap alone.
    Alone(Kind),
}

impl LightmapFile {
    const fn extension(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Alone(kind) => kind.extension(),
        }
    }
}

/// Takes texels from the map or bakes them, and writes what `export` was asked for.
pub(crate) fn run(
    flags: &ExportFlags,
    (file, target): (LightmapFile, Target),
) -> Result<Option<Exported>, Failure> {
    let output = OutputPath::check(&flags.output, file.extension())?;
    output.differs_from(&flags.map)?;
    output.replaces_exports_alone()?;
    if file == LightmapFile::Glb {
        for extension in lightmap_files::beside(target).iter().map(|kind| kind.extension()) {
            OutputPath::check(&flags.output.with_extension(extension), extension)?;
        }
    }
    let MapFile { scene, map, lightmap } = map_file::read_with_texels(&flags.map)?;
    let onto = onto(flags, &scene, (&output, target))?;
    let density = lightmap.as_ref().map(|held| held.layout.asked_texels_per_m);
    let held = lightmap.filter(|_| !flags.without_dark);
    let baked = match Baked::held(&flags.layout, &map, held) {
        Some(held) => held,
        None => {
            let dark =
                if flags.without_dark { dark_sides(&scene, &map) } else { HashSet::default() };
            let texels_per_meter = flags.layout.texels_per_meter.or(density);
            let layout = LayoutFlags { texels_per_meter, ..flags.layout };
            let planned = Planned::new(&layout, &scene, memory::of_lightmap(), &dark)?;
            let Some(baked) = planned.bake((&scene, &map), (Clock::ENDLESS, None))? else {
                note(Note::Warning, format!("{}: not written", output.path().display()));
                return Ok(None);
            };
            baked
        }
    };
    let made = onto.as_ref().map_or(Made::Export, Made::Onto);
    let report = match file {
        LightmapFile::Glb => baked.write(&scene, &map, (&output, target, made))?,
        LightmapFile::Alone(kind) => {
            let files = lightmap_files::pages(&baked.lightmap, output.path(), (kind, target))?;
            baked.report(target, files)
        }
    };
    Exported::new(&report, report.text()).map(Some)
}

/// The scene that is to be written again, found to be that of the map.
fn onto(
    flags: &ExportFlags,
    scene: &Scene,
    (output, target): (&OutputPath, Target),
) -> Result<Option<Onto>, Failure> {
    let Some(path) = &flags.onto else { return Ok(None) };
    output.differs_from(path)?;
    let options = Options { without_lights: flags.without_lights, reach: reach() };
    let Loaded { value, warnings } =
        Onto::open(path, scene, (target, options)).map_err(bad_file)?;
    show_warnings(&warnings);
    Ok(Some(value))
}
