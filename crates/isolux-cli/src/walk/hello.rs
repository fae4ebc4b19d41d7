//! What a page begins with.

use serde::Serialize;

/// What a page begins with, as `web/src/wire.ts` has it.
#[derive(Serialize)]
pub(crate) struct Hello {
    version: &'static str,
    worlds: Vec<WorldName>,
    live: bool,
    readings: &'static str,
}

#[derive(Serialize)]
struct WorldName {
    name: String,
    file: String,
}

impl Hello {
    /// Of maps, or of a run.
    pub(crate) fn new(names: Vec<(String, String)>, live: bool, readings: &'static str) -> Self {
        let worlds = names.into_iter().map(|(name, file)| WorldName { name, file }).collect();
        Self { version: env!("CARGO_PKG_VERSION"), worlds, live, readings }
    }

    /// As JSON.
    pub(crate) fn to_json(&self) -> String {
        // Strings and truths alone: nothing to go wrong.
        serde_json::to_string(self).unwrap_or_default()
    }
}
