//! Luminaires that are no surfaces, and their photometric solids.

use super::origin::origin;
use super::record::{LuminaireRecord, Solid};
use isolux::geometry::{Direction, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, Scene};
use isolux::units::sincos_deg;

/// Angles from nadir to zenith, and around, of a photometric solid.
const ROWS: usize = 37;
const COLUMNS: usize = 49;
/// Solids that a page is given at most; luminaires beyond those are drawn without.
const MOST_SOLIDS: usize = 64;

/// All luminaires without surface, and the solids that they share.
pub(super) fn all(scene: &Scene) -> (Vec<LuminaireRecord<'_>>, Vec<Solid>) {
    let origin = origin(scene);
    let mut known: Vec<&IntensityDistribution> = Vec::new();
    let records = scene.luminaires().iter().map(|one| record(one, origin, &mut known)).collect();
    (records, known.into_iter().map(solid).collect())
}

fn record<'a>(
    one: &'a Luminaire,
    origin: Vector,
    known: &mut Vec<&'a IntensityDistribution>,
) -> LuminaireRecord<'a> {
    let bare = LuminaireRecord {
        name: &one.name,
        group: one.group,
        colour: one.colour,
        kind: "point",
        position: None,
        direction: [0.0, 0.0, -1.0],
        c0: [1.0, 0.0, 0.0],
        luminous_flux_lm: None,
        illuminance_lx: None,
        peak_cd: None,
        solid: None,
        area: one.kind.area().copied(),
    };
    match &one.kind {
        LuminaireKind::Point { position, world_from_luminaire, intensity, .. } => {
            let turned = |v: Vector| <[f64; 3]>::from(world_from_luminaire.vector(v));
            LuminaireRecord {
                position: Some((*position - origin).into()),
                direction: turned(Vector::new(0.0, 0.0, -1.0)),
                c0: turned(Vector::new(1.0, 0.0, 0.0)),
                luminous_flux_lm: Some(intensity.luminous_flux_lm()),
                peak_cd: Some(intensity.max_intensity_cd()),
                solid: number_of(intensity, known),
                ..bare
            }
        }
        LuminaireKind::Directional { direction, illuminance_lx, .. } => LuminaireRecord {
            kind: "directional",
            direction: direction.to_vector().into(),
            illuminance_lx: Some(*illuminance_lx),
            ..bare
        },
        LuminaireKind::Sky { .. } => LuminaireRecord { kind: "sky", ..bare },
    }
}

/// The solid of a distribution, shared by all that are alike.
fn number_of<'a>(
    intensity: &'a IntensityDistribution,
    known: &mut Vec<&'a IntensityDistribution>,
) -> Option<usize> {
    if let Some(number) = known.iter().position(|other| *other == intensity) {
        return Some(number);
    }
    if known.len() == MOST_SOLIDS {
        return None;
    }
    known.push(intensity);
    Some(known.len() - 1)
}

fn solid(intensity: &IntensityDistribution) -> Solid {
    let peak_cd = intensity.max_intensity_cd().max(f64::MIN_POSITIVE);
    let gammas = (0..ROWS).map(|row| 180.0 * row as f64 / (ROWS - 1) as f64);
    let values = gammas.flat_map(|gamma| {
        (0..COLUMNS).map(move |column| {
            let around = 360.0 * column as f64 / (COLUMNS - 1) as f64;
            towards(gamma, around).map_or(0.0, |d| (intensity.intensity_cd(d) / peak_cd) as f32)
        })
    });
    Solid { rows: ROWS, columns: COLUMNS, values: values.collect() }
}

/// A direction in the frame of a luminaire: nadir is -z, C 0 along +x.
fn towards(gamma_deg: f64, c_deg: f64) -> Option<Direction> {
    let ((sin, cos), (sin_c, cos_c)) = (sincos_deg(gamma_deg), sincos_deg(c_deg));
    Vector::new(sin * cos_c, sin * sin_c, -cos).direction()
}
