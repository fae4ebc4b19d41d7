//! Values in, pixels out: views traced from an illumination map, exposure, tone mapping, false
//! colour.
//!
//! [`trace_map()`], or [`trace()`] with a reader of one's own, makes a [`LuminanceImage`] (cd/m2 and lx); [`develop()`] shows it as the eye or a camera
//! would, [`false_colour()`] as a chart of lux with a legend. Both end in a [`Picture`] of sRGB bytes.
//! [`PolarDiagram`] draws an intensity distribution.
//! Nothing here reads or writes a file.

mod camera;
mod develop;
mod error;
mod exposure;
mod false_colour;
mod gathered;
mod image;
mod picture;
mod plan;
mod polar;
mod srgb;
mod text;
mod tone;
mod trace;

pub use develop::{Development, develop};
pub use error::ViewError;
pub use exposure::Exposure;
pub use false_colour::{ColourMap, Contours, FalseColour, Quantity, Scale, false_colour};
pub use gathered::{Gathered, ViewProgress, trace_map};
pub use image::{LuminanceImage, Reading, Seen, Sight, Size, Surface};
pub use picture::{Picture, UNKNOWN};
pub use plan::plan;
pub use polar::PolarDiagram;
pub use tone::ToneCurve;
pub use trace::{Read, SurfacePoint, TraceSettings, trace, trace_watched};
