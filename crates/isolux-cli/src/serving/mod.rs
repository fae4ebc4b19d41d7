//! The walk-through served to browsers: a map, or a run on the way. Without the feature `serve` both are refused.

#[cfg(feature = "serve")]
mod enabled;
#[cfg(feature = "serve")]
pub(crate) use enabled::{Live, view};

#[cfg(not(feature = "serve"))]
mod disabled;
#[cfg(not(feature = "serve"))]
pub(crate) use disabled::{Live, view};
