//! The parts of the engines, each against what can be computed by hand.

mod aiming;
mod all_round;
mod ambient;
mod anderson;
mod arrivals;
mod audit;
mod backdrop;
mod balance;
mod bare;
mod bright;
mod carrying;
mod coat;
mod cuts;
mod daylight;
mod deposits;
mod details;
mod direct_light;
mod emission;
mod energy;
mod errors;
mod estimates;
mod faces;
mod finer;
mod fit;
mod fixed_point;
mod foreseeing;
mod glass;
mod gloss;
mod held;
mod judging;
mod kept;
mod landing;
mod luminous;
pub(super) mod many;
mod middles;
mod mirrors;
mod mixing;
mod moved;
mod net;
mod openings;
mod parts;
mod paths;
mod reflectance;
mod run_parts;
mod sealed;
mod sensitivity;
mod sharing;
mod sight;
mod sums;
mod sunk;
mod ties;
mod trusting;

use crate::engine::mesh::Fit;
use crate::engine::pilot::PilotRequest;
use crate::engine::ray::{Dice, NEVER, SurfacePoint};
use crate::photometry::IntensityDistribution;
use crate::sampling::{Key, Sequence};
use crate::scene::{Finish, Luminaire, LuminaireKind, Material, Scene, SceneParts, Shape};
use crate::units::Rgb;
use isolux_geometry::{Point, Transform, Vector};

/// The rectangle `corner + s u + t v` as two triangles; the front is where `u x v` points.
pub(super) fn rectangle(corner: [f64; 3], u: [f64; 3], v: [f64; 3], material: u32) -> Shape {
    let at = |s: f64, t: f64| [0, 1, 2].map(|k| corner[k] + s * u[k] + t * v[k]);
    Shape {
        name: "rectangle".into(),
        positions: vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Shape::default()
    }
}

/// The faces of an axis-parallel box from the origin, fronts inside: floor first, ceiling last.
pub(super) fn inward_box([x, y, z]: [f64; 3], material: u32) -> Vec<Shape> {
    let (u, v, w) = ([x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]);
    vec![
        rectangle([0.0; 3], u, v, material),
        rectangle([0.0; 3], v, w, material),
        rectangle([x, 0.0, 0.0], w, v, material),
        rectangle([0.0; 3], w, u, material),
        rectangle([0.0, y, 0.0], u, w, material),
        rectangle([0.0, 0.0, z], v, u, material),
    ]
}

pub(super) fn painted(reflectance: Rgb) -> Material {
    Material::one_sided("painted", Finish::diffuse(reflectance))
}

pub(super) fn glowing(luminance_cd_m2: f64) -> Material {
    let finish = Finish { luminance_cd_m2: Rgb::grey(luminance_cd_m2), ..Finish::BLACK };
    Material::one_sided("glowing", finish)
}

fn luminaire(kind: LuminaireKind) -> Luminaire {
    Luminaire { name: "lamp".into(), group: 0, colour: Rgb::WHITE, kind }
}

/// A luminaire that stands upright.
pub(super) fn point(position: [f64; 3], intensity: IntensityDistribution) -> Luminaire {
    let (position, world_from_luminaire) = (Point::from(position), Transform::IDENTITY);
    luminaire(LuminaireKind::Point { position, world_from_luminaire, intensity, area: None })
}

pub(super) fn isotropic(position: [f64; 3], intensity_cd: f64) -> Luminaire {
    point(position, IntensityDistribution::Isotropic { intensity_cd })
}

pub(super) fn scene(
    shapes: Vec<Shape>,
    materials: Vec<Material>,
    luminaires: Vec<Luminaire>,
) -> Scene {
    let parts = SceneParts { shapes, materials, luminaires, ..SceneParts::default() };
    Scene::assemble(parts).unwrap()
}

/// What a pilot is asked for a map of 2 %.
fn usual_request() -> PilotRequest {
    PilotRequest {
        target: 0.02,
        goal: 0.02,
        mesh_target: 0.05,
        seed: 1,
        is_fitted: true,
        is_hybrid: true,
        refines_caustics: true,
        max_vertices: 1 << 20,
        most_for_indirect_light: None,
        least_edge_m: None,
        deadline: NEVER.clone(),
        end: NEVER.clone(),
    }
}

/// The front of the first triangle that a place lies on.
fn front_at(scene: &Scene, at: Point) -> SurfacePoint {
    let weights = |t: u32| {
        let [u, v] = scene.triangle(t).barycentric(at);
        let lies_on = (scene.triangle(t).point(u, v) - at).length() < 1e-6;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && lies_on).then_some((t, [u, v]))
    };
    let (triangle, [u, v]) = (0..scene.triangle_count()).find_map(weights).expect("a surface");
    SurfacePoint::new(scene, triangle, false, u, v)
}

fn dice(seed: u64) -> Dice {
    Dice::new(Sequence::new(Key::new(seed)), 0)
}

fn direction(v: [f64; 3]) -> isolux_geometry::Direction {
    Vector::from(v).direction().unwrap()
}

/// Mean of independent numbers and the standard error of it.
fn mean_and_error(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let values: Vec<f64> = values.collect();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
    (mean, (squares / (n * (n - 1.0))).sqrt())
}

/// Standard errors that a mean of thousands of numbers is off once in two million trials.
const SIGMAS: f64 = 5.0;

/// Roundings of coordinates, directions and distances to `f32` on the way of a ray, where it enters
/// a value at all: a few parts in ten million.
const RAY_ROUNDING: f64 = 1e-6;
