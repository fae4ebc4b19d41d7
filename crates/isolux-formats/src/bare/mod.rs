//! Triangle meshes of files that say nothing of materials, units and axes: STL and PLY.

mod paint;
mod scene;
mod weld;

pub(crate) use paint::Painter;
pub(crate) use scene::{ALONE, Kind, Part, Reading, UNNAMED, scene};
pub(crate) use weld::Weld;
