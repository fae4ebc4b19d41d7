//! What energy allows: a map with more light than that is none.
//!
//! Of the light that falls on surfaces they reflect a share `rho` at most, and what they reflect is all that falls on them beside the
//! flux that comes straight. So no more than `flux / (1 - rho)` falls on them in all, and of that `rho flux / (1 - rho)` after reflections:
//! in the mean over their area what a white sphere around all luminaires has everywhere.

use crate::elements::carries_map;
use crate::engine::light::Emission;
use crate::engine::plan::Plan;
use crate::scene::{Finish, Scene, Texture};
use crate::units::Rgb;

/// Noise and interpolation are part of a map: what it errs by where it knows nothing yet is all of the light, and so it may have twice as
/// much as there is.
const ERRS_BY: f64 = 1.0;

/// The most that comes to surfaces after diffuse reflections, in the mean, lx; infinite where some reflect all light.
pub(crate) fn allowed_lx(scene: &Scene, area_m2: f64) -> f64 {
    let flux_lm = Emission::new(scene).map_or(0.0, |emission| emission.flux_lm());
    let share = most_reflected(scene);
    if share < 1.0 { flux_lm * share / (1.0 - share) / area_m2 } else { f64::INFINITY }
}

/// What energy allows the map of a plan.
pub(crate) struct Allowed {
    /// In the mean over the surface, lx.
    lx: f64,
    /// The surface that every vertex stands for where all of an element is known, m2.
    known_m2: Vec<f64>,
    /// All of the surface, m2.
    area_m2: f64,
}

impl Allowed {
    pub(crate) fn of(plan: &Plan) -> Self {
        let mut known_m2 = vec![0.0; plan.mesh.standings.len()];
        for leaf in plan.mesh.subdivision.leaves() {
            let corners = plan.mesh.subdivision.node(leaf).0.vertices.map(|v| v as usize);
            if corners.iter().all(|&v| plan.mesh.standings[v].is_some()) {
                let third_m2 = plan.mesh.subdivision.triangle(leaf).area() / 3.0;
                corners.iter().for_each(|&v| known_m2[v] += third_m2);
            }
        }
        let area_m2 = plan.area_m2();
        Self { lx: allowed_lx(plan.scene, area_m2), known_m2, area_m2 }
    }

    /// The mean of indirect light, as far as vertices know it, if that is more than energy allows, and what that is, lx.
    pub(crate) fn excess_lx(&self, indirect_lx: impl Fn(usize) -> f64) -> Option<[f64; 2]> {
        let known = self.known_m2.iter().enumerate().filter(|&(_, &m2)| m2 > 0.0);
        let (flux_lm, known_m2) = known.fold((0.0, 0.0), |(flux_lm, known_m2), (v, m2)| {
            (flux_lm + m2 * indirect_lx(v), known_m2 + m2)
        });
        let mean_lx = if known_m2 > 0.0 { flux_lm / self.area_m2.max(known_m2) } else { 0.0 };
        // NaN is no light that is allowed, either.
        let is_allowed = mean_lx <= (1.0 + ERRS_BY) * self.lx;
        (!is_allowed).then_some([mean_lx, self.lx])
    }
}

/// The greatest share of light that a surface with a map reflects.
fn most_reflected(scene: &Scene) -> f64 {
    let brightest: Vec<Rgb> = scene.textures().iter().map(Texture::brightest).collect();
    let of = |finish: &Finish| {
        let texture = finish.diffuse.texture.and_then(|t| brightest.get(t as usize));
        let diffuse = finish.diffuse.colour * texture.copied().unwrap_or(Rgb::WHITE);
        let gloss =
            if finish.is_glossy() { Rgb::WHITE - finish.diffuse.colour } else { finish.mirror };
        (diffuse + gloss.greater(finish.mirror)).max_channel()
    };
    let sides = (0..scene.triangle_count()).flat_map(|t| [false, true].map(|back| (t, back)));
    let with_map = sides.filter(|&(t, back)| carries_map(scene, t, back));
    let shares = with_map.filter_map(|(t, back)| Some(of(scene.material(t).finish(back)?)));
    shares.fold(0.0, f64::max)
}
