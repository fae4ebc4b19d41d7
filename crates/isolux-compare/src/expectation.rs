//! What a case is: a scene and what must come out.

use isolux::engine::ProbePoint;
use isolux::scene::SceneParts;
use isolux::units::Rgb;
use serde::Serialize;

/// A scene with exact answers.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name, in lower case with underscores.
    pub name: &'static str,
    /// What it tests.
    pub notes: &'static str,
    /// The scene.
    pub parts: fn() -> SceneParts,
    /// The answers; may take a second to compute.
    pub expectations: fn() -> Vec<Expectation>,
}

/// What an ideal luxmeter reads at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Where.
    pub at: ProbePoint,
    /// Which part of the light.
    pub quantity: Quantity,
    /// The exact value, lx.
    pub expected_lx: Rgb,
    /// How far the exact answer of the scene as tessellated may be from it.
    pub bound: Bound,
}

impl Expectation {
    /// Of a scene in which nothing reflects diffusely: all light is direct.
    pub fn direct_only(at: ProbePoint, expected_lx: Rgb, bound: Bound) -> [Self; 2] {
        [Quantity::Direct, Quantity::Total].map(|quantity| Self {
            at,
            quantity,
            expected_lx,
            bound,
        })
    }
}

/// A part of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// All of it.
    Total,
    /// Without any diffuse reflection.
    Direct,
    /// After at least one diffuse reflection.
    Indirect,
}

impl Quantity {
    /// The three parts with their values.
    pub fn split(direct_lx: Rgb, indirect_lx: Rgb) -> [(Self, Rgb); 3] {
        [
            (Self::Direct, direct_lx),
            (Self::Indirect, indirect_lx),
            (Self::Total, direct_lx + indirect_lx),
        ]
    }
}

/// A bound with its reason.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// Largest difference, lx.
    pub lx: f64,
    /// Why it is not zero.
    pub reason: &'static str,
}

impl Bound {
    /// The triangles are the very surfaces of the closed form.
    pub const EXACT_GEOMETRY: Self = Self { lx: 0.0, reason: "geometry is exact" };
}
