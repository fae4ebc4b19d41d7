//! 5.8, the internally reflected component of diffuse surfaces.
//!
//! The formula of the integrating sphere, `E_i = rho Phi / (A (1 - rho))`, holds for a sphere alone: there the form
//! factor between any two places is `1 / A`. For a cube with the same formula the standard's answer is disputed;
//! its exact answer is that of the integral equation, which [`super::super::cube::reference`] solves. Both are
//! here: a sphere of radius 2 m, and a cube of 4 m, whose illuminance is that of CUBE (10 m, 50,000 cd) times the
//! ratio of intensities and the inverse ratio of areas. The triangles of the sphere lie outside it; a
//! closed surface keeps the flux, so the mean illuminance falls as the area grows, amplified by
//! `1 / (1 - rho)` at most.

use super::super::cube::{self, reference::CubeReference};
use super::room::{diffuse, split};
use crate::expectation::{Bound, Case, Expectation, Quantity};
use crate::model::{SphereMesh, inward_box, isotropic, sphere};
use isolux::engine::ProbePoint;
use isolux::geometry::{Normal, Point, Vector};
use isolux::scene::SceneParts;
use isolux::units::Rgb;
use std::f64::consts::PI;

const INTENSITY_CD: f64 = 1000.0;
const REFLECTANCE: f64 = 0.5;
const HALF_EDGE_M: f64 = 2.0;
const RADIUS_M: f64 = 2.0;
/// Rows of triangles from a pole to the equator: 8 rows^2 triangles.
const ROWS: u32 = 30;

pub(super) fn cases() -> [Case; 2] {
    [
        Case {
            name: "cie171_5_8_sphere",
            notes: "CIE 171 5.8: a point luminaire in a diffuse sphere",
            parts: sphere_parts,
            expectations: sphere_expectations,
        },
        Case {
            name: "cie171_5_8_cube",
            notes: "CIE 171 5.8: a point luminaire in a diffuse cube, by the integral equation",
            parts: cube_parts,
            expectations: cube_expectations,
        },
    ]
}

fn sphere_parts() -> SceneParts {
    SceneParts {
        name: "cie171_5_8_sphere".into(),
        shapes: vec![sphere(RADIUS_M, ROWS).shape("sphere", 0, |_| true)],
        materials: vec![diffuse(REFLECTANCE)],
        luminaires: vec![isotropic("luminaire", Point::ORIGIN, INTENSITY_CD)],
        ..SceneParts::default()
    }
}

fn cube_parts() -> SceneParts {
    let (low, high) = ([-HALF_EDGE_M; 3], [HALF_EDGE_M; 3]);
    SceneParts {
        name: "cie171_5_8_cube".into(),
        shapes: vec![inward_box("walls", low, high, 0)],
        materials: vec![diffuse(REFLECTANCE)],
        luminaires: vec![isotropic("luminaire", Point::ORIGIN, INTENSITY_CD)],
        ..SceneParts::default()
    }
}

/// Direct and indirect light of the sphere, lx.
fn sphere_lx() -> [f64; 2] {
    let direct = INTENSITY_CD / (RADIUS_M * RADIUS_M);
    let area_m2 = 4.0 * PI * RADIUS_M * RADIUS_M;
    let flux_lm = 4.0 * PI * INTENSITY_CD;
    [direct, REFLECTANCE * flux_lm / area_m2 / (1.0 - REFLECTANCE)]
}

fn sphere_expectations() -> Vec<Expectation> {
    let mesh = sphere(RADIUS_M, ROWS);
    (0..8).filter_map(|k| sphere_place(&mesh, k)).flat_map(|at| on_sphere(at, &mesh)).collect()
}

/// The k-th of eight places on a spiral from pole to pole.
fn sphere_place(mesh: &SphereMesh, k: u32) -> Option<ProbePoint> {
    let z = (f64::from(k) + 0.5) / 4.0 - 1.0;
    let (sin, cos) = libm::sincos(2.4 * f64::from(k));
    let r = (1.0 - z * z).sqrt();
    let outward = Vector::new(r * cos, r * sin, z).direction()?;
    Some(ProbePoint { position: mesh.place_towards(outward)?, normal: (-outward).to_normal() })
}

fn on_sphere(at: ProbePoint, mesh: &SphereMesh) -> [Expectation; 3] {
    let [direct, indirect] = sphere_lx();
    // A place of the mesh is farther away by the thickness at most, and its normal, between those
    // of corners, tilted by no more than distances differ over an edge.
    let farther = 2.0 * mesh.thickness_m() / RADIUS_M;
    let tilt = mesh.thickness_m() / mesh.longest_edge_m();
    let direct_bound = (farther + tilt * tilt) * direct;
    let indirect_bound = mesh.area_excess(1.0) / (1.0 - REFLECTANCE) * indirect;
    let reason = "triangles around the sphere: how far they are from it, and their area";
    Quantity::split(Rgb::grey(direct), Rgb::grey(indirect)).map(|(quantity, expected_lx)| {
        let lx = match quantity {
            Quantity::Direct => direct_bound,
            Quantity::Indirect => indirect_bound,
            Quantity::Total => direct_bound + indirect_bound,
        };
        Expectation { at, quantity, expected_lx, bound: Bound { lx, reason } }
    })
}

/// From the middle of the floor to a corner, and along an edge.
fn cube_expectations() -> Vec<Expectation> {
    let reference = CubeReference::with_reflectance(REFLECTANCE);
    let size = cube::HALF_EDGE_M / HALF_EDGE_M;
    let scale = INTENSITY_CD / cube::INTENSITY_CD * size * size;
    [(0.0, 0.0), (0.3, 0.1), (0.5, 0.5), (0.75, 0.0), (0.9, 0.6), (1.0, 0.0), (1.0, 0.5)]
        .into_iter()
        .flat_map(|(x, y)| {
            let position = Point::new(HALF_EDGE_M * x, HALF_EDGE_M * y, -HALF_EDGE_M);
            let lx = reference.at(x, y);
            let at = ProbePoint { position, normal: Normal::Z };
            split(at, scale * lx.direct_lx, scale * lx.indirect_lx)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{CUBE_REFERENCE, ROUNDING};

    #[test]
    fn the_sphere_absorbs_what_the_luminaire_sends() {
        let [direct, indirect] = sphere_lx();
        let absorbed = (1.0 - REFLECTANCE) * (direct + indirect) * 4.0 * PI * RADIUS_M * RADIUS_M;
        let sent = 4.0 * PI * INTENSITY_CD;
        assert!((absorbed / sent - 1.0).abs() < ROUNDING, "{absorbed} {sent}");
    }

    /// The mean of indirect light over a cube is close to the sphere's formula, its middle and its edges are not.
    #[test]
    fn the_cube_differs_from_the_formula_of_the_sphere_place_by_place() {
        let all = cube_expectations();
        let middle_direct = INTENSITY_CD / (HALF_EDGE_M * HALF_EDGE_M);
        let off = all[0].expected_lx.luminance() / middle_direct - 1.0;
        assert!(off.abs() < CUBE_REFERENCE, "{off}");
        let formula = REFLECTANCE * 4.0 * PI * INTENSITY_CD
            / (6.0 * 4.0 * HALF_EDGE_M * HALF_EDGE_M)
            / (1.0 - REFLECTANCE);
        let indirect = all.iter().filter(|e| e.quantity == Quantity::Indirect);
        let ratios: Vec<f64> = indirect.map(|e| e.expected_lx.luminance() / formula).collect();
        let (low, high) = ratios.iter().fold((9.0_f64, 0.0_f64), |(l, h), &r| (l.min(r), h.max(r)));
        assert!(low < 0.99 && high > 1.01, "{ratios:?}");
    }
}
