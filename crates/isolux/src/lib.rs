//! Illumination maps: the illuminance on every surface of a scene, with its standard error.
//!
//! The core of isolux. It computes; it reads no file and prints nothing. Modules know only those
//! before them: [`units`], [`quadrature`], [`photometry`], [`scene`], [`elements`], [`map`], [`sampling`],
//! [`engine`], [`lightmap`].
//!
//! Units are SI: metre, candela, lumen, lux (illuminance), cd/m2 (luminance), steradian. A colour
//! quantity is three channels of linear Rec. 709 whose luminance-weighted sum is the photometric
//! value.

pub use isolux_geometry as geometry;

mod ablation;
pub mod elements;
pub mod engine;
pub mod lightmap;
pub mod map;
pub mod photometry;
pub mod quadrature;
pub mod sampling;
pub mod scene;
pub mod units;
