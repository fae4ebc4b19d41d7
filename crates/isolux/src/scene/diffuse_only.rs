//! A scene without specular transport, for comparison.

use super::{Body, Dielectric, Finish, Material, Scene, SceneProblem};
use crate::units::Rgb;

/// A refractive index that reflects nothing.
const AS_AIR: f64 = 1.0;

impl Scene {
    /// The same scene with nothing but diffuse reflection: mirrors and gloss absorb what they would
    /// have reflected, and glass lets light straight through, as in radiosity systems that leave
    /// specular surfaces to a later ray tracing (Lightscape LVS, in the study of 1998).
    pub fn diffuse_only(&self) -> Result<Self, Vec<SceneProblem>> {
        let mut parts = self.to_parts();
        for material in &mut parts.materials {
            *material = Material { body: diffuse(&material.body), ..material.clone() };
        }
        Self::assemble(parts)
    }
}

fn diffuse(body: &Body) -> Body {
    let without =
        |finish: &Finish| Finish { mirror: Rgb::BLACK, gloss: None, coat: None, ..finish.clone() };
    match body {
        Body::Opaque { front, back } => Body::Opaque { front: without(front), back: without(back) },
        Body::Dielectric(glass) => {
            Body::Dielectric(Dielectric { ior: AS_AIR, thin: true, ..*glass })
        }
    }
}
