//! What is seen beyond the scene: its sky and its sun.

use super::container::Sections;
use super::record::{SkyRecord, SunRecord};
use crate::lightmap::shared_exponent;
use isolux::geometry::{Transform, Vector};
use isolux::photometry::{Sky, SkyPicture};
use isolux::scene::{Luminaire, LuminaireKind, Scene};
use isolux::units::Rgb;
use std::f64::consts::PI;

/// A pixel is a degree.
const WIDTH: u32 = 360;
const HEIGHT: u32 = 180;

/// The first sky of a scene as a picture all around.
pub(super) fn sky(scene: &Scene, sections: &mut Sections) -> Option<SkyRecord> {
    let of = |luminaire: &Luminaire| match &luminaire.kind {
        LuminaireKind::Sky { world_from_sky, sky } => {
            Some((luminaire.group, luminaire.colour, *world_from_sky, sky.clone()))
        }
        LuminaireKind::Point { .. } | LuminaireKind::Directional { .. } => None,
    };
    let (group, colour, world_from_sky, sky) = scene.luminaires().iter().find_map(of)?;
    let codes: Vec<u32> = pixels(&sky, colour).map(|rgb| shared_exponent::encode(rgb.0)).collect();
    let axis = |v: [f64; 3]| axis(&world_from_sky, v);
    Some(SkyRecord {
        group,
        width: WIDTH,
        height: HEIGHT,
        codes: sections.u32s(&codes),
        east: axis([1.0, 0.0, 0.0]),
        north: axis([0.0, 1.0, 0.0]),
        zenith: axis([0.0, 0.0, 1.0]),
    })
}

fn axis(world_from_sky: &Transform, of_sky: [f64; 3]) -> [f64; 3] {
    world_from_sky.vector(Vector::from(of_sky)).into()
}

/// Rows from the zenith, columns from north by east.
fn pixels(sky: &Sky, colour: Rgb) -> impl Iterator<Item = Rgb> + '_ {
    let frame = SkyPicture { width: WIDTH, height: HEIGHT, rgb_cd_m2: Vec::new() };
    (0..WIDTH * HEIGHT).map(move |at| {
        let middle = [at % WIDTH, at / WIDTH].map(|k| f64::from(k) + 0.5);
        sky.luminance_cd_m2(frame.direction(middle)) * colour
    })
}

/// The first disc of a scene, as the sun is.
pub(super) fn sun(scene: &Scene) -> Option<SunRecord> {
    scene.luminaires().iter().find_map(|luminaire| {
        let LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } =
            luminaire.kind
        else {
            return None;
        };
        if half_angle_rad <= 0.0 {
            return None;
        }
        let (sine, cosine) = libm::sincos(half_angle_rad);
        Some(SunRecord {
            group: luminaire.group,
            towards: (-direction).to_vector().into(),
            cosine,
            luminance_cd_m2: luminaire.colour * (illuminance_lx / (PI * sine * sine)),
        })
    })
}
