//! How much light there is, and how much of it stays.

use super::finding::Finding;
use crate::quantity::significant;
use isolux::scene::{Body, Finish, LuminaireKind, Scene};

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
    /// Area of the sides that are not black.
    inside_m2: f64,
    has_directional: bool,
    materials_above_bright: Vec<String>,
}

impl Energy {
    pub(super) fn of(scene: &Scene) -> Self {
        let (mut area_m2, mut inside_m2, mut reflected_m2) = (0.0, 0.0, 0.0);
        for triangle in 0..scene.triangle_count() {
            let area = scene.triangle(triangle).area();
            area_m2 += area;
            for back in [false, true] {
                let share = scene.material(triangle).finish(back).map(|f| reflectance(scene, f));
                if let Some(share) = share.filter(|share| *share > 0.0) {
                    inside_m2 += area;
                    reflected_m2 += area * share;
                }
            }
        }
        Self {
            area_m2,
            flux_lm: scene.luminous_flux_lm(),
            mean_reflectance: if inside_m2 > 0.0 { reflected_m2 / inside_m2 } else { 0.0 },
            inside_m2,
            has_directional: scene
                .luminaires()
                .iter()
                .any(|l| matches!(l.kind, LuminaireKind::Directional { .. })),
            materials_above_bright: bright_materials(scene),
        }
    }

    /// What the balance of a closed room gives: flux over absorbing area. `None` for others.
    pub(super) fn mean_illuminance_lx(&self, is_closed: bool) -> Option<f64> {
        let absorbing_m2 = self.inside_m2 * (1.0 - self.mean_reflectance);
        let applies = is_closed && !self.has_directional && absorbing_m2 > 0.0;
        applies.then(|| self.flux_lm / absorbing_m2)
    }

    pub(super) fn findings(&self) -> Vec<Finding> {
        let mut found = Vec::new();
        if self.flux_lm <= 0.0 && !self.has_directional {
            found.push(Finding::warning(
                "scene",
                "there is no light",
                "add a luminaire or an emitting material",
            ));
        }
        let brightness = if self.area_m2 > 0.0 { self.flux_lm / self.area_m2 } else { 0.0 };
        if brightness > GLARING_LX || (brightness > 0.0 && brightness < DIM_LX) {
            found.push(Finding::warning(
                "luminaires",
                format!("{} lm for each m2 of surface", significant(brightness, 2)),
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

/// Share of diffuse light that a finish does not absorb, near enough for a balance.
fn reflectance(scene: &Scene, finish: &Finish) -> f64 {
    let texture = finish.diffuse.texture.and_then(|t| scene.textures().get(t as usize));
    let mean = texture.map_or(finish.diffuse.colour, |t| finish.diffuse.colour * t.mean());
    let gloss = finish.gloss.map_or(0.0, |g| g.f0.luminance());
    (mean + finish.mirror).luminance() + gloss
}

fn bright_materials(scene: &Scene) -> Vec<String> {
    let is_bright = |finish: &Finish| {
        // A mirror may be perfect, a wall not.
        finish.mirror.is_black() && reflectance(scene, finish) > BRIGHT
    };
    scene
        .materials()
        .iter()
        .filter(|m| match &m.body {
            Body::Opaque { front, back } => is_bright(front) || is_bright(back),
            Body::Dielectric(_) => false,
        })
        .map(|m| m.name.clone())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::scene::SceneParts;

    fn energy(change: impl FnOnce(&mut SceneParts)) -> Energy {
        let mut parts = isolux_compare::builtin("cube").unwrap();
        change(&mut parts);
        Energy::of(&Scene::assemble(parts).unwrap())
    }

    #[test]
    fn the_balance_of_the_cube_is_that_of_its_closed_form() {
        let energy = energy(|_| {});
        // 4 pi I over the absorbing third of 600 m2.
        let expected = 4.0 * std::f64::consts::PI * 50_000.0 / 200.0;
        let found = energy.mean_illuminance_lx(true).unwrap();
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} lx");
        assert_eq!(energy.mean_illuminance_lx(false), None);
        assert!(energy.findings().is_empty());
    }

    #[test]
    fn scenes_without_light_and_with_watts_for_lumens_are_found() {
        assert_eq!(energy(|parts| parts.luminaires.clear()).findings().len(), 1);
        for factor in [1e-6, 1e6] {
            let scaled = energy(|parts| {
                for luminaire in &mut parts.luminaires {
                    if let LuminaireKind::Point { intensity, .. } = &mut luminaire.kind {
                        *intensity = intensity.scaled(factor);
                    }
                }
            });
            assert_eq!(scaled.findings().len(), 1, "{factor}");
        }
    }
}
