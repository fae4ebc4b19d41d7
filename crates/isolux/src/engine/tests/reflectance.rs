//! What surfaces reflect in the mean.

use super::*;
use crate::elements::Subdivision;
use crate::engine::ray::reflectance::Reflectances;
use crate::scene::Texture;

#[test]
fn textures_count() {
    // A white finish under a picture of two greys, side by side; each covers half of the rectangle.
    let dark_and_light = [0, 0, 0, 188, 188, 188];
    let texture = Texture { width: 2, height: 1, srgb: dark_and_light.to_vec() };
    let mut finish = Finish::diffuse(Rgb::WHITE);
    finish.diffuse.texture = Some(0);
    let mut floor = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0);
    floor.uvs = Some(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let parts = SceneParts {
        shapes: vec![floor],
        materials: vec![Material::one_sided("tiles", finish)],
        textures: vec![texture],
        ..SceneParts::default()
    };
    let scene = Scene::assemble(parts).unwrap();
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(0.2, usize::MAX);
    let reflectances = Reflectances::default();
    let found = reflectances.of_all(&scene, &subdivision);
    assert_eq!(reflectances.of_all(&scene, &subdivision), found);
    // Elements that are made later count, too.
    let [mut refined, fresh] = [subdivision.clone(), subdivision.clone()];
    refined.bisect_to(0.1, usize::MAX);
    assert_ne!(refined.vertex_count(), fresh.vertex_count());
    let of_new = Reflectances::default().of_all(&scene, &refined);
    assert_eq!(reflectances.of_all(&scene, &refined), of_new);
    // 16 places in each of some hundred elements of a linear ramp from one to the other.
    let mean = scene.textures()[0].mean().luminance();
    assert!((found - mean).abs() < 0.01 * mean, "{found} for {mean}");
}
