//! From a map to a layout: which sides, how dense, and whether it fits into memory.

use super::charts::{Patch, UnwrapError, UnwrapRequest, Unwrapped, Unwrapper};
use super::cover::LEAST_AREA;
use super::layout::{Layout, OwnPlaces, ROUNDING, Side};
use super::lit::{area_of_m2, lit_area_m2, lit_sides};
use super::own_places;
use crate::scene::Scene;
use isolux_geometry::Normal;
use std::collections::{HashMap, HashSet};

/// Without a wish, the density is such that all surfaces have so many texels: a page of 512 x 512, half full.
const USUAL_TEXELS: f64 = 131_072.0;
/// Charts end where neighbours differ by more than this, cosine of 15 degrees: illuminance jumps at a crease, and a
/// lookup must not mix both its sides. Facets of curved surfaces stay together.
const CREASE_COS: f64 = 0.965_925_8;
/// What a texel takes at most while it is baked and written: fragments (16 bytes a piece), values, the solver, pixels
/// of the pictures.
pub const BYTES_PER_TEXEL: u64 = 128;
/// Texels that lie between charts for every one of theirs; measured on CUBE, the demonstration and the hall: 1.3 to
/// 2.1 in all.
const PACKED: f64 = 2.0;

/// Pages as large as that of places which the file has, that all other surfaces may take: all pages are of one size, and on many small
/// ones charts are cut short.
const MOST_BESIDE_OWN: f64 = 4.0;
/// Width of the square in the middle of which dark sides lie: with the padding about it neither bilinear lookups nor the
/// first mipmap find light there.
const BLACK_TEXELS: f64 = 4.0;

/// What is asked of a lightmap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightmapSettings {
    /// Texels a metre; `None` leaves it to the size of the scene.
    pub texels_per_m: Option<f64>,
    /// Width and height of a page at most, texels.
    pub page: u32,
    /// Texels around each chart.
    pub padding: u32,
    /// Memory that baking may take.
    pub max_memory_bytes: u64,
}

impl Default for LightmapSettings {
    fn default() -> Self {
        Self { texels_per_m: None, page: 2048, padding: 2, max_memory_bytes: 8 << 30 }
    }
}

/// Why there is no lightmap.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LightmapError {
    /// It would take too much memory.
    #[error("the lightmap takes about {needed} bytes, more than the {allowed} allowed")]
    Memory {
        /// Bytes it would take.
        needed: u64,
        /// Bytes allowed.
        allowed: u64,
    },
    /// The density is not a number above zero.
    #[error("{0} texels a metre are no density")]
    Density(f64),
    /// The density is such that all surfaces together cover less of a texel than counts.
    #[error("at {0} texels a metre no texel would be known")]
    Sparse(f64),
    /// No side carries the map.
    #[error("no surface carries the map")]
    NothingLit,
    /// The library that lays charts out failed.
    #[error("the charts cannot be laid out: {0}")]
    Unwrap(String),
    /// Whoever watched wanted no more.
    #[error("stopped")]
    Stopped,
}

/// Lays out all sides that carry the map.
pub fn plan(
    scene: &Scene,
    settings: &LightmapSettings,
    unwrapper: &impl Unwrapper,
) -> Result<Layout, LightmapError> {
    plan_without(scene, settings, unwrapper, &HashSet::new())
}

/// The same, but some sides all lie at one place, which stays black. Where surfaces have places that the file gives them,
/// or no others are left, they have texels like all. The usual density is that at which all others have their texels.
pub fn plan_without(
    scene: &Scene,
    settings: &LightmapSettings,
    unwrapper: &impl Unwrapper,
    dark: &HashSet<(u32, bool)>,
) -> Result<Layout, LightmapError> {
    let area_m2 = lit_area_m2(scene);
    if area_m2 <= 0.0 {
        return Err(LightmapError::NothingLit);
    }
    let bright_m2 = match area_of_m2(scene, |side| !dark.contains(&side)) {
        0.0 => area_m2,
        bright_m2 => bright_m2,
    };
    let texels_per_m = match settings.texels_per_m {
        Some(wish) if wish.is_finite() && wish > 0.0 => wish,
        Some(wish) => return Err(LightmapError::Density(wish)),
        None => rounded((USUAL_TEXELS / bright_m2).sqrt()),
    };
    let texels = bright_m2 * texels_per_m * texels_per_m * PACKED;
    check_memory(texels, settings)?;
    let own = own_places::find(scene, (texels_per_m, settings.page, settings.padding))
        .and_then(|own| own.map(|own| not_in_the_way(scene, own, area_m2)).transpose());
    let (own, own_places) = match own {
        Ok(Some(own)) => (Some(own), OwnPlaces::Kept),
        Ok(None) => (None, OwnPlaces::None),
        Err(why) => (None, OwnPlaces::Refused(why)),
    };
    let layout = match own {
        None if dark.is_empty() || lit_sides(scene).all(|side| dark.contains(&side)) => {
            unwrapped(scene, (texels_per_m, settings), unwrapper, |_| true)?
        }
        None => unwrapped_without(scene, (texels_per_m, settings), unwrapper, dark)?,
        Some(own) => {
            let kept: HashSet<(u32, bool)> =
                own.sides.iter().map(|side| (side.triangle, side.back)).collect();
            if lit_sides(scene).all(|side| kept.contains(&side)) {
                own
            } else {
                let settings = LightmapSettings { page: own.width, ..*settings };
                let left = |side: (u32, bool)| !kept.contains(&side);
                let rest = unwrapped(scene, (own.texels_per_m, &settings), unwrapper, left)?;
                joined(own, rest)
            }
        }
    };
    check_memory(layout.texel_count() as f64, settings)?;
    if layout.covered() <= LEAST_AREA {
        return Err(LightmapError::Sparse(texels_per_m));
    }
    let layout = of_true_density(scene, layout);
    Ok(Layout { own_places, asked_texels_per_m: texels_per_m, ..layout })
}

/// Places that the file has, unless their page is much too small for all other surfaces.
fn not_in_the_way(scene: &Scene, own: Layout, area_m2: f64) -> Result<Layout, String> {
    let own_m2: f64 = own.sides.iter().map(|side| scene.triangle(side.triangle).area()).sum();
    let rest = (area_m2 - own_m2) * own.texels_per_m * own.texels_per_m * PACKED;
    let page = own.texel_count() as f64;
    if rest <= MOST_BESIDE_OWN * page {
        return Ok(own);
    }
    let first = own.sides.first().map_or(0, |side| scene.shape_of(side.triangle));
    Err(format!(
        "the second texture coordinates of `{}` and others place {:.1} % of the surface alone, on a page of {} x {} texels, too \
         small for the rest",
        scene.shape_names()[first as usize],
        100.0 * own_m2 / area_m2,
        own.width,
        own.height
    ))
}

/// Some sides, laid out anew.
fn unwrapped(
    scene: &Scene,
    (texels_per_m, settings): (f64, &LightmapSettings),
    unwrapper: &impl Unwrapper,
    is_wanted: impl Fn((u32, bool)) -> bool,
) -> Result<Layout, LightmapError> {
    let (patches, sides) = patches(scene, is_wanted);
    let unwrapped = unwrap(&patches, (texels_per_m, settings), unwrapper)?;
    Ok(layout(&unwrapped, &sides, (texels_per_m, settings)))
}

/// All sides laid out anew, but dark ones at one place, in the middle of a chart that nothing covers.
fn unwrapped_without(
    scene: &Scene,
    (texels_per_m, settings): (f64, &LightmapSettings),
    unwrapper: &impl Unwrapper,
    dark: &HashSet<(u32, bool)>,
) -> Result<Layout, LightmapError> {
    let (mut patches, sides) = patches(scene, |side| !dark.contains(&side));
    patches.push(nothing(BLACK_TEXELS / texels_per_m));
    let unwrapped = unwrap(&patches, (texels_per_m, settings), unwrapper)?;
    let mut layout = layout(&unwrapped, &sides, (texels_per_m, settings));
    let placed = unwrapped.placed.last().into_iter().flatten();
    let (page, corners): (Vec<u32>, Vec<[[f32; 2]; 3]>) =
        placed.map(|placed| (placed.page, placed.uvs)).unzip();
    let corners = corners.as_flattened();
    let middle = [0, 1].map(|k| corners.iter().map(|uv| uv[k]).sum::<f32>() / corners.len() as f32);
    let all_there = |(triangle, back)| Side {
        triangle,
        back,
        page: page.first().copied().unwrap_or(0),
        uvs: [middle; 3],
    };
    layout.sides.extend(lit_sides(scene).filter(|side| dark.contains(side)).map(all_there));
    layout.sides.sort_unstable_by_key(|side| (side.triangle, side.back));
    layout.charts = layout.charts.saturating_sub(1);
    Ok(layout)
}

/// A square without anything on it.
fn nothing(side_m: f64) -> Patch {
    let side = side_m as f32;
    Patch {
        positions: vec![[0.0; 3], [side, 0.0, 0.0], [side, side, 0.0], [0.0, side, 0.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        creases: vec![[true, true, false], [false, true, true]],
    }
}

fn unwrap(
    patches: &[Patch],
    (texels_per_m, settings): (f64, &LightmapSettings),
    unwrapper: &impl Unwrapper,
) -> Result<Unwrapped, LightmapError> {
    let LightmapSettings { page, padding, .. } = *settings;
    let request = UnwrapRequest { texels_per_m, page, padding };
    unwrapper.unwrap(patches, &request).map_err(|error| match error {
        UnwrapError::TooLarge => LightmapError::Memory {
            needed: (1 << 30) * BYTES_PER_TEXEL,
            allowed: settings.max_memory_bytes,
        },
        other => LightmapError::Unwrap(other.to_string()),
    })
}

/// Where the sides of the first patches lie.
fn layout(
    unwrapped: &Unwrapped,
    sides: &[Vec<(u32, bool)>],
    (texels_per_m, settings): (f64, &LightmapSettings),
) -> Layout {
    let mut placed: Vec<Side> = sides
        .iter()
        .zip(&unwrapped.placed)
        .flat_map(|(sides, placed)| sides.iter().zip(placed))
        .map(|(&(triangle, back), place)| Side {
            triangle,
            back,
            page: place.page,
            uvs: turned(place.uvs, back),
        })
        .collect();
    placed.sort_unstable_by_key(|side| (side.triangle, side.back));
    Layout {
        width: unwrapped.width,
        height: unwrapped.height,
        pages: unwrapped.pages,
        texels_per_m,
        least_texels_per_m: unwrapped.least_texels_per_m,
        asked_texels_per_m: texels_per_m,
        padding: settings.padding,
        charts: unwrapped.charts,
        own_places: OwnPlaces::None,
        sides: placed,
    }
}

/// The pages of another layout, none larger, after those of the first.
fn joined(first: Layout, rest: Layout) -> Layout {
    let share = [(rest.width, first.width), (rest.height, first.height)]
        .map(|(own, page)| own as f32 / page as f32);
    let moved = rest.sides.into_iter().map(|side| Side {
        page: first.pages + side.page,
        uvs: side.uvs.map(|uv| [uv[0] * share[0], uv[1] * share[1]]),
        ..side
    });
    let mut sides: Vec<Side> = first.sides.into_iter().chain(moved).collect();
    sides.sort_unstable_by_key(|side| (side.triangle, side.back));
    Layout {
        pages: first.pages + rest.pages,
        charts: first.charts + rest.charts,
        least_texels_per_m: first.least_texels_per_m.min(rest.least_texels_per_m),
        sides,
        ..first
    }
}

/// With the density that surfaces have in the mean, where some charts have less than they should.
fn of_true_density(scene: &Scene, layout: Layout) -> Layout {
    if layout.least_texels_per_m >= layout.texels_per_m * (1.0 - ROUNDING) {
        return layout;
    }
    let placed = layout.sides.iter().filter(|side| !side.is_point());
    let area_m2: f64 = placed.map(|s| scene.triangle(s.triangle).area()).sum();
    Layout { texels_per_m: (layout.covered() / area_m2).sqrt(), ..layout }
}

fn check_memory(texels: f64, settings: &LightmapSettings) -> Result<(), LightmapError> {
    // Conversions of floats saturate.
    let needed = (texels * BYTES_PER_TEXEL as f64) as u64;
    let allowed = settings.max_memory_bytes;
    if needed > allowed { Err(LightmapError::Memory { needed, allowed }) } else { Ok(()) }
}

/// Two digits: a density for people.
fn rounded(value: f64) -> f64 {
    let unit = libm::pow(10.0, libm::floor(libm::log10(value)) - 1.0);
    libm::floor(value / unit) * unit
}

/// Corners in the other direction.
fn turned<T: Copy>([a, b, c]: [T; 3], back: bool) -> [T; 3] {
    if back { [a, c, b] } else { [a, b, c] }
}

pub(super) type Sides = Vec<Vec<(u32, bool)>>;

/// One patch for each side of each shape, and the sides in them: those that are wanted.
pub(super) fn patches(
    scene: &Scene,
    is_wanted: impl Fn((u32, bool)) -> bool,
) -> (Vec<Patch>, Sides) {
    let mut by_shape: Sides = vec![Vec::new(); 2 * scene.shape_names().len()];
    for (triangle, back) in lit_sides(scene).filter(|&side| is_wanted(side)) {
        by_shape[2 * scene.shape_of(triangle) as usize + usize::from(back)].push((triangle, back));
    }
    by_shape.retain(|sides| !sides.is_empty());
    (by_shape.iter().map(|sides| patch(scene, sides)).collect(), by_shape)
}

fn patch(scene: &Scene, sides: &[(u32, bool)]) -> Patch {
    let mesh = scene.bvh().mesh();
    let mut made = Patch::default();
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    let mut normals: Vec<[Normal; 3]> = Vec::new();
    for &(triangle, back) in sides {
        let corners = turned(scene.triangle(triangle).corners, back).map(|point| {
            // Adding zero makes one zero of the two.
            let position = mesh.local_from_world(point).map(|c| c + 0.0);
            *known.entry(position.map(f32::to_bits)).or_insert_with(|| {
                made.positions.push(position);
                made.positions.len() as u32 - 1
            })
        });
        made.triangles.push(corners);
        let flat = [scene.geometric_normal(triangle); 3];
        normals.push(turned(scene.corner_normals(triangle).unwrap_or(flat), back));
    }
    made.creases = creases(&made.triangles, &normals);
    made
}

/// Whether a crease runs along each edge.
fn creases(triangles: &[[u32; 3]], normals: &[[Normal; 3]]) -> Vec<[bool; 3]> {
    // On every edge, lower vertex first: the triangle, its edge, and the normals at its ends.
    let mut edges: Vec<([u32; 2], usize, usize, [Normal; 2])> = Vec::new();
    for (index, (corners, normals)) in triangles.iter().zip(normals).enumerate() {
        for k in 0..3 {
            let (p, q) = (k, (k + 1) % 3);
            let (p, q) = if corners[p] < corners[q] { (p, q) } else { (q, p) };
            edges.push(([corners[p], corners[q]], index, k, [normals[p], normals[q]]));
        }
    }
    edges.sort_unstable_by_key(|&(edge, index, k, _)| (edge, index, k));
    let mut found = vec![[false; 3]; triangles.len()];
    for run in edges.chunk_by(|a, b| a.0 == b.0) {
        let first = run[0].3;
        let is_smooth =
            run.len() == 2 && run[1].3.iter().zip(first).all(|(a, b)| a.dot(b) >= CREASE_COS);
        for &(_, index, k, _) in run {
            found[index][k] = !is_smooth;
        }
    }
    found
}
