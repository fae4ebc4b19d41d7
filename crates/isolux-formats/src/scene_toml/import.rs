//! Geometry files that a scene names.

use super::context::Context;
use super::orientation::without_scale;
use super::placement::scene_from_up;
use super::record::GeometryRecord;
use super::shapes::Piece;
use super::spans::At;
use crate::picture::MOST_PIXELS_OF_SCENE;
use crate::{Loaded, Problems, bare, gltf, mitsuba, obj, ply, rad, stl};
use isolux::geometry::Direction;
use isolux::geometry::Transform;
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Body, Camera, Finish, Luminaire, LuminaireKind, Material, SceneParts};
use std::path::Path;

/// The units and axes of a file, and what is in it.
#[derive(Debug)]
pub(super) struct Import {
    /// Takes the file's coordinates to metres and to the up axis of the scene.
    pub(super) scene_from_file: Transform,
    pub(super) pieces: Vec<Piece>,
    parts: SceneParts,
    /// Indices in the scene of the materials and textures of the file that are used.
    material_index: Vec<Option<u32>>,
    texture_index: Vec<Option<u32>>,
    label: String,
}

/// Reads a geometry file. Materials that the entry replaces are not looked at.
pub(super) fn read(
    file: &At<String>,
    record: &GeometryRecord,
    context: &mut Context,
) -> Option<Import> {
    let path = context.path_of(&file.span(), file.get_ref())?;
    refuse_vertex_colours(file, record, context);
    refuse_efficacy(file, record, context);
    refuse_unlit_luminance(file, record, context);
    let (read, usual_unit_m) = open(&path, file, record, context)?;
    let mut parts = context.findings.absorb(read)?;
    if !context.pictures.take(&parts.textures) {
        let what = format!("its pictures are more than the {MOST_PIXELS_OF_SCENE} pixels in all");
        context.problem(&file.span(), what, "make them smaller");
        return None;
    }
    let unit_m = record.units.as_ref().map_or(usual_unit_m, |unit| unit.get_ref().metres());
    let up = record.up.as_ref().map_or(parts.up, |up| *up.get_ref());
    let scale = Transform::scale(unit_m, unit_m, unit_m);
    let pieces = std::mem::take(&mut parts.shapes).into_iter().map(|shape| Piece {
        slot: parts.materials.get(shape.material as usize).map_or("", |m| &m.name).to_owned(),
        shape,
    });
    Some(Import {
        scene_from_file: scene_from_up(context.up, up).then_from(&scale),
        pieces: pieces.collect(),
        material_index: vec![None; parts.materials.len()],
        texture_index: vec![None; parts.textures.len()],
        label: path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned()),
        parts,
    })
}

/// What a file holds, and the metres in its unit where nothing else is said.
fn open(
    path: &Path,
    file: &At<String>,
    record: &GeometryRecord,
    context: &mut Context,
) -> Option<(Result<Loaded<SceneParts>, Problems>, f64)> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let is_replaced = |name: &str| record.material.is_some() || record.materials.contains_key(name);
    let reach = context.root.reach();
    Some(match extension.as_deref() {
        Some("obj") => {
            let materials = context.materials;
            let reading = obj::Reading {
                unit_is_known: true,
                is_replaced: &is_replaced,
                materials,
                vertex_colours: record.asks_for_vertex_colours(),
                reach,
            };
            (obj::read_as(path, &reading), context.unit_m)
        }
        Some("gltf" | "glb") => {
            let reading = gltf::Reading {
                unit_is_known: record.units.is_some(),
                unlit_luminance_cd_m2: record.unlit_luminance_cd_m2.as_ref().map(|l| l.get_ref().0),
                reach,
            };
            (gltf::read_as(path, reading), 1.0)
        }
        Some("rad") => {
            let unit_is_known = record.units.is_some();
            let reading = rad::Reading { unit_is_known, is_replaced: &is_replaced, reach };
            (rad::read_as(path, &reading), 1.0)
        }
        Some("xml") => {
            let reading = mitsuba::Reading {
                unit_is_known: record.units.is_some(),
                is_replaced: &is_replaced,
                efficacy_lm_w: record.efficacy_lm_w.as_ref().map(|e| e.get_ref().0),
                reach,
            };
            (mitsuba::read_as(path, &reading), 1.0)
        }
        Some("stl" | "ply") => {
            let reading = bare::Reading {
                unit_is_known: true,
                is_replaced: &is_replaced,
                vertex_colours: record.asks_for_vertex_colours(),
            };
            let is_stl = extension.as_deref() == Some("stl");
            let read = if is_stl { stl::read_as } else { ply::read_as };
            (read(path, &reading), context.unit_m)
        }
        _ => {
            let what = format!("`{}` is not geometry by its extension", file.get_ref());
            context.problem(
                &file.span(),
                what,
                "name an .obj, .gltf, .glb, .ply, .rad, .stl or .xml file",
            );
            return None;
        }
    })
}

/// Colours of vertices where there are none, or where a material stands in for them.
fn refuse_vertex_colours(file: &At<String>, record: &GeometryRecord, context: &mut Context) {
    let Some(asked) = record.vertex_colours.as_ref().filter(|asked| *asked.get_ref()) else {
        return;
    };
    let name = file.get_ref().to_lowercase();
    let (is_obj, is_ply) = (name.ends_with(".obj"), name.ends_with(".ply"));
    // Materials of an OBJ file may replace some of its parts, those of a PLY file the whole.
    let is_replaced = record.material.is_some() || is_ply && !record.materials.is_empty();
    let what = match is_obj || is_ply {
        false => "`vertex_colours` of a file that is neither .obj nor .ply",
        true if is_replaced => "`vertex_colours` beside a material",
        true => return,
    };
    context.problem(&asked.span(), what, "remove it, or what it contradicts");
}

/// A luminance of unlit materials of a file that has none.
fn refuse_unlit_luminance(file: &At<String>, record: &GeometryRecord, context: &mut Context) {
    let name = file.get_ref().to_lowercase();
    let is_gltf = name.ends_with(".gltf") || name.ends_with(".glb");
    if let Some(luminance) = record.unlit_luminance_cd_m2.as_ref().filter(|_| !is_gltf) {
        let what = "`unlit_luminance_cd_m2` for a file that is not glTF";
        context.problem(&luminance.span(), what, "only glTF has unlit materials; remove it");
    }
}

/// An efficacy of a file that is not in watts, or of which the reader knows it.
fn refuse_efficacy(file: &At<String>, record: &GeometryRecord, context: &mut Context) {
    let is_mitsuba = file.get_ref().to_lowercase().ends_with(".xml");
    if let Some(given) = record.efficacy_lm_w.as_ref().filter(|_| !is_mitsuba) {
        let what = "`efficacy_lm_w` of a file that is no Mitsuba .xml";
        context.problem(&given.span(), what, "remove it");
    }
}

impl Import {
    /// The name of the file without directory and extension.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// Number of luminaires in the file.
    pub(super) fn luminaire_count(&self) -> usize {
        self.parts.luminaires.len()
    }

    /// Whether a turn of the file changes where it sends light.
    pub(super) fn has_aimed_luminaires(&self) -> bool {
        let is_aimed = |kind: &LuminaireKind| match kind {
            LuminaireKind::Point { intensity, .. } => {
                !matches!(intensity, IntensityDistribution::Isotropic { .. })
            }
            LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => true,
        };
        self.parts.luminaires.iter().any(|l| is_aimed(&l.kind))
    }

    /// A material of the file, taken into the scene when first asked for.
    pub(super) fn material(&mut self, index: u32, scene: &mut SceneParts) -> Option<u32> {
        let slot = self.material_index.get(index as usize).copied()?;
        if slot.is_some() {
            return slot;
        }
        let own = self.parts.materials[index as usize].clone();
        let body = match own.body {
            Body::Opaque { front, back } => Body::Opaque {
                front: self.with_texture_of_scene(front, scene),
                back: self.with_texture_of_scene(back, scene),
            },
            glass @ Body::Dielectric(_) => glass,
        };
        let made = scene.materials.len() as u32;
        scene.materials.push(Material { name: format!("{}/{}", self.label, own.name), body });
        self.material_index[index as usize] = Some(made);
        Some(made)
    }

    fn with_texture_of_scene(&mut self, mut finish: Finish, scene: &mut SceneParts) -> Finish {
        finish.diffuse.texture = finish.diffuse.texture.and_then(|of_file| {
            let known = self.texture_index.get_mut(of_file as usize)?;
            if known.is_none() {
                *known = Some(scene.textures.len() as u32);
                scene.textures.push(self.parts.textures[of_file as usize].clone());
            }
            *known
        });
        finish
    }

    /// The luminaires of the file, moved into the scene; intensities do not scale.
    pub(super) fn luminaires(&self, scene_from_file: &Transform) -> Vec<Luminaire> {
        let Some(turn) = without_scale(scene_from_file) else { return Vec::new() };
        let kind = |kind: &LuminaireKind| match kind {
            LuminaireKind::Point { position, world_from_luminaire, intensity, area } => {
                LuminaireKind::Point {
                    position: scene_from_file.point(*position),
                    world_from_luminaire: turn.then_from(world_from_luminaire),
                    intensity: intensity.clone(),
                    area: *area,
                }
            }
            LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } => {
                LuminaireKind::Directional {
                    direction: turned(&turn, *direction),
                    illuminance_lx: *illuminance_lx,
                    half_angle_rad: *half_angle_rad,
                }
            }
            LuminaireKind::Sky { world_from_sky, sky } => LuminaireKind::Sky {
                world_from_sky: turn.then_from(world_from_sky),
                sky: sky.clone(),
            },
        };
        let moved = |l: &Luminaire| Luminaire { kind: kind(&l.kind), group: 0, ..l.clone() };
        self.parts.luminaires.iter().map(moved).collect()
    }

    /// The cameras of the file, moved into the scene.
    pub(super) fn cameras(&self, scene_from_file: &Transform) -> Vec<Camera> {
        let Some(turn) = without_scale(scene_from_file) else { return Vec::new() };
        let moved = |c: &Camera| Camera {
            position: scene_from_file.point(c.position),
            direction: turned(&turn, c.direction),
            up: turned(&turn, c.up),
            ..c.clone()
        };
        self.parts.cameras.iter().map(moved).collect()
    }
}

fn turned(turn: &Transform, direction: Direction) -> Direction {
    turn.vector(direction.to_vector()).direction().unwrap_or(direction)
}
