//! The energy bound: a map with more light than luminaires can cause is wrong.
//!
//! Surfaces reflect a share `rho` of their light at most, and receive the direct flux and the reflected flux.
//! So they receive at most `flux / (1 - rho)` in all, and `rho flux / (1 - rho)` after reflections. Its mean
//! over their area is what a white sphere around all luminaires would have everywhere.

use crate::elements::carries_map;
use crate::engine::light::Emission;
use crate::engine::plan::Plan;
use crate::scene::{Finish, Scene, Texture};
use crate::units::Rgb;

/// The bound on the mean illuminance after diffuse reflections, lx; infinite where a surface reflects all
/// light.
pub(crate) fn allowed_lx(scene: &Scene, area_m2: f64) -> f64 {
    let flux_lm = Emission::new(scene).map_or(0.0, |emission| emission.flux_lm());
    let share = most_reflected(scene);
    if share < 1.0 { flux_lm * share / (1.0 - share) / area_m2 } else { f64::INFINITY }
}

/// The energy bound for the map of a plan.
pub(crate) struct Allowed {
    /// The bound on the mean over the surface, lx.
    lx: f64,
    /// The area that each vertex stands for on elements whose vertices are all known, m2.
    known_m2: Vec<f64>,
    /// The area of all of the surface, m2.
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

    /// The mean indirect light of the known vertices and the bound, lx, if the mean exceeds twice the bound.
    pub(crate) fn excess_lx(&self, indirect_lx: impl Fn(usize) -> f64) -> Option<[f64; 2]> {
        let known = self.known_m2.iter().enumerate().filter(|&(_, &m2)| m2 > 0.0);
        let (flux_lm, known_m2) = known.fold((0.0, 0.0), |(flux_lm, known_m2), (v, m2)| {
            (flux_lm + m2 * indirect_lx(v), known_m2 + m2)
        });
        let mean_lx = if known_m2 > 0.0 { flux_lm / self.area_m2.max(known_m2) } else { 0.0 };
        // Where a map knows nothing yet, its error is all of the light, so it may hold twice the bound. The
        // comparison is such that NaN is an excess, too.
        let is_allowed = mean_lx <= 2.0 * self.lx;
        (!is_allowed).then_some([mean_lx, self.lx])
    }
}

/// The largest reflectance of any surface that carries a map.
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
