//! Where maps of the hall are compared with the reference.

use isolux::elements::carries_map;
use isolux::engine::ProbePoint;
use isolux::sampling::{Key, Sequence};
use isolux::scene::Scene;
use std::collections::BTreeSet;

/// A place on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct HallPlace {
    /// Name of the surface.
    pub surface: String,
    /// Where, and the way it faces.
    pub at: ProbePoint,
}

/// A side of a triangle that carries a map.
#[derive(Clone, Copy)]
struct Side {
    triangle: u32,
    back: bool,
}

/// `count` places by area over all sides of surfaces that carry a map: any first part of more of
/// them is as even.
pub fn by_area(scene: &Scene, count: u32) -> Vec<HallPlace> {
    let sides = sides(scene);
    let mut sums_m2 = Vec::with_capacity(sides.len());
    let mut sum_m2 = 0.0;
    for side in &sides {
        sum_m2 += scene.triangle(side.triangle).area();
        sums_m2.push(sum_m2);
    }
    let sequence = Sequence::new(Key::new(1));
    let place = |index| {
        let [share, _] = sequence.pair(index, 0);
        let drawn = sums_m2.partition_point(|&sum| sum <= share * sum_m2).min(sides.len() - 1);
        let [a, b] = sequence.pair(index, 1);
        // Folded over the diagonal of the unit square: uniform in the triangle.
        let (u, v) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
        place(scene, sides[drawn], u, v)
    };
    (0..count).map(place).collect()
}

/// At most `count` different corners of triangles, which every map has as vertices, each triangle as
/// likely as another.
pub fn at_corners(scene: &Scene, count: u32) -> Vec<HallPlace> {
    let sides = sides(scene);
    let key = Key::new(2);
    let mut seen = BTreeSet::new();
    let corner = |index| {
        let bits = key.with(index).bits();
        let side = sides[(bits % sides.len() as u64) as usize];
        let [u, v] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]][(bits >> 40) as usize % 3];
        place(scene, side, u, v)
    };
    // Enough draws that each corner comes up many times.
    let draws = 16 * 3 * sides.len() as u64;
    let is_new = |place: &HallPlace| {
        let (position, normal) = (place.at.position, place.at.normal.to_vector());
        let numbers = [position.x, position.y, position.z, normal.x, normal.y, normal.z];
        seen.insert(numbers.map(f64::to_bits))
    };
    (0..draws).map(corner).filter(is_new).take(count as usize).collect()
}

fn sides(scene: &Scene) -> Vec<Side> {
    let both = |triangle| [false, true].map(|back| Side { triangle, back });
    let carries = |side: &Side| carries_map(scene, side.triangle, side.back);
    (0..scene.triangle_count()).flat_map(both).filter(carries).collect()
}

fn place(scene: &Scene, side: Side, u: f64, v: f64) -> HallPlace {
    let front = scene.shading_normal(side.triangle, u, v);
    let normal = if side.back { -front } else { front };
    let shape = scene.shape_of(side.triangle) as usize;
    HallPlace {
        surface: scene.shape_names()[shape].clone(),
        at: ProbePoint { position: scene.triangle(side.triangle).point(u, v), normal },
    }
}
