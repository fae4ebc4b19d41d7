//! Skies: the CIE general sky, and a dome of facets that stands for it.
//!
//! The luminance in a direction at the angle Z from the zenith and chi from the sun is `L_z` times
//! `phi(Z) f(chi) / (phi(0) f(Z_s))`, with the gradation `phi(Z) = 1 + a exp(b / cos Z)` and the indicatrix
//! `f(chi) = 1 + c (exp(d chi) - exp(d pi / 2)) + e cos^2 chi` (CIE S 011 / ISO 15469:2004). Type 1 is the
//! overcast sky, type 12 the clear one.
//!
//! A dome about the middle of an opening has facets of the mean luminance of the sky behind them. What an
//! opening lets through of the sky itself is an integral over the opening; what it lets through of the
//! dome is a sum of Lambert's formula over facets. The difference of the two, computed place by place, is the bound of
//! the case: it holds the steps between facets and the finite distance of the dome.

use super::panel::unit;
use super::visible::{above, gathered_lx, lambert_lx, within};
use crate::expectation::{Bound, Expectation};
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::quadrature::GaussRule;
use isolux::scene::{Finish, Material, Shape};
use isolux::units::Rgb;
use std::f64::consts::{FRAC_PI_2, PI};

/// A CIE general sky.
#[derive(Clone, Copy, Debug)]
pub(super) struct CieSky {
    /// Gradation: a and b.
    gradation: [f64; 2],
    /// Indicatrix: c, d and e.
    indicatrix: [f64; 3],
    /// Luminance in the zenith, cd/m2.
    zenith_cd_m2: f64,
    /// Towards the sun, which itself is not part of it.
    sun: Vector,
}

impl CieSky {
    /// Type 1, overcast.
    pub(super) const fn overcast(zenith_cd_m2: f64) -> Self {
        let sun = Vector::new(0.0, 0.0, 1.0);
        Self { gradation: [4.0, -0.7], indicatrix: [0.0, -1.0, 0.0], zenith_cd_m2, sun }
    }

    /// Type 12, clear with low turbidity.
    pub(super) fn clear(zenith_cd_m2: f64, sun: Vector) -> Self {
        let sun = unit(sun);
        Self { gradation: [-1.0, -0.32], indicatrix: [10.0, -3.0, 0.45], zenith_cd_m2, sun }
    }

    /// The luminance towards a direction, cd/m2; nothing below the horizon.
    pub(super) fn luminance_cd_m2(&self, towards: Vector) -> f64 {
        let towards = unit(towards);
        if towards.z <= 0.0 {
            return 0.0;
        }
        let from_sun = libm::acos(towards.dot(self.sun).clamp(-1.0, 1.0));
        let sun_from_zenith = libm::acos(self.sun.z);
        self.zenith_cd_m2 * self.phi(towards.z) * self.f(from_sun)
            / (self.phi(1.0) * self.f(sun_from_zenith))
    }

    /// Whether luminance depends on the place of the sun.
    pub(super) fn has_sun(&self) -> bool {
        self.indicatrix[0] != 0.0
    }

    fn phi(&self, cos_z: f64) -> f64 {
        let [a, b] = self.gradation;
        1.0 + a * libm::exp(b / cos_z)
    }

    fn f(&self, chi_rad: f64) -> f64 {
        let ([c, d, e], cos) = (self.indicatrix, libm::cos(chi_rad));
        1.0 + c * (libm::exp(d * chi_rad) - libm::exp(d * FRAC_PI_2)) + e * cos * cos
    }
}

/// A part of the hemisphere above a plane of constant height, in facets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dome {
    /// About where.
    pub(super) centre: Point,
    /// How far the corners of facets are, m.
    pub(super) radius_m: f64,
    /// Azimuth from +x towards +y, from and to, rad.
    pub(super) azimuths_rad: [f64; 2],
    /// Facets from the horizon to the zenith, and around.
    pub(super) facets: [u32; 2],
}

/// A polygon of one luminance.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Counter-clockwise seen from inside the dome.
    pub(super) corners: Vec<Point>,
    /// Its luminance, cd/m2.
    pub(super) luminance_cd_m2: f64,
}

fn towards(elevation_rad: f64, azimuth_rad: f64) -> Vector {
    let ((sin, cos), (sin_a, cos_a)) = (libm::sincos(elevation_rad), libm::sincos(azimuth_rad));
    Vector::new(cos * cos_a, cos * sin_a, sin)
}

impl Dome {
    /// The facets for a sky, row by row from the horizon.
    pub(super) fn facets(&self, sky: &CieSky) -> Vec<Facet> {
        let [rows, around] = self.facets;
        let [from, to] = self.azimuths_rad;
        let elevation = |k: u32| FRAC_PI_2 * f64::from(k) / f64::from(rows);
        let azimuth = |k: u32| from + (to - from) * f64::from(k) / f64::from(around);
        let one = |row: u32, k: u32| {
            self.facet(sky, [elevation(row), elevation(row + 1)], [azimuth(k), azimuth(k + 1)])
        };
        (0..rows).flat_map(|row| (0..around).map(move |k| one(row, k))).collect()
    }

    /// The facet between two elevations and two azimuths, with the mean over its solid angle.
    fn facet(&self, sky: &CieSky, elevations: [f64; 2], azimuths: [f64; 2]) -> Facet {
        let corner =
            |e: f64, a: f64| self.centre + towards(elevations[0].max(e), a) * self.radius_m;
        let ([low, high], [left, right]) = (elevations, azimuths);
        let mut corners = vec![corner(low, left), corner(low, right), corner(high, right)];
        if high < FRAC_PI_2 {
            corners.push(corner(high, left));
        }
        // From inside azimuths run clockwise about whoever looks outwards with up above.
        corners.reverse();
        let rule = GaussRule::new(6);
        let weighted = rule.integrate(low, high, |e| {
            libm::cos(e) * rule.integrate(left, right, |a| sky.luminance_cd_m2(towards(e, a)))
        });
        let solid_angle_sr = (libm::sin(high) - libm::sin(low)) * (right - left);
        Facet { corners, luminance_cd_m2: weighted / solid_angle_sr }
    }
}

/// Facets as shapes, each with a material of its own; the first of these has the number `first`.
pub(super) fn shapes_of(facets: &[Facet], first: u32) -> (Vec<Shape>, Vec<Material>) {
    let parts = facets.iter().zip(first..).map(|(facet, number)| {
        let finish = Finish { luminance_cd_m2: Rgb::grey(facet.luminance_cd_m2), ..Finish::BLACK };
        let shape = crate::model::polygon("sky", &facet.corners, number);
        (shape, Material::one_sided(format!("sky {number}"), finish))
    });
    parts.unzip()
}

/// An opening to a sky, and what is done to light on its way through, by the cosine of its incidence.
pub(super) struct Skylight<'a> {
    pub(super) sky: &'a CieSky,
    pub(super) facets: &'a [Facet],
    pub(super) opening: &'a [Point],
    pub(super) transmitted: Option<fn(f64) -> f64>,
}

/// Nodes of the quadrature over an opening: doubled, no value here changes by more than 1e-9 of it.
const OPENING_NODES: usize = 40;
/// Nodes over a facet behind glass.
const FACET_NODES: usize = 6;

impl Skylight<'_> {
    /// The light of the sky at a place, and how far that of the dome is from it.
    pub(super) fn expected(&self, at: ProbePoint) -> [Expectation; 2] {
        let (sky, dome) = (self.of_sky_lx(at), self.of_dome_lx(at));
        let reason = "facets of one luminance each, at a finite distance, in place of the sky";
        Expectation::direct_only(at, Rgb::grey(sky), Bound { lx: (sky - dome).abs(), reason })
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
        let upwards = ProbePoint { position: at.position, normal: isolux::geometry::Normal::Z };
        gathered_lx(&above(self.opening, upwards), at, OPENING_NODES, |through| {
            self.sky.luminance_cd_m2(through - at.position) * self.share(at, through)
        })
    }

    /// A sum over facets.
    pub(super) fn of_dome_lx(&self, at: ProbePoint) -> f64 {
        let seen = |facet: &Facet| {
            let polygon = within(&facet.corners, self.opening, at.position);
            let l = facet.luminance_cd_m2;
            match self.transmitted {
                None => lambert_lx(l, &polygon, at),
                Some(_) => gathered_lx(&polygon, at, FACET_NODES, |p| l * self.share(at, p)),
            }
        };
        self.facets.iter().map(seen).sum()
    }
}

/// All around.
pub(super) const ALL_AROUND: [f64; 2] = [0.0, 2.0 * PI];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{MOON_SPENCER, ROUNDING};

    #[test]
    fn the_overcast_sky_is_nearly_that_of_moon_and_spencer() {
        // (1 + 2 sin(elevation)) / 3 (1942): type 1 is a fit of the same sky.
        let sky = CieSky::overcast(1.0);
        for degrees in [20.0, 40.0, 60.0, 90.0_f64] {
            let up = libm::sin(degrees.to_radians());
            let found = sky.luminance_cd_m2(towards(degrees.to_radians(), 1.0));
            let moon_spencer = (1.0 + 2.0 * up) / 3.0;
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

    #[test]
    fn facets_close_the_hemisphere_and_look_inside() {
        let sky = CieSky::overcast(1.0);
        let dome = Dome {
            centre: Point::ORIGIN,
            radius_m: 10.0,
            azimuths_rad: ALL_AROUND,
            facets: [6, 24],
        };
        let facets = dome.facets(&sky);
        let above = ProbePoint { position: Point::ORIGIN, normal: isolux::geometry::Normal::Z };
        let open: f64 = facets.iter().map(|f| lambert_lx(1.0, &f.corners, above)).sum();
        // The rim is a polygon of 24 corners, inside the horizon in the plane of the place: all is seen.
        assert!((open / PI - 1.0).abs() < 100.0 * ROUNDING, "{open}");
        for facet in &facets {
            let turn =
                (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[1]);
            assert!(turn.dot(facet.corners[0].to_vector()) < 0.0);
        }
    }
}
