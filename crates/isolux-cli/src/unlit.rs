//! Places without light: those that are dark, and those outside of the room or inside of things, where nothing is known.

use crate::notes::{Note, note};
use crate::origin::Extent;
use isolux::engine::{ExactSettings, MapReader, ProbePoint};
use isolux::geometry::Ray;
use isolux::map::Illuminance;
use isolux::sampling::{CosineHemisphere, Key, Sequence};
use isolux::scene::Scene;
use isolux_formats::counted;

/// Few rays: whether there is any light is asked, not how much.
const ANY: ExactSettings = ExactSettings { rays: 128, replicates: 2, seed: 1 };
/// Rays by which a place is found to be in the open.
const LOOKS: u32 = 64;

/// Whether a reading holds no light at all.
pub(crate) fn is_dark(value: &Illuminance) -> bool {
    value.illuminance_lx() == 0.0
}

/// The reading of a place in the open that a map holds no value of, if no light is found there afresh. A map itself does not tell a
/// dark room from the inside of things.
pub(crate) fn known_dark(
    (scene, reader): (&Scene, &MapReader<'_>),
    at: ProbePoint,
) -> Option<Illuminance> {
    let is_open = Extent::of(scene).holds(at.position) && is_in_the_open(scene, at);
    is_open.then(|| reader.estimate(at, &ANY)).filter(is_dark)
}

/// Fresh readings without those that are dark and not in the open; tells of these.
pub(crate) fn without_unknown(
    scene: &Scene,
    points: &[ProbePoint],
    mut values: Vec<Option<Illuminance>>,
) -> Vec<Option<Illuminance>> {
    let extent = Extent::of(scene);
    let mut unknown = 0;
    for (at, value) in points.iter().zip(&mut values) {
        let is_open = || extent.holds(at.position) && is_in_the_open(scene, *at);
        if value.as_ref().is_some_and(is_dark) && !is_open() {
            unknown += 1;
            *value = None;
        }
    }
    if unknown > 0 {
        let what = format!(
            "{unknown} of {} outside of the room, or inside of a thing: no light is found there and nothing is known, so no value \
             is given",
            counted(points.len(), "point lies", "points lie")
        );
        note(Note::Warning, what);
    }
    values
}

/// Whether more of what a luxmeter sees are fronts of surfaces, or nothing, than backs: from outside of a room, and from inside of a
/// thing, backs are seen. Best effort: surfaces may face the wrong way.
fn is_in_the_open(scene: &Scene, at: ProbePoint) -> bool {
    let (axis, sequence) = (at.normal.to_direction(), Sequence::new(Key::new(3)));
    let origin = scene.bvh().offset_origin(at.position, at.normal);
    let sees_back = |index: &u32| {
        let way = axis.from_local(CosineHemisphere::sample(sequence.pair(*index, 0)));
        scene.bvh().closest_hit(&Ray::new(origin, way)).is_some_and(|hit| hit.back)
    };
    2 * (0..LOOKS).filter(sees_back).count() <= LOOKS as usize
}
