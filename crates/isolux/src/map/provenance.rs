//! Where a map came from and how good it is.

use super::audit::Audit;
use crate::units::Rgb;
use serde::{Deserialize, Serialize};

/// Everything needed to repeat a run and to judge its result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Name of the scene.
    pub scene: String,
    /// Hash of everything the result depends on in the scene, hexadecimal.
    pub scene_hash: String,
    /// Version of isolux.
    pub version: String,
    /// How it was computed.
    pub method: Method,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Increments (independent replicates) accumulated.
    pub increments: u64,
    /// Rays traced.
    pub rays: u64,
    /// The accuracy asked for, a fraction, where one was.
    pub accuracy_target: Option<f64>,
    /// Whether the run reached what was asked of it.
    pub complete: bool,
    /// How good the map is; `None` before the error could be believed.
    pub accuracy: Option<Accuracy>,
    /// Where readers with the scene at hand gather indirect light afresh; `None` before the error could
    /// be believed: then they interpolate.
    pub fresh: Option<Fresh>,
    /// What the filter did; `None` where it was off.
    pub filter: Option<FilterReport>,
    /// What stands in place of light that was not shot, where it was not all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unshot: Option<Unshot>,
    /// Whether mirrors, gloss and glass were left out, for comparison.
    #[serde(default, skip_serializing_if = "is_false")]
    pub diffuse_only: bool,
    /// What an independent test of the error has found; `None` where there was none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub audit: Option<Audit>,
    /// Of which maps it is the sum, where it is one: then the seed is that of the first, rays are those of
    /// all, and increments the fewest.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mixed: Vec<MixedPart>,
}

/// A map that another was made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MixedPart {
    /// The groups whose light it holds; none where its scene has no groups.
    pub groups: Vec<String>,
    /// What its light was multiplied by.
    pub dimming: f64,
    /// Hash of its scene.
    pub scene_hash: String,
    /// Its seed.
    pub seed: u64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it")]
const fn is_false(value: &bool) -> bool {
    !*value
}

/// Where a map is not to be trusted, and what those know who gather there over it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fresh {
    /// Where the interpolation error of an element is larger, lx; `None` if it is small enough
    /// everywhere. (And everywhere that something stands nearer than the element is long.)
    pub above_lx: Option<f64>,
    /// Whether it is in gaps alone, as to gather elsewhere would change no more than what the map errs by.
    #[serde(default, skip_serializing_if = "is_false")]
    pub in_gaps_alone: bool,
    /// What light is wrong by that is read close by, where the map is not trusted either, lx.
    pub lookup_lx: f64,
}

/// The light that a radiosity solution has not shot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unshot {
    /// Its share of all light.
    pub share: f64,
    /// What readers add to indirect light in its place, the same everywhere; values of vertices
    /// are without it, lx.
    pub ambient_lx: Rgb,
    /// The standard error of the light at a place for what it stands for, lx: alike in all readings, and not part of the values of vertices.
    #[serde(default)]
    pub doubt_lx: f64,
}

/// What the filter did to a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilterReport {
    /// Share of the surface where most of the detail was taken for noise.
    pub share: f64,
    /// Signal that may have gone with it: root mean square, relative as in [`Accuracy`].
    pub bias: f64,
}

/// Relative errors of the scene: area-weighted root mean squares over all surfaces, relative to the
/// root mean square of the illuminance (the distance of Kopylov, Khodulev, Volevich 1998, 3.3), or to twice its mean where there is
/// light, if that is less.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// The whole error of the map read with direct light evaluated afresh: root of the sum of the
    /// squares of the three parts below.
    pub reached: f64,
    /// From the spread of independent replicates.
    pub statistical: f64,
    /// From interpolating the indirect part between vertices, where readers do so.
    pub discretization: f64,
    /// The part of that which lies where caustics are, and is told by the standard errors of the vertices there.
    #[serde(default)]
    pub caustics: f64,
    /// Bound of the error common to all replicates: interpolated light at the ends of rays.
    pub bias: f64,
    /// The whole error of the bare interpolated map, direct light included.
    pub interpolated: f64,
}

impl Accuracy {
    /// The part of [`Accuracy::discretization`] that may be anywhere.
    pub fn discretization_beside_caustics(&self) -> f64 {
        let Self { discretization, caustics, .. } = self;
        (discretization * discretization - caustics * caustics).max(0.0).sqrt()
    }

    /// What more increments on the same elements leave: discretization and bias.
    pub fn of_elements(&self) -> f64 {
        libm::hypot(self.discretization, self.bias)
    }
}

/// The engines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Particles from the luminaires.
    Forward,
    /// Exact direct light, gathered indirect light, particles for caustics.
    Hybrid,
    /// Samples of indirect light with gradients, made where they are asked for.
    Cache,
    /// Shots over form factors.
    Radiosity,
}
