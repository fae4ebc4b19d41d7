//! How much light there is, and how much of it stays.

use super::finding::Finding;
use crate::quantity::significant;
use isolux::scene::{Finish, Material, Scene, Texture};
use isolux::units::Rgb;

/// Above this the light of a closed room would take a hundred reflections to die.
const BRIGHT: f64 = 0.95;
/// No interior is brighter on average, direct sun included.
const GLARING_LX: f64 = 100_000.0;
/// Emergency lighting gives more.
const DIM_LX: f64 = 0.1;

/// The balance of a scene.
pub(super) struct Energy {
    /// Of all triangles, one side each.
    pub area_m2: f64,
    /// Of what emits.
    pub flux_lm: f64,
    /// Share of the light that is not absorbed, mean over all sides that are not black.
    pub mean_reflectance: f64,
    /// Sources of parallel light.
    pub parallel: usize,
    materials_above_bright: Vec<String>,
}

impl Energy {
    pub(super) fn of(scene: &Scene) -> Self {
        let (mut area_m2, mut inside_m2, mut reflected_m2) = (0.0, 0.0, 0.0);
        let reflectances = Reflectances::of(scene);
        for triangle in 0..scene.triangle_count() {
            let area = scene.triangle(triangle).area();
            area_m2 += area;
            for share in reflectances.of_triangle(scene, triangle) {
                if share > 0.0 {
                    inside_m2 += area;
                    reflected_m2 += area * share;
                }
            }
        }
        Self {
            area_m2,
            // A sum of nothing is -0.
            flux_lm: scene.luminous_flux_lm() + 0.0,
            mean_reflectance: if inside_m2 > 0.0 { reflected_m2 / inside_m2 } else { 0.0 },
            parallel: scene.luminaires().iter().filter(|l| l.kind.is_infinitely_far()).count(),
            materials_above_bright: bright_materials(scene, &reflectances),
        }
    }

    /// What is strange about the light, where so much of the surface is lit.
    pub(super) fn findings(&self, lit_m2: f64) -> Vec<Finding> {
        let mut found = Vec::new();
        if self.flux_lm <= 0.0 && self.parallel == 0 {
            found.push(Finding::warning(
                "scene",
                "there is no light",
                "let a material emit, or write a scene.toml with a [[luminaire]] that names this file as its geometry",
            ));
        }
        let brightness = if lit_m2 > 0.0 { self.flux_lm / lit_m2 } else { 0.0 };
        if brightness > GLARING_LX || (brightness > 0.0 && brightness < DIM_LX) {
            found.push(Finding::warning(
                "luminaires",
                format!("{} lm for each m2 of lit surface", significant(brightness, 2)),
                "check their unit: candela and lumen, not watt",
            ));
        }
        found.extend(self.materials_above_bright.iter().map(|name| {
            Finding::warning(
                format!("material `{name}`"),
                format!("reflects more than {} %", 100.0 * BRIGHT),
                "fresh white paint reflects 85 %: lower it, unless it is meant",
            )
        }));
        found
    }
}

/// What front and back of every material reflect; zero for glass.
struct Reflectances(Vec<[f64; 2]>);

impl Reflectances {
    fn of(scene: &Scene) -> Self {
        let means: Vec<Rgb> = scene.textures().iter().map(Texture::mean).collect();
        let sides = |material: &Material| {
            [false, true].map(|back| material.finish(back).map_or(0.0, |f| reflectance(f, &means)))
        };
        Self(scene.materials().iter().map(sides).collect())
    }

    fn of_triangle(&self, scene: &Scene, triangle: u32) -> [f64; 2] {
        self.0[scene.material_index(triangle) as usize]
    }
}

/// Share of diffuse light that a finish does not absorb, near enough for a balance.
fn reflectance(finish: &Finish, texture_means: &[Rgb]) -> f64 {
    let texture = finish.diffuse.texture.and_then(|t| texture_means.get(t as usize));
    let mean = texture.map_or(finish.diffuse.colour, |t| finish.diffuse.colour * *t);
    (mean + finish.mirror).luminance() + finish.glossy_f0().luminance()
}

fn bright_materials(scene: &Scene, reflectances: &Reflectances) -> Vec<String> {
    let is_bright = |material: &Material, shares: &[f64; 2]| {
        [false, true].into_iter().zip(shares).any(|(back, share)| {
            // A mirror may be perfect, a wall not.
            *share > BRIGHT && material.finish(back).is_some_and(|f| f.mirror.is_black())
        })
    };
    let all = scene.materials().iter().zip(&reflectances.0);
    all.filter(|(m, shares)| is_bright(m, shares)).map(|(m, _)| m.name.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::scene::LuminaireKind;
    use isolux::scene::SceneParts;

    fn energy(change: impl FnOnce(&mut SceneParts)) -> Energy {
        let mut parts = isolux_compare::builtin("cube").unwrap();
        change(&mut parts);
        Energy::of(&Scene::assemble(parts).unwrap())
    }

    #[test]
    fn scenes_without_light_and_with_watts_for_lumens_are_found() {
        assert!(energy(|_| {}).findings(600.0).is_empty());
        assert_eq!(energy(|parts| parts.luminaires.clear()).findings(0.0).len(), 1);
        for factor in [1e-6, 1e6] {
            let scaled = energy(|parts| {
                for luminaire in &mut parts.luminaires {
                    if let LuminaireKind::Point { intensity, .. } = &mut luminaire.kind {
                        *intensity = intensity.scaled(factor);
                    }
                }
            });
            assert_eq!(scaled.findings(600.0).len(), 1, "{factor}");
        }
    }
}
