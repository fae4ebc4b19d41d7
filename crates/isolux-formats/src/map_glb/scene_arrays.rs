//! The scene of a map: its record, its arrays, and back.

use super::Fault;
use super::arrays::{self, Arrays, Table};
use super::bytes::Bytes;
use super::images;
use super::record::{
    KindRecord, LuminaireRecord, SceneRecord, ShapeRecord, SkyRecord, TextureRecord,
};
use super::skies::{Pictures, Rows};
use isolux::photometry::{IntensityDistribution, PhotometricWeb};
use isolux::scene::{Fitting, Luminaire, LuminaireKind, SceneParts, Shape, Texture};
use std::collections::HashMap;
use std::sync::Arc;

const POSITIONS: &str = "scene_positions";
const NORMALS: &str = "scene_normals";
const UVS: &str = "scene_uvs";
/// Only where a shape has them: maps of before know none.
const LIGHTMAP_UVS: &str = "scene_lightmap_uvs";

/// Writes the arrays of a scene and returns its record. `textures` are the buffer views of the
/// pictures.
pub(super) fn write(
    parts: SceneParts,
    textures: &[u32],
    bytes: &mut Bytes,
    table: &mut Table,
) -> SceneRecord {
    let of = |f: fn(&Shape) -> &[[f64; 3]]| -> Vec<f64> {
        parts.shapes.iter().flat_map(|s| f(s).as_flattened()).copied().collect()
    };
    arrays::write_floats((bytes, table), POSITIONS, 3, &of(|s| &s.positions));
    let normals = of(|s| s.normals.as_deref().unwrap_or_default());
    arrays::write_floats((bytes, table), NORMALS, 3, &normals);
    let uvs = parts.shapes.iter().flat_map(|s| s.uvs.iter().flatten().flatten());
    arrays::write_floats((bytes, table), UVS, 2, &uvs.copied().collect::<Vec<f64>>());
    let placed = parts.shapes.iter().filter_map(|s| s.lightmap_uvs.as_deref());
    let placed: Vec<f64> = placed.flatten().flatten().map(|&c| f64::from(c)).collect();
    if !placed.is_empty() {
        arrays::write_floats((bytes, table), LIGHTMAP_UVS, 2, &placed);
    }
    let mut distributions = Distributions::default();
    let mut pictures = Pictures::default();
    // Nothing is known of luminaires beyond the end of the list.
    let fittings = parts.fittings.iter().copied().chain(std::iter::repeat(Fitting::default()));
    let mut record = |(l, fitting)| distributions.record(l, fitting, &mut pictures);
    let luminaires = parts.luminaires.into_iter().zip(fittings).map(&mut record).collect();
    pictures.write(bytes, table);
    SceneRecord {
        name: parts.name,
        up: parts.up,
        shapes: parts.shapes.iter().map(shape_record).collect(),
        materials: parts.materials,
        textures: parts.textures.iter().zip(textures).map(texture_record).collect(),
        luminaires,
        distributions: distributions.table,
        maintenance: parts.maintenance,
        groups: parts.groups,
        cameras: parts.cameras,
        grids: parts.grids,
    }
}

fn shape_record(shape: &Shape) -> ShapeRecord {
    ShapeRecord {
        name: shape.name.clone(),
        material: shape.material,
        triangles: shape.triangles.len(),
        has_normals: shape.normals.is_some(),
        has_uvs: shape.uvs.is_some(),
        has_lightmap_uvs: shape.lightmap_uvs.is_some(),
    }
}

fn texture_record((texture, &buffer_view): (&Texture, &u32)) -> TextureRecord {
    TextureRecord { width: texture.width, height: texture.height, buffer_view }
}

/// Distributions, each once.
#[derive(Default)]
struct Distributions {
    table: Vec<IntensityDistribution>,
    /// By their JSON, which distinguishes every bit.
    known: HashMap<String, u32>,
    /// Tables that luminaires share, by where they are, which they keep: each is made text of once however many share it.
    shared: HashMap<*const PhotometricWeb, (Arc<PhotometricWeb>, u32)>,
}

impl Distributions {
    fn record(
        &mut self,
        luminaire: Luminaire,
        fitting: Fitting,
        pictures: &mut Pictures,
    ) -> LuminaireRecord {
        let Luminaire { name, group, colour, kind } = luminaire;
        let kind = match kind {
            LuminaireKind::Point { position, world_from_luminaire, intensity, area } => {
                let distribution = self.index(intensity);
                KindRecord::Point { position, world_from_luminaire, distribution, area }
            }
            LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } => {
                KindRecord::Directional { direction, illuminance_lx, half_angle_rad }
            }
            LuminaireKind::Sky { world_from_sky, sky } => {
                KindRecord::Sky { world_from_sky, sky: pictures.record(sky) }
            }
        };
        LuminaireRecord { name, group, colour, kind, fitting }
    }

    fn index(&mut self, intensity: IntensityDistribution) -> u32 {
        let IntensityDistribution::Web(web) = &intensity else { return self.by_text(intensity) };
        let web = Arc::clone(web);
        if let Some((_, known)) = self.shared.get(&Arc::as_ptr(&web)) {
            return *known;
        }
        let index = self.by_text(intensity);
        self.shared.insert(Arc::as_ptr(&web), (web, index));
        index
    }

    fn by_text(&mut self, intensity: IntensityDistribution) -> u32 {
        let json = serde_json::to_string(&intensity).unwrap_or_default();
        *self.known.entry(json).or_insert_with(|| {
            self.table.push(intensity);
            self.table.len() as u32 - 1
        })
    }
}

/// The parts of a scene from a file of any origin, unchecked but for what holds them together.
pub(super) fn read(record: SceneRecord, arrays: &Arrays<'_>) -> Result<SceneParts, Fault> {
    let mut corners = Corners {
        positions: arrays.float_rows(POSITIONS)?.into_iter(),
        normals: arrays.float_rows(NORMALS)?.into_iter(),
        uvs: arrays.float_rows(UVS)?.into_iter(),
        lightmap_uvs: match record.shapes.iter().any(|shape| shape.has_lightmap_uvs) {
            true => arrays.float_rows(LIGHTMAP_UVS)?.into_iter(),
            false => Vec::new().into_iter(),
        },
    };
    let shapes =
        record.shapes.into_iter().map(|s| corners.shape(s)).collect::<Result<Vec<_>, _>>()?;
    let Corners { positions, normals, uvs, lightmap_uvs } = &corners;
    if positions.len() + normals.len() + uvs.len() + lightmap_uvs.len() > 0 {
        return Err(Fault::new("extras.isolux.scene.shapes", "leave triangles over"));
    }
    let distributions = &record.distributions;
    let mut pictures = Rows::of(arrays, record.luminaires.iter().any(is_picture))?;
    Ok(SceneParts {
        name: record.name,
        up: record.up,
        shapes,
        materials: record.materials,
        textures: textures(&record.textures, arrays)?,
        fittings: record.luminaires.iter().map(|luminaire| luminaire.fitting).collect(),
        luminaires: record
            .luminaires
            .into_iter()
            .map(|l| luminaire(l, distributions, &mut pictures))
            .collect::<Result<_, _>>()?,
        maintenance: record.maintenance,
        groups: record.groups,
        cameras: record.cameras,
        grids: record.grids,
    })
}

/// What is left of the arrays while shapes take their share.
struct Corners {
    positions: std::vec::IntoIter<[f64; 3]>,
    normals: std::vec::IntoIter<[f64; 3]>,
    uvs: std::vec::IntoIter<[f64; 2]>,
    lightmap_uvs: std::vec::IntoIter<[f64; 2]>,
}

impl Corners {
    fn shape(&mut self, record: ShapeRecord) -> Result<Shape, Fault> {
        let count = record.triangles.saturating_mul(3);
        let short = || Fault::new(format!("shape `{}`", record.name), "lacks triangles");
        let positions = take(&mut self.positions, count).ok_or_else(short)?;
        let normals = record.has_normals.then(|| take(&mut self.normals, count).ok_or_else(short));
        let uvs = record.has_uvs.then(|| take(&mut self.uvs, count).ok_or_else(short));
        let (normals, uvs) = (normals.transpose()?, uvs.transpose()?);
        let placed = record.has_lightmap_uvs;
        let lightmap_uvs = placed.then(|| take(&mut self.lightmap_uvs, count).ok_or_else(short));
        let single =
            |list: Vec<[f64; 2]>| list.into_iter().map(|uv| uv.map(|c| c as f32)).collect();
        Ok(Shape {
            positions,
            normals,
            uvs,
            lightmap_uvs: lightmap_uvs.transpose()?.map(single),
            // An array of 12 bytes a corner in a file of 4 GiB at most: indices fit.
            triangles: (0..record.triangles as u32)
                .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
                .collect(),
            material: record.material,
            name: record.name,
        })
    }
}

fn take<T>(from: &mut std::vec::IntoIter<T>, count: usize) -> Option<Vec<T>> {
    (count <= from.len()).then(|| from.take(count).collect())
}

fn textures(records: &[TextureRecord], arrays: &Arrays<'_>) -> Result<Vec<Texture>, Fault> {
    let bytes = |t: &TextureRecord| 3 * u64::from(t.width) * u64::from(t.height);
    let total = records.iter().map(bytes).fold(0, u64::saturating_add);
    if total > images::MOST_BYTES {
        let what =
            format!("take {total} bytes together, more than the {} allowed", images::MOST_BYTES);
        return Err(Fault::new("extras.isolux.scene.textures", what));
    }
    let texture = |(index, t): (usize, &TextureRecord)| {
        let place = format!("extras.isolux.scene.textures[{index}]");
        let png = arrays.view(t.buffer_view);
        let png = png.ok_or_else(|| Fault::new(&place, "lies outside of the binary chunk"))?;
        images::decode(png, (t.width, t.height), &place)
    };
    records.iter().enumerate().map(texture).collect()
}

fn is_picture(luminaire: &LuminaireRecord) -> bool {
    matches!(luminaire.kind, KindRecord::Sky { sky: SkyRecord::Picture { .. }, .. })
}

fn luminaire(
    record: LuminaireRecord,
    distributions: &[IntensityDistribution],
    pictures: &mut Rows,
) -> Result<Luminaire, Fault> {
    let LuminaireRecord { name, group, colour, kind, .. } = record;
    let kind = match kind {
        KindRecord::Point { position, world_from_luminaire, distribution, area } => {
            let Some(intensity) = distributions.get(distribution as usize) else {
                return Err(Fault::new(
                    format!("luminaire `{name}`"),
                    format!("names distribution {distribution}, which does not exist"),
                ));
            };
            let intensity = intensity.clone();
            LuminaireKind::Point { position, world_from_luminaire, intensity, area }
        }
        KindRecord::Directional { direction, illuminance_lx, half_angle_rad } => {
            LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad }
        }
        KindRecord::Sky { world_from_sky, sky } => {
            LuminaireKind::Sky { world_from_sky, sky: pictures.sky(sky, &name)? }
        }
    };
    Ok(Luminaire { name, group, colour, kind })
}
