//! Lightmaps as files, read back.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

mod card;
mod files;
mod glb;
#[path = "../lit/mod.rs"]
mod lit;
mod targets;
mod vertices;
