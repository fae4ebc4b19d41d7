//! Full diffuse spheres: indirect light is the same everywhere.
//!
//! The form factor between two places of a sphere of radius R is `1 / (4 R^2)`, whatever their
//! distance, so `I_a = (1 / (4 pi R^2)) Int(k I_d) / (1 - K)`, K the mean reflectance (Kopylov,
//! Khodulev, Volevich 1998, appendix A, formulae 5 and 6). Of luminaires inside, `Int(I_d)` over a part
//! of the sphere is the flux into the solid angle it fills: all of it for one reflectance. For two
//! hemispheres and an isotropic luminaire at height `c` above the plane between them, the lower one
//! fills `2 pi (1 - c / sqrt(c^2 + R^2))` sr.
//!
//! The triangles are circumscribed about the sphere; a closed surface keeps the flux, so the mean
//! illuminance falls as the area grows, amplified by `1 / (1 - K)` at most.

use crate::expectation::{Bound, Case, Expectation, Quantity};
use crate::model::{SphereMesh, isotropic, sphere};
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::scene::{Finish, Luminaire, Material, SceneParts};
use isolux::units::Rgb;
use std::f64::consts::PI;

const RADIUS_M: f64 = 2.0;
/// Rows of triangles from a pole to the equator: 8 rows^2 triangles.
const ROWS: u32 = 36;

/// A sphere, its hemispheres and its luminaires (position, cd).
#[derive(Clone, Copy)]
struct FullSphere {
    name: &'static str,
    upper: f64,
    lower: f64,
    luminaires: fn() -> Vec<([f64; 3], f64)>,
}

const fn uniform(
    name: &'static str,
    k: f64,
    luminaires: fn() -> Vec<([f64; 3], f64)>,
) -> FullSphere {
    FullSphere { name, upper: k, lower: k, luminaires }
}

fn centred() -> Vec<([f64; 3], f64)> {
    vec![([0.0; 3], 1000.0)]
}

fn off_centre() -> Vec<([f64; 3], f64)> {
    vec![([0.5, -0.7, 0.9], 1000.0)]
}

fn on_axis() -> Vec<([f64; 3], f64)> {
    vec![([0.0, 0.0, 1.1], 1000.0)]
}

/// Luminaires on a spiral of equal steps in height, at radii up to 1.2 m, brighter and dimmer in turn.
fn thousand() -> Vec<([f64; 3], f64)> {
    (0..1000)
        .map(|k| {
            let turn_rad = PI * (3.0 - 5.0_f64.sqrt()) * f64::from(k);
            let z = (f64::from(k) + 0.5) / 500.0 - 1.0;
            let reach_m = 0.3 + 0.9 * f64::from(k % 7) / 6.0;
            let r = reach_m * (1.0 - z * z).sqrt();
            let (sin, cos) = libm::sincos(turn_rad);
            ([r * cos, r * sin, reach_m * z], 0.5 + f64::from(k % 4) / 2.0)
        })
        .collect()
}

const CENTRED_20: FullSphere = uniform("full_sphere_centred_20", 0.2, centred);
const CENTRED_50: FullSphere = uniform("full_sphere_centred_50", 0.5, centred);
const CENTRED_90: FullSphere = uniform("full_sphere_centred_90", 0.9, centred);
const OFF_CENTRE_20: FullSphere = uniform("full_sphere_off_centre_20", 0.2, off_centre);
const OFF_CENTRE_50: FullSphere = uniform("full_sphere_off_centre_50", 0.5, off_centre);
const OFF_CENTRE_90: FullSphere = uniform("full_sphere_off_centre_90", 0.9, off_centre);
const THOUSAND: FullSphere = uniform("full_sphere_1000_luminaires", 0.5, thousand);
const TWO_VALUED: FullSphere = FullSphere {
    name: "full_sphere_two_reflectances",
    upper: 0.8,
    lower: 0.3,
    luminaires: on_axis,
};

/// A function cannot be made of a value, so every case names its own.
macro_rules! case {
    ($sphere:expr, $notes:expr) => {
        Case {
            name: $sphere.name,
            notes: $notes,
            parts: || $sphere.parts(),
            expectations: || $sphere.expectations(),
        }
    };
}

pub(super) fn cases() -> [Case; 8] {
    let centred = "a luminaire in the middle of a diffuse sphere";
    let off_centre = "a luminaire off the middle of a diffuse sphere";
    [
        case!(CENTRED_20, centred),
        case!(CENTRED_50, centred),
        case!(CENTRED_90, centred),
        case!(OFF_CENTRE_20, off_centre),
        case!(OFF_CENTRE_50, off_centre),
        case!(OFF_CENTRE_90, off_centre),
        case!(TWO_VALUED, "a sphere of two hemispheres of different reflectance"),
        case!(THOUSAND, "a thousand luminaires in a diffuse sphere"),
    ]
}

impl FullSphere {
    fn parts(&self) -> SceneParts {
        let mesh = sphere(RADIUS_M, ROWS);
        let finish = |k: f64| Finish::diffuse(Rgb::grey(k));
        let lights = (self.luminaires)();
        let luminaire = |(k, &(position, cd)): (usize, &([f64; 3], f64))| -> Luminaire {
            isotropic(&format!("luminaire {k}"), position.into(), cd)
        };
        SceneParts {
            name: self.name.into(),
            shapes: vec![
                mesh.shape("upper", 0, |centroid| centroid.z > 0.0),
                mesh.shape("lower", 1, |centroid| centroid.z < 0.0),
            ],
            materials: vec![
                Material::one_sided("upper", finish(self.upper)),
                Material::one_sided("lower", finish(self.lower)),
            ],
            luminaires: lights.iter().enumerate().map(luminaire).collect(),
            ..SceneParts::default()
        }
    }

    fn mean_reflectance(&self) -> f64 {
        0.5 * (self.upper + self.lower)
    }

    fn ambient_lx(&self) -> f64 {
        let reflected_lm: f64 = (self.luminaires)()
            .iter()
            .map(|([_, _, c], cd)| {
                let lower_sr = 2.0 * PI * (1.0 - c / (c * c + RADIUS_M * RADIUS_M).sqrt());
                // Off the axis the solid angle is another; there both reflectances are the same.
                cd * (self.lower * lower_sr + self.upper * (4.0 * PI - lower_sr))
            })
            .sum();
        reflected_lm / (4.0 * PI * RADIUS_M * RADIUS_M) / (1.0 - self.mean_reflectance())
    }

    fn direct_lx(&self, at: ProbePoint) -> f64 {
        (self.luminaires)()
            .iter()
            .map(|&(source, cd)| {
                let d = Point::from(source) - at.position;
                cd * d.dot(at.normal.to_vector()) / (d.length_squared() * d.length())
            })
            .sum()
    }

    fn expectations(&self) -> Vec<Expectation> {
        let mesh = sphere(RADIUS_M, ROWS);
        places(&mesh).into_iter().flat_map(|at| self.expected_at(at, &mesh)).collect()
    }

    fn expected_at(&self, at: ProbePoint, mesh: &SphereMesh) -> [Expectation; 3] {
        let (direct, ambient) = (self.direct_lx(at), self.ambient_lx());
        // Places are on the mesh; only the normal between its corners may tilt, by the slope
        // of their distances. Light falls at less than 45 degrees, so cosines change by as much.
        let direct_bound =
            mesh.thickness_m() * mesh.longest_edge_m() / (RADIUS_M * RADIUS_M) * direct;
        let ambient_bound = mesh.area_excess(1.0) / (1.0 - self.mean_reflectance()) * ambient;
        let reason = "triangles around the sphere: their area, and their normals";
        Quantity::split(Rgb::grey(direct), Rgb::grey(ambient)).map(|(quantity, expected_lx)| {
            let lx = match quantity {
                Quantity::Direct => direct_bound,
                Quantity::Indirect => ambient_bound,
                Quantity::Total => direct_bound + ambient_bound,
            };
            Expectation { at, quantity, expected_lx, bound: Bound { lx, reason } }
        })
    }
}

/// Twelve places of the mesh on a spiral from pole to pole, facing the middle.
fn places(mesh: &SphereMesh) -> Vec<ProbePoint> {
    (0..12)
        .filter_map(|k| {
            let z = (f64::from(k) + 0.5) / 6.0 - 1.0;
            let r = (1.0 - z * z).sqrt();
            let (sin, cos) = libm::sincos(2.4 * f64::from(k));
            let outward = Vector::new(r * cos, r * sin, z).direction()?;
            let position = mesh.place_towards(outward)?;
            Some(ProbePoint { position, normal: (-outward).to_normal() })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::QUADRATURE;
    use isolux::quadrature::GaussRule;

    const ALL: [FullSphere; 8] = [
        CENTRED_20,
        CENTRED_50,
        CENTRED_90,
        OFF_CENTRE_20,
        OFF_CENTRE_50,
        OFF_CENTRE_90,
        TWO_VALUED,
        THOUSAND,
    ];

    /// Int(k I_d) over the sphere by quadrature, half by half.
    fn reflected_lm(sphere: &FullSphere) -> f64 {
        let rule = GaussRule::new(96);
        let half = |k: f64, low: f64, high: f64| {
            let flux = rule.integrate(low, high, |z| {
                rule.integrate(0.0, 2.0 * PI, |azimuth_rad| {
                    let (sin, cos) = libm::sincos(azimuth_rad);
                    let r = (1.0 - z * z).sqrt();
                    let outward = Vector::new(r * cos, r * sin, z);
                    sphere.direct_lx(ProbePoint {
                        position: Point::ORIGIN + outward * RADIUS_M,
                        normal: (-outward).normal().unwrap(),
                    })
                })
            });
            k * flux * RADIUS_M * RADIUS_M
        };
        half(sphere.lower, -1.0, 0.0) + half(sphere.upper, 0.0, 1.0)
    }

    #[test]
    fn no_place_is_lost() {
        assert_eq!(places(&sphere(RADIUS_M, ROWS)).len(), 12);
    }

    #[test]
    fn ambient_light_agrees_with_quadrature() {
        for sphere in ALL.iter().filter(|s| s.name != THOUSAND.name) {
            let area_m2 = 4.0 * PI * RADIUS_M * RADIUS_M;
            let expected = reflected_lm(sphere) / area_m2 / (1.0 - sphere.mean_reflectance());
            let found = sphere.ambient_lx();
            assert!((found / expected - 1.0).abs() < QUADRATURE, "{} {found}", sphere.name);
        }
    }
}
