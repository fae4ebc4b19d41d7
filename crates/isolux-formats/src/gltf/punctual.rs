//! KHR_lights_punctual: points, spots and parallel light.

use super::buffers::Document;
use super::notes::{Flaw, Notes, no_such};
use super::orientation;
use gltf_json::extensions::scene::khr_lights_punctual::{Light, Spot, Type};
use gltf_json::validation::Checked;
use isolux::geometry::{Point, Transform};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{LuminaireKind, LuminousArea};
use isolux::units::Rgb;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Angles may exceed a right angle by this much, rad: the rounding of `f32`.
const ANGLE_ROUNDING_RAD: f64 = 1e-6;
/// Share of the outer angle that the inner one keeps where the file makes them equal, which would
/// leave no room for the ramp between them.
const SHARPEST_SPOT: f64 = 0.999;

/// The light of that index.
pub(super) fn get<'a>(document: &'a Document, index: usize) -> Result<&'a Light, Flaw> {
    let extension = document.root.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
    let lights = extension.map_or(&[][..], |e| &e.lights);
    lights
        .get(index)
        .ok_or_else(|| no_such("extensions.KHR_lights_punctual.lights", index, lights.len()))
}

/// Colour of luminance one, and what the light is in a node's place.
pub(super) fn resolve(
    light: &Light,
    place: &str,
    world_from_node: &Transform,
    notes: &mut Notes,
) -> Result<(Rgb, LuminaireKind), Flaw> {
    let Checked::Valid(type_) = light.type_ else {
        return Err(Flaw::new("unknown type of light", "use directional, point or spot").at("type"));
    };
    if light.range.is_some() {
        let what = "the range of a light is left out: light falls off with the square of distance";
        let remedy = "give engines that cut it off there a longer one, or they show less light";
        notes.warn(Flaw::new(what, remedy).at(format!("{place}.range")));
    }
    let (colour, intensity) = photometric(light.color.map(f64::from), f64::from(light.intensity))?;
    let kind = match type_ {
        Type::Directional => LuminaireKind::Directional {
            direction: orientation::forward(world_from_node)?,
            illuminance_lx: intensity,
            half_angle_rad: 0.0,
        },
        Type::Point => {
            let intensity = IntensityDistribution::Isotropic { intensity_cd: intensity };
            point(world_from_node, intensity, None)
        }
        Type::Spot => {
            orientation::forward(world_from_node)?;
            let spot = light.spot.as_ref();
            point(world_from_node, spot_distribution(spot, intensity, place, notes)?, None)
        }
    };
    Ok((colour, kind))
}

/// A luminaire at the origin of a node, turned by its rotation alone.
pub(super) fn point(
    world_from_node: &Transform,
    intensity: IntensityDistribution,
    area: Option<LuminousArea>,
) -> LuminaireKind {
    LuminaireKind::Point {
        position: world_from_node.point(Point::ORIGIN),
        world_from_luminaire: orientation::rotation(world_from_node),
        intensity,
        area,
    }
}

/// The three channels `colour * value` as a colour of luminance one and a photometric value.
pub(super) fn photometric(colour: [f64; 3], value: f64) -> Result<(Rgb, f64), Flaw> {
    let colour = Rgb(colour);
    if !(colour.is_finite() && colour.min_channel() >= 0.0) {
        let what = format!("colour {:?}", colour.0);
        return Err(Flaw::new(what, "give three numbers of zero or more").at("color"));
    }
    if !(value >= 0.0 && value.is_finite()) {
        let what = format!("intensity {value}");
        return Err(Flaw::new(what, "give a number of zero or more").at("intensity"));
    }
    Ok((colour.chromaticity(), value * colour.luminance()))
}

fn spot_distribution(
    spot: Option<&Spot>,
    peak_cd: f64,
    place: &str,
    notes: &mut Notes,
) -> Result<IntensityDistribution, Flaw> {
    let (mut inner_rad, outer_rad) = spot.map_or((0.0, FRAC_PI_4), |spot| {
        (f64::from(spot.inner_cone_angle), f64::from(spot.outer_cone_angle))
    });
    let in_range = outer_rad > 0.0 && outer_rad <= FRAC_PI_2 + ANGLE_ROUNDING_RAD;
    if !(in_range && inner_rad >= 0.0 && inner_rad.is_finite()) {
        let what = format!("cone angles {inner_rad} and {outer_rad} rad");
        let remedy = "half angles in radians: 0 <= inner < outer <= pi / 2";
        return Err(Flaw::new(what, remedy).at("spot"));
    }
    if inner_rad >= outer_rad {
        let what = if inner_rad > outer_rad {
            "the inner cone angle is above the outer one: the spot is given a soft edge of a thousandth of that"
        } else {
            "a spot without a soft edge is given one of a thousandth of its angle"
        };
        notes.warn(Flaw::new(what, "make innerConeAngle smaller").at(format!("{place}.spot")));
    }
    inner_rad = inner_rad.min(SHARPEST_SPOT * outer_rad);
    Ok(IntensityDistribution::Spot { peak_cd, inner_rad, outer_rad })
}
