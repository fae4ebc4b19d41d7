//! Settings of radiosity, and the limits that follow from them.

use serde::{Deserialize, Serialize};

/// Settings given by the user; the others follow from the accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RadiositySettings {
    /// The largest error at a receiver from treating light as constant over a source, as a share of the root
    /// mean square of the light in the scene.
    pub form_factor_tolerance: Option<f64>,
    /// The share of unshot light at which shooting stops.
    pub unshot: Option<f64>,
    /// The largest number of receivers that indirect light is computed at, unless the scene has more
    /// vertices.
    pub max_receivers: Option<u32>,
    /// The least edge of an element, m; shorter ones are not bisected.
    pub min_element_m: Option<f64>,
    /// Whether maps have an ambient term in place of unshot light.
    pub ambient: bool,
    /// Whether the scene was made diffuse ([`crate::scene::Scene::diffuse_only`]) before. It is only
    /// recorded.
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

/// The limits for an accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RadiosityLimits {
    /// The form-factor tolerance: [`RadiositySettings::form_factor_tolerance`].
    pub form_factor_tolerance: f64,
    /// The largest uncertainty of the visibility of one source, as a share of the root mean square of the
    /// light.
    pub visibility_tolerance: f64,
    /// The most light from one source to a receiver by two rays, as a share of the root mean square of the
    /// light.
    pub largest_link: f64,
    /// The share of unshot light at which shooting stops: [`RadiositySettings::unshot`].
    pub unshot: f64,
    /// The number of rays at each check point; each is gathered eight times.
    pub check_rays: u32,
}

/// The form-factor tolerance, as a share of the accuracy. Errors of about a hundred sources of a receiver
/// have either sign, so they add up to ten times that of one.
const FORM_FACTOR_SHARE: f64 = 0.25;
/// The visibility tolerance, as a share of the accuracy.
const VISIBILITY_SHARE: f64 = 0.1;
/// The unshot light, as a share of the accuracy. It is reflected again and again: five times at a mean
/// reflectance of 0.8.
const UNSHOT_SHARE: f64 = 0.05;
/// The most light from one source by two rays, in accuracies. Two rays miss the shadows of things that block
/// less.
const LINK_SHARE: f64 = 4.0;

impl RadiositySettings {
    /// The limits for an accuracy (a fraction).
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
