//! CUBE: the inside of a cube of 10 m, reflectance 2/3, an isotropic luminaire of 50,000 cd in the
//! middle (Kopylov, Khodulev, Volevich 1998, 2.1).
//!
//! Direct light is `2000 (1 + x^2 + y^2)^(-3/2)` lx in coordinates of a face (edges at +-1). The whole
//! has no closed form; [`reference`] solves the integral equation. Table 1 of the paper is right but
//! for the last digit of point C, which is 686.7, not 686.6.
//!
//! The geometry is exact, so the cases have no discretization bound of their own.

mod krylov;
mod line;
pub mod reference;
mod room;
mod transport;

pub use room::{COLOURED_REFLECTANCE, HALF_EDGE_M, INTENSITY_CD, REFLECTANCE, TABLE_1, TablePoint};

use crate::expectation::{Bound, Case, Expectation, Quantity};
use crate::model::{inward_box, isotropic};
use isolux::engine::ProbePoint;
use isolux::geometry::{Normal, Point};
use isolux::scene::{Finish, Material, SceneParts};
use isolux::units::Rgb;
use reference::{CubeIlluminance, CubeReference, cube_reference};

/// CUBE as published.
pub fn parts() -> SceneParts {
    walls_of("cube", Rgb::grey(REFLECTANCE))
}

/// CUBE with a reflectance of its own in every channel.
pub fn coloured_parts() -> SceneParts {
    walls_of("coloured_cube", COLOURED_REFLECTANCE)
}

fn walls_of(name: &str, reflectance: Rgb) -> SceneParts {
    let (low, high) = ([-HALF_EDGE_M; 3], [HALF_EDGE_M; 3]);
    SceneParts {
        name: name.into(),
        shapes: vec![inward_box("walls", low, high, 0)],
        materials: vec![Material::one_sided("white", Finish::diffuse(reflectance))],
        luminaires: vec![isotropic("centre", Point::ORIGIN, INTENSITY_CD)],
        ..SceneParts::default()
    }
}

/// A place of the floor by its face coordinates.
pub fn floor_point(x: f64, y: f64) -> ProbePoint {
    let position = Point::new(HALF_EDGE_M * x, HALF_EDGE_M * y, -HALF_EDGE_M);
    ProbePoint { position, normal: Normal::Z }
}

pub(super) fn cases() -> [Case; 2] {
    [
        Case {
            name: "cube",
            notes: "GraphiCon'98 CUBE: diffuse interreflection, points of Table 1 and a grid",
            parts,
            expectations: || expectations(|x, y| illuminance(&[cube_reference()], x, y)),
        },
        Case {
            name: "coloured_cube",
            notes: "CUBE with reflectance 0.8, 2/3, 0.3 in red, green, blue",
            parts: coloured_parts,
            expectations: || {
                let channels = COLOURED_REFLECTANCE.0.map(CubeReference::with_reflectance);
                expectations(|x, y| illuminance(&channels.each_ref(), x, y))
            },
        },
    ]
}

/// Direct and indirect illuminance from the reference of each channel (or of all at once).
fn illuminance(channels: &[&CubeReference], x: f64, y: f64) -> [Rgb; 2] {
    let values: Vec<CubeIlluminance> = channels.iter().map(|c| c.at(x, y)).collect();
    let of = |k: usize| values[k.min(values.len() - 1)];
    let channel = |f: fn(CubeIlluminance) -> f64| Rgb([f(of(0)), f(of(1)), f(of(2))]);
    [channel(|e| e.direct_lx), channel(|e| e.indirect_lx)]
}

fn expectations(at: impl Fn(f64, f64) -> [Rgb; 2]) -> Vec<Expectation> {
    let grid = (0..4).flat_map(|i| (0..4).map(move |j| (f64::from(i), f64::from(j))));
    let grid = grid.map(|(i, j)| ((2.0 * i - 3.0) / 4.0, (2.0 * j - 3.0) / 4.0));
    TABLE_1
        .iter()
        .map(|p| (p.x, p.y))
        .chain(grid)
        .flat_map(|(x, y)| {
            let [direct, indirect] = at(x, y);
            [
                (Quantity::Direct, direct),
                (Quantity::Indirect, indirect),
                (Quantity::Total, direct + indirect),
            ]
            .map(|(quantity, expected_lx)| Expectation {
                at: floor_point(x, y),
                quantity,
                expected_lx,
                bound: Bound::EXACT_GEOMETRY,
            })
        })
        .collect()
}
