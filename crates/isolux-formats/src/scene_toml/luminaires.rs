//! Luminaires: where they hang, how they stand, in which group.

use super::chromaticity;
use super::context::Context;
use super::photometry::{self, Files};
use super::quantity::{Triple, plain};
use super::record::{ArrayRecord, DirectionalRecord, GroupRecord, LuminaireRecord};
use super::spans::{At, Span};
use isolux::geometry::{Direction, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, SceneParts, world_from_luminaire};
use isolux::units::Rgb;
use std::collections::HashMap;

/// The group of light that names none.
const UNGROUPED: &str = "ungrouped";

/// Light groups by name. Without any named group there is no list at all.
#[derive(Debug, Default)]
pub(super) struct Groups {
    pub(super) names: Vec<String>,
    index_of: HashMap<String, u32>,
}

impl Groups {
    /// The declared groups, after one for light without group if there is such light.
    pub(super) fn new(
        declared: &[GroupRecord],
        luminaires: &[At<LuminaireRecord>],
        scene: &SceneParts,
    ) -> Self {
        let mut groups = Self::default();
        let any_named =
            !declared.is_empty() || luminaires.iter().any(|l| l.get_ref().group.is_some());
        let any_unnamed = !scene.luminaires.is_empty()
            || luminaires.iter().any(|l| l.get_ref().group.is_none())
            || scene.shapes.iter().any(|shape| emits(scene, shape.material));
        if any_named && any_unnamed {
            groups.index(UNGROUPED);
        }
        for group in declared {
            groups.index(group.name.get_ref());
        }
        groups
    }

    fn index(&mut self, name: &str) -> u32 {
        if let Some(&known) = self.index_of.get(name) {
            return known;
        }
        let index = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.index_of.insert(name.to_owned(), index);
        index
    }
}

fn emits(scene: &SceneParts, material: u32) -> bool {
    let Some(material) = scene.materials.get(material as usize) else { return false };
    [false, true].iter().any(|&back| material.finish(back).is_some_and(|f| f.is_emitter()))
}

/// Adds all luminaires of the file to the scene.
pub(super) fn add(
    entries: &[At<LuminaireRecord>],
    groups: &mut Groups,
    scene: &mut SceneParts,
    context: &mut Context,
) {
    let mut files = Files::default();
    for (number, entry) in (1..).zip(entries) {
        let record = entry.get_ref();
        let name = record.name.clone().unwrap_or_else(|| format!("luminaire {number}"));
        let group = record.group.as_deref().map_or(0, |name| groups.index(name));
        let colour = colour(record, context);
        let Some(kinds) = kinds(entry, &name, &mut files, context) else { continue };
        let Some(colour) = colour else { continue };
        scene.luminaires.extend(kinds.into_iter().map(|(place, kind)| {
            let name = format!("{name}{place}");
            Luminaire { name, group, colour, kind }
        }));
    }
}

fn colour(record: &LuminaireRecord, context: &mut Context) -> Option<Rgb> {
    match (&record.colour, &record.cct_k) {
        (None, None) => Some(Rgb::WHITE),
        (Some(colour), None) if colour.get_ref().0.luminance() > 0.0 => {
            Some(colour.get_ref().0.chromaticity())
        }
        (Some(colour), None) => {
            context.problem(&colour.span(), "black has no colour", "use `dimming = 0`");
            None
        }
        (None, Some(cct)) => {
            let kelvin = cct.get_ref().0;
            if chromaticity::RANGE_K.contains(&kelvin) {
                return Some(chromaticity::of_temperature(kelvin));
            }
            let what = format!("colour temperature {kelvin} K");
            context.problem(&cct.span(), what, "give 1000 to 25000 K, or `colour`");
            None
        }
        (Some(_), Some(cct)) => {
            context.problem(&cct.span(), "`colour` and `cct_k`", "give one of them");
            None
        }
    }
}

/// All luminaires of an entry, each with what its name ends in.
fn kinds(
    entry: &At<LuminaireRecord>,
    name: &str,
    files: &mut Files,
    context: &mut Context,
) -> Option<Vec<(String, LuminaireKind)>> {
    let record = entry.get_ref();
    let choices = [
        ("isotropic", record.isotropic.is_some()),
        ("cosine", record.cosine.is_some()),
        ("spot", record.spot.is_some()),
        ("directional", record.directional.is_some()),
        ("ies", record.ies.is_some()),
        ("ldt", record.ldt.is_some()),
    ];
    context.one_of(&entry.span(), &format!("luminaire `{name}`"), &choices)?;
    if let Some(sun) = &record.directional {
        let kind = directional(sun, entry, context)?;
        return context.take_luminaires(&entry.span(), 1, 1).then(|| vec![(String::new(), kind)]);
    }
    let intensity = photometry::intensity(record, files, context);
    let places = places(entry, name, context);
    let aim = Aim::new(record, context);
    let intensity = intensity?.scaled(record.dimming.map_or(1.0, |d| d.0));
    points(&places?, &aim?, &intensity, entry, context)
}

fn directional(
    sun: &At<DirectionalRecord>,
    entry: &At<LuminaireRecord>,
    context: &mut Context,
) -> Option<LuminaireKind> {
    let record = entry.get_ref();
    let without_meaning = [
        ("position", record.position.as_ref().map(At::span)),
        ("target", record.target.as_ref().map(At::span)),
        ("rotate_deg", record.rotate_deg.as_ref().map(At::span)),
        ("array", record.array.as_ref().map(At::span)),
        ("flux_lm", record.flux_lm.as_ref().map(At::span)),
    ];
    for (key, span) in without_meaning {
        if let Some(span) = span {
            let what = format!("`{key}` of a directional luminaire");
            context.problem(&span, what, "remove it; give `direction`, where the light goes");
        }
    }
    let Some(direction) = &record.direction else {
        let what = "a directional luminaire without `direction`";
        context.problem(&sun.span(), what, "give the direction in which its light goes");
        return None;
    };
    Some(LuminaireKind::Directional {
        direction: direction_of(direction, context)?,
        illuminance_lx: sun.get_ref().illuminance_lx.0 * record.dimming.map_or(1.0, |d| d.0),
    })
}

fn direction_of(triple: &At<Triple>, context: &mut Context) -> Option<Direction> {
    let direction = Vector::from(plain(*triple.get_ref())).direction();
    if direction.is_none() {
        context.problem(&triple.span(), "a direction of length zero", "give where it points");
    }
    direction
}

/// A point of the file, in metres.
fn point_m(triple: Triple, context: &Context) -> Point {
    Point::from(plain(triple).map(|c| c * context.unit_m))
}

/// What a luminaire aims at.
enum Aim {
    Along(Direction),
    At(Point, Span),
}

impl Aim {
    fn new(record: &LuminaireRecord, context: &mut Context) -> Option<Self> {
        match (&record.target, &record.direction) {
            (None, None) => Some(Self::Along(-context.up.direction())),
            (None, Some(direction)) => direction_of(direction, context).map(Self::Along),
            (Some(target), None) => {
                Some(Self::At(point_m(*target.get_ref(), context), target.span()))
            }
            (Some(target), Some(_)) => {
                context.problem(&target.span(), "`target` and `direction`", "give one of them");
                None
            }
        }
    }

    fn from(&self, position: Point, context: &mut Context) -> Option<Direction> {
        match self {
            Self::Along(direction) => Some(*direction),
            Self::At(target, span) => {
                let aim = (*target - position).direction();
                if aim.is_none() {
                    context.problem(span, "the target is where the luminaire is", "move one");
                }
                aim
            }
        }
    }
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

fn points(
    places: &[(String, Point)],
    aim: &Aim,
    intensity: &IntensityDistribution,
    entry: &At<LuminaireRecord>,
    context: &mut Context,
) -> Option<Vec<(String, LuminaireKind)>> {
    let rotate_deg = entry.get_ref().rotate_deg.as_ref().map_or(0.0, |r| r.get_ref().0);
    let mut kinds = Vec::with_capacity(places.len());
    for (place, position) in places {
        let aim = aim.from(*position, context)?;
        let world_from_luminaire = world_from_luminaire(context.up, aim, rotate_deg);
        let (position, intensity) = (*position, intensity.clone());
        let kind = LuminaireKind::Point { position, world_from_luminaire, intensity };
        kinds.push((place.clone(), kind));
    }
    Some(kinds)
}
