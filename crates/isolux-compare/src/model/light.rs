//! Luminaires.

use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind};
use isolux::units::Rgb;

/// A white point with the same intensity in every direction.
pub fn isotropic(name: &str, position: Point, intensity_cd: f64) -> Luminaire {
    aimed(name, position, -Direction::Z, IntensityDistribution::Isotropic { intensity_cd })
}

/// A white point luminaire whose nadir points along a direction.
pub fn aimed(
    name: &str,
    position: Point,
    aim: Direction,
    intensity: IntensityDistribution,
) -> Luminaire {
    let z = -aim;
    let (x, y) = z.frame();
    let columns = [x, y, z].map(Direction::to_vector);
    let world_from_luminaire = Transform { columns, translation: Vector::ZERO };
    let kind = LuminaireKind::Point { position, world_from_luminaire, intensity, area: None };
    Luminaire { name: name.into(), group: 0, colour: Rgb::WHITE, kind }
}
