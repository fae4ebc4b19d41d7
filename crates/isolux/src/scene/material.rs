//! How surfaces reflect, transmit and emit; energy-conserving by construction.

use crate::units::Rgb;
use serde::{Deserialize, Serialize};

/// A named material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Name, as written in the scene.
    pub name: String,
    /// What it is made of.
    pub body: Body,
}

/// What light can do at a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(
    clippy::large_enum_variant,
    reason = "materials are few, and engines read finishes at every hit"
)]
pub enum Body {
    /// Light stays on the side it came from.
    Opaque {
        /// The side from which corners turn counter-clockwise.
        front: Finish,
        /// The other side; [`Finish::BLACK`] for a one-sided material.
        back: Finish,
    },
    /// Smooth glass or liquid: reflects and refracts by Fresnel's equations, without scattering.
    Dielectric(Dielectric),
}

/// One side of an opaque surface: a sum of a diffuse part, a mirror part, a glossy part, a clear coat
/// over it, and light of its own. In each channel diffuse, mirror and glossy reflectance sum to at
/// most one; what is glossy is cut at grazing angles, where it would exceed that.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Finish {
    /// Lambertian reflectance.
    pub diffuse: Reflectance,
    /// Reflectance of a perfect mirror, the same at every angle.
    pub mirror: Rgb,
    /// Microfacet reflection.
    pub gloss: Option<Gloss>,
    /// A second one, over the first; files of scenes without know nothing of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coat: Option<Coat>,
    /// Luminance of the light it emits, the same in every direction, cd/m2.
    pub luminance_cd_m2: Rgb,
}

/// Diffuse reflectance: a colour, times a texture where there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reflectance {
    /// Factor, 0 to 1.
    pub colour: Rgb,
    /// Index into the textures of the scene.
    pub texture: Option<u32>,
}

/// GGX microfacets with Schlick's Fresnel term (Walter et al. 2007; Schlick 1994).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gloss {
    /// Reflectance at normal incidence.
    pub f0: Rgb,
    /// Width of the facet distribution, 0 < alpha <= 1 (perceptual roughness squared).
    pub alpha: f64,
}

/// A smooth or rough layer of index 1.5 (Khronos, KHR_materials_clearcoat): GGX microfacets with Schlick's Fresnel term.
/// Gloss below loses `1 - F` on its way in and again on its way out; diffuse reflectance is that with the coat on, as
/// it is measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coat {
    /// Share of the surface that it covers, above 0 to 1.
    pub cover: f64,
    /// Width of the facet distribution, 0 < alpha <= 1 (perceptual roughness squared).
    pub alpha: f64,
}

/// Smooth dielectric.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dielectric {
    /// Refractive index against air (inside over outside), > 1 or < 1.
    pub ior: f64,
    /// Share of the light left by one crossing of the pane (thin) or of the surface (solid).
    pub transmittance: Rgb,
    /// A pane of two parallel faces in one surface: transmits straight on, with the inner
    /// reflections summed. Otherwise the surface bounds a solid.
    pub thin: bool,
}

impl Finish {
    /// Absorbs all.
    pub const BLACK: Self = Self {
        diffuse: Reflectance { colour: Rgb::BLACK, texture: None },
        mirror: Rgb::BLACK,
        gloss: None,
        coat: None,
        luminance_cd_m2: Rgb::BLACK,
    };

    /// A Lambertian surface.
    pub fn diffuse(reflectance: Rgb) -> Self {
        Self { diffuse: Reflectance { colour: reflectance, texture: None }, ..Self::BLACK }
    }

    /// A perfect mirror.
    pub fn mirror(reflectance: Rgb) -> Self {
        Self { mirror: reflectance, ..Self::BLACK }
    }

    /// Whether any part of it is glossy.
    pub fn is_glossy(&self) -> bool {
        self.gloss.is_some() || self.coat.is_some()
    }

    /// Whether it emits.
    pub fn is_emitter(&self) -> bool {
        !self.luminance_cd_m2.is_black()
    }

    /// Whether it is nothing but a mirror, so that an illuminance on it would light nothing.
    pub fn is_pure_mirror(&self) -> bool {
        self.diffuse.colour.is_black() && !self.is_glossy() && !self.mirror.is_black()
    }

    /// Whether it shines and reflects nothing diffusely, as lamps do that are described by their luminance alone: how it
    /// looks does not depend on an illuminance on it either.
    pub fn is_pure_emitter(&self) -> bool {
        self.is_emitter() && self.diffuse.colour.is_black()
    }
}

impl Material {
    /// The same finish on both sides.
    pub fn two_sided(name: impl Into<String>, finish: Finish) -> Self {
        Self { name: name.into(), body: Body::Opaque { front: finish.clone(), back: finish } }
    }

    /// A finish in front and a black back.
    pub fn one_sided(name: impl Into<String>, finish: Finish) -> Self {
        Self { name: name.into(), body: Body::Opaque { front: finish, back: Finish::BLACK } }
    }

    /// The finish of one side, `None` for a dielectric.
    pub fn finish(&self, back: bool) -> Option<&Finish> {
        match &self.body {
            Body::Opaque { front, back: rear } => Some(if back { rear } else { front }),
            Body::Dielectric(_) => None,
        }
    }

    /// Whether a side of it has a glossy part.
    pub fn is_glossy(&self) -> bool {
        [false, true].iter().any(|&back| self.finish(back).is_some_and(Finish::is_glossy))
    }
}
