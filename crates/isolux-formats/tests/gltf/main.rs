//! glTF files read into scenes: valid small files, one feature each, and hostile ones.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod build;
mod compressed;
mod geometry;
mod hostile;
mod layers;
mod lights;
mod materials;
mod optional;
mod poses;
mod samples;
