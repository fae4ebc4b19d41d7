//! What is seen where a ray leaves the scene.

use super::{Luminaire, LuminaireKind, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Transform, Vector};
use std::f64::consts::PI;

impl Scene {
    /// Luminance of the skies in a direction that leaves the scene, cd/m2, with that of discs such as the sun if they are asked for.
    pub fn beyond_cd_m2(&self, towards: Direction, with_discs: bool) -> Rgb {
        let of = |luminaire: &Luminaire| match &luminaire.kind {
            LuminaireKind::Sky { .. } => luminaire.sky_cd_m2(towards).unwrap_or(Rgb::BLACK),
            LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad }
                if with_discs && *half_angle_rad > 0.0 =>
            {
                let is_on_disc = towards.dot(-*direction) >= libm::cos(*half_angle_rad);
                let cd_m2 =
                    if is_on_disc { illuminance_lx / projected_sr(*half_angle_rad) } else { 0.0 };
                luminaire.colour * cd_m2
            }
            LuminaireKind::Directional { .. } | LuminaireKind::Point { .. } => Rgb::BLACK,
        };
        self.luminaires().iter().map(of).sum()
    }
}

impl Luminaire {
    /// Luminance of a sky in a direction away from the scene, cd/m2; `None` for what is no sky.
    pub fn sky_cd_m2(&self, towards: Direction) -> Option<Rgb> {
        let LuminaireKind::Sky { world_from_sky, sky } = &self.kind else { return None };
        let local = local_from(world_from_sky, towards);
        Some(local.map_or(Rgb::BLACK, |local| self.colour * sky.luminance_cd_m2(local)))
    }
}

/// A direction of the world in the frame of a sky.
fn local_from(world_from_sky: &Transform, towards: Direction) -> Option<Direction> {
    let world = towards.to_vector();
    let [x, y, z] = world_from_sky.columns.map(|axis| axis.dot(world));
    Vector::new(x, y, z).direction()
}

/// Projected solid angle of a disc that is seen under twice an angle, for a surface that faces it, sr.
fn projected_sr(half_angle_rad: f64) -> f64 {
    let sin = libm::sin(half_angle_rad);
    PI * sin * sin
}
