//! The systems of angles in which goniometers measure (IES LM-75, CIE 121).

use isolux_geometry::Vector;
use serde::{Deserialize, Serialize};

/// Where the polar axis of a table lies in the frame of the luminaire, which shines along -z.
///
/// For A and B the luminaire is thought of as aimed at a wall: +x is up and -y is to the right of whoever
/// looks along the beam, as in Radiance's `source.cal`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum AngleSystem {
    /// The polar axis is the beam: C about -z from +x towards +y, gamma from -z.
    #[default]
    C,
    /// The polar axis is horizontal: planes turn by the vertical angle V, and the horizontal angle H lies in
    /// them. Plane 90 + V, polar angle 90 + H, from the pole +y.
    B,
    /// The polar axis is vertical: planes turn by the horizontal angle H, and the vertical angle V lies in
    /// them. Plane 90 + H, polar angle 90 + V, from the pole -x.
    A,
}

impl AngleSystem {
    /// Whether it is the system C.
    pub const fn is_c(&self) -> bool {
        matches!(self, Self::C)
    }

    /// From the frame in which the pole is -z and plane 0 contains +x.
    pub(super) const fn luminaire_from_web(self, Vector { x, y, z }: Vector) -> Vector {
        match self {
            Self::C => Vector { x, y, z },
            Self::B => Vector { x: -x, y: -z, z: -y },
            Self::A => Vector { x: z, y: x, z: -y },
        }
    }

    /// The inverse of [`Self::luminaire_from_web`].
    pub(super) const fn web_from_luminaire(self, Vector { x, y, z }: Vector) -> Vector {
        match self {
            Self::C => Vector { x, y, z },
            Self::B => Vector { x: -x, y: -z, z: -y },
            Self::A => Vector { x: y, y: -z, z: x },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frames_of_floodlights() {
        let (right, up, aim) =
            (Vector::new(0.0, -1.0, 0.0), Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.0, -1.0));
        // Plane 90 and polar angle 90 are the aim in both.
        let ahead = Vector::new(0.0, 1.0, 0.0);
        let (last_plane, last_pole) = (Vector::new(-1.0, 0.0, 0.0), Vector::new(0.0, 0.0, 1.0));
        for (system, plane_180, pole_180) in
            [(AngleSystem::B, up, right), (AngleSystem::A, right, up)]
        {
            assert_eq!(system.luminaire_from_web(ahead), aim, "{system:?}");
            assert_eq!(system.luminaire_from_web(last_plane), plane_180, "{system:?}");
            assert_eq!(system.luminaire_from_web(last_pole), pole_180, "{system:?}");
        }
        for system in [AngleSystem::A, AngleSystem::B, AngleSystem::C] {
            let v = Vector::new(0.1, 0.2, 0.3);
            assert_eq!(system.web_from_luminaire(system.luminaire_from_web(v)), v, "{system:?}");
        }
    }
}
