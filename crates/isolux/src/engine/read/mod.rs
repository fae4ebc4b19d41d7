//! Readings of a map: at any place, and over texels and pixels.

mod map_reader;
pub mod net;

pub(crate) use map_reader::GLANCE_SAMPLES;
pub use map_reader::{
    Allowance, ExactSettings, IndirectReading, MapReader, PictureLight, Told, reference_lx,
};
