//! Places in a lightmap that the file of the scene has: kept where they serve.

use super::cover::{Fragment, fragments};
use super::layout::{Layout, OwnPlaces, Side};
use super::lit::lit_sides;
use crate::scene::Scene;
use std::collections::HashMap;

/// Coordinates may leave the page by so much: rounding of exporters.
const BEYOND: f32 = 1e-4;
/// A texel may be covered to so much more than all of it: rounding at shared edges.
const OVERLAP: f64 = 1e-3;
/// Pages are whole blocks of compressed textures.
const BLOCK: u32 = 4;

/// A layout of the fronts that have a place, on one page; nothing where none has. On failure, why they cannot be
/// used: they leave the page, overlap, or lie nearer to each other than a lookup reaches.
pub(super) fn find(
    scene: &Scene,
    (texels_per_m, most, padding): (f64, u32, u32),
) -> Result<Option<Layout>, String> {
    let sides: Vec<Side> = lit_sides(scene)
        .filter(|&(_, back)| !back)
        .filter_map(|(triangle, back)| {
            let uvs = scene.corner_lightmap_uvs(triangle)?;
            Some(Side { triangle, back, page: 0, uvs })
        })
        .collect();
    if sides.is_empty() {
        return Ok(None);
    }
    check_range(scene, &sides)?;
    let (density, size) = size(scene, &sides, texels_per_m, most)?;
    let mut layout = Layout {
        width: size,
        height: size,
        pages: 1,
        texels_per_m: density,
        least_texels_per_m: density,
        asked_texels_per_m: texels_per_m,
        padding,
        charts: 0,
        own_places: OwnPlaces::Kept,
        sides,
    };
    let charts = charts(scene, &layout.sides);
    layout.charts = charts.iter().copied().max().map_or(0, |last| last + 1);
    check_room(scene, &layout, &charts)?;
    Ok(Some(layout))
}

fn check_range(scene: &Scene, sides: &[Side]) -> Result<(), String> {
    let is_inside = |c: &f32| (-BEYOND..=1.0 + BEYOND).contains(c);
    match sides.iter().find(|side| !side.uvs.iter().flatten().all(is_inside)) {
        None => Ok(()),
        Some(side) => Err(format!(
            "the second texture coordinates of `{}` leave 0 to 1, as those of a lightmap must not",
            name(scene, side)
        )),
    }
}

fn name<'a>(scene: &'a Scene, side: &Side) -> &'a str {
    &scene.shape_names()[scene.shape_of(side.triangle) as usize]
}

/// Density on a square page, and its size: as asked for in the mean, if the page may be so large.
fn size(scene: &Scene, sides: &[Side], texels_per_m: f64, most: u32) -> Result<(f64, u32), String> {
    let area_m2: f64 = sides.iter().map(|side| scene.triangle(side.triangle).area()).sum();
    let share: f64 = sides.iter().map(Side::share).sum();
    let side_m = (area_m2 / share).sqrt();
    if !side_m.is_finite() {
        return Err("the second texture coordinates cover no area".to_owned());
    }
    let wish = (texels_per_m * side_m).ceil().clamp(f64::from(BLOCK), f64::from(most)) as u32;
    let size = wish.next_multiple_of(BLOCK).min(most);
    Ok((f64::from(size) / side_m, size))
}

/// The number of the chart of each side: sides that share an edge both on the page and in space are of one chart. Those
/// that only touch on the page are not: light does not go on from one to the other.
fn charts(scene: &Scene, sides: &[Side]) -> Vec<u32> {
    let mut edges: HashMap<[Corner; 2], usize> = HashMap::new();
    let mut parent: Vec<usize> = (0..sides.len()).collect();
    for (index, side) in sides.iter().enumerate() {
        let corners = corners(scene, side);
        for k in 0..3 {
            let mut edge = [corners[k], corners[(k + 1) % 3]];
            edge.sort_unstable();
            let other = *edges.entry(edge).or_insert(index);
            let (a, b) = (root(&mut parent, index), root(&mut parent, other));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut numbers: HashMap<usize, u32> = HashMap::new();
    (0..sides.len())
        .map(|index| {
            let next = numbers.len() as u32;
            *numbers.entry(root(&mut parent, index)).or_insert(next)
        })
        .collect()
}

/// A place on the page and in space, as whole numbers, with one zero.
type Corner = ([u32; 2], [u64; 3]);

fn corners(scene: &Scene, side: &Side) -> [Corner; 3] {
    let points = scene.triangle(side.triangle).corners;
    [0, 1, 2].map(|k| {
        let place = side.uvs[k].map(|c| (c + 0.0).to_bits());
        let point = points[k];
        (place, [point.x, point.y, point.z].map(|c| (c + 0.0).to_bits()))
    })
}

/// The first of those that an entry has been joined with.
pub(super) fn root(parent: &mut [usize], mut index: usize) -> usize {
    while parent[index] != index {
        parent[index] = parent[parent[index]];
        index = parent[index];
    }
    index
}

/// No texel is covered twice, and next to a chart lies no other: a bilinear lookup at its border would read it.
fn check_room(scene: &Scene, layout: &Layout, charts: &[u32]) -> Result<(), String> {
    let found = fragments(scene, layout);
    // First: what overlaps no density keeps apart.
    check_overlap(scene, layout, &found)?;
    let mut owners: Vec<Option<u32>> = vec![None; layout.texel_count()];
    for of_texel in found.chunk_by(|a, b| a.texel == b.texel) {
        let chart = |f: &Fragment| charts[f.side as usize];
        let first = of_texel[0];
        if of_texel.iter().any(|f| chart(f) != chart(&first)) {
            return Err(too_close(layout));
        }
        owners[first.texel as usize] = Some(chart(&first));
    }
    let width = layout.width as usize;
    let differ =
        |a: usize, b: usize| matches!((owners[a], owners[b]), (Some(a), Some(b)) if a != b);
    let clashes = (0..owners.len()).any(|at| {
        let (right, down) = (at % width + 1 < width, at + width < owners.len());
        (right && differ(at, at + 1))
            || (down && differ(at, at + width))
            || (right && down && (differ(at, at + width + 1) || differ(at + 1, at + width)))
    });
    if clashes { Err(too_close(layout)) } else { Ok(()) }
}

fn check_overlap(scene: &Scene, layout: &Layout, found: &[Fragment]) -> Result<(), String> {
    let is_twice = |of_texel: &&[Fragment]| {
        of_texel.iter().map(|f| f64::from(f.share)).sum::<f64>() > 1.0 + OVERLAP
    };
    let mut texels = found.chunk_by(|a, b| a.texel == b.texel);
    let Some(of_texel) = texels.find(is_twice) else { return Ok(()) };
    let name = |f: &Fragment| name(scene, &layout.sides[f.side as usize]);
    let shape = |f: &Fragment| scene.shape_of(layout.sides[f.side as usize].triangle);
    let first = &of_texel[0];
    let one = name(first);
    Err(match of_texel.iter().find(|f| shape(f) != shape(first)) {
        Some(other) => {
            format!("the second texture coordinates of `{one}` and `{}` overlap", name(other))
        }
        None => format!("the second texture coordinates of `{one}` overlap themselves"),
    })
}

fn too_close(layout: &Layout) -> String {
    format!(
        "charts of the second texture coordinates lie nearer than a texel to each other on {} x {}; more \
         --texels-per-meter, or more padding, would keep them apart",
        layout.width, layout.height
    )
}
