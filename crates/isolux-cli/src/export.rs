//! `isolux export`: a map for other software.

use crate::console::{facts, print, print_json};
use crate::engine_export;
use crate::failure::{Failure, Outcome};
use crate::flags::ExportFlags;
use crate::map_file;
use crate::output::OutputPath;
use crate::quantity::show_bytes;
use crate::walk_export;
use isolux::units::Digits;
use isolux_formats::export::{ExportKind, csv, export};
use isolux_formats::map_glb::Preview;
use serde::Serialize;

/// Runs the subcommand.
pub(crate) fn run(flags: &ExportFlags, json: bool) -> Result<Outcome, Failure> {
    if flags.digits.is_some() && extension(flags).as_deref() != Some("csv") {
        return Err(Failure::bad_input(format!(
            "{}: --digits is for .csv; end the name in that, or leave it out",
            flags.output.display()
        )));
    }
    if let Some(wanted) = engine_export::Wanted::of(flags)? {
        return wanted.write(flags, json);
    }
    if extension(flags).as_deref() == Some("html") {
        return walk_export::run(flags, json);
    }
    if flags.beside.is_some() {
        return Err(Failure::bad_input(format!(
            "{}: --beside is for .html; end the name in that, or leave it out",
            flags.output.display()
        )));
    }
    let (kind, extension) = kind(flags)?;
    let output = OutputPath::check(&flags.output, extension)?;
    output.differs_from(&flags.map)?;
    output.replaces_exports_alone()?;
    let (scene, map) = map_file::read(&flags.map)?;
    let preview = Preview::automatic(&scene, &map);
    let bytes = match flags.digits {
        Some(digits) => csv(&map, Digits::Significant(digits)).into_bytes(),
        None => export(&scene, &map, &preview, kind),
    };
    output.write(&bytes)?;
    let report = Report {
        file: output.path().display().to_string(),
        bytes: bytes.len() as u64,
        receivers: map.values.len(),
        exposure_m2_cd: preview.exposure_m2_cd,
        white_cd_m2: preview.white_cd_m2,
    };
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(Outcome::Done)
}

fn extension(flags: &ExportFlags) -> Option<String> {
    flags.output.extension().map(|e| e.to_string_lossy().to_lowercase())
}

fn kind(flags: &ExportFlags) -> Result<(ExportKind, &'static str), Failure> {
    let found = extension(flags);
    let known = ExportKind::ALL.into_iter().find(|(_, e)| found.as_deref() == Some(*e));
    known.ok_or_else(|| {
        let mut all: Vec<String> = ExportKind::ALL.iter().map(|(_, e)| format!(".{e}")).collect();
        all.extend([".glb", ".exr", ".ktx2", ".html"].map(str::to_owned));
        Failure::bad_input(format!(
            "{}: cannot write this kind of file; end its name in one of {}",
            flags.output.display(),
            all.join(", ")
        ))
    })
}

#[derive(Serialize)]
struct Report {
    file: String,
    bytes: u64,
    receivers: usize,
    /// Of colours, where the file has any.
    exposure_m2_cd: f64,
    white_cd_m2: f64,
}

impl Report {
    fn text(&self) -> String {
        facts(&[
            ("file", self.file.clone()),
            ("size", show_bytes(self.bytes)),
            ("receivers", self.receivers.to_string()),
        ])
    }
}
