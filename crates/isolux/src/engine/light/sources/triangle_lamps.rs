//! Triangles of emitting surfaces as lamps of the light tree, in scenes with many such surfaces.
//!
//! A sample of each surface takes time in proportion to their number. As lamps of the tree, with a cosine
//! distribution about their normal, triangles are chosen by a few teeth of a comb (stratified samples of the tree).

use super::super::openings::Openings;
use super::{AREA_SAMPLES, FEWEST_AREA_SAMPLES, corners_seen};
use crate::ablation::without;
use crate::scene::Scene;
use isolux_geometry::{Point, Vector};

/// The most emitting surfaces of which every one is sampled: exactly where nothing hides them. From two on,
/// faces take less time for the same errors (decision 48).
const FEW_SURFACES: usize = 3;

/// Extent of a surface, as a share of the scene's, above which it is sampled by itself: skies, luminous ceilings.
const LARGE_EXTENT_SHARE: f64 = 0.25;
/// The most surfaces that are sampled by themselves for their extent or their triangles: so many share the samples of a receiver with
/// the fewest for each. More would take time in proportion to their number.
const MOST_BY_THEMSELVES: usize = AREA_SAMPLES / FEWEST_AREA_SAMPLES;

/// The most triangles in the light tree, if few surfaces have all others. Each takes 600 bytes: with 2^20, a scene of
/// 786,000 takes 1.5 GB in place of 0.9 GB (decision 48).
const MOST_TRIANGLES: usize = 1 << 18;

/// An emitting triangle in the light tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// Number of its emitting surface.
    pub(crate) surface: u32,
    pub(crate) triangle: u32,
    back: bool,
    /// Radius of a sphere about its centroid that contains all of it, m.
    pub(crate) radius_m: f64,
}

impl Face {
    /// Corners, counter-clockwise as seen from the emitting side.
    pub(crate) fn corners(&self, scene: &Scene) -> [Point; 3] {
        corners_seen(scene, self.triangle, self.back)
    }
}

/// Centroid of a triangle, and twice its area along its normal, m2.
pub(crate) fn middle_and_twice_m2([a, b, c]: [Point; 3]) -> (Point, Vector) {
    let (ab, ac) = (b - a, c - a);
    (a + (ab + ac) / 3.0, ab.cross(ac))
}

/// The faces of a scene for the light tree. There are none if emitting surfaces are few, and none
/// of surfaces that rays sample through openings.
pub(crate) fn faces(scene: &Scene, openings: &Openings) -> Vec<Face> {
    let bounds = scene.bvh().mesh().bounds();
    let most_m = LARGE_EXTENT_SHARE * bounds.map_or(0.0, |(low, high)| (high - low).length());
    let areas = scene.area_luminaires();
    if areas.len() <= FEW_SURFACES || without("triangle-lamps") {
        return Vec::new();
    }
    let all = areas.iter().enumerate().filter(|&(number, _)| !openings.are_before(number));
    let found = all.filter_map(|(number, area)| {
        let face = |&triangle: &u32| {
            let face =
                Face { surface: number as u32, triangle, back: area.back, radius_m: f64::INFINITY };
            let corners = face.corners(scene);
            let (middle, _) = middle_and_twice_m2(corners);
            let reach_m = corners.iter().map(|&p| (p - middle).length()).fold(0.0, f64::max);
            // Allowance for the rounding of a length and of the steps after it.
            (Face { radius_m: reach_m * (1.0 + 1e-12), ..face }, corners)
        };
        let (faces, corners): (Vec<Face>, Vec<[Point; 3]>) =
            area.triangles.iter().map(face).unzip();
        let &[start, ..] = corners.first()?;
        let extent_m = corners.iter().flatten().map(|&p| (p - start).length()).fold(0.0, f64::max);
        Some((extent_m, faces))
    });
    let (mut large, small): (Vec<_>, Vec<_>) = found.partition(|(extent_m, _)| *extent_m > most_m);
    large.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut by_themselves = large.len().min(MOST_BY_THEMSELVES);
    let others = large.into_iter().skip(MOST_BY_THEMSELVES);
    let mut found: Vec<Vec<Face>> =
        small.into_iter().chain(others).map(|(_, faces)| faces).collect();
    found.sort_by_key(Vec::len);
    let mut triangles: usize = found.iter().map(Vec::len).sum();
    while triangles > MOST_TRIANGLES && by_themselves < MOST_BY_THEMSELVES {
        triangles -= found.pop().map_or(0, |faces| faces.len());
        by_themselves += 1;
    }
    if found.len() <= FEW_SURFACES { Vec::new() } else { found.concat() }
}
