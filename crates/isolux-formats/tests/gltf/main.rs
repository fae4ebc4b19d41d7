//! glTF files read into scenes: valid small files, one feature each, and hostile ones.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod build;
mod geometry;
mod hostile;
mod lights;
mod materials;
mod samples;
