//! Lightmaps as files, read back.

mod card;
mod files;
mod glb;
mod targets;
