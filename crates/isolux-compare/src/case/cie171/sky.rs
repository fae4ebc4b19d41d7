//! CIE skies through openings.
//!
//! What an opening lets through of a sky is an integral over the opening: the luminance of the sky behind each place of it,
//! times what is done to light on its way through.

use super::panel::unit;
use super::room::direct;
use super::visible::{above, gathered_lx};
use crate::expectation::Expectation;
use isolux::engine::ProbePoint;
use isolux::geometry::{Normal, Point, Transform, Vector};
use isolux::photometry::{GeneralSky, Sky};
use isolux::scene::{Luminaire, LuminaireKind};
use isolux::units::Rgb;

/// A CIE standard general sky, above a black ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct CieSky(GeneralSky);

impl CieSky {
    /// Type 1, overcast, by its luminance in the zenith.
    pub(super) fn overcast(zenith_cd_m2: f64) -> Self {
        Self::of(1, zenith_cd_m2, Vector::new(0.0, 0.0, 1.0))
    }

    /// Type 12, clear with low turbidity. The sun itself is not part of it.
    pub(super) fn clear(zenith_cd_m2: f64, sun: Vector) -> Self {
        Self::of(12, zenith_cd_m2, sun)
    }

    fn of(number: u8, zenith_cd_m2: f64, sun: Vector) -> Self {
        let sky = sun.direction().and_then(|sun| GeneralSky::cie(number, sun));
        let sky = sky.and_then(|sky| sky.with_zenith_cd_m2(zenith_cd_m2));
        Self(sky.unwrap_or(GeneralSky::uniform(zenith_cd_m2)))
    }

    /// The luminance towards a direction, cd/m2; nothing below the horizon.
    pub(super) fn luminance_cd_m2(&self, towards: Vector) -> f64 {
        unit(towards).direction().map_or(0.0, |towards| self.0.luminance_cd_m2(towards))
    }

    /// The sky as a luminaire.
    pub(super) fn luminaire(&self) -> Luminaire {
        let sky = Sky::General { sky: self.0, ground_cd_m2: 0.0 };
        let kind = LuminaireKind::Sky { world_from_sky: Transform::IDENTITY, sky };
        Luminaire { name: "sky".into(), group: 0, colour: Rgb::WHITE, kind }
    }
}

/// An opening to a sky, and what is done to light on its way through, by the cosine of its incidence.
pub(super) struct Skylight<'a> {
    pub(super) sky: &'a CieSky,
    pub(super) opening: &'a [Point],
    pub(super) transmitted: Option<fn(f64) -> f64>,
}

/// Nodes of the quadrature over an opening: doubled, no value here changes by more than 1e-9 of it.
const OPENING_NODES: usize = 40;

impl Skylight<'_> {
    /// The light of the sky at a place.
    pub(super) fn expected(&self, at: ProbePoint) -> [Expectation; 2] {
        direct(at, self.of_sky_lx(at))
    }

    /// What is done to light from a place beyond.
    fn share(&self, at: ProbePoint, beyond: Point) -> f64 {
        let normal =
            unit((self.opening[1] - self.opening[0]).cross(self.opening[2] - self.opening[1]));
        let cos = unit(beyond - at.position).dot(normal).abs();
        self.transmitted.map_or(1.0, |t| t(cos))
    }

    /// An integral over the part of the opening through which the sky is seen.
    pub(super) fn of_sky_lx(&self, at: ProbePoint) -> f64 {
        let upwards = ProbePoint { position: at.position, normal: Normal::Z };
        gathered_lx(&above(self.opening, upwards), at, OPENING_NODES, |through| {
            self.sky.luminance_cd_m2(through - at.position) * self.share(at, through)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{MOON_SPENCER, ROUNDING};

    #[test]
    fn the_overcast_sky_is_nearly_that_of_moon_and_spencer() {
        // (1 + 2 sin(elevation)) / 3 (1942): type 1 is a fit of the same sky.
        let sky = CieSky::overcast(1.0);
        for degrees in [20.0, 40.0, 60.0, 90.0_f64] {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let found = sky.luminance_cd_m2(Vector::new(cos, 0.0, sin));
            let moon_spencer = (1.0 + 2.0 * sin) / 3.0;
            assert!(
                (found / moon_spencer - 1.0).abs() < MOON_SPENCER,
                "{degrees}: {found} {moon_spencer}"
            );
        }
    }

    #[test]
    fn zenith_and_sun() {
        let sun = Vector::new(1.0, 0.0, 0.7);
        let sky = CieSky::clear(3000.0, sun);
        let zenith = sky.luminance_cd_m2(Vector::new(0.0, 0.0, 1.0));
        assert!((zenith / 3000.0 - 1.0).abs() < ROUNDING);
        let (near, far) =
            (sky.luminance_cd_m2(sun), sky.luminance_cd_m2(Vector::new(-1.0, 0.0, 0.7)));
        assert!(near > 5.0 * far, "{near} {far}");
        assert_eq!(sky.luminance_cd_m2(-sun), 0.0);
    }
}
