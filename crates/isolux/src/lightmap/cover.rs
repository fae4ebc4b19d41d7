//! Which part of which side every texel covers.

use super::clip::Polygon;
use super::layout::Layout;
use crate::scene::Scene;
use rayon::prelude::*;

/// Smaller parts of a texel are rounding.
pub(super) const LEAST_AREA: f64 = 1e-9;

/// The part of a side that a texel covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fragment {
    /// Number of the texel.
    pub(super) texel: u32,
    /// Index of the side.
    pub(super) side: u32,
    /// Area on the surface, m2.
    pub(super) area_m2: f32,
    /// Share of the texel.
    pub(super) share: f32,
}

/// All of them, in the order of texels and sides.
pub(super) fn fragments(scene: &Scene, layout: &Layout) -> Vec<Fragment> {
    let mut found: Vec<Fragment> =
        (0..layout.sides.len() as u32).flat_map(|side| of_side(scene, layout, side)).collect();
    // No two have both the same: any order of the work gives this one.
    found.par_sort_unstable_by_key(|f| (f.texel, f.side));
    found
}

fn of_side(scene: &Scene, layout: &Layout, index: u32) -> Vec<Fragment> {
    let side = &layout.sides[index as usize];
    let whole = Polygon::triangle(layout.corners(side));
    let area = whole.area();
    let m2_a_texel = scene.triangle(side.triangle).area() / area;
    let mut found = Vec::new();
    if !m2_a_texel.is_finite() {
        return found;
    }
    for y in cells(&whole, 1, layout.height) {
        let row = whole.within(1, f64::from(y), f64::from(y + 1));
        for x in cells(&row, 0, layout.width) {
            let share = row.within(0, f64::from(x), f64::from(x + 1)).area();
            if share > LEAST_AREA {
                found.push(Fragment {
                    texel: layout.index(side.page, x, y) as u32,
                    side: index,
                    area_m2: (share * m2_a_texel) as f32,
                    share: share as f32,
                });
            }
        }
    }
    found
}

/// The cells along an axis that a polygon reaches into.
fn cells(polygon: &Polygon, axis: usize, size: u32) -> std::ops::Range<u32> {
    let Some((low, high)) = polygon.range(axis) else { return 0..0 };
    let inside = |at: f64| at.clamp(0.0, f64::from(size)) as u32;
    inside(low.floor())..inside(high.ceil())
}

/// The polygon of a fragment.
pub(super) fn polygon(layout: &Layout, fragment: &Fragment) -> Polygon {
    let width = layout.width;
    let row = fragment.texel / width;
    let (x, y) = (f64::from(fragment.texel % width), f64::from(row % layout.height));
    let side = &layout.sides[fragment.side as usize];
    Polygon::triangle(layout.corners(side)).within(1, y, y + 1.0).within(0, x, x + 1.0)
}

/// Barycentric weights (u, v) of a place in texels on a side, on the triangle.
pub(super) fn weights(layout: &Layout, side: u32, at: [f64; 2]) -> [f64; 2] {
    let [a, b, c] = layout.corners(&layout.sides[side as usize]);
    let (ab, ac, ap) = (minus(b, a), minus(c, a), minus(at, a));
    let area = cross(ab, ac);
    if area == 0.0 {
        return [1.0 / 3.0; 2];
    }
    let (u, v) = ((cross(ap, ac) / area).clamp(0.0, 1.0), (cross(ab, ap) / area).clamp(0.0, 1.0));
    let sum = (u + v).max(1.0);
    [u / sum, v / sum]
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
