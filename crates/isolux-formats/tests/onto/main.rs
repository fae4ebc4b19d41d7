//! Scenes of others, written again with a lightmap.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

#[path = "../gltf/build.rs"]
#[allow(dead_code, reason = "made for the tests of the reader")]
mod build;
mod grafted;
mod kept;
mod light;
#[path = "../lit/mod.rs"]
mod lit;
mod opened;
mod placed;
mod refused;
mod scene;
#[path = "../spoil/mod.rs"]
#[allow(dead_code, reason = "text is spoilt elsewhere")]
mod spoil;
mod written;
