//! Bright surfaces, which few rays meet unless they are sent there.

use super::*;
use crate::elements::{Elements, Subdivision, Vertex};
use crate::engine::gather::{BrightSurfaces, DirectAtEnds, Gatherer, Gathering};
use crate::engine::light::Lighting;
use crate::engine::ray::{NEVER, SurfacePoint};
use crate::map::Standing;
use crate::scene::{Body, Dielectric};
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

    fn bright(&self) -> Option<Arc<BrightSurfaces>> {
        BrightSurfaces::of(self.scene, &self.lighting, 1, &NEVER).0
    }

    /// Direct light reflected once, and light read of vertices, in many trials at a place: the mean, the standard error of that, and rays of a
    /// trial.
    fn reflected(
        &self,
        at: SurfacePoint,
        bright: Option<&BrightSurfaces>,
        read: &[Rgb],
    ) -> (f64, f64, f64) {
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
        let found = operator.apply(read);
        let (mean, error) = mean_and_error(found.iter().map(|lx| lx.luminance()));
        (mean, error, operator.rays as f64 / rows.len() as f64)
    }
}

/// With rays sent to what is bright, as much light comes to a place as without, and variance and rays fall so many times. Also, the light
/// that comes there and how far both may differ by chance.
fn gain(lit: &Lit<'_>, bright: &BrightSurfaces, at: SurfacePoint, read: &[Rgb]) -> (f64, f64, f64) {
    let (mean, error, rays) = lit.reflected(at, Some(bright), read);
    let (expected, plain_error, plain_rays) = lit.reflected(at, None, read);
    let allowed = SIGMAS * libm::hypot(error, plain_error);
    assert!((mean - expected).abs() < allowed, "{mean} +- {error} for {expected} +- {plain_error}");
    ((plain_error / error).powi(2) * plain_rays / rays, expected, allowed)
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
        let black = vec![Rgb::BLACK; lit.direct.len()];
        let (gain, ..) = gain(&lit, &bright, at, &black);
        assert!(gain > less, "at {:?}: variance and rays fall {gain} times", at.point);
    }
}

/// A can on the ceiling with a lamp inside: light that goes to and fro in it is as much brighter than that of the room.
#[test]
fn what_is_reflected_again_where_it_is_bright_is_found_by_rays_sent_there() {
    let (x, y, z) = ([0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.3]);
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    for (corner, u, v) in [
        ([1.9, 1.4, 2.2], y, z),
        ([2.1, 1.4, 2.2], z, y),
        ([1.9, 1.4, 2.2], z, x),
        ([1.9, 1.6, 2.2], x, z),
    ] {
        shapes.push(rectangle(corner, u, v, 0));
    }
    let lamps = vec![isotropic([2.0, 1.5, 2.35], 100.0)];
    let scene = scene(shapes, vec![painted(Rgb::grey(0.6))], lamps);
    let lit = Lit::of(&scene);
    let bright = lit.bright().expect("the can");
    let is_inside =
        |p: Point| (1.9..=2.1).contains(&p.x) && (1.4..=1.6).contains(&p.y) && p.z >= 2.2;
    let value = |v: &Vertex| Rgb::grey(if is_inside(v.position) { 5000.0 } else { 10.0 });
    let read: Vec<Rgb> = lit.elements.vertices().iter().map(value).collect();
    for (triangle, [u, v], less) in [(0, [0.4, 0.3], 5.0), (4, [0.2, 0.5], 1.0)] {
        let at = SurfacePoint::new(&scene, triangle, false, u, v);
        let (gain, ..) = gain(&lit, &bright, at, &read);
        assert!(gain > less, "at {:?}: variance and rays fall {gain} times", at.point);
    }
}

/// Rays come through a pane by themselves: what were sent there besides would count twice.
#[test]
fn what_is_bright_beyond_glass_is_left_to_rays_that_come_through() {
    let glass = Dielectric { ior: 1.5, transmittance: Rgb::WHITE, thin: true };
    let glass = Material { name: "pane".into(), body: Body::Dielectric(glass) };
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.push(rectangle([2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.5], 1));
    let lamps = vec![isotropic([1.3, 1.6, 2.45], 100.0)];
    let scene = scene(shapes, vec![painted(Rgb::grey(0.6)), glass], lamps);
    let lit = Lit::of(&scene);
    let bright = lit.bright().expect("the ceiling above the lamp");
    let black = vec![Rgb::BLACK; lit.direct.len()];
    // On the floor beyond the pane.
    let at = SurfacePoint::new(&scene, 0, false, 0.6, 0.2);
    assert!(at.point.x > 2.5 && at.point.z == 0.0, "{at:?}");
    let (_, expected, allowed) = gain(&lit, &bright, at, &black);
    // Twice as much would be seen.
    assert!(allowed < 0.5 * expected, "{allowed} {expected}");
}

#[test]
fn even_light_has_nothing_bright() {
    let lamps = vec![isotropic([2.0, 1.5, 1.3], 100.0)];
    let even = scene(inward_box([4.0, 3.0, 2.5], 0), vec![painted(Rgb::grey(0.6))], lamps);
    assert!(Lit::of(&even).bright().is_none());
    let dark = scene(inward_box([4.0, 3.0, 2.5], 0), vec![painted(Rgb::grey(0.6))], vec![]);
    assert!(Lit::of(&dark).bright().is_none());
}
