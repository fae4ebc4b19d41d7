//! Directed luminaires over a black floor, and parallel light past a screen.
//!
//! `E = I(gamma) cos(theta) / r^2` for every luminaire, with `I = I_0 cos^n(gamma)` or the falloff that
//! KHR_lights_punctual recommends, the square of `clamp(cos(gamma) s + o)` with
//! `s = 1 / (cos inner - cos outer)`, `o = -s cos outer`. Parallel light gives `E_0 cos(theta)` or nothing.
//! Geometry is exact.

use crate::expectation::{Bound, Case, Expectation};
use crate::model::{Rectangle, aimed};
use crate::tolerance::PLACE_ON_RIM;
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Normal, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Finish, Luminaire, LuminaireKind, Material, SceneParts};
use isolux::units::Rgb;

/// Where a lamp is, where it aims, how it shines.
struct Lamp {
    position: [f64; 3],
    aim: [f64; 3],
    beam: Beam,
}

#[derive(Clone, Copy)]
enum Beam {
    Cosine { peak_cd: f64, exponent: f64 },
    Khronos { peak_cd: f64, inner_rad: f64, outer_rad: f64 },
}

const COSINE_LAMPS: [Lamp; 3] = [
    lamp([-2.0, 0.0, 3.0], [0.0, 0.0, -1.0], Beam::Cosine { peak_cd: 900.0, exponent: 1.0 }),
    lamp([1.5, 1.0, 2.5], [0.5, 0.3, -1.0], Beam::Cosine { peak_cd: 2500.0, exponent: 4.0 }),
    lamp([0.0, -2.0, 4.0], [-0.4, 0.6, -1.5], Beam::Cosine { peak_cd: 9000.0, exponent: 20.0 }),
];

const KHRONOS_LAMPS: [Lamp; 2] = [
    lamp(
        [0.0, 0.0, 3.0],
        [0.0, 0.0, -1.0],
        Beam::Khronos { peak_cd: 2000.0, inner_rad: 0.3, outer_rad: 0.7 },
    ),
    lamp(
        [-2.0, 1.0, 2.0],
        [1.0, -0.5, -1.0],
        Beam::Khronos { peak_cd: 3000.0, inner_rad: 0.0, outer_rad: 0.9 },
    ),
];

const SUN_LX: f64 = 80_000.0;
const SUN: [f64; 3] = [0.5, 0.2, -1.0];

const fn lamp(position: [f64; 3], aim: [f64; 3], beam: Beam) -> Lamp {
    Lamp { position, aim, beam }
}

pub(super) fn cases() -> [Case; 3] {
    [
        Case {
            name: "spots_cosine",
            notes: "three cos^n luminaires over a black floor",
            parts: || lamps_over_floor("spots_cosine", &COSINE_LAMPS),
            expectations: || lit_by(&COSINE_LAMPS),
        },
        Case {
            name: "spots_khr",
            notes: "two spot lights of KHR_lights_punctual over a black floor",
            parts: || lamps_over_floor("spots_khr", &KHRONOS_LAMPS),
            expectations: || lit_by(&KHRONOS_LAMPS),
        },
        Case {
            name: "directional",
            notes: "parallel light past a screen on a black floor and a black wall",
            parts: sun_parts,
            expectations: sun_expectations,
        },
    ]
}

fn floor() -> Rectangle {
    Rectangle::new([-5.0, -5.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0])
}

fn black() -> Material {
    Material::one_sided("black", Finish::BLACK)
}

fn towards(v: [f64; 3]) -> Direction {
    Vector::from(v).direction().unwrap_or(-Direction::Z)
}

fn lamps_over_floor(name: &str, lamps: &[Lamp]) -> SceneParts {
    let luminaire = |lamp: &Lamp| {
        let intensity = match lamp.beam {
            Beam::Cosine { peak_cd, exponent } => {
                IntensityDistribution::CosinePower { peak_cd, exponent }
            }
            Beam::Khronos { peak_cd, inner_rad, outer_rad } => {
                IntensityDistribution::Spot { peak_cd, inner_rad, outer_rad }
            }
        };
        aimed("lamp", lamp.position.into(), towards(lamp.aim), intensity)
    };
    SceneParts {
        name: name.into(),
        shapes: vec![floor().shape("floor", 0)],
        materials: vec![black()],
        luminaires: lamps.iter().map(luminaire).collect(),
        ..SceneParts::default()
    }
}

impl Beam {
    fn intensity_cd(self, cos_gamma: f64) -> f64 {
        match self {
            Self::Cosine { peak_cd, exponent } => peak_cd * cos_gamma.max(0.0).powf(exponent),
            Self::Khronos { peak_cd, inner_rad, outer_rad } => {
                let scale = 1.0 / (inner_rad.cos() - outer_rad.cos());
                let falloff = (cos_gamma * scale - outer_rad.cos() * scale).clamp(0.0, 1.0);
                peak_cd * falloff * falloff
            }
        }
    }
}

fn lit_by(lamps: &[Lamp]) -> Vec<Expectation> {
    let places = (0..36).map(|k| (f64::from(k / 6) - 2.5, f64::from(k % 6) - 2.5));
    places
        .flat_map(|(x, y)| {
            let position = Point::new(1.5 * x, 1.5 * y, 0.0);
            let lx = illuminance_lx(lamps, position);
            let at = ProbePoint { position, normal: Normal::Z };
            let bound = Bound {
                lx: change_lx(lamps, position, lx),
                reason: "on the rim of a triangle the place is moved, and beams are steep",
            };
            Expectation::direct_only(at, Rgb::grey(lx), bound)
        })
        .collect()
}

fn illuminance_lx(lamps: &[Lamp], position: Point) -> f64 {
    let from = |lamp: &Lamp| {
        let d = position - Point::from(lamp.position);
        let cos_gamma = d.dot(towards(lamp.aim).to_vector()) / d.length();
        let r2 = d.length_squared();
        lamp.beam.intensity_cd(cos_gamma) * -d.z / (r2 * r2.sqrt())
    };
    lamps.iter().map(from).sum()
}

/// The largest change when the place moves as far as a reader may move it.
fn change_lx(lamps: &[Lamp], position: Point, lx: f64) -> f64 {
    let step_m = PLACE_ON_RIM * position.x.abs().max(position.y.abs());
    let steps = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
    let change = |(x, y): (f64, f64)| {
        let moved = position + Vector::new(x, y, 0.0) * step_m;
        (illuminance_lx(lamps, moved) - lx).abs()
    };
    // Along both axes at once it may be twice that.
    2.0 * steps.into_iter().map(change).fold(0.0, f64::max)
}

fn screen() -> Rectangle {
    Rectangle::new([-1.0, -1.5, 1.0], [2.0, 0.0, 0.0], [0.0, 2.5, 0.0])
}

fn wall() -> Rectangle {
    Rectangle::new([5.0, -5.0, 0.0], [0.0, 0.0, 3.0], [0.0, 10.0, 0.0])
}

fn sun_parts() -> SceneParts {
    let kind = LuminaireKind::Directional {
        direction: towards(SUN),
        illuminance_lx: SUN_LX,
        half_angle_rad: 0.0,
    };
    SceneParts {
        name: "directional".into(),
        shapes: vec![
            floor().shape("floor", 0),
            wall().shape("wall", 0),
            screen().shape("screen", 1),
        ],
        materials: vec![black(), Material::two_sided("screen", Finish::BLACK)],
        luminaires: vec![Luminaire { name: "sun".into(), group: 0, colour: Rgb::WHITE, kind }],
        ..SceneParts::default()
    }
}

fn sun_expectations() -> Vec<Expectation> {
    let on_floor = (0..49).map(|k| {
        let (x, y) = (f64::from(k / 7) - 3.0, f64::from(k % 7) - 3.0);
        ProbePoint { position: Point::new(0.7 * x + 0.31, 0.7 * y, 0.0), normal: Normal::Z }
    });
    let facing = (-Direction::X).to_normal();
    let on_wall = [(-3.0, 0.5), (0.0, 1.5), (4.0, 2.5)]
        .map(|(y, z)| ProbePoint { position: Point::new(5.0, y, z), normal: facing });
    on_floor
        .chain(on_wall)
        .filter(|at| !screen().is_grazed(at.position, sunward(at.position), 0.02))
        .flat_map(|at| {
            let cos_theta = -towards(SUN).cos(at.normal);
            let hidden = screen().blocks(at.position, sunward(at.position));
            let lx = if hidden { 0.0 } else { SUN_LX * cos_theta };
            Expectation::direct_only(at, Rgb::grey(lx), Bound::EXACT_GEOMETRY)
        })
        .collect()
}

/// A place far enough towards the sun to be beyond everything.
fn sunward(from: Point) -> Point {
    from + towards(SUN) * -100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_screen_casts_a_shadow_and_leaves_light() {
        let found = sun_expectations();
        let dark = found.iter().filter(|e| e.expected_lx.is_black()).count();
        assert!(dark > 8 && dark < found.len() - 8, "{dark} of {}", found.len());
    }

    #[test]
    fn places_lie_inside_and_outside_the_cones() {
        let found = lit_by(&KHRONOS_LAMPS);
        assert!(found.iter().any(|e| e.expected_lx.is_black()));
        assert!(found.iter().any(|e| e.expected_lx.luminance() > 100.0));
    }
}
