//! `isolux export` of maps whose light is in the colours of vertices.

use crate::console::facts;
use crate::exported::Exported;
use crate::failure::Failure;
use crate::flags::ExportFlags;
use crate::map_file;
use crate::output::OutputPath;
use crate::quantity::{show_bytes, significant};
use crate::shown::names;
use crate::walk::Opened;
use isolux_formats::counted;
use isolux_formats::lightmap::{Target, VertexConvention};
use isolux_formats::map_glb::{Preview, VertexColours, VertexFile, write_vertices};
use serde::Serialize;

/// Writes a `.glb` for a consumer.
pub(crate) fn run(flags: &ExportFlags, target: Target) -> Result<Exported, Failure> {
    if flags.white.is_some() && target == Target::Viewer {
        return Err(Failure::bad_input(
            "--white is for colours in proportion to luminance, and those of --target viewer are tone mapped; \
             name another target, or leave it out",
        ));
    }
    let output = OutputPath::check(&flags.output, "glb")?;
    output.differs_from(&flags.map)?;
    output.replaces_exports_alone()?;
    let opened = match flags.lux {
        true => Opened::read(&flags.map)?,
        false => Opened::alone(&flags.map, map_file::read(&flags.map)?),
    };
    let (scene, map) = (&*opened.scene, &*opened.map);
    let groups = opened.groups();
    let file = VertexFile {
        scene,
        map,
        preview: Preview::automatic(scene, map),
        target,
        white_cd_m2: flags.white,
        lux: flags.lux.then_some(&groups[..]),
    };
    let made = write_vertices(&file)
        .map_err(|e| Failure::Refused(format!("{}: {e}", output.path().display())))?;
    output.write(&made.bytes)?;
    let of_groups = flags.lux.then(|| groups.into_iter().map(|group| group.name).collect());
    let report = Report::of(&made, (target, of_groups), output.path().display().to_string());
    Exported::new(&report, report.text())
}

/// What `--json` says.
#[derive(Serialize)]
struct Report {
    target: &'static str,
    convention: VertexConvention,
    file: String,
    bytes: u64,
    vertices: usize,
    exposure_m2_cd: f64,
    white_cd_m2: f64,
    largest_colour: f64,
    vertices_above_white: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    groups: Option<Vec<String>>,
}

impl Report {
    fn of(
        made: &VertexColours,
        (target, groups): (Target, Option<Vec<String>>),
        file: String,
    ) -> Self {
        Self {
            target: target.name(),
            convention: target.vertex_convention(),
            file,
            bytes: made.bytes.len() as u64,
            vertices: made.vertices,
            exposure_m2_cd: made.exposure_m2_cd,
            white_cd_m2: made.white_cd_m2,
            largest_colour: made.largest,
            vertices_above_white: made.above_white,
            groups,
        }
    }

    /// For people.
    fn text(&self) -> String {
        let VertexConvention { quantity, formula, setting, .. } = self.convention;
        let mut all = vec![
            ("file", self.file.clone()),
            ("  size", show_bytes(self.bytes)),
            ("  COLOR_0", format!("{quantity}; {formula}")),
            ("  white", format!("{} cd/m2", significant(self.white_cd_m2, 3))),
            ("  vertices", self.vertices.to_string()),
        ];
        if let Some(groups) = &self.groups {
            let groups = match groups.is_empty() {
                true => "all light together".to_owned(),
                false => names(groups.iter().map(String::as_str)),
            };
            all.push(("  lux", groups));
        }
        if self.vertices_above_white > 0 {
            let (largest, count) = (significant(self.largest_colour, 3), self.vertices_above_white);
            let count = counted(count, "vertex", "vertices");
            let text = format!("{count}, up to {largest} times; cut (--white says where)");
            all.push(("  above white", text));
        }
        if !setting.is_empty() {
            all.push(("  set", format!("{}: {setting}", self.target)));
        }
        facts(&all)
    }
}
