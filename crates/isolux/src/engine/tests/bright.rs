//! Bright surfaces, which few rays meet unless they are sent there.

use super::*;
use crate::elements::{Elements, Subdivision};
use crate::engine::bright::Bright;
use crate::engine::direct::Lighting;
use crate::engine::gather::{DirectAtEnds, Gatherer, Gathering};
use crate::engine::surface::SurfacePoint;
use crate::map::Standing;
use std::sync::Arc;

/// A room with a lamp 5 cm below its ceiling.
fn room() -> Scene {
    let lamps = vec![isotropic([1.3, 1.6, 2.45], 100.0)];
    scene(inward_box([4.0, 3.0, 2.5], 0), vec![painted(Rgb::grey(0.6))], lamps)
}

struct Lit<'a> {
    scene: &'a Scene,
    lighting: Lighting<'a>,
    elements: Elements,
    direct: Vec<Rgb>,
}

impl<'a> Lit<'a> {
    fn of(scene: &'a Scene) -> Self {
        let mut subdivision = Subdivision::new(scene);
        subdivision.bisect_to(0.06, usize::MAX);
        let lighting = Lighting::new(scene);
        let receivers = subdivision.receivers(0.01);
        let at = receivers.iter().map(|r| Gatherer::at_vertex(scene, r, 0).surface);
        let direct = at.map(|at| lighting.illuminance(&at, &mut dice(0))).collect();
        Self { scene, lighting, elements: subdivision.elements(), direct }
    }

    fn bright(&self) -> Option<Arc<Bright>> {
        Bright::of(self.scene, &self.lighting, 1).0
    }

    /// Direct light reflected once, in many trials at a place: its mean, the standard error of that, and rays of a trial.
    fn reflected(&self, at: SurfacePoint, bright: Option<&Bright>) -> (f64, f64, f64) {
        let standings = vec![Some(Standing::Open); self.direct.len()];
        let gathering = Gathering {
            scene: self.scene,
            lighting: &self.lighting,
            elements: &self.elements,
            level: u32::MAX,
            standings: &standings,
            direct: DirectAtEnds::Evaluated,
            regathers: false,
            bright,
            cuts: None,
            backdrop: None,
        };
        let rows = vec![Gatherer::on_surface(at, 16); 4000];
        let operator = gathering.operator(&rows, |k| Key::new(3).with(k as u64));
        let black = vec![Rgb::BLACK; self.direct.len()];
        let found = operator.apply(&black);
        let (mean, error) = mean_and_error(found.iter().map(|lx| lx.luminance()));
        (mean, error, operator.rays as f64 / rows.len() as f64)
    }
}

#[test]
fn rays_sent_to_what_is_bright_bring_the_same_light_with_less_noise() {
    let scene = room();
    let lit = Lit::of(&scene);
    let bright = lit.bright().expect("the ceiling above the lamp");
    // On the floor, on a wall, and on the ceiling itself, from which none of it is seen.
    for (triangle, [u, v], less) in
        [(0, [0.4, 0.3], 10.0), (4, [0.2, 0.5], 5.0), (10, [0.3, 0.3], 0.99)]
    {
        let at = SurfacePoint::new(&scene, triangle, false, u, v);
        let (mean, error, rays) = lit.reflected(at, Some(&bright));
        let (expected, plain_error, plain_rays) = lit.reflected(at, None);
        let allowed = SIGMAS * libm::hypot(error, plain_error);
        assert!(
            (mean - expected).abs() < allowed,
            "{mean} +- {error} for {expected} +- {plain_error}"
        );
        let gain = (plain_error / error).powi(2) * plain_rays / rays;
        assert!(gain > less, "at {:?}: variance and rays fall {gain} times", at.point);
    }
}

#[test]
fn even_light_has_nothing_bright() {
    let lamps = vec![isotropic([2.0, 1.5, 1.3], 100.0)];
    let even = scene(inward_box([4.0, 3.0, 2.5], 0), vec![painted(Rgb::grey(0.6))], lamps);
    assert!(Lit::of(&even).bright().is_none());
    let dark = scene(inward_box([4.0, 3.0, 2.5], 0), vec![painted(Rgb::grey(0.6))], vec![]);
    assert!(Lit::of(&dark).bright().is_none());
}
