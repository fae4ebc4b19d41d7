//! Luminaires without a surface.

use super::property::{float, origin_and_axis, transform, triple};
use super::record::{Element, Wrong};
use super::spectrum::{Of, colour};
use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::photometry::{IntensityDistribution, PhotometricWeb};
use isolux::scene::{Luminaire, LuminaireKind, UpAxis, world_from_luminaire};
use isolux::units::Rgb;

/// A spotlight is seen this many degrees beyond its cutoff as dark, so that its table ends there.
const EDGE_DEG: f64 = 1e-6;

/// Its own name or, without one, its kind and line.
pub(super) fn name(emitter: &Element) -> String {
    let usual = format!("{} line {}", emitter.kind(), emitter.at.line);
    emitter.attribute("id").map_or(usual, str::to_owned)
}

fn luminaire(emitter: &Element, light: Rgb, kind: LuminaireKind) -> Luminaire {
    Luminaire { name: name(emitter), group: 0, colour: light.chromaticity(), kind }
}

/// The light of an emitter in photometric units.
pub(super) fn light(emitter: &Element, slot: &str, efficacy_lm_w: f64) -> Result<Rgb, Wrong> {
    let light = emitter.child(slot).map_or(Ok(Rgb::WHITE), |child| colour(child, Of::Light))?;
    Ok(light * efficacy_lm_w)
}

/// Where an emitter stands and looks.
fn stand(emitter: &Element) -> Result<(Point, Direction), Wrong> {
    let flat = || ("it looks nowhere".to_owned(), "correct its `to_world`");
    origin_and_axis(&transform(emitter, "to_world")?).ok_or_else(flat)
}

/// `point`.
pub(super) fn point(emitter: &Element, efficacy_lm_w: f64) -> Result<Luminaire, Wrong> {
    let intensity = light(emitter, "intensity", efficacy_lm_w)?;
    let position = match triple(emitter, "position")? {
        Some(position) => Point::from(position),
        None => stand(emitter)?.0,
    };
    let kind = LuminaireKind::Point {
        position,
        world_from_luminaire: Transform::IDENTITY,
        intensity: IntensityDistribution::Isotropic { intensity_cd: intensity.luminance() },
        area: None,
    };
    Ok(luminaire(emitter, intensity, kind))
}

/// `spot`: full up to `beam_width` from the axis, none from `cutoff_angle` on, linear in the angle
/// between.
pub(super) fn spot(emitter: &Element, efficacy_lm_w: f64) -> Result<Luminaire, Wrong> {
    let intensity = light(emitter, "intensity", efficacy_lm_w)?;
    let cutoff_deg = float(emitter, "cutoff_angle")?.unwrap_or(20.0);
    let beam_deg = float(emitter, "beam_width")?.unwrap_or(0.75 * cutoff_deg);
    let angles = format!("a beam of {beam_deg} degrees and a cutoff of {cutoff_deg}");
    let refused =
        || (angles.clone(), "give angles from the axis, 0 <= beam_width <= cutoff_angle < 180");
    if !(beam_deg >= 0.0
        && beam_deg <= cutoff_deg
        && cutoff_deg > 0.0
        && cutoff_deg + EDGE_DEG < 180.0)
    {
        return Err(refused());
    }
    let cd = intensity.luminance();
    let mut table = vec![(0.0, cd)];
    for node in [(beam_deg, cd), (cutoff_deg.max(beam_deg + EDGE_DEG), 0.0), (180.0, 0.0)] {
        if table.last().is_some_and(|(angle_deg, _)| node.0 > *angle_deg) {
            table.push(node);
        }
    }
    let (gammas_deg, candela) = table.into_iter().unzip();
    let web = PhotometricWeb::new(vec![0.0], gammas_deg, candela).map_err(|_| refused())?;
    let (position, aim) = stand(emitter)?;
    let world_from_luminaire = world_from_luminaire(UpAxis::Z, aim, 0.0);
    let intensity_cd = IntensityDistribution::Web(web.into());
    let kind = LuminaireKind::Point {
        position,
        world_from_luminaire,
        intensity: intensity_cd,
        area: None,
    };
    Ok(luminaire(emitter, intensity, kind))
}

/// `directional`.
pub(super) fn directional(emitter: &Element, efficacy_lm_w: f64) -> Result<Luminaire, Wrong> {
    let irradiance = light(emitter, "irradiance", efficacy_lm_w)?;
    let direction = match triple(emitter, "direction")? {
        Some(direction) => {
            let none = || ("a direction of length zero".to_owned(), "say where the light goes");
            Vector::from(direction).direction().ok_or_else(none)?
        }
        None => stand(emitter)?.1,
    };
    let illuminance_lx = irradiance.luminance();
    let kind = LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad: 0.0 };
    Ok(luminaire(emitter, irradiance, kind))
}
