//! `isolux bake`: a scene to light that an engine reads, in one step.

use crate::console::{print, print_json};
use crate::engine_export::Wanted;
use crate::exported::Exported;
use crate::failure::{Failure, Outcome};
use crate::flags::{BakeFlags, ExportFlags, LayoutFlags, LayoutName, TargetName};
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::progress::Reporter;
use crate::report::Report;
use crate::solving::{Run, solve};
use crate::{map_file, memory, source};
use isolux::engine::SolveRequest;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The files that engines read light from.
const KINDS: [&str; 3] = ["glb", "exr", "ktx2"];

/// Runs the subcommand.
pub(crate) fn run(flags: &BakeFlags, json: bool) -> Result<Outcome, Failure> {
    let extension = flags.output.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let kind = || {
        Failure::bad_input(format!(
            "{}: cannot bake to this kind of file; end its name in .glb, .exr or .ktx2",
            flags.output.display()
        ))
    };
    if !KINDS.contains(&extension.as_str()) {
        return Err(kind());
    }
    let output = OutputPath::check(&flags.output, &extension)?;
    let folder = map_folder(&flags.output)?;
    let path = folder.path().join("map.glb");
    let export = export_of(flags, path.clone());
    let wanted = Wanted::of(&export)?.ok_or_else(kind)?;
    output.differs_from(&flags.scene)?;
    output.replaces_exports_alone()?;
    let scene = source::read_scene(&flags.scene)?;
    let map = OutputPath::check(&path, "glb")?;
    let request = SolveRequest {
        accuracy: Some(flags.accuracy),
        seed: flags.seed,
        time_limit: flags.time_limit,
        max_memory_bytes: memory::of_map(),
        ..SolveRequest::default()
    };
    let run = Run { source: &flags.scene, output: &map, request: &request };
    let solved = solve(&scene, &run, None, (&mut Reporter::new(None), None))?;
    let report = Report::of((&scene, &solved.solution.map), solved.solution.time_s, &map);
    if solved.outcome == Outcome::Interrupted {
        note(Note::Warning, format!("{}: not written", flags.output.display()));
        return Ok(Outcome::Interrupted);
    }
    map_file::write(&map, &scene, &solved.solution.map)?;
    drop((scene, solved.solution));
    let Some(exported) = wanted.exported(&export)? else { return Ok(Outcome::Interrupted) };
    let baked = Baked { solution: report.without_map(), exported };
    if json {
        print_json(&baked.facts())?
    } else {
        print(&format!("{}{}", baked.solution.text(), baked.exported.text))?
    }
    Ok(solved.outcome)
}

/// A folder beside the output for the map, which goes away with it.
fn map_folder(output: &Path) -> Result<tempfile::TempDir, Failure> {
    let beside = match output.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    tempfile::Builder::new().prefix(".isolux-bake").tempdir_in(beside).map_err(|e| {
        let folder = beside.display();
        Failure::bad_input(format!(
            "{folder}: nothing can be written there ({e}); choose another folder"
        ))
    })
}

/// The flags of the export that follows the run.
fn export_of(flags: &BakeFlags, map: PathBuf) -> ExportFlags {
    let extension = |path: &Path| path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let is_gltf = matches!(extension(&flags.scene).as_deref(), Some("glb" | "gltf"));
    let keeps_materials = matches!(flags.target, TargetName::Three | TargetName::Bevy);
    let is_glb = extension(&flags.output).as_deref() == Some("glb");
    let is_texels = flags.layout == LayoutName::Texels;
    let is_onto = is_gltf && keeps_materials && is_glb && is_texels;
    ExportFlags {
        map,
        output: flags.output.clone(),
        layout: LayoutFlags { layout: flags.layout, texels_per_meter: flags.texels_per_meter },
        target: flags.target,
        without_dark: false,
        onto: is_onto.then(|| flags.scene.clone()),
        without_lights: flags.without_lights,
        digits: None,
        beside: None,
        finer: Duration::ZERO,
        white: None,
        lux: false,
        threads: flags.threads,
    }
}

/// A run, and what was written of it.
struct Baked {
    solution: Report,
    exported: Exported,
}

impl Baked {
    fn facts(&self) -> impl Serialize {
        serde_json::json!({ "solution": self.solution, "export": self.exported.facts })
    }
}
