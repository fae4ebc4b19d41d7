//! What Python programs hold. Their methods are in `map` and `scene`.

use isolux::map::IlluminationMap;
use pyo3::prelude::*;
use std::sync::Arc;

/// A scene.
#[pyclass(frozen, module = "isolux._native")]
pub(crate) struct Scene {
    pub(crate) held: Arc<isolux::scene::Scene>,
}

/// A map with its scene.
#[pyclass(frozen, module = "isolux._native")]
pub(crate) struct Map {
    pub(crate) held: Arc<(isolux::scene::Scene, IlluminationMap)>,
}
