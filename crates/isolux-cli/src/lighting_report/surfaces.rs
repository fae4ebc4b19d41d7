//! The surfaces of a report, by material.

use crate::shown::name;
use isolux::scene::{Finish, Material, Scene, Texture};
use isolux::units::Rgb;
use isolux_report::Surface;

/// All materials that some surface has, the largest first.
pub(super) fn of(scene: &Scene) -> Vec<Surface> {
    let mut areas_m2 = vec![0.0; scene.materials().len()];
    for triangle in 0..scene.triangle_count() {
        areas_m2[scene.material_index(triangle) as usize] += scene.triangle(triangle).area();
    }
    let textures: Vec<Rgb> = scene.textures().iter().map(Texture::mean).collect();
    let surface = |(material, &area_m2): (&Material, &f64)| Surface {
        name: name(&material.name),
        area_m2,
        reflectance: lit_side(material).map(|finish| diffuse(finish, &textures)),
        specular: lit_side(material).map_or(0.0, specular),
    };
    let all = scene.materials().iter().zip(&areas_m2).filter(|(_, area_m2)| **area_m2 > 0.0);
    let mut surfaces: Vec<Surface> = all.map(surface).collect();
    surfaces.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
    surfaces
}

/// The area of all triangles, and the mean diffuse reflectance of those that are not glass.
pub(super) fn mean(scene: &Scene) -> (f64, f64) {
    let surfaces = of(scene);
    let area_m2: f64 = surfaces.iter().map(|of| of.area_m2).sum();
    let opaque = || surfaces.iter().filter_map(|of| Some((of.area_m2, of.reflectance?)));
    let opaque_m2: f64 = opaque().map(|(area_m2, _)| area_m2).sum();
    let reflected_m2: f64 = opaque().map(|(area_m2, share)| area_m2 * share).sum();
    (area_m2, if opaque_m2 > 0.0 { reflected_m2 / opaque_m2 } else { 0.0 })
}

/// The front, or the back where the front is black; `None` of glass.
fn lit_side(material: &Material) -> Option<&Finish> {
    let [front, back] = [false, true].map(|back| material.finish(back));
    front.filter(|front| **front != Finish::BLACK).or(back).or(front)
}

fn diffuse(finish: &Finish, textures: &[Rgb]) -> f64 {
    let of = finish.diffuse;
    let texture = of.texture.and_then(|index| textures.get(index as usize));
    let factor = texture.map_or(Rgb::WHITE, |mean| *mean);
    (of.colour * factor).luminance()
}

fn specular(finish: &Finish) -> f64 {
    let gloss = finish.gloss.map_or(0.0, |gloss| gloss.f0.luminance());
    finish.mirror.luminance() + gloss
}
