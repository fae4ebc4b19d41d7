//! Luminaires: where they hang, how they stand, in which group.

use super::aim::{Aim, direction_of, point_m};
use super::chromaticity;
use super::context::Context;
use super::groups::Groups;
use super::library::Libraries;
use super::photometry::{self, Emission, Files};
use super::quantity::plain;
use super::record::{ArrayRecord, DirectionalRecord, LuminaireRecord};
use super::sky;
use super::sky_record::LuminancesRecord;
use super::spans::At;
use isolux::geometry::{Point, Vector};
use isolux::scene::{
    Fitting, Luminaire, LuminaireKind, Maintenance, SceneParts, world_from_luminaire,
};
use isolux::units::Rgb;

/// Light from afar stands below a half-space.
const WIDEST_DEG: f64 = 180.0;

/// The most skies: every place asks all of them.
const MOST_SKIES: usize = 16;

/// Adds all luminaires of the file to the scene.
pub(super) fn add(
    entries: &[At<LuminaireRecord>],
    groups: &mut Groups,
    libraries: &mut Libraries,
    scene: &mut SceneParts,
    context: &mut Context,
) {
    let mut files = Files::default();
    let mut skies = 0;
    // Luminaires of geometry files are there already, and have no factor.
    let mut factors: Vec<f64> = scene.luminaires.iter().map(|_| 1.0).collect();
    scene.fittings.resize(scene.luminaires.len(), Fitting::default());
    for (number, entry) in (1..).zip(entries) {
        let record = entry.get_ref();
        let name = record.name.clone().unwrap_or_else(|| format!("luminaire {number}"));
        let group = record.group.as_deref().map_or(0, |name| groups.index(name));
        let own = chromaticity::given(&record.light(), context);
        let Some(found) = kinds(entry, &name, &mut files, libraries, context) else { continue };
        let Some(own) = own else { continue };
        skies += found
            .kinds
            .iter()
            .filter(|(_, kind)| matches!(kind, LuminaireKind::Sky { .. }))
            .count();
        if skies > MOST_SKIES {
            let what = format!("more than {MOST_SKIES} skies");
            context.problem(&entry.span(), what, "write one sky that has the luminances of all");
            break;
        }
        let colour = own.or(found.colour).unwrap_or(Rgb::WHITE);
        scene.luminaires.extend(found.kinds.into_iter().map(|(place, kind)| {
            let name = format!("{name}{place}");
            Luminaire { name, group, colour, kind }
        }));
        scene.fittings.resize(scene.luminaires.len(), found.fitting);
        factors.extend(found.maintenance);
    }
    scene.maintenance = Maintenance::of(factors);
}

/// All luminaires of an entry.
struct Kinds {
    /// Each with what its name ends in.
    kinds: Vec<(String, LuminaireKind)>,
    /// That of a library.
    colour: Option<Rgb>,
    /// The maintenance factor in their light; `None` for the sun, which needs none.
    maintenance: Option<f64>,
    fitting: Fitting,
}

fn kinds(
    entry: &At<LuminaireRecord>,
    name: &str,
    files: &mut Files,
    libraries: &mut Libraries,
    context: &mut Context,
) -> Option<Kinds> {
    let record = entry.get_ref();
    let choices = [
        ("type", record.kind.is_some()),
        ("isotropic", record.isotropic.is_some()),
        ("cosine", record.cosine.is_some()),
        ("spot", record.spot.is_some()),
        ("directional", record.directional.is_some()),
        ("sky", record.sky.is_some()),
        ("ies", record.ies.is_some()),
        ("ldt", record.ldt.is_some()),
    ];
    context.one_of(&entry.span(), &format!("luminaire `{name}`"), &choices)?;
    let far = match (&record.directional, &record.sky) {
        (Some(sun), _) => Some(directional(sun, entry, context)?),
        (None, Some(sky)) => Some(sky_of(sky, record, context)?),
        (None, None) => None,
    };
    if let Some(kind) = far {
        let one = context.take_luminaires(&entry.span(), 1, 1);
        let maintenance = record.maintenance_factor.map(|m| m.0);
        return one.then(|| Kinds {
            kinds: vec![(String::new(), kind)],
            colour: None,
            maintenance,
            fitting: Fitting::default(),
        });
    }
    let light = match &record.kind {
        Some(kind) => of_library(kind, record, (&mut *files, libraries), context),
        None => photometry::emission(&record.light(), files, context).map(|emission| Light {
            emission,
            colour: None,
            factor: record.maintenance_factor.map_or(1.0, |m| m.0),
        }),
    };
    let places = places(entry, name, context);
    let aim = Aim::new(record, context);
    let light = light?;
    let factor = light.factor * record.dimming.map_or(1.0, |d| d.0);
    let (places, aim) = (places?, aim?);
    let intensity = files.scaled(&light.emission.intensity, factor);
    let emission = Emission { intensity, ..light.emission };
    let own = record.power_w.as_ref().map(|power| power.get_ref().0);
    let emergency_share = emergency_share(record, context);
    let fitting = Fitting { power_w: own.or(emission.power_w), emergency_share };
    let kinds = points(&places, &aim, &emission, entry, context);
    let (colour, maintenance) = (light.colour, Some(light.factor));
    Some(Kinds { kinds: kinds?, colour, maintenance, fitting })
}

/// The share of its light in emergency lighting.
fn emergency_share(record: &LuminaireRecord, context: &mut Context) -> Option<f64> {
    let share = record.emergency_flux_share.as_ref();
    match (record.emergency.as_ref().map(At::get_ref), share) {
        (Some(false), Some(share)) => {
            let what = "`emergency_flux_share` beside `emergency = false`";
            context.problem(&share.span(), what, "remove one of them");
            None
        }
        (_, Some(share)) => Some(share.get_ref().0),
        (Some(true), None) => Some(1.0),
        (Some(false) | None, None) => None,
    }
}

/// The light of one luminaire, undimmed.
struct Light {
    emission: Emission,
    colour: Option<Rgb>,
    /// Maintenance factor.
    factor: f64,
}

/// The light of a luminaire of a library, where the entry itself says nothing else.
fn of_library(
    kind: &At<String>,
    record: &LuminaireRecord,
    (files, libraries): (&mut Files, &mut Libraries),
    context: &mut Context,
) -> Option<Light> {
    if let Some(set) = &record.lamp_set {
        let what = "`lamp_set` beside `type`";
        context.problem(&set.span(), what, "write it into the library");
    }
    let known = libraries.find(kind, context)?;
    Some(Light {
        emission: known.emission.with_area(record.luminous_area.as_ref()).with_flux(
            record.flux_lm.as_ref(),
            files,
            context,
        )?,
        colour: known.colour,
        factor: record.maintenance_factor.map(|m| m.0).or(known.maintenance_factor).unwrap_or(1.0),
    })
}

/// What dims light that comes from infinitely far away.
fn dimming(record: &LuminaireRecord) -> f64 {
    record.dimming.map_or(1.0, |d| d.0) * record.maintenance_factor.map_or(1.0, |m| m.0)
}

fn sky_of(
    sky: &At<LuminancesRecord>,
    record: &LuminaireRecord,
    context: &mut Context,
) -> Option<LuminaireKind> {
    refuse_without_meaning(record, "a sky", "remove it; `north_deg` turns a sky", context);
    if let Some(direction) = &record.direction {
        context.problem(
            &direction.span(),
            "`direction` of a sky",
            "remove it; give `sun` in `sky`",
        );
    }
    sky::kind_of_entry(sky, dimming(record), context)
}

fn refuse_without_meaning(
    record: &LuminaireRecord,
    whose: &str,
    remedy: &str,
    context: &mut Context,
) {
    let without_meaning = [
        ("position", record.position.as_ref().map(At::span)),
        ("target", record.target.as_ref().map(At::span)),
        ("rotate_deg", record.rotate_deg.as_ref().map(At::span)),
        ("array", record.array.as_ref().map(At::span)),
        ("flux_lm", record.flux_lm.as_ref().map(At::span)),
        ("luminous_area", record.luminous_area.as_ref().map(At::span)),
        ("lamp_set", record.lamp_set.as_ref().map(At::span)),
        ("power_w", record.power_w.as_ref().map(At::span)),
        ("emergency", record.emergency.as_ref().map(At::span)),
        ("emergency_flux_share", record.emergency_flux_share.as_ref().map(At::span)),
    ];
    for (key, span) in without_meaning {
        if let Some(span) = span {
            context.problem(&span, format!("`{key}` of {whose}"), remedy);
        }
    }
}

fn directional(
    sun: &At<DirectionalRecord>,
    entry: &At<LuminaireRecord>,
    context: &mut Context,
) -> Option<LuminaireKind> {
    let record = entry.get_ref();
    let remedy = "remove it; give `direction`, where the light goes";
    refuse_without_meaning(record, "a directional luminaire", remedy, context);
    let Some(direction) = &record.direction else {
        let what = "a directional luminaire without `direction`";
        context.problem(&sun.span(), what, "give the direction in which its light goes");
        return None;
    };
    Some(LuminaireKind::Directional {
        direction: direction_of(direction, context)?,
        illuminance_lx: sun.get_ref().illuminance_lx.0 * dimming(record),
        half_angle_rad: half_angle_rad(sun.get_ref(), context)?,
    })
}

/// Half of the angle under which light from afar is seen.
fn half_angle_rad(sun: &DirectionalRecord, context: &mut Context) -> Option<f64> {
    let Some(angle) = &sun.angle_deg else { return Some(0.0) };
    let angle_deg = angle.get_ref().0;
    if angle_deg < WIDEST_DEG {
        return Some((0.5 * angle_deg).to_radians());
    }
    let what = format!("an `angle_deg` of {angle_deg}");
    context.problem(&angle.span(), what, "give the full angle, below 180: the sun's is 0.533");
    None
}

/// Positions of an entry, each with its indices in the array.
fn places(
    entry: &At<LuminaireRecord>,
    name: &str,
    context: &mut Context,
) -> Option<Vec<(String, Point)>> {
    let record = entry.get_ref();
    let Some(position) = &record.position else {
        let what = format!("luminaire `{name}` has no position");
        context.problem(&entry.span(), what, "add `position = [x, y, z]`");
        return None;
    };
    let first = point_m(*position.get_ref(), context);
    let Some(array) = &record.array else {
        return context.take_luminaires(&entry.span(), 1, 1).then(|| vec![(String::new(), first)]);
    };
    let ArrayRecord { count: [nx, ny, nz], step } = array.get_ref();
    if [nx, ny, nz].contains(&&0) {
        let what = "an array with a count of 0";
        context.problem(&array.span(), what, "write 1 where it does not extend");
        return None;
    }
    let plane = (*nx as usize).saturating_mul(*ny as usize);
    if !context.take_luminaires(&array.span(), plane, *nz as usize) {
        return None;
    }
    let step = plain(*step).map(|c| c * context.unit_m);
    let mut places = Vec::with_capacity(plane * *nz as usize);
    for k in 0..*nz {
        for j in 0..*ny {
            for i in 0..*nx {
                let [x, y, z] = [i, j, k].map(f64::from);
                let shift = Vector::new(x * step[0], y * step[1], z * step[2]);
                places.push((format!("[{i},{j},{k}]"), first + shift));
            }
        }
    }
    Some(places)
}

/// A luminaire for each place.
fn points(
    places: &[(String, Point)],
    aim: &Aim,
    Emission { intensity, area, .. }: &Emission,
    entry: &At<LuminaireRecord>,
    context: &mut Context,
) -> Option<Vec<(String, LuminaireKind)>> {
    let rotate_deg = entry.get_ref().rotate_deg.as_ref().map_or(0.0, |r| r.get_ref().0);
    let mut kinds = Vec::with_capacity(places.len());
    for (place, position) in places {
        let aim = aim.from(*position, context)?;
        let kind = LuminaireKind::Point {
            position: *position,
            world_from_luminaire: world_from_luminaire(context.up, aim, rotate_deg),
            intensity: intensity.clone(),
            area: *area,
        };
        kinds.push((place.clone(), kind));
    }
    Some(kinds)
}
