//! Mean diffuse reflectance of surfaces.

use crate::elements::{Origin, Subdivision};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Triangle;
use rayon::prelude::*;

/// Places in an element at which its texture is sampled.
const TEXTURE_PLACES: u32 = 16;

/// Mean diffuse reflectance of a part of a triangle. `number` seeds the places at which its texture is
/// sampled.
pub(crate) fn of_part(scene: &Scene, origin: &Origin, part: &Triangle, number: u32) -> Rgb {
    let Some(finish) = scene.material(origin.triangle).finish(origin.back) else {
        return Rgb::BLACK;
    };
    if finish.diffuse.texture.is_none() {
        return finish.diffuse.colour;
    }
    let sequence = Sequence::new(Key::new(0).with(u64::from(number)));
    let at = |k: u32| {
        let [a, b] = sequence.pair(k, 0);
        let root = a.sqrt();
        let place = part.point(root * (1.0 - b), root * b);
        let [u, v] = scene.triangle(origin.triangle).barycentric(place);
        scene.diffuse_reflectance(finish, origin.triangle, u, v)
    };
    (0..TEXTURE_PLACES).map(at).sum::<Rgb>() / f64::from(TEXTURE_PLACES)
}

/// Mean photometric diffuse reflectance of all surfaces, weighted by area.
pub(crate) fn of_all(scene: &Scene, subdivision: &Subdivision) -> f64 {
    let of_leaf = |node: u32| {
        let part = subdivision.triangle(node);
        let m2 = part.area();
        (m2, m2 * of_part(scene, &subdivision.node(node).1, &part, node).luminance())
    };
    let leaves: Vec<u32> = subdivision.leaves().collect();
    let all: Vec<(f64, f64)> = leaves.into_par_iter().with_min_len(256).map(of_leaf).collect();
    let (area_m2, reflected_m2) =
        all.iter().fold((0.0, 0.0), |(m2, all), of| (m2 + of.0, all + of.1));
    reflected_m2 / area_m2
}
