//! EXT_lights_image_based: a cube of pictures all around, infinitely far away.

use super::buffers::Document;
use super::notes::{Flaw, Notes, no_such};
use super::pictures::Face;
use super::surfaces::Surfaces;
use crate::sky_formula::sampled_in_colour;
use isolux::geometry::{Direction, Transform, Vector};
use isolux::photometry::Sky;
use isolux::scene::{Luminaire, LuminaireKind};
use isolux::units::Rgb;
use serde::Deserialize;
use serde_json::Value;
use std::sync::Arc;

pub(super) const NAME: &str = "EXT_lights_image_based";

/// A light of the extension. Its spherical harmonics say the same as its pictures, and its coarser pictures are blurred ones: neither is read.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Light {
    name: Option<String>,
    #[serde(default = "unturned")]
    rotation: [f64; 4],
    #[serde(default = "one")]
    intensity: f64,
    /// Six faces for each size, the largest first.
    specular_images: Vec<[usize; 6]>,
}

const fn unturned() -> [f64; 4] {
    [0.0, 0.0, 0.0, 1.0]
}

const fn one() -> f64 {
    1.0
}

/// The surroundings of the scene that is read, if it has any.
pub(super) fn surroundings(
    document: &Document,
    surfaces: &mut Surfaces<'_>,
    notes: &mut Notes,
) -> Option<Luminaire> {
    let root = &document.root;
    let scene = root.scenes.get(root.scene.map_or(0, |scene| scene.value()))?;
    let used = scene.extensions.as_ref()?.others.get(NAME)?.get("light")?;
    let made = light(document, used).and_then(|(light, place)| {
        luminaire(light, surfaces, notes, &place).map_err(|flaw| flaw.rooted(place))
    });
    notes.accept(made)
}

/// The light that a scene names, and its place.
fn light(document: &Document, used: &Value) -> Result<(Light, String), Flaw> {
    let lights = document.root.extensions.as_ref().and_then(|e| e.others.get(NAME)?.get("lights"));
    let lights = lights.and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let list = format!("extensions.{NAME}.lights");
    let index = used.as_u64().and_then(|index| usize::try_from(index).ok());
    let index = index.unwrap_or(usize::MAX);
    let record = lights.get(index).ok_or_else(|| no_such(&list, index, lights.len()))?;
    let place = format!("{list}[{index}]");
    let read = Light::deserialize(record).map_err(|error| {
        Flaw::new(error.to_string(), "export the file again").rooted(place.clone())
    })?;
    Ok((read, place))
}

fn luminaire(
    light: Light,
    surfaces: &mut Surfaces<'_>,
    notes: &mut Notes,
    place: &str,
) -> Result<Luminaire, Flaw> {
    if !(light.intensity >= 0.0 && light.intensity.is_finite()) {
        let what = format!("{} is no brightness", light.intensity);
        return Err(Flaw::new(what, "give a number of zero or more").at("intensity"));
    }
    let turn = turn(light.rotation)?;
    let faces = light.specular_images.first();
    let faces =
        faces.ok_or_else(|| Flaw::new("no pictures", "export it again").at("specularImages"))?;
    let mut read = Vec::with_capacity(faces.len());
    for (k, &image) in faces.iter().enumerate() {
        let at = |flaw: Flaw| flaw.at(format!("specularImages[0][{k}]"));
        read.push(surfaces.face(image).map_err(at)?);
    }
    let what = "the extension says no unit of luminance; its values are taken as cd/m2";
    notes.warn(Flaw::new(what, "scale `intensity`, or give --sky with a picture").at(place));
    let picture = sampled_in_colour(|towards| seen(&read, towards));
    let kind = LuminaireKind::Sky {
        world_from_sky: turn.then_from(&own_from_sky()),
        sky: Sky::Picture(Arc::new(picture)).scaled(light.intensity),
    };
    let name = light.name.unwrap_or_else(|| "surroundings".to_owned());
    Ok(Luminaire { name, group: 0, colour: Rgb::WHITE, kind })
}

/// +y is above; pictures begin at -z and go by +x.
fn own_from_sky() -> Transform {
    let axes = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
    Transform { columns: axes.map(Vector::from), translation: Vector::ZERO }
}

/// The rotation of a quaternion (x, y, z, w) of any length.
fn turn(quaternion: [f64; 4]) -> Result<Transform, Flaw> {
    let length = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
    if !(length.is_finite() && length > 0.0) {
        return Err(Flaw::new("no rotation", "give a quaternion").at("rotation"));
    }
    let [x, y, z, w] = quaternion.map(|part| part / length);
    let columns = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    Ok(Transform { columns: columns.map(Vector::from), translation: Vector::ZERO })
}

/// What faces (+x, -x, +y, -y, +z, -z) show in a direction of the frame of skies. Each is saved as it looks from the middle of the cube: that
/// is the orientation of OpenGL, flipped about the vertical axis.
fn seen(faces: &[Face], towards: Direction) -> [f64; 3] {
    let of_sky = towards.to_vector();
    let [x, y, z] = [of_sky.x, of_sky.z, -of_sky.y];
    let (face, right, down, ahead) = if x.abs() >= y.abs() && x.abs() >= z.abs() {
        if x > 0.0 { (0, z, -y, x) } else { (1, -z, -y, -x) }
    } else if y.abs() >= z.abs() {
        if y > 0.0 { (2, -x, z, y) } else { (3, -x, -z, -y) }
    } else if z > 0.0 {
        (4, -x, -y, z)
    } else {
        (5, x, -y, -z)
    };
    faces[face].at([0.5 * (right / ahead + 1.0), 0.5 * (down / ahead + 1.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn towards(v: [f64; 3]) -> Direction {
        Vector::new(v[0], -v[2], v[1]).direction().unwrap()
    }

    /// From the middle of a cube one sees, to the right of what one faces, what one faces after a turn to the right.
    #[test]
    fn faces_are_seen_from_within() {
        // Four pixels each: upper left, upper right, lower left, lower right.
        let face =
            |k: usize| Face { side: 2, rgb: (0..4).map(|at| [(10 * k + at) as f32; 3]).collect() };
        let faces: Vec<Face> = (0..6).map(face).collect();
        for (v, value) in [
            ([1.0, 0.5, 0.5], 1.0), // +x: +z is to the right
            ([1.0, -0.5, -0.5], 2.0),
            ([-1.0, 0.5, -0.5], 11.0), // -x: -z is to the right
            ([0.5, 0.5, 1.0], 40.0),   // +z: +x is to the left
            ([0.5, 0.5, -1.0], 51.0),  // -z: +x is to the right
            ([0.5, 1.0, 0.5], 22.0),   // +y: below is +z, and +x is to the left
            ([0.5, -1.0, 0.5], 30.0),  // -y: above is +z
        ] {
            assert_eq!(seen(&faces, towards(v))[0], value, "{v:?}");
        }
    }

    #[test]
    fn quaternions_turn_counter_clockwise() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let about_y = turn([0.0, half, 0.0, half]).unwrap();
        let [x, ..] = about_y.columns;
        // Two roundings of numbers near one.
        assert!((x - Vector::new(0.0, 0.0, -1.0)).length() < 4.0 * f64::EPSILON, "{x:?}");
        assert!(turn([0.0; 4]).is_err());
    }
}
