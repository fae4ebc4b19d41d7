//! Lightmaps: a map as texels over charts of the surfaces.
//!
//! A second layout of the same values. [`Layout`] says where every lit side of every triangle lies in the pages;
//! [`bake`] reads the map over the part of the surface that each texel covers, fills the borders of charts, and
//! makes the two sides of every seam agree.

mod arrays;
mod bake;
mod charts;
mod clip;
mod cover;
mod dark;
mod dilate;
mod edge;
mod ground;
mod layout;
mod lit;
mod own_places;
mod places;
mod plan;
mod reach;
mod seam_report;
mod seams;
mod shadow;
mod solve;
mod stitch;
mod t_junctions;
mod texels;
mod unwrap;
mod work;

#[cfg(test)]
mod tests;

pub use arrays::{LightmapArrays, LightmapArraysError};
pub use bake::bake;
pub use charts::{Patch, Placed, UnwrapError, UnwrapRequest, Unwrapped, Unwrapper};
pub use dark::{dark_share, dark_sides};
pub use layout::{Layout, OwnPlaces, Side};
pub use lit::lit_area_m2;
pub use plan::{BYTES_PER_TEXEL, LightmapError, LightmapSettings, plan, plan_without};
pub use seam_report::{Jump, SeamReport};
pub use texels::{Cover, Lightmap, Texel};
pub use unwrap::UvUnwrap;
pub use work::Pace;
