//! SPHERE: an octant of a unit sphere, diffuse 0.7, closed by three mirrors (Kopylov, Khodulev,
//! Volevich 1998, 2.2 and appendix A).
//!
//! Mirrors in the coordinate planes (XY 1.0, XZ 0.8, YZ 0.6) turn the isotropic luminaire of 100 cd at
//! (0.2, 0.4, 0.6) into eight, each times the product of the reflectances passed; all of them see
//! every place of the octant. Between places of a sphere the form factor is constant, so the indirect
//! illuminance is, too: with `F = (1 + k_x)(1 + k_y)(1 + k_z) / 4`, `c = k F / pi` and `A = pi / 2`,
//! `I_a = c Int(I_d) / (1 - c A)` (formula 7). The integral is by Gauss quadrature.
//!
//! The sphere is of triangles circumscribed about it. Flux is kept by any closed surface, so the
//! mean illuminance falls as the area grows; the absorbing mirrors amplify that by `1 / (1 - c A)`
//! at most. That is the bound of indirect light.

use crate::expectation::{Bound, Case, Expectation, Quantity};
use crate::model::{SphereMesh, isotropic, octant};
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::quadrature::GaussRule;
use isolux::scene::{Finish, Material, SceneParts};
use isolux::units::Rgb;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// Diffuse reflectance of the sphere.
pub const REFLECTANCE: f64 = 0.7;
/// Reflectances of the mirrors perpendicular to x (YZ), y (XZ) and z (XY).
pub const MIRRORS: [f64; 3] = [0.6, 0.8, 1.0];
/// Intensity of the luminaire, cd.
pub const INTENSITY_CD: f64 = 100.0;
/// Where the luminaire is, m.
pub const LUMINAIRE: [f64; 3] = [0.2, 0.4, 0.6];
/// Rows of the triangulation: their square is the number of triangles.
const ROWS: u32 = 96;
/// Points of the quadrature each way; the integrand is analytic.
const QUADRATURE_POINTS: usize = 64;

/// The octant and its mirrors.
pub fn parts() -> SceneParts {
    let mesh = octant(1.0, ROWS);
    let mut shapes = vec![mesh.shape("sphere", 0, |_| true)];
    let names = ["mirror_yz", "mirror_xz", "mirror_xy"];
    shapes.extend((0..3).map(|axis| mesh.sector(names[axis], axis, 1 + axis as u32)));
    let mut materials =
        vec![Material::one_sided("diffuse", Finish::diffuse(Rgb::grey(REFLECTANCE)))];
    materials
        .extend((0..3).map(|axis| {
            Material::one_sided(names[axis], Finish::mirror(Rgb::grey(MIRRORS[axis])))
        }));
    SceneParts {
        name: "sphere".into(),
        shapes,
        materials,
        luminaires: vec![isotropic("luminaire", LUMINAIRE.into(), INTENSITY_CD)],
        ..SceneParts::default()
    }
}

/// Direct illuminance, mirror images included, at a place of the unit sphere, lx.
pub fn direct_lx(place: Point) -> f64 {
    let inward = -place.to_vector();
    (0..8)
        .map(|images| {
            let (mut share, mut source) = (1.0, LUMINAIRE);
            for axis in (0..3).filter(|axis| images >> axis & 1 == 1) {
                share *= MIRRORS[axis];
                source[axis] = -source[axis];
            }
            let d: Vector = Point::from(source) - place;
            share * INTENSITY_CD * d.dot(inward) / (d.length_squared() * d.length())
        })
        .sum()
}

/// Indirect illuminance, the same everywhere, lx: 666.649509.
pub fn ambient_lx() -> f64 {
    static AMBIENT: LazyLock<f64> = LazyLock::new(|| {
        let c = exchange();
        c * direct_flux_lm() / (1.0 - c * FRAC_PI_2)
    });
    *AMBIENT
}

/// Direct and indirect illuminance at a place of the unit sphere, lx.
pub fn total_lx(at: &ProbePoint) -> f64 {
    direct_lx(at.position) + ambient_lx()
}

/// Indirect illuminance thrown by one lumen received, 1/m2.
fn exchange() -> f64 {
    let factor = MIRRORS.iter().map(|k| 1.0 + k).product::<f64>() / 4.0;
    REFLECTANCE * factor / PI
}

/// Integral of the direct illuminance over the octant. (In the polar angle the integrand is smooth;
/// in z it has a root at the pole.)
fn direct_flux_lm() -> f64 {
    let rule = GaussRule::new(QUADRATURE_POINTS);
    rule.integrate(0.0, FRAC_PI_2, |azimuth_rad| {
        let (sin, cos) = libm::sincos(azimuth_rad);
        rule.integrate(0.0, FRAC_PI_2, |polar_rad| {
            let (r, z) = libm::sincos(polar_rad);
            r * direct_lx(Point::new(r * cos, r * sin, z))
        })
    })
}

/// The place of the paper, (1, 1, 1) / sqrt 3.
pub fn centre() -> ProbePoint {
    probe_at(Vector::new(1.0, 1.0, 1.0))
}

/// Places over the octant: `n^2` cells of equal area in z and azimuth, at their middles.
pub fn grid(n: u32) -> Vec<ProbePoint> {
    let middle = move |k: u32| (f64::from(k) + 0.5) / f64::from(n);
    (0..n * n)
        .map(|k| {
            let z = middle(k / n);
            let (sin, cos) = libm::sincos(FRAC_PI_2 * middle(k % n));
            let r = (1.0 - z * z).sqrt();
            probe_at(Vector::new(r * cos, r * sin, z))
        })
        .collect()
}

fn probe_at(towards: Vector) -> ProbePoint {
    let unit = towards * (1.0 / towards.length());
    let inward = (-towards).direction().map_or(isolux::geometry::Normal::Z, |d| d.to_normal());
    ProbePoint { position: Point::ORIGIN + unit, normal: inward }
}

pub(super) fn case() -> Case {
    Case {
        name: "sphere",
        notes: "GraphiCon'98 SPHERE: diffuse-specular-diffuse light, eight images of a luminaire",
        parts,
        expectations,
    }
}

fn expectations() -> Vec<Expectation> {
    let mesh = octant(1.0, ROWS);
    let ambient_bound_lx = ambient_bound_lx(&mesh);
    std::iter::once(centre())
        .chain(grid(4))
        .flat_map(|at| expected_at(at, mesh.thickness_m(), ambient_bound_lx))
        .collect()
}

fn expected_at(at: ProbePoint, thickness_m: f64, ambient_bound_lx: f64) -> [Expectation; 3] {
    let direct_lx = direct_lx(at.position);
    // The inverse cube in `cos / d^2 = h / d^3`, when the place moves out to the triangle; images are
    // farther away than the luminaire.
    let nearest_m = (Point::from(LUMINAIRE) - at.position).length();
    let direct_bound_lx = 3.0 * thickness_m / nearest_m * direct_lx;
    let reason = "triangles around the sphere: their area, and how far they are from it";
    Quantity::split(Rgb::grey(direct_lx), Rgb::grey(ambient_lx())).map(|(quantity, expected_lx)| {
        let lx = match quantity {
            Quantity::Direct => direct_bound_lx,
            Quantity::Indirect => ambient_bound_lx,
            Quantity::Total => direct_bound_lx + ambient_bound_lx,
        };
        Expectation { at, quantity, expected_lx, bound: Bound { lx, reason } }
    })
}

fn ambient_bound_lx(mesh: &SphereMesh) -> f64 {
    mesh.area_excess(0.125) / (1.0 - exchange() * FRAC_PI_2) * ambient_lx()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::PRINTED_SIX_DIGITS;

    #[test]
    fn agrees_with_appendix_a() {
        let direct = direct_lx(centre().position);
        for (found, expected) in [
            (direct, 686.598_367),
            (ambient_lx(), 666.649_509),
            (direct + ambient_lx(), 1_353.247_877),
        ] {
            assert!((found - expected).abs() < PRINTED_SIX_DIGITS, "{found}");
        }
    }

    #[test]
    fn flux_is_what_the_images_send_through_the_octant() {
        // With ideal mirrors the eight images would send all their flux through the whole sphere, an
        // eighth of it through each octant: the shares here lie between none and all of that.
        let one = 4.0 * PI * INTENSITY_CD;
        let flux = direct_flux_lm();
        assert!(flux < one && flux > 0.6 * 0.8 * one, "{flux}");
    }

    #[test]
    fn the_mesh_changes_the_answer_by_less_than_half_a_thousandth() {
        let mesh = octant(1.0, ROWS);
        assert!(ambient_bound_lx(&mesh) < 5e-4 * ambient_lx());
        let direct = expected_at(centre(), mesh.thickness_m(), 0.0)[0];
        assert!(direct.bound.lx < 1e-3 * direct.expected_lx.luminance());
    }
}
