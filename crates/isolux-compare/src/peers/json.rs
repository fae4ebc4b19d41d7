//! Scenes as the scripts read them.

use super::points::{ExactPoint, PointSet};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, SceneParts, Shape};
use serde_json::{Value, json};

/// All that is read of it.
pub(super) fn scene(parts: &SceneParts, sets: &[PointSet]) -> Value {
    let mut distributions: Vec<&IntensityDistribution> = Vec::new();
    let luminaires: Vec<Value> =
        parts.luminaires.iter().map(|lamp| luminaire(lamp, &mut distributions)).collect();
    let (suns, lamps): (Vec<Value>, Vec<Value>) =
        luminaires.into_iter().partition(|lamp| lamp.get("direction").is_some());
    json!({
        "name": parts.name,
        "shapes": parts.shapes.iter().map(|s| shape(s, &parts.name)).collect::<Vec<_>>(),
        "materials": parts.materials,
        "luminaires": lamps,
        "suns": suns,
        "distributions": distributions,
        "point_sets": sets.iter().map(point_set).collect::<Vec<_>>(),
    })
}

fn shape(shape: &Shape, scene: &str) -> Value {
    // What the triangles stand for, for renderers that have spheres of their own.
    let sphere = (scene == "sphere" && shape.name == "sphere")
        .then(|| json!({ "centre": [0.0, 0.0, 0.0], "radius_m": 1.0 }));
    json!({
        "sphere": sphere,
        "name": shape.name,
        "positions": shape.positions,
        "triangles": shape.triangles,
        "material": shape.material,
    })
}

/// Where a luminaire is and how it stands, and the number of its distribution; or where parallel light goes.
fn luminaire<'a>(lamp: &'a Luminaire, known: &mut Vec<&'a IntensityDistribution>) -> Value {
    match &lamp.kind {
        LuminaireKind::Directional { direction, illuminance_lx, .. } => json!({
            "name": lamp.name,
            "direction": direction,
            "illuminance_lx": illuminance_lx,
        }),
        LuminaireKind::Sky { world_from_sky, sky } => json!({
            "name": lamp.name,
            "axes": world_from_sky.columns,
            "sky": sky,
        }),
        LuminaireKind::Point { position, world_from_luminaire, intensity, .. } => {
            let number = known.iter().position(|d| *d == intensity).unwrap_or_else(|| {
                known.push(intensity);
                known.len() - 1
            });
            json!({
                "name": lamp.name,
                "position": position,
                "axes": world_from_luminaire.columns,
                "colour": lamp.colour,
                "distribution": number,
            })
        }
    }
}

fn point_set(set: &PointSet) -> Value {
    let of = |f: fn(&ExactPoint) -> Value| set.points.iter().map(f).collect::<Vec<_>>();
    json!({
        "name": set.name,
        "own_error": set.own_error,
        "has_caustics": set.has_caustics,
        "positions": of(|p| json!(<[f64; 3]>::from(p.at.position))),
        "normals": of(|p| json!(<[f64; 3]>::from(p.at.normal.to_vector()))),
        "expected_lx": of(|p| json!(p.expected_lx)),
        "weights": of(|p| json!(p.weight)),
    })
}
