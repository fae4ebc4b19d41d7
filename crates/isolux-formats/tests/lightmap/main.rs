//! Lightmaps as files, read back.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

mod card;
mod files;
mod glb;
mod targets;
mod vertices;
