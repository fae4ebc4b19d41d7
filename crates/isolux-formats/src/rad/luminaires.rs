//! Luminaires: distant sources, spotlights, photometric files.

use super::build::without_scale;
use super::material::Spot;
use super::tessellate::area;
use crate::{Loaded, Problems, ies};
use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, Shape, UpAxis, world_from_luminaire};
use isolux::units::Rgb;
use std::f64::consts::PI;
use std::path::Path;

/// Full angle, degrees, up to which a source is taken as a disc, whose solid angle and projected solid angle differ by 0.2 % at most.
pub(super) const WIDEST_DISC_DEG: f64 = 10.0;
/// Share of the outer angle at which a spotlight begins to fade, so that there is a ramp.
const SHARP: f64 = 0.999;

fn luminaire(name: String, colour: Rgb, kind: LuminaireKind) -> Luminaire {
    Luminaire { name, group: 0, colour: colour.chromaticity(), kind }
}

/// Where a `source` is, and its full angle in degrees.
pub(super) fn cone(
    numbers: &[f64],
    world_from_file: &Transform,
) -> Result<(Direction, f64), (String, &'static str)> {
    let [x, y, z, angle_deg] = *numbers else {
        return Err((
            format!("{} real arguments where 4 are due", numbers.len()),
            "write x y z angle",
        ));
    };
    let towards = world_from_file.vector(Vector::new(x, y, z)).direction();
    let towards = towards.ok_or(("a direction of length zero".to_owned(), "say where it is"))?;
    if !(angle_deg > 0.0 && angle_deg <= 360.0) {
        return Err((format!("an angle of {angle_deg} degrees"), "write its full angle"));
    }
    Ok((towards, angle_deg))
}

/// A `source` of small angle: the illuminance is luminance times solid angle.
pub(super) fn disc(
    name: String,
    (towards, angle_deg): (Direction, f64),
    luminance_cd_m2: Rgb,
) -> Luminaire {
    // Of a surface that faces it: luminance times the projected solid angle.
    let sin = libm::sin(0.5 * angle_deg.to_radians());
    let illuminance_lx = luminance_cd_m2.luminance() * PI * sin * sin;
    let kind = LuminaireKind::Directional {
        direction: -towards,
        illuminance_lx,
        half_angle_rad: 0.5 * angle_deg.to_radians(),
    };
    luminaire(name, luminance_cd_m2, kind)
}

/// A spotlight in the middle of its surface, with the flux that the surface sends into its cone.
pub(super) fn spot(
    name: String,
    spot: &Spot,
    shape: &Shape,
    is_ball: bool,
) -> Result<Luminaire, String> {
    let aim = Vector::from(spot.aim).direction().ok_or("its direction has no length")?;
    let Middle { centroid, area_vector_m2 } = middle(shape).ok_or("its surface has no area")?;
    let half_rad = 0.5 * spot.angle_deg.to_radians();
    let sin = libm::sin(0.5 * half_rad);
    let area_sr = if is_ball {
        // A ball has the same projected area, a quarter of its surface, towards everywhere.
        0.25 * area(shape) * (4.0 * PI * sin * sin)
    } else {
        let normal = area_vector_m2.direction().ok_or("its surface is not flat")?;
        let tilt_rad = libm::acos(normal.dot(aim).clamp(-1.0, 1.0));
        // Rounding of the angle of a cone that just touches the surface.
        if tilt_rad + half_rad > PI / 2.0 + 1e-6 {
            return Err("its cone reaches behind its surface".into());
        }
        let sin = libm::sin(half_rad);
        area_vector_m2.dot(aim.to_vector()) * PI * sin * sin
    };
    let flux_lm = spot.luminance_cd_m2.luminance() * area_sr;
    let unit = IntensityDistribution::Spot {
        peak_cd: 1.0,
        inner_rad: SHARP * half_rad,
        outer_rad: half_rad,
    };
    let intensity = unit.scaled(flux_lm / unit.luminous_flux_lm());
    let world_from_luminaire = world_from_luminaire(UpAxis::Z, aim, 0.0);
    let kind =
        LuminaireKind::Point { position: centroid, world_from_luminaire, intensity, area: None };
    Ok(luminaire(name, spot.luminance_cd_m2, kind))
}

/// Where a surface is and how it faces.
pub(super) struct Middle {
    pub(super) centroid: Point,
    /// Sum of areas times normals.
    pub(super) area_vector_m2: Vector,
}

pub(super) fn middle(shape: &Shape) -> Option<Middle> {
    let corner = |k: u32| Vector::from(shape.positions[k as usize]);
    let (mut moment, mut sum, mut total) = (Vector::ZERO, Vector::ZERO, 0.0);
    for t in &shape.triangles {
        let [a, b, c] = t.map(corner);
        let twice = (b - a).cross(c - a);
        moment += (a + b + c) * (twice.length() / 6.0);
        sum += twice * 0.5;
        total += 0.5 * twice.length();
    }
    let centroid = Point::ORIGIN + moment * (1.0 / total);
    (total > 0.0).then_some(Middle { centroid, area_vector_m2: sum })
}

/// A point with a distribution in the frame of `ies2rad`: nadir -z, C0 along +x.
pub(super) fn point(
    name: String,
    colour: Rgb,
    position: Point,
    intensity: IntensityDistribution,
    world_from_file: &Transform,
) -> Option<Luminaire> {
    let world_from_luminaire = without_scale(world_from_file)?;
    let kind = LuminaireKind::Point { position, world_from_luminaire, intensity, area: None };
    Some(luminaire(name, colour, kind))
}

/// The distribution of a photometric file.
pub(super) fn read_ies(path: &Path) -> Result<Loaded<IntensityDistribution>, Problems> {
    let Loaded { value, warnings } = ies::read(path)?;
    Ok(Loaded { value: value.resolve()?, warnings })
}

/// Whether a surface faces along or against the third axis of a frame, and not aside.
pub(super) fn faces_down(area_vector: Vector, world_from_file: &Transform) -> Option<bool> {
    let z: Direction = world_from_file.columns[2].direction()?;
    let cos = area_vector.direction()?.dot(z);
    // As level as numbers of six digits can say.
    (cos.abs() > 1.0 - 1e-6).then_some(cos < 0.0)
}
