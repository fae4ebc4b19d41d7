//! Surfaces that show what they face, by the planes they lie in: a page draws the picture in a mirror plane by plane.

use crate::map_glb::display::Layer;
use isolux::geometry::{Normal, Point};
use isolux::scene::{Finish, Scene};
use std::collections::BTreeMap;

/// Layers of more planes are taken for curved.
const MOST: usize = 16;
/// Facets wider than this blur what they show.
const SHARP_ALPHA: f64 = 0.02;
/// Planes are one within this angle, about, and this share of the size of their place.
const ALIKE: f64 = 1e-4;

/// The planes of layers that reflect sharply.
pub(super) struct Planes {
    /// By shape, material and side; those of curved ones are left out.
    known: BTreeMap<(u32, u32, bool), Vec<(Normal, Point)>>,
}

impl Planes {
    /// Those of a scene.
    pub(super) fn new(scene: &Scene) -> Self {
        let mut known: BTreeMap<_, Vec<(Normal, Point)>> = BTreeMap::new();
        for triangle in 0..scene.triangle_count() {
            for back in [false, true] {
                if scene.material(triangle).finish(back).is_some_and(is_sharp) {
                    let key = (scene.shape_of(triangle), scene.material_index(triangle), back);
                    let planes = known.entry(key).or_default();
                    // One too many tells of a curved surface.
                    if planes.len() <= MOST && number(scene, planes, triangle).is_none() {
                        let [place, ..] = scene.triangle(triangle).corners;
                        planes.push((scene.geometric_normal(triangle), place));
                    }
                }
            }
        }
        known.retain(|_, planes| planes.len() <= MOST);
        Self { known }
    }

    /// The number of the plane that a triangle lies in among those of its layer; zero for all where that does not reflect sharply, or is curved.
    pub(super) fn of(&self, scene: &Scene, layer: Layer, triangle: u32) -> usize {
        let planes = self.known.get(&(layer.shape, layer.material, layer.back));
        planes.and_then(|planes| number(scene, planes, triangle)).unwrap_or(0)
    }
}

fn number(scene: &Scene, planes: &[(Normal, Point)], triangle: u32) -> Option<usize> {
    let normal = scene.geometric_normal(triangle);
    let [place, ..] = scene.triangle(triangle).corners;
    planes.iter().position(|(other, at)| {
        let away = place - *at;
        let off = away.dot(other.to_vector()).abs();
        other.dot(normal) > 1.0 - ALIKE && off <= ALIKE * away.length()
    })
}

/// Whether a side shows something of what it faces without blur.
fn is_sharp(finish: &Finish) -> bool {
    let is_smooth = |alpha: f64| alpha < SHARP_ALPHA;
    !finish.mirror.is_black()
        || finish.gloss.is_some_and(|gloss| is_smooth(gloss.alpha))
        || finish.coat.is_some_and(|coat| is_smooth(coat.alpha))
}
