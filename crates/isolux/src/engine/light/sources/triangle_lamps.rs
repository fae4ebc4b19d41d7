//! Triangles of emitting surfaces that are drawn like luminaires, where such surfaces are many.
//!
//! A look at each surface takes as long as there are surfaces. As lamps of the tree, which shine like the cosine about their
//! normal, they are chosen by few teeth of a comb among all.

use super::super::openings::Openings;
use super::corners_seen;
use crate::ablation::without;
use crate::scene::Scene;
use isolux_geometry::{Point, Vector};

/// Emitting surfaces up to which every one is looked at.
const FEW: usize = 3;

/// Surfaces that reach further than this share of the scene's extent are looked at one by one: skies, luminous ceilings.
const LARGE: f64 = 0.25;

/// Triangles that are drawn at most.
const MOST: usize = 1 << 18;

/// A triangle that emits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// The number of its emitting surface.
    pub(crate) surface: u32,
    pub(crate) triangle: u32,
    back: bool,
    /// All of it is within so much of its middle, m.
    pub(crate) radius_m: f64,
}

impl Face {
    /// Its corners, counter-clockwise as seen from where it shines.
    pub(crate) fn corners(&self, scene: &Scene) -> [Point; 3] {
        corners_seen(scene, self.triangle, self.back)
    }
}

/// The middle of a triangle, and twice its area along its normal, m2.
pub(crate) fn middle_and_twice_m2([a, b, c]: [Point; 3]) -> (Point, Vector) {
    let (ab, ac) = (b - a, c - a);
    (a + (ab + ac) / 3.0, ab.cross(ac))
}

/// Those of a scene that are drawn: none where emitting surfaces are few, and none of those that rays are aimed at through openings.
pub(crate) fn faces(scene: &Scene, openings: &Openings) -> Vec<Face> {
    let bounds = scene.bvh().mesh().bounds();
    let most_m = LARGE * bounds.map_or(0.0, |(low, high)| (high - low).length());
    let areas = scene.area_luminaires();
    if areas.len() <= FEW || without("triangle-lamps") {
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
            // The roundings of a length and of those that follow.
            (Face { radius_m: reach_m * (1.0 + 1e-12), ..face }, corners)
        };
        let (faces, corners): (Vec<Face>, Vec<[Point; 3]>) =
            area.triangles.iter().map(face).unzip();
        let &[start, ..] = corners.first()?;
        let extent_m = corners.iter().flatten().map(|&p| (p - start).length()).fold(0.0, f64::max);
        (extent_m <= most_m).then_some(faces)
    });
    let mut found: Vec<Vec<Face>> = found.collect();
    // Those of the fewest triangles, as far as there is room for them.
    found.sort_by_key(Vec::len);
    let mut left = MOST;
    found.retain(|faces| {
        let has_room = faces.len() <= left;
        left -= if has_room { faces.len() } else { 0 };
        has_room
    });
    if found.len() <= FEW { Vec::new() } else { found.concat() }
}
