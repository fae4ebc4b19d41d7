//! Sides that no light comes to: they need no texels of their own.

use super::charts::Patch;
use super::layout::Layout;
use super::own_places::root;
use super::plan::{self, Sides};
use crate::elements::Element;
use crate::map::IlluminationMap;
use crate::scene::Scene;
use std::collections::{HashMap, HashSet};

/// Sides of which the map knows nothing, or that no light comes to at any vertex, without doubt. Only whole surfaces,
/// up to their creases, and none that give light of their own: no chart is torn.
pub fn dark_sides(scene: &Scene, map: &IlluminationMap) -> HashSet<(u32, bool)> {
    let gives_light = |element: &Element| {
        let finish = scene.material(element.triangle).finish(element.back);
        finish.is_some_and(|finish| finish.is_emitter())
    };
    let lit: HashSet<(u32, bool)> = map
        .elements
        .elements()
        .iter()
        .filter(|&element| gives_light(element) || !is_dark(map, element))
        .map(|element| (element.triangle, element.back))
        .collect();
    let (patches, sides): (Vec<Patch>, Sides) = plan::patches(scene, |_| true);
    let of_patch = |(patch, sides): (&Patch, &Vec<(u32, bool)>)| -> Vec<(u32, bool)> {
        let surfaces = surfaces(patch);
        let numbered = || surfaces.iter().zip(sides);
        let bright: HashSet<usize> =
            numbered().filter(|(_, side)| lit.contains(side)).map(|(&number, _)| number).collect();
        numbered().filter(|(n, _)| !bright.contains(n)).map(|(_, &side)| side).collect()
    };
    patches.iter().zip(&sides).flat_map(of_patch).collect()
}

/// The share of the area with texels that is of dark sides.
pub fn dark_share(scene: &Scene, map: &IlluminationMap, layout: &Layout) -> f64 {
    let dark = dark_sides(scene, map);
    let (mut all_m2, mut dark_m2) = (0.0, 0.0);
    for side in layout.sides.iter().filter(|side| !side.is_point()) {
        let area_m2 = scene.triangle(side.triangle).area();
        all_m2 += area_m2;
        if dark.contains(&(side.triangle, side.back)) {
            dark_m2 += area_m2;
        }
    }
    if all_m2 > 0.0 { dark_m2 / all_m2 } else { 0.0 }
}

/// Whether a map has no light for an element, and no doubt about that.
fn is_dark(map: &IlluminationMap, element: &Element) -> bool {
    element.vertices.iter().filter_map(|&vertex| map.read_at_vertex(vertex)).all(|value| {
        let errors_lx = [
            value.standard_error_lx,
            value.indirect_standard_error_lx,
            value.interpolation_error_lx,
        ];
        value.total_lx().is_black() && errors_lx == [0.0; 3]
    })
}

/// The surface of each triangle of a patch: those that share an edge which is no crease are of one.
fn surfaces(patch: &Patch) -> Vec<usize> {
    let mut edges: HashMap<[u32; 2], usize> = HashMap::new();
    let mut parent: Vec<usize> = (0..patch.triangles.len()).collect();
    for (index, (corners, creases)) in patch.triangles.iter().zip(&patch.creases).enumerate() {
        for k in (0..3).filter(|&k| !creases[k]) {
            let mut edge = [corners[k], corners[(k + 1) % 3]];
            edge.sort_unstable();
            let other = *edges.entry(edge).or_insert(index);
            let (a, b) = (root(&mut parent, index), root(&mut parent, other));
            parent[a.max(b)] = a.min(b);
        }
    }
    (0..parent.len()).map(|index| root(&mut parent, index)).collect()
}
