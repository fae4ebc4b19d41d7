//! 1024 luminaires in the open over a floor that nothing else sees.
//!
//! A plane does not light itself, so the floor may be grey: the answer is the sum of `I cos / r^2` over
//! all luminaires. They differ in height, intensity and colour. Geometry is exact.

use crate::expectation::{Bound, Case, Expectation, Quantity};
use crate::model::{Rectangle, isotropic};
use isolux::engine::ProbePoint;
use isolux::geometry::{Normal, Point};
use isolux::scene::{Finish, Luminaire, Material, SceneParts};
use isolux::units::Rgb;

/// Luminaires along each side.
const SIDE: u32 = 32;
const SPACING_M: f64 = 1.25;
const HALF_FLOOR_M: f64 = 20.0;

pub(super) fn case() -> Case {
    Case {
        name: "luminaires_1024",
        notes: "1024 coloured luminaires over a grey floor in the open",
        parts,
        expectations,
    }
}

/// Position, intensity and colour of luminaire `k`.
fn luminaire(k: u32) -> (Point, f64, Rgb) {
    let (i, j) = (k % SIDE, k / SIDE);
    let along = |n: u32| SPACING_M * (f64::from(n) + 0.5) - HALF_FLOOR_M;
    let height_m = 2.0 + f64::from((7 * i + 3 * j) % 5) / 4.0;
    let intensity_cd = 10.0 + f64::from((5 * i + 11 * j) % 13);
    let colours = [Rgb::WHITE, Rgb::new(1.5, 0.9, 0.5), Rgb::new(0.6, 1.05, 1.4)];
    let colour = colours[((i + j) % 3) as usize].chromaticity();
    (Point::new(along(i), along(j), height_m), intensity_cd, colour)
}

fn parts() -> SceneParts {
    let side_m = 2.0 * HALF_FLOOR_M;
    let floor =
        Rectangle::new([-HALF_FLOOR_M, -HALF_FLOOR_M, 0.0], [side_m, 0.0, 0.0], [0.0, side_m, 0.0]);
    let luminaires = (0..SIDE * SIDE).map(|k| {
        let (position, intensity_cd, colour) = luminaire(k);
        Luminaire { colour, ..isotropic(&format!("luminaire {k}"), position, intensity_cd) }
    });
    SceneParts {
        name: "luminaires_1024".into(),
        shapes: vec![floor.shape("floor", 0)],
        materials: vec![Material::one_sided("grey", Finish::diffuse(Rgb::grey(0.5)))],
        luminaires: luminaires.collect(),
        ..SceneParts::default()
    }
}

fn expectations() -> Vec<Expectation> {
    (0..16)
        .map(|k| (f64::from(k % 4), f64::from(k / 4)))
        .map(|(i, j)| Point::new(11.3 * i - 18.0, 10.7 * j - 17.0, 0.0))
        .flat_map(|position| {
            let direct_lx = (0..SIDE * SIDE).map(luminaire).map(|(source, cd, colour)| {
                let d = source - position;
                colour * (cd * d.z / (d.length_squared() * d.length()))
            });
            let at = ProbePoint { position, normal: Normal::Z };
            let bound = Bound::EXACT_GEOMETRY;
            Quantity::split(direct_lx.sum(), Rgb::BLACK)
                .map(|(quantity, expected_lx)| Expectation { at, quantity, expected_lx, bound })
        })
        .collect()
}
