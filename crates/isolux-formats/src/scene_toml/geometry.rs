//! Geometry: what stands in the scene, where, and of what.

use super::context::Context;
use super::import::{self, Import};
use super::materials::Palette;
use super::orientation::is_distorting;
use super::record::GeometryRecord;
use super::shapes::{Piece, placed};
use super::spans::{At, Span};
use super::{inline, placement};
use isolux::geometry::Transform;
use isolux::scene::{SceneParts, Shape};

/// Pieces with their frame, before they are placed.
struct Thing {
    name: String,
    scene_from_thing: Transform,
    pieces: Vec<Piece>,
    import: Option<Import>,
}

/// Adds one entry to the scene; `None` after a problem.
pub(super) fn add(
    entry: &At<GeometryRecord>,
    number: usize,
    palette: &mut Palette,
    scene: &mut SceneParts,
    context: &mut Context,
) -> Option<()> {
    let record = entry.get_ref();
    let thing = thing(entry, number, context);
    let maps = placements(record, context);
    let mut thing = thing?;
    let materials = materials(&mut thing, entry, palette, scene, context)?;
    let maps: Vec<Transform> = maps?.iter().map(|m| m.then_from(&thing.scene_from_thing)).collect();
    let triangles = thing.pieces.iter().map(|p| p.shape.triangles.len()).sum();
    if !context.take_triangles(&entry.span(), triangles, maps.len()) {
        return None;
    }
    for (k, map) in maps.iter().enumerate() {
        let copy = (maps.len() > 1).then_some(k);
        for (piece, &material) in thing.pieces.iter().zip(&materials) {
            let name = shape_name(&thing.name, copy, piece);
            scene.shapes.push(Shape { name, material, ..placed(&piece.shape, map) });
        }
    }
    add_lights_and_cameras(&thing, entry, &maps, scene, context)
}

fn add_lights_and_cameras(
    thing: &Thing,
    entry: &At<GeometryRecord>,
    maps: &[Transform],
    scene: &mut SceneParts,
    context: &mut Context,
) -> Option<()> {
    let import = thing.import.as_ref()?;
    let keeps_luminaires = entry.get_ref().luminaires.as_ref().is_none_or(|keep| *keep.get_ref());
    let room = !keeps_luminaires
        || context.take_luminaires(&entry.span(), import.luminaire_count(), maps.len());
    if keeps_luminaires && import.has_aimed_luminaires() && maps.iter().any(is_distorting) {
        let what = "the placement stretches or shears a file with luminaires: they are turned and \
                    moved, their beams keep their shape";
        let remedy = "scale all axes alike, or set `luminaires = false` and place them here";
        context.warning(&entry.span(), what, remedy);
    }
    for map in maps {
        if keeps_luminaires && room {
            scene.luminaires.extend(import.luminaires(map));
        }
        scene.cameras.extend(import.cameras(map));
    }
    Some(())
}

/// `name`, `name[2]` for one of several, and the face or part of it.
fn shape_name(name: &str, copy: Option<usize>, piece: &Piece) -> String {
    let copy = copy.map_or_else(String::new, |k| format!("[{k}]"));
    let part = if piece.shape.name.is_empty() { &piece.slot } else { &piece.shape.name };
    if part.is_empty() { format!("{name}{copy}") } else { format!("{name}{copy}/{part}") }
}

fn thing(entry: &At<GeometryRecord>, number: usize, context: &mut Context) -> Option<Thing> {
    let record = entry.get_ref();
    let kind = kind(record, &entry.span(), context)?;
    let name = record.name.clone();
    if let Some(file) = &record.file {
        let mut import = import::read(file, record, context)?;
        return Some(Thing {
            name: name.unwrap_or_else(|| import.label().to_owned()),
            scene_from_thing: import.scene_from_file,
            pieces: std::mem::take(&mut import.pieces),
            import: Some(import),
        });
    }
    refuse_keys_of_files(record, context);
    let pieces = inline_pieces(record, context)?;
    let unit_m = context.unit_m;
    Some(Thing {
        name: name.unwrap_or_else(|| format!("{kind} {number}")),
        scene_from_thing: Transform::scale(unit_m, unit_m, unit_m),
        pieces,
        import: None,
    })
}

fn kind(record: &GeometryRecord, at: &Span, context: &mut Context) -> Option<&'static str> {
    let kinds = [
        ("file", record.file.is_some()),
        ("polygon", record.polygon.is_some()),
        ("rectangle", record.rectangle.is_some()),
        ("box", record.cuboid.is_some()),
        ("disc", record.disc.is_some()),
        ("sphere", record.sphere.is_some()),
    ];
    context.one_of(at, "the geometry", &kinds)
}

fn inline_pieces(record: &GeometryRecord, context: &mut Context) -> Option<Vec<Piece>> {
    let GeometryRecord { polygon, rectangle, cuboid, disc, sphere, .. } = record;
    polygon
        .as_ref()
        .map(|r| inline::polygon(r, context))
        .or_else(|| rectangle.as_ref().map(|r| inline::rectangle(r, context)))
        .or_else(|| cuboid.as_ref().map(|r| inline::cuboid(r, context)))
        .or_else(|| disc.as_ref().map(|r| inline::disc(r, context)))
        .or_else(|| sphere.as_ref().map(|r| inline::ball(r, context)))
        .flatten()
}

fn refuse_keys_of_files(record: &GeometryRecord, context: &mut Context) {
    let spans = [
        ("units", record.units.as_ref().map(At::span)),
        ("up", record.up.as_ref().map(At::span)),
        ("luminaires", record.luminaires.as_ref().map(At::span)),
        ("unlit_luminance_cd_m2", record.unlit_luminance_cd_m2.as_ref().map(At::span)),
        ("efficacy_lm_w", record.efficacy_lm_w.as_ref().map(At::span)),
        ("vertex_colours", record.vertex_colours.as_ref().map(At::span)),
    ];
    for (key, span) in spans {
        if let Some(span) = span {
            let what = format!("`{key}` without `file`");
            context.problem(&span, what, "it describes a geometry file; remove it");
        }
    }
}

/// `transform`, and then each of `placements`.
fn placements(record: &GeometryRecord, context: &mut Context) -> Option<Vec<Transform>> {
    let first = match &record.transform {
        None => Some(Transform::IDENTITY),
        Some(transform) => placement::resolve(transform, context),
    };
    let Some(list) = &record.placements else { return Some(vec![first?]) };
    if list.get_ref().is_empty() {
        let what = "`placements` is empty: the geometry stands nowhere";
        context.problem(&list.span(), what, "give one entry for each copy, or remove the key");
        return None;
    }
    let made: Vec<_> = list.get_ref().iter().map(|p| placement::resolve(p, context)).collect();
    let first = first?;
    made.into_iter().map(|map| Some(map?.then_from(&first))).collect()
}

/// The material of every piece.
fn materials(
    thing: &mut Thing,
    entry: &At<GeometryRecord>,
    palette: &mut Palette,
    scene: &mut SceneParts,
    context: &mut Context,
) -> Option<Vec<u32>> {
    let record = entry.get_ref();
    refuse_stray_assignments(thing, record, context);
    let assigned: Vec<(&str, Option<u32>)> = record
        .materials
        .iter()
        .map(|(slot, name)| (slot.get_ref().as_str(), palette.index_of(name, context)))
        .collect();
    let for_all = record.material.as_ref().map(|name| palette.index_of(name, context));
    let mut materials = Vec::with_capacity(thing.pieces.len());
    for piece in &thing.pieces {
        let of_slot =
            assigned.iter().find(|(slot, _)| *slot == piece.slot).map(|(_, index)| *index);
        let chosen = match (of_slot.or(for_all), &mut thing.import) {
            (Some(index), _) => index?,
            (None, Some(import)) => import.material(piece.shape.material, scene)?,
            (None, None) => {
                let face = if piece.slot.is_empty() { "it" } else { &piece.slot };
                let what = format!("`{}` has no material for {face}", thing.name);
                context.problem(&entry.span(), what, "add `material = \"NAME\"`");
                return None;
            }
        };
        materials.push(chosen);
    }
    Some(materials)
}

/// Assignments to names that the thing does not have.
fn refuse_stray_assignments(thing: &Thing, record: &GeometryRecord, context: &mut Context) {
    for slot in record.materials.keys() {
        if thing.pieces.iter().any(|piece| piece.slot == *slot.get_ref()) {
            continue;
        }
        let mut names: Vec<&str> = thing.pieces.iter().map(|p| p.slot.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        names.truncate(20);
        let what = format!("`{}` has no part of material `{}`", thing.name, slot.get_ref());
        context.problem(&slot.span(), what, format!("it has `{}`", names.join("`, `")));
    }
}
