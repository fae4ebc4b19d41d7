//! Mean diffuse reflectance of surfaces.

use crate::elements::{Origin, Subdivision};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Triangle;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

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

/// Photometric diffuse reflectances of elements, each evaluated when it is first asked for.
#[derive(Debug, Default)]
pub(crate) struct Reflectances(Mutex<Vec<Option<f64>>>);

impl Reflectances {
    /// Mean reflectance of all surfaces, weighted by area. All calls are about one
    /// subdivision, which may be refined meanwhile, or about a copy from before that.
    pub(crate) fn of_all(&self, scene: &Scene, subdivision: &Subdivision) -> f64 {
        let leaves: Vec<u32> = subdivision.leaves().collect();
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let nodes = leaves.iter().max().map_or(0, |&node| node as usize + 1);
        let nodes = nodes.max(known.len());
        known.resize(nodes, None);
        let of_node = |node: u32| {
            let part = subdivision.triangle(node);
            of_part(scene, &subdivision.node(node).1, &part, node).luminance()
        };
        let is_new = |node: &u32| known[*node as usize].is_none();
        let new: Vec<u32> = leaves.iter().copied().filter(is_new).collect();
        let found: Vec<f64> = new.par_iter().with_min_len(256).map(|&node| of_node(node)).collect();
        for (node, reflectance) in new.into_iter().zip(found) {
            known[node as usize] = Some(reflectance);
        }
        let (mut area_m2, mut reflected_m2) = (0.0, 0.0);
        for node in leaves {
            let m2 = subdivision.triangle(node).area();
            area_m2 += m2;
            reflected_m2 += m2 * known[node as usize].unwrap_or(0.0);
        }
        reflected_m2 / area_m2
    }
}
