//! A scene as built in, with points and the exact illuminance there, as JSON for the scripts of
//! `benchmarks/peers`: `cargo run --release -p isolux-compare --example peers -- cube`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example for the terminal")]

use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::scene::{SceneParts, Shape};
use isolux_compare::case::{cube, sphere};
use isolux_compare::{builtin, cube_grid, sphere_grid};
use serde_json::{Value, json};
use std::process::ExitCode;

fn main() -> ExitCode {
    let name = std::env::args().nth(1).unwrap_or_default();
    let (Some(parts), Some(points)) = (builtin(&name).ok(), point_sets(&name)) else {
        eprintln!("there are no exact points for a scene `{name}`; choose cube or sphere");
        return ExitCode::from(2);
    };
    println!("{}", scene(&parts, &points));
    ExitCode::SUCCESS
}

/// Points at which a scene is judged.
struct PointSet {
    name: &'static str,
    points: Vec<ExactPoint>,
}

/// The exact illuminance at a place, and how much the place counts.
struct ExactPoint {
    at: ProbePoint,
    expected_lx: f64,
    weight: f64,
}

impl ExactPoint {
    fn of((at, expected_lx): (ProbePoint, f64)) -> Self {
        Self { at, expected_lx, weight: 1.0 }
    }
}

/// The map of the whole scene first, then the places of the paper.
fn point_sets(scene: &str) -> Option<[PointSet; 2]> {
    let (map, paper): (Vec<ExactPoint>, Vec<ExactPoint>) = match scene {
        "cube" => (cube_map(), cube_table()),
        "sphere" => {
            let at = sphere::centre();
            let centre = ExactPoint::of((at, sphere::total_lx(&at)));
            (sphere_grid().into_iter().map(ExactPoint::of).collect(), vec![centre])
        }
        _ => return None,
    };
    Some([PointSet { name: "map", points: map }, PointSet { name: "paper", points: paper }])
}

/// The grid of the floor on all six faces.
fn cube_map() -> Vec<ExactPoint> {
    let faces = (0..3).flat_map(|axis| [-1.0, 1.0].map(|side| (axis, side)));
    faces
        .flat_map(|(axis, side)| {
            cube_grid().iter().filter_map(move |&(floor, expected_lx)| {
                let at = on_face(floor.position, axis, side)?;
                Some(ExactPoint::of((at, expected_lx)))
            })
        })
        .collect()
}

/// A place of the floor moved to the same place of a face perpendicular to an axis.
fn on_face(floor: Point, axis: usize, side: f64) -> Option<ProbePoint> {
    let mut position = [0.0; 3];
    position[axis] = side * cube::HALF_EDGE_M;
    position[(axis + 1) % 3] = floor.x;
    position[(axis + 2) % 3] = floor.y;
    let mut inward = [0.0; 3];
    inward[axis] = -side;
    Some(ProbePoint { position: position.into(), normal: Vector::from(inward).normal()? })
}

/// Points A to F.
fn cube_table() -> Vec<ExactPoint> {
    let reference = cube::reference::cube_reference();
    cube::TABLE_1
        .iter()
        .map(|p| {
            let expected_lx = reference.at(p.x, p.y).total_lx();
            ExactPoint { at: cube::floor_point(p.x, p.y), expected_lx, weight: p.weight }
        })
        .collect()
}

fn scene(parts: &SceneParts, sets: &[PointSet]) -> Value {
    json!({
        "name": parts.name,
        "shapes": parts.shapes.iter().map(|s| shape(s, &parts.name)).collect::<Vec<_>>(),
        "materials": parts.materials,
        "luminaires": parts.luminaires,
        "point_sets": sets.iter().map(point_set).collect::<Vec<_>>(),
    })
}

fn shape(shape: &Shape, scene: &str) -> Value {
    // What the triangles stand for, for renderers that have spheres of their own.
    let sphere = (scene == "sphere" && shape.name == "sphere")
        .then(|| json!({ "centre": [0.0, 0.0, 0.0], "radius_m": 1.0 }));
    json!({
        "sphere": sphere,
        "name": shape.name,
        "positions": shape.positions,
        "triangles": shape.triangles,
        "material": shape.material,
    })
}

fn point_set(set: &PointSet) -> Value {
    let of = |f: fn(&ExactPoint) -> Value| set.points.iter().map(f).collect::<Vec<_>>();
    json!({
        "name": set.name,
        "positions": of(|p| json!(<[f64; 3]>::from(p.at.position))),
        "normals": of(|p| json!(<[f64; 3]>::from(p.at.normal.to_vector()))),
        "expected_lx": of(|p| json!(p.expected_lx)),
        "weights": of(|p| json!(p.weight)),
    })
}
