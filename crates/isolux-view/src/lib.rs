//! Values in, pixels out: views traced from an illumination map, exposure, tone mapping,
//! colours of displays, false colour.
//!
//! [`MapViewer::trace()`], or [`trace()`] with a reader of one's own, makes a [`LuminanceImage`] (cd/m2 and lx); [`develop()`] shows it as the eye or a camera
//! would, in the codes of a display ([`MonitorProfile`]), [`false_colour()`] as a chart of lux with a legend. Both end in a [`Picture`].
//! [`PolarDiagram`] draws an intensity distribution, [`Plan`] the values of a calculation grid.
//! Nothing here reads or writes a file.

mod camera;
mod colorimetry;
mod develop;
mod difference;
mod direct;
mod drawing;
mod error;
mod exposure;
mod false_colour;
mod gathered;
mod image;
mod lab;
mod light;
mod marching;
mod matrix;
mod middles;
mod picture;
mod plan;
mod polar;
mod profile;
mod round;
mod rounds;
mod srgb;
mod stroke;
mod tables;
mod text;
mod tone;
mod trace;
mod white;

pub use camera::{Projection, View, ViewRays};
pub use develop::{Development, develop};
pub use difference::differences;
pub use drawing::Drawing;
pub use error::ViewError;
pub use exposure::Exposure;
pub use false_colour::{
    ColourMap, Contours, FalseColour, Quantity, Scale, false_colour, round_limits,
};
pub use gathered::{Gathered, MapViewer, ViewProgress};
pub use image::{LuminanceImage, Reading, Seen, Sight, Size, Surface};
pub use light::{colour_of_light, light_of_groups};
pub use picture::{Picture, UNKNOWN};
pub use plan::{Plan, PlanPoint, PlanWords};
pub use polar::PolarDiagram;
pub use profile::{MAX_ICC_BYTES, MonitorProfile, ProfileError};
pub use rounds::{Noise, Rounds, judged_windows};
pub use tables::{Spaced, ToneTable, tone_table};
pub use tone::{Levels, ToneMap, ToneOperator};
pub use trace::{Read, SurfacePoint, TraceSettings, Window, trace, trace_watched};
pub use white::WhiteAdaptation;
