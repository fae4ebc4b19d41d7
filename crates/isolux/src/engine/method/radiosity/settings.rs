//! How finely radiosity works: presets, and what is set by hand.

use serde::{Deserialize, Serialize};

/// What is set by hand; what is not follows from the accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RadiositySettings {
    /// What taking light as constant over a source may change at a receiver, a share of the root mean
    /// square of the light in the scene.
    pub form_factor_tolerance: Option<f64>,
    /// Stop shooting when this share of all light is unshot.
    pub unshot: Option<f64>,
    /// Receivers that indirect light is computed at, at most, unless the scene has more.
    pub max_receivers: Option<u32>,
    /// Elements are not bisected below this edge, m.
    pub min_element_m: Option<f64>,
    /// Whether maps have an ambient term in place of the light that is unshot.
    pub ambient: bool,
    /// Whether the scene was made diffuse ([`crate::scene::Scene::diffuse_only`]) before; the engine only
    /// writes it down.
    pub diffuse_only: bool,
}

impl Default for RadiositySettings {
    fn default() -> Self {
        Self {
            form_factor_tolerance: None,
            unshot: None,
            max_receivers: None,
            min_element_m: None,
            ambient: true,
            diffuse_only: false,
        }
    }
}

/// The limits that settings come to for an accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RadiosityLimits {
    /// See [`RadiositySettings::form_factor_tolerance`].
    pub form_factor_tolerance: f64,
    /// What the visibility of one source may be in doubt by, a share of the same.
    pub visibility_tolerance: f64,
    /// What one source may bring to a receiver by two rays at most, a share of the same.
    pub largest_link: f64,
    /// See [`RadiositySettings::unshot`].
    pub unshot: f64,
    /// Rays for the check of the map at one place, eight times over.
    pub check_rays: u32,
}

/// Parts of the accuracy: some hundred sources of a receiver, whose errors have either sign, make ten
/// times the error of one.
const FORM_FACTOR_SHARE: f64 = 0.25;
const VISIBILITY_SHARE: f64 = 0.1;
/// What is unshot is reflected again and again: at a mean reflectance of 0.8 five times.
const UNSHOT_SHARE: f64 = 0.05;
/// Shadows of things smaller than what brings so much are missed by two rays; a few accuracies.
const LINK_SHARE: f64 = 4.0;

impl RadiositySettings {
    /// What they come to for an accuracy (a fraction).
    pub fn limits(&self, accuracy: f64) -> RadiosityLimits {
        let tolerance = self.form_factor_tolerance.unwrap_or(FORM_FACTOR_SHARE * accuracy);
        RadiosityLimits {
            form_factor_tolerance: tolerance,
            visibility_tolerance: tolerance * (VISIBILITY_SHARE / FORM_FACTOR_SHARE),
            largest_link: (LINK_SHARE * accuracy).clamp(0.01, 0.1),
            unshot: self.unshot.unwrap_or(UNSHOT_SHARE * accuracy),
            check_rays: ((0.3 / accuracy.max(1e-6)) as u32).clamp(16, 512).next_power_of_two(),
        }
    }
}
