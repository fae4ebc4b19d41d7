//! What a cache of samples holds.

use crate::cache_samples;
use crate::console::{facts, print, print_json};
use crate::failure::Failure;
use crate::shown::name;
use isolux::engine::SampleKind;
use serde::Serialize;
use std::path::Path;

/// Prints a cache.
pub(super) fn show(path: &Path, json: bool) -> Result<(), Failure> {
    let (head, cache) = cache_samples::read(path)?;
    let contents = Contents {
        kind: "cache",
        scene: head.scene,
        scene_hash: head.scene_hash,
        version: head.version,
        samples_read: cache.count(SampleKind::Near),
        samples_for_rays: cache.count(SampleKind::Far),
    };
    if json { print_json(&contents) } else { print(&contents.text()) }
}

/// What `info --json` prints of a cache.
#[derive(Serialize)]
struct Contents {
    kind: &'static str,
    scene: String,
    scene_hash: String,
    version: String,
    /// Samples that are read.
    samples_read: usize,
    /// Samples that rays read where they end.
    samples_for_rays: usize,
}

impl Contents {
    fn text(&self) -> String {
        facts(&[
            ("cache of", name(&self.scene)),
            ("computed by", format!("isolux {}", self.version)),
            ("samples that are read", self.samples_read.to_string()),
            ("samples that rays read", self.samples_for_rays.to_string()),
        ])
    }
}
