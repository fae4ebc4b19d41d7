//! `isolux check`: audit of a scene before a run.

mod around;
mod borders;
mod energy;
mod extent;
mod finding;
mod lamps;
mod light;
mod outside;

use crate::console::{facts, print, print_json};
use crate::daylight::Daylight;
use crate::estimate::{Estimate, Survey};
use crate::failure::{Failure, Outcome};
use crate::flags::CheckFlags;
use crate::installed::Installed;
use crate::memory;
use crate::origin::Extent;
use crate::quantity::{flux, significant};
use crate::shown::name;
use crate::source;
use finding::{Finding, Severity};
use isolux::engine::{SolveError, SolveRequest};
use isolux::scene::{Scene, UpAxis};
use isolux_formats::Problem;
use serde::Serialize;
use std::path::Path;

/// Runs the subcommand.
pub(crate) fn run(flags: &CheckFlags, json: bool) -> Result<Outcome, Failure> {
    let loaded = source::read_scene_with_warnings(&flags.scene)?;
    let read = loaded.warnings.iter().map(Finding::of_reading).collect();
    let audit = Audit::of(&loaded.value, &flags.scene, read);
    if json {
        print_json(&audit)?
    } else {
        print(&audit.text())?
    }
    Ok(Outcome::Done)
}

/// What should be known of a scene before its light is believed, as sentences, and whether each is a warning; `read` is what reading
/// it has left out or guessed.
pub(crate) fn findings(scene: &Scene, source: &Path, read: &[Problem]) -> Vec<(bool, String)> {
    let read = read.iter().map(Finding::of_reading).collect();
    let told = |finding: &Finding| (finding.severity == Severity::Warning, finding.sentence());
    Audit::of(scene, source, read).findings.iter().map(told).collect()
}

/// What is known of a scene without solving it.
#[derive(Serialize)]
struct Audit {
    scene: String,
    triangles: u32,
    size_m: [f64; 3],
    /// The axis that points up in the scene as written.
    up: UpAxis,
    area_m2: f64,
    luminaires: usize,
    /// Of them, those infinitely far away, which have an illuminance but no flux.
    parallel: usize,
    emitting_surfaces: usize,
    luminous_flux_lm: f64,
    #[serde(flatten)]
    installed: Installed,
    #[serde(flatten)]
    daylight: Daylight,
    mean_reflectance: f64,
    #[serde(flatten)]
    light: light::Light,
    open_edges: u64,
    /// None where the scene cannot be solved.
    estimate: Option<Estimate>,
    findings: Vec<Finding>,
}

impl Audit {
    fn of(scene: &Scene, source: &Path, mut findings: Vec<Finding>) -> Self {
        let extent = Extent::of(scene);
        let borders = borders::Borders::of(scene);
        let energy = energy::Energy::of(scene);
        let light = light::Light::of(scene);
        let request =
            SolveRequest { max_memory_bytes: memory::of_map(), ..SolveRequest::default() };
        let estimate = Estimate::of(scene, &request, Survey::Short);
        findings.extend(match scene.triangle_count() {
            0 => of_scene(source::NO_AREA),
            _ => [
                extent::findings(&extent, source),
                borders.findings(),
                energy.findings(light.lit_m2),
            ]
            .concat(),
        });
        match estimate {
            Err(SolveError::NoReceiver) if scene.triangle_count() > 0 => {
                findings.extend(of_scene(source::NO_MAP));
            }
            Err(SolveError::Memory { needed, allowed }) => {
                let (what, remedy) = memory::of_triangles(needed, allowed);
                findings.extend(of_scene((&what, &remedy)));
            }
            _ => {}
        }
        findings.extend(lamps::findings(scene));
        let daylight = Daylight::of(scene);
        findings.extend(daylight.below_horizon().map(below_horizon));
        Self {
            scene: scene.name().to_owned(),
            triangles: scene.triangle_count(),
            size_m: extent.size_m(),
            up: scene.up(),
            area_m2: energy.area_m2,
            luminaires: scene.luminaires().len(),
            parallel: energy.parallel,
            emitting_surfaces: scene.area_luminaires().len(),
            luminous_flux_lm: energy.flux_lm,
            installed: Installed::of(scene),
            daylight,
            mean_reflectance: energy.mean_reflectance,
            light,
            open_edges: borders.open,
            estimate: estimate.ok(),
            findings,
        }
    }

    fn text(&self) -> String {
        let [x, y, z] = self.size_m.map(|side| significant(side, 3));
        let up = match self.up {
            UpAxis::Y => "y",
            UpAxis::Z => "z",
        };
        let unknown = || ["none", "none", "cannot be solved"].map(str::to_owned);
        let [receivers, memory, time] = self.estimate.map_or_else(unknown, |e| e.shown());
        let mut rows = vec![
            ("scene", name(&self.scene)),
            ("size", format!("{x} x {y} x {z} m")),
            ("up", up.to_owned()),
            ("triangles", self.triangles.to_string()),
            ("surface", format!("{} m2", significant(self.area_m2, 3))),
            ("open edges", self.open_edges.to_string()),
            ("luminaires", self.luminaires.to_string()),
            ("emitting surfaces", self.emitting_surfaces.to_string()),
            ("luminous flux", flux(self.luminous_flux_lm, self.parallel > 0)),
            ("mean reflectance", significant(self.mean_reflectance, 2)),
            ("mean illuminance", self.light.shown()),
            ("receivers at 1 %", receivers),
            ("memory at 1 %", memory),
            ("time to 1 %", format!("{time}; to bake lightmaps comes on top")),
        ];
        rows.extend(self.installed.text().map(|text| ("power", text)));
        rows.extend(self.daylight.rows());
        let mut text = facts(&rows);
        text += "\n";
        text += &self.findings.iter().map(Finding::line).collect::<String>();
        if self.findings.is_empty() {
            text += "nothing found\n";
        }
        text
    }
}

/// Light that no sun sends.
fn below_horizon((luminaire, below_deg): (&str, f64)) -> Finding {
    Finding::note(
        format!("luminaire `{luminaire}`"),
        format!("shines upwards, from {} degrees below the horizon", significant(below_deg, 2)),
        "turn it if it is meant as the sun",
    )
}

fn of_scene((what, remedy): (&str, &str)) -> Vec<Finding> {
    vec![Finding::warning("scene", what, remedy)]
}
