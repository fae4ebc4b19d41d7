//! Furnaces: enclosures in which every surface has the same luminance.
//!
//! If every surface emits `M = pi L` and reflects a share rho, the radiosity `B = M / (1 - rho)` solves the
//! equation whatever the shape, since the form factors of every place sum to one: `E = B`
//! everywhere, direct `M`, indirect `rho M / (1 - rho)`. A mirror that reflects all, and glass that
//! absorbs nothing, change nothing: they show the same luminance from elsewhere (inside solid glass it is
//! larger by the square of the index, which the way out undoes; Drude 1900). Geometry is exact.

use crate::expectation::{Bound, Case, Expectation, Quantity};
use crate::model::{Rectangle, inward_box, outward_box};
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::scene::{Body, Dielectric, Finish, Material, SceneParts};
use isolux::units::Rgb;
use std::f64::consts::PI;

const LUMINANCE_CD_M2: f64 = 100.0;
/// Red, green, blue: three furnaces at once.
const REFLECTANCE: Rgb = Rgb::new(0.8, 0.5, 0.2);
const HIGH: [f64; 3] = [4.0, 3.0, 2.5];

pub(super) fn cases() -> [Case; 3] {
    [
        Case {
            name: "furnace",
            notes: "an empty box whose surfaces all emit and reflect alike",
            parts: empty,
            expectations: || expectations(&[]),
        },
        Case {
            name: "furnace_mirror",
            notes: "the furnace with a block and an ideal mirror",
            parts: with_mirror,
            expectations: || expectations(&ON_BLOCK),
        },
        Case {
            name: "furnace_glass",
            notes: "the furnace with a pane and a block of clear glass",
            parts: with_glass,
            expectations: || expectations(&[]),
        },
    ]
}

fn empty() -> SceneParts {
    let glowing =
        Finish { luminance_cd_m2: Rgb::grey(LUMINANCE_CD_M2), ..Finish::diffuse(REFLECTANCE) };
    SceneParts {
        name: "furnace".into(),
        shapes: vec![inward_box("walls", [0.0; 3], HIGH, 0)],
        materials: vec![Material::one_sided("glowing", glowing)],
        ..SceneParts::default()
    }
}

fn with_mirror() -> SceneParts {
    let mut parts = empty();
    parts.name = "furnace_mirror".into();
    parts.materials.push(Material::two_sided("mirror", Finish::mirror(Rgb::WHITE)));
    let mirror = Rectangle::new([2.0, 0.4, 0.3], [0.0, 1.2, 0.0], [0.0, 0.0, 1.5]);
    parts.shapes.push(outward_box("block", [0.7, 0.8, 0.1], [1.5, 1.6, 1.0], 0));
    parts.shapes.push(mirror.shape("mirror", 1));
    parts
}

fn with_glass() -> SceneParts {
    let glass = |name: &str, thin| Material {
        name: name.into(),
        body: Body::Dielectric(Dielectric { ior: 1.5, transmittance: Rgb::WHITE, thin }),
    };
    let mut parts = empty();
    parts.name = "furnace_glass".into();
    parts.materials.extend([glass("pane", true), glass("glass", false)]);
    let pane = Rectangle::new([2.6, 0.5, 0.4], [0.0, 2.0, 0.0], [0.3, 0.0, 1.5]);
    parts.shapes.push(pane.shape("pane", 1));
    parts.shapes.push(outward_box("glass", [3.2, 1.0, 0.5], [3.6, 1.8, 1.2], 2));
    parts
}

/// Place and normal.
type Place = ([f64; 3], [f64; 3]);

const WALLS: [Place; 7] = [
    ([2.0, 1.5, 0.0], [0.0, 0.0, 1.0]),
    ([0.3, 0.2, 0.0], [0.0, 0.0, 1.0]),
    ([1.1, 2.6, 2.5], [0.0, 0.0, -1.0]),
    ([0.0, 1.0, 1.2], [1.0, 0.0, 0.0]),
    ([4.0, 2.2, 0.4], [-1.0, 0.0, 0.0]),
    ([3.1, 0.0, 2.3], [0.0, 1.0, 0.0]),
    ([2.4, 3.0, 1.1], [0.0, -1.0, 0.0]),
];

const ON_BLOCK: [Place; 3] = [
    ([1.1, 1.2, 1.0], [0.0, 0.0, 1.0]),
    // Ten centimetres above the floor.
    ([1.1, 1.2, 0.1], [0.0, 0.0, -1.0]),
    ([1.5, 1.1, 0.5], [1.0, 0.0, 0.0]),
];

fn expectations(more: &[Place]) -> Vec<Expectation> {
    let exitance = Rgb::grey(PI * LUMINANCE_CD_M2);
    let indirect = exitance * REFLECTANCE.map(|rho| rho / (1.0 - rho));
    WALLS
        .iter()
        .chain(more)
        .filter_map(|&(position, normal)| {
            let normal = Vector::from(normal).normal()?;
            Some(ProbePoint { position: Point::from(position), normal })
        })
        .flat_map(|at| {
            Quantity::split(exitance, indirect).map(|(quantity, expected_lx)| Expectation {
                at,
                quantity,
                expected_lx,
                bound: Bound::EXACT_GEOMETRY,
            })
        })
        .collect()
}
