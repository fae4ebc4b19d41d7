//! What a map holds.

use super::scene::list;
use crate::audit;
use crate::console::{facts, print, print_json};
use crate::failure::Failure;
use crate::maintained::Maintained;
use crate::map_facts;
use crate::quantity::{show_share, significant};
use crate::shown::name;
use crate::summary::{self, Lit};
use isolux::map::{IlluminationMap, MixedPart, Provenance, Unshot};
use isolux::scene::Scene;
use serde::Serialize;

/// Prints a map.
pub(super) fn show(scene: &Scene, map: &IlluminationMap, json: bool) -> Result<(), Failure> {
    let contents = Contents {
        kind: "map",
        scene_unchanged: scene.hash() == map.provenance.scene_hash,
        provenance: &map.provenance,
        maintained: Maintained::of(scene),
        receivers: map.values.len(),
        unknown: map.values.iter().filter(|value| value.is_none()).count(),
        cameras: scene.cameras().iter().map(|c| c.name.clone()).collect(),
        surfaces: summary::by_shape(scene, map),
    };
    if json { print_json(&contents) } else { print(&contents.text()) }
}

/// What `info --json` prints of a map.
#[derive(Serialize)]
struct Contents<'a> {
    kind: &'static str,
    /// Whether the scene inside is the one that was solved.
    scene_unchanged: bool,
    provenance: &'a Provenance,
    #[serde(flatten)]
    maintained: Maintained,
    receivers: usize,
    unknown: usize,
    cameras: Vec<String>,
    surfaces: Vec<Lit>,
}

impl Contents<'_> {
    fn text(&self) -> String {
        let from = self.provenance;
        let mut all = vec![("map of", name(&from.scene))];
        all.extend(map_facts::of(from, (self.receivers, self.unknown)));
        all.push(("values", self.maintained.text()));
        all.push(("cameras", list(&self.cameras)));
        if let Some(Unshot { share, ambient_lx, doubt_lx }) = from.unshot {
            let [lx, doubt] = [ambient_lx.luminance(), doubt_lx].map(|lx| significant(lx, 3));
            all.push((
                "light unshot",
                format!(
                    "{}, {lx} lx of ambient light instead (\u{b1} {doubt} at a place)",
                    show_share(share)
                ),
            ));
        }
        if !from.mixed.is_empty() {
            let parts: Vec<String> = from.mixed.iter().map(part).collect();
            all.push(("sum of", parts.join(", ")));
        }
        if from.diffuse_only {
            all.push(("left out", "mirrors, gloss and refraction (--diffuse-only)".to_owned()));
        }
        let checks = from.audit.as_ref().map(|a| format!("\n{}", audit::checks(a)));
        format!("{}{}\n{}", facts(&all), checks.unwrap_or_default(), summary::text(&self.surfaces))
    }
}

/// A part of a sum, as `spots 30 %`.
fn part(part: &MixedPart) -> String {
    let groups: Vec<String> = part.groups.iter().map(|group| name(group)).collect();
    let whole = if groups.is_empty() { "a map".to_owned() } else { groups.join(" and ") };
    format!("{whole} {}", show_share(part.dimming))
}
