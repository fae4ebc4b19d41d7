//! What is kept of a run beside its map: its state, its pilot, a part of it.

use crate::console::{facts, print, print_json};
use crate::failure::Failure;
use crate::memory;
use crate::part_files;
use crate::quantity::{show_count, show_share};
use crate::request::method_name;
use crate::shown::name;
use crate::source::bad_file;
use isolux::engine::RunIdentity;
use isolux::map::Method;
use isolux_formats::checkpoint::{self, Contents};
use isolux_formats::{Problem, Problems};
use serde::Serialize;
use std::ops::Range;
use std::path::Path;

/// Prints a state, a pilot or a part.
pub(super) fn show(path: &Path, json: bool) -> Result<(), Failure> {
    let read = part_files::whole(path, memory::of_map(), "give another file, or make it again")?;
    let contents = checkpoint::contents(&read).map_err(|what| {
        let remedy = "remove it, and make it again";
        bad_file(Problems::from(Problem::new(path, "", what, remedy)))
    })?;
    let kept = Kept::of(&contents);
    if json { print_json(&kept) } else { print(&kept.text()) }
}

/// What `info --json` prints of it.
#[derive(Serialize)]
struct Kept {
    kind: &'static str,
    /// As the user named it; only parts know.
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    scene_hash: String,
    version: String,
    method: Method,
    seed: u64,
    accuracy_target: Option<f64>,
    mesh_accuracy: f64,
    /// The number of the mesh, counted from one.
    mesh: u32,
    receivers: usize,
    /// Of a part those of its increments, else all so far.
    rays: u64,
    /// The first and the one after the last of each range; a pilot has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    increments: Option<Vec<[u64; 2]>>,
}

impl Kept {
    fn of(contents: &Contents) -> Self {
        match contents {
            Contents::Run(run) => {
                let size = (run.stage, run.receivers.len(), run.rays);
                let made = std::iter::once(0..run.increments);
                Self::new("state of a run", &run.identity, size).with_increments(made)
            }
            Contents::Pilot(pilot) => {
                let size = (pilot.stage, pilot.result.receivers(), pilot.rays);
                Self::new("pilot", &pilot.identity, size)
            }
            Contents::Part(of) => {
                let segments = &of.part.segments;
                let receivers = segments.first().map_or(0, |first| first.receivers.len());
                let rays = segments.iter().map(|segment| segment.rays).sum();
                let size = (of.part.stage, receivers, rays);
                let kept = Self::new("part of a run", &of.part.identity, size);
                let kept = kept.with_increments(of.part.ranges());
                Self { scene: Some(of.scene.clone()), ..kept }
            }
        }
    }

    fn new(
        kind: &'static str,
        of: &RunIdentity,
        (mesh, receivers, rays): (u32, usize, u64),
    ) -> Self {
        Self {
            kind,
            scene: None,
            scene_hash: of.scene_hash.clone(),
            version: of.version.clone(),
            method: of.method,
            seed: of.seed,
            accuracy_target: of.accuracy,
            mesh_accuracy: of.mesh_accuracy,
            mesh,
            receivers,
            rays,
            increments: None,
        }
    }

    fn with_increments(self, ranges: impl IntoIterator<Item = Range<u64>>) -> Self {
        let some = ranges.into_iter().filter(|range| !range.is_empty());
        Self { increments: Some(some.map(|range| [range.start, range.end]).collect()), ..self }
    }

    fn text(&self) -> String {
        let mut all = vec![("kind", self.kind.to_owned())];
        all.extend(self.scene.iter().map(|scene| ("scene", name(scene))));
        all.push(("hash of the scene", self.scene_hash.clone()));
        if let Some(increments) = &self.increments {
            let ranges: Vec<_> = increments.iter().map(|[a, b]| format!("{a}..{b}")).collect();
            let none = || "none yet".to_owned();
            all.push(("increments", ranges.first().map_or_else(none, |_| ranges.join(", "))));
        }
        let target = self.accuracy_target.map_or("none".to_owned(), show_share);
        all.extend([
            ("computed by", format!("isolux {}, {}", self.version, method_name(self.method))),
            ("seed", self.seed.to_string()),
            ("error asked for", target),
            ("mesh", format!("{}, interpolated to {}", self.mesh, show_share(self.mesh_accuracy))),
            ("receivers", self.receivers.to_string()),
            ("rays", show_count(self.rays as f64)),
        ]);
        facts(&all)
    }
}
