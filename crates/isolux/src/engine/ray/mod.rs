//! Places, specular paths, short rays and accumulators: the parts that every other room is made of.

mod accumulator;
mod anderson;
mod deadline;
mod noise;
mod path;
mod place;
pub(crate) mod reflectance;
mod scatter;
mod sensor;
mod short_rays;
mod surface;

pub use accumulator::Sums;
pub(crate) use accumulator::{
    Accumulator, Effort, Estimate, MAX_INCREMENTS, Sample, UNITS_OF_REFERENCE, mean_and_variance,
};
pub(crate) use anderson::Anderson;
pub use deadline::StopFlag;
pub(crate) use deadline::{Deadline, NEVER};
pub(crate) use noise::Noise;
pub(crate) use path::{Dice, MAX_SPECULAR, PathEnd, follow, follow_on, specular_step};
pub use place::ProbePoint;
pub(crate) use place::{INWARD_ROUNDINGS, Places, place_key};
pub(crate) use scatter::{Scattered, luminance_ratio};
#[cfg(test)]
pub(crate) use scatter::{reflect, refract, specular_share};
pub use sensor::Sensor;
pub(crate) use short_rays::ShortRays;
pub(crate) use surface::{COPLANAR_COS, Stand, SurfacePoint};
