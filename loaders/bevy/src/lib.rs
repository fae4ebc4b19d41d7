//! Reads isolux illumination maps into Bevy: lux and standard error at every place, groups of luminaires that dim live.
//!
//! The files are those of `isolux export map.glb -o light.glb --lux`.

mod file;
mod map;
mod mix;
mod world;

pub use file::{IlluminationLoader, Trouble};
pub use map::{IlluminationMap, Light, Reading, Surface};
pub use mix::Levels;
pub use world::{
    ATTRIBUTE_ILLUMINANCE_LX, ATTRIBUTE_STANDARD_ERROR_LX, IlluminationPlugin, IlluminationRoot,
    LitSurface,
};
