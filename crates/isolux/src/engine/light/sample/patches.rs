//! Visible parts of the light tree from patches of surfaces, found once for all receivers on a patch.
//!
//! A cut of the light tree takes longer than the shadow rays that it chooses, and close places see nearly the same.
//! A patch is so small against the distance of the nearest luminaire that the choice of luminaires hardly changes
//! over it. Everything visible from anywhere on a patch counts as visible, so estimates have no bias. Patches are
//! cells of a grid over a triangle and depend on the place alone, so the order of the receivers does not matter.

use super::super::lighting::Lighting;
use super::super::tree::Tree;
use super::super::tree::cut::{Cut, Parts};
use crate::ablation::without;
use crate::engine::ray::{INWARD_ROUNDINGS, SurfacePoint};
use isolux_geometry::Point;
use std::sync::{Arc, Mutex, PoisonError};

/// The greatest length of a cell, as a share of the distance to the nearest luminaire. The light of that luminaire
/// differs by the same share over half a cell. A view of the hall takes 47, 33 and 27 s with a hundredth, a
/// twentieth and a fifth; with a fifth, a lightmap takes a hundredth more readings (decision 30).
const CELL_LENGTH_SHARE: f64 = 0.1;

/// Cosine between the geometric and the shading normal above which they are equal but for rounding.
const FLAT_COS: f64 = 1.0 - 1e-12;

/// Number of patches that every thread keeps.
const KEPT_PATCHES: usize = 64;

/// Bound of the number of cells along an edge.
const CELLS_BOUND: f64 = (1_u64 << 30) as f64;

/// A cell of a triangle: its index along the two edges from the first corner, and the number of cells along them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cell {
    triangle: u32,
    back: bool,
    along: [u32; 2],
    of: [u32; 2],
}

/// A patch of a surface, with its middle and its radius about that.
pub(crate) struct Patch {
    cell: Cell,
    middle: SurfacePoint,
    reach_m: f64,
}

/// The parts that a thread has kept, by cell.
type Kept = Vec<Option<(Cell, Arc<Parts>)>>;

/// A cache of the parts seen from patches, one for each thread.
pub(crate) struct Patches {
    of_threads: Vec<Mutex<Kept>>,
}

impl Lighting<'_> {
    /// [`Lighting::fine_cut`] with the parts of the patch that a receiver lies on, where there is one.
    pub(crate) fn cut_on(&self, patches: &Patches, at: &SurfacePoint) -> Cut<'_> {
        match Patch::of(self, at).filter(|_| !without("patch-visibility")) {
            None => self.fine_cut(at),
            Some(patch) => {
                let parts =
                    patches.parts(patch, |middle, reach_m| self.parts_about(middle, reach_m));
                Cut { views: self.views(at, 0.0), parts }
            }
        }
    }
}

impl Patches {
    /// An empty cache.
    pub(crate) fn new() -> Self {
        let threads = rayon::current_num_threads() + 1;
        Self { of_threads: (0..threads).map(|_| Mutex::default()).collect() }
    }

    /// The parts seen from a patch; `find` computes them if they are not in the cache.
    pub(crate) fn parts(
        &self,
        patch: Patch,
        find: impl FnOnce(&SurfacePoint, f64) -> Parts,
    ) -> Arc<Parts> {
        let thread = rayon::current_thread_index().map_or(0, |index| index + 1);
        let kept = &self.of_threads[thread % self.of_threads.len()];
        let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.resize(KEPT_PATCHES, None);
        let slot = &mut kept[patch.cell.slot()];
        match slot {
            Some((cell, parts)) if *cell == patch.cell => parts.clone(),
            _ => {
                let parts = Arc::new(find(&patch.middle, patch.reach_m));
                *slot = Some((patch.cell, parts.clone()));
                parts
            }
        }
    }
}

impl Patch {
    /// The patch that a place lies on. There is none where the shading normal differs from the
    /// geometric one, since the horizon then differs from place to place.
    pub(crate) fn of(lighting: &Lighting, at: &SurfacePoint) -> Option<Self> {
        if at.shading.dot(at.geometric) < FLAT_COS {
            return None;
        }
        let nearest_m = lighting.tree.nearest_m(at.point, f64::INFINITY);
        let longest_m = libm::exp2(libm::floor(libm::log2(CELL_LENGTH_SHARE * nearest_m)));
        let triangle = lighting.scene.triangle(at.triangle);
        let [a, b, c] = triangle.corners;
        let edges_m = [(b - a).length(), (c - a).length()];
        let of = edges_m.map(|edge_m| (edge_m / longest_m).ceil().max(1.0));
        if !of.iter().all(|&count| count < CELLS_BOUND) {
            return None;
        }
        let along = [(at.u, of[0]), (at.v, of[1])];
        let along = along.map(|(share, of)| (share * of).floor().clamp(0.0, of - 1.0));
        let [u, v] = std::array::from_fn(|k| (along[k] + 0.5) / of[k]);
        let point = triangle.point(u, v);
        let largest_m = lighting.scene.bvh().mesh().largest_coordinate_m(at.triangle);
        let inwards_m = INWARD_ROUNDINGS * f64::from(f32::EPSILON) * largest_m;
        let half_m = 0.5 * (edges_m[0] / of[0] + edges_m[1] / of[1]);
        Some(Self {
            cell: Cell {
                triangle: at.triangle,
                back: at.back,
                along: along.map(|k| k as u32),
                of: of.map(|k| k as u32),
            },
            middle: SurfacePoint { u, v, point, shading: at.geometric, ..*at },
            reach_m: half_m + inwards_m,
        })
    }
}

impl Cell {
    /// The index in the cache; neighbouring cells have different ones.
    fn slot(&self) -> usize {
        let [i, j] = self.along;
        let place = i.wrapping_add(j.wrapping_mul(8)).wrapping_add(self.triangle.wrapping_mul(21));
        place as usize % KEPT_PATCHES
    }
}

impl Tree {
    /// Distance to the nearest luminaire, m, at most `most_m`.
    pub(crate) fn nearest_m(&self, from: Point, most_m: f64) -> f64 {
        let mut nearest_m = most_m;
        let mut waiting = vec![0_u32];
        while let Some(number) = waiting.pop() {
            let node = &self.nodes[number as usize];
            if (node.centre - from).length() - node.radius_m >= nearest_m {
                continue;
            }
            match node.second {
                Some(second) => {
                    let away = |k: u32| (self.nodes[k as usize].centre - from).length_squared();
                    let (first, second) = (number + 1, second);
                    let is_first_nearer = away(first) <= away(second);
                    waiting.extend(if is_first_nearer { [second, first] } else { [first, second] });
                }
                None => {
                    let lamps = &self.lamps[node.first as usize..][..node.count as usize];
                    let away = lamps.iter().map(|lamp| {
                        ((lamp.position - from).length() - self.radius_m(lamp)).max(0.0)
                    });
                    nearest_m = away.fold(nearest_m, f64::min);
                }
            }
        }
        nearest_m
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::engine::light::tree::cut::Part;
    use crate::engine::ray::Dice;
    use crate::engine::tests::many::{hall, hall_of_panels, number};
    use crate::sampling::{Key, Sequence};
    use crate::scene::Scene;

    /// Whether a partition contains a luminaire by a chain of mirrors.
    fn holds(lighting: &Lighting, parts: &Parts, lamp: u32, chain: usize) -> bool {
        let is_it = |part: Part| match part {
            Part::Lamp(other) => other == lamp,
            Part::Node(number) => {
                let node = &lighting.tree.nodes[number as usize];
                (node.first..node.first + node.count).contains(&lamp)
            }
        };
        parts.seen.iter().any(|seen| seen.chain == chain && is_it(seen.part))
    }

    /// Two counts over places of a scene: the luminaires that give light but are missing from the
    /// parts of the patch (or of its middle alone), and all that give light.
    fn lost(scene: &Scene, reach_counts: bool) -> [usize; 2] {
        let lighting = Lighting::new(scene);
        let [mut lost, mut lit] = [0; 2];
        for k in 0..800 {
            let triangle = (k % u64::from(scene.triangle_count())) as u32;
            let [u, v] = [50, 51].map(|n| 0.25 + 0.24 * number(k, n));
            let at = SurfacePoint::new(scene, triangle, k % 3 == 0, u, v);
            // There is no patch where a face touches the place.
            let Some(patch) = Patch::of(&lighting, &at) else { continue };
            assert!((at.point - patch.middle.point).length() <= patch.reach_m);
            let reach_m = if reach_counts { patch.reach_m } else { 0.0 };
            let parts = lighting.parts_about(&patch.middle, reach_m);
            for chain in 0..lighting.chains.len() {
                let Some(view) = lighting.view(chain, &at, 0.0) else { continue };
                for lamp in 0..lighting.tree.lamps.len() as u32 {
                    let dice = &mut Dice::new(Sequence::new(Key::new(k)), lamp);
                    if lighting.lit_by_lamp(&view, lamp, &at, dice).luminance() > 0.0 {
                        lit += 1;
                        lost += usize::from(!holds(&lighting, &parts, lamp, chain));
                    }
                }
            }
        }
        [lost, lit]
    }

    #[test]
    fn what_gives_light_anywhere_on_a_patch_is_seen_from_it() {
        for (scene, most) in [(hall(600), 10_000), (hall_of_panels(60, 100), 5_000)] {
            let [lost_all, lit] = lost(&scene, true);
            assert!(lit > most, "{lit}");
            assert_eq!(lost_all, 0, "of {lit}");
            let [by_middles, _] = lost(&scene, false);
            assert!(by_middles > 0, "{by_middles} of {lit}: there is something to be lost");
        }
    }
}
