//! The texels of a map, as arrays with every digit, and back.

use super::Fault;
use super::arrays::{Arrays, Table, write_floats, write_integers};
use super::bytes::Bytes;
use isolux::lightmap::{Cover, Layout, Lightmap, LightmapArrays, OwnPlaces, SeamReport, Side};
use isolux::scene::Scene;
use serde::{Deserialize, Serialize};

const SIDES: &str = "lightmap_sides";
const PLACES: &str = "lightmap_places";
const COVERS: &str = "lightmap_covers";
const SHOWN: &str = "lightmap_shown_lx";
const OWNERS: &str = "lightmap_owners";
const ERRORS: &str = "lightmap_standard_errors_lx";
const COVERAGE: &str = "lightmap_coverage";
/// By their numbers in files.
const RANKS: [Cover; 4] = [Cover::Empty, Cover::Filled, Cover::Unknown, Cover::Known];

/// What is known of the texels besides the arrays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct LightmapRecord {
    width: u32,
    height: u32,
    pages: u32,
    texels_per_m: f64,
    /// Older files do not tell it.
    least_texels_per_m: Option<f64>,
    asked_texels_per_m: f64,
    padding: u32,
    charts: u32,
    own_places: OwnPlaces,
    seams: SeamReport,
    readings: u64,
    /// Left out where there are none.
    #[serde(default, skip_serializing_if = "is_none")]
    coarse: u64,
}

fn is_none(count: &u64) -> bool {
    *count == 0
}

/// Writes the texels; nothing where JSON cannot hold what is known of their seams.
pub(super) fn write(
    lightmap: &Lightmap,
    (bytes, table): (&mut Bytes, &mut Table),
) -> Option<LightmapRecord> {
    if !lightmap.seams.is_finite() {
        return None;
    }
    let LightmapArrays { layout, covers, shown_lx, owners, standard_errors_lx, coverage, .. } =
        lightmap.to_arrays();
    let side = |s: &Side| [u64::from(s.triangle), u64::from(s.back), u64::from(s.page)];
    let sides: Vec<u64> = layout.sides.iter().flat_map(side).collect();
    write_integers((bytes, table), SIDES, 3, &sides);
    let mut floats = |name, columns, values: &mut dyn Iterator<Item = f32>| {
        let values: Vec<f64> = values.map(f64::from).collect();
        write_floats((bytes, table), name, columns, &values);
    };
    floats(PLACES, 6, &mut layout.sides.iter().flat_map(|side| side.uvs).flatten());
    floats(SHOWN, 3, &mut shown_lx.into_iter().flatten());
    floats(ERRORS, 1, &mut standard_errors_lx.into_iter());
    floats(COVERAGE, 1, &mut coverage.into_iter());
    let rank = |cover: &Cover| RANKS.iter().position(|c| c == cover).unwrap_or(0) as u64;
    write_integers((bytes, table), COVERS, 1, &covers.iter().map(rank).collect::<Vec<_>>());
    let owners: Vec<u64> = owners.into_iter().map(u64::from).collect();
    write_integers((bytes, table), OWNERS, 1, &owners);
    Some(LightmapRecord {
        width: layout.width,
        height: layout.height,
        pages: layout.pages,
        texels_per_m: layout.texels_per_m,
        least_texels_per_m: Some(layout.least_texels_per_m),
        asked_texels_per_m: layout.asked_texels_per_m,
        padding: layout.padding,
        charts: layout.charts,
        own_places: layout.own_places,
        seams: lightmap.seams,
        readings: lightmap.readings,
        coarse: lightmap.coarse,
    })
}

/// The texels of a file of any origin, over a scene.
pub(super) fn read(
    record: LightmapRecord,
    arrays: &Arrays<'_>,
    scene: &Scene,
) -> Result<Lightmap, Fault> {
    let fault = |what: String| Fault::new("extras.isolux.lightmap", what);
    let rows = arrays.index_rows::<3>(SIDES)?;
    let places = arrays.float_rows::<6>(PLACES)?;
    if rows.len() != places.len() {
        return Err(fault(format!("has {} sides in {} places", rows.len(), places.len())));
    }
    let single = |name| -> Result<Vec<f32>, Fault> {
        Ok(arrays.float_rows::<1>(name)?.into_iter().map(|[c]| c as f32).collect())
    };
    let covers = arrays.integers(COVERS, 1)?.into_iter().map(|rank| {
        let cover = usize::try_from(rank).ok().and_then(|rank| RANKS.get(rank));
        cover.copied().ok_or_else(|| fault(format!("has a texel of kind {rank}")))
    });
    let sides = rows.into_iter().zip(places).map(|([triangle, back, page], place)| {
        let [a, b, c, d, e, f] = place.map(|t| t as f32);
        Side { triangle, back: back != 0, page, uvs: [[a, b], [c, d], [e, f]] }
    });
    let arrays = LightmapArrays {
        layout: Layout {
            width: record.width,
            height: record.height,
            pages: record.pages,
            texels_per_m: record.texels_per_m,
            least_texels_per_m: record.least_texels_per_m.unwrap_or(record.texels_per_m),
            asked_texels_per_m: record.asked_texels_per_m,
            padding: record.padding,
            charts: record.charts,
            own_places: record.own_places,
            sides: sides.collect(),
        },
        covers: covers.collect::<Result<_, _>>()?,
        shown_lx: arrays.float_rows::<3>(SHOWN)?.into_iter().map(|c| c.map(|c| c as f32)).collect(),
        owners: arrays.index_rows::<1>(OWNERS)?.into_iter().flatten().collect(),
        standard_errors_lx: single(ERRORS)?,
        coverage: single(COVERAGE)?,
        seams: record.seams,
        readings: record.readings,
        coarse: record.coarse,
    };
    Lightmap::from_arrays(arrays, scene).map_err(|error| fault(error.to_string()))
}
