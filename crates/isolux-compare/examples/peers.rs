//! A scene as built in, with points and the exact illuminance there, as JSON for the scripts of
//! `benchmarks/peers`: `cargo run --release -p isolux-compare --example peers -- cube`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example for the terminal")]

use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, SceneParts, Shape};
use isolux_compare::case::{cube, find, sphere};
use isolux_compare::{Case, Quantity, builtin, cube_grid, sphere_grid};
use serde_json::{Value, json};
use std::process::ExitCode;

fn main() -> ExitCode {
    let name = std::env::args().nth(1).unwrap_or_default();
    let (Some(parts), Some(points)) = (parts(&name), point_sets(&name)) else {
        eprintln!(
            "there are no points for a scene `{name}`; choose cube, sphere, hall or a case of `isolux validate`"
        );
        return ExitCode::from(2);
    };
    println!("{}", scene(&parts, &points));
    ExitCode::SUCCESS
}

/// A scene as built in, else that of a case.
fn parts(name: &str) -> Option<SceneParts> {
    builtin(name).ok().or_else(|| find(name).map(|case| (case.parts)()))
}

/// Points at which a scene is judged.
struct PointSet {
    name: &'static str,
    points: Vec<ExactPoint>,
    /// What the expected values are off by themselves, in the measure of errors.
    own_error: f64,
    /// Whether they hold the light that glass and gloss throw on surfaces.
    has_caustics: bool,
}

impl PointSet {
    fn exact(name: &'static str, points: Vec<ExactPoint>) -> Self {
        Self { name, points, own_error: 0.0, has_caustics: true }
    }
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
fn point_sets(scene: &str) -> Option<Vec<PointSet>> {
    let (map, paper): (Vec<ExactPoint>, Vec<ExactPoint>) = match scene {
        "hall" => return Some(vec![hall_map()]),
        "cube" => (cube_map(), cube_table()),
        "sphere" => {
            let at = sphere::centre();
            let centre = ExactPoint::of((at, sphere::total_lx(&at)));
            (sphere_grid().into_iter().map(ExactPoint::of).collect(), vec![centre])
        }
        name => return find(name).map(|case| vec![case_map(&case)]),
    };
    Some(vec![PointSet::exact("map", map), PointSet::exact("paper", paper)])
}

/// The places of the reference that were chosen by area. Relative errors would make the darkest corner count as
/// much as a desk: weights turn them into errors relative to the root mean square of the light.
fn hall_map() -> PointSet {
    /// Gaps of a millimetre between solids, where one side is meant and the other hit.
    const LEAST_LX: f64 = 0.3;
    let text = include_str!("../../../benchmarks/hall/reference.csv");
    let (mut points, mut squared, mut own) = (Vec::new(), 0.0, 0.0);
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |k: usize| fields[k].parse::<f64>().expect("the reference holds numbers");
        let (expected_lx, own_lx) = (number(6), number(9));
        if fields[10] != "area" || expected_lx < LEAST_LX {
            continue;
        }
        let normal = Vector::new(number(3), number(4), number(5)).normal();
        let at = ProbePoint {
            position: [0, 1, 2].map(number).into(),
            normal: normal.expect("normals have a direction"),
        };
        points.push(ExactPoint { at, expected_lx, weight: expected_lx * expected_lx });
        squared += expected_lx * expected_lx;
        own += own_lx * own_lx;
    }
    let own_error = (own / squared).sqrt();
    PointSet { name: "map", points, own_error, has_caustics: false }
}

/// All places of a case whose whole light is known and not nothing: an error relative to nothing is none. What
/// the scene as tessellated is off by is taken as the values' own error.
fn case_map(case: &Case) -> PointSet {
    let expectations = (case.expectations)();
    let lit: Vec<_> = expectations
        .iter()
        .filter(|e| e.quantity == Quantity::Total && !e.expected_lx.is_black())
        .collect();
    let own = |e: &&isolux_compare::Expectation| (e.bound.lx / e.expected_lx.luminance()).powi(2);
    let own_error = (lit.iter().map(own).sum::<f64>() / lit.len() as f64).sqrt();
    let points = lit.iter().map(|e| ExactPoint::of((e.at, e.expected_lx.luminance()))).collect();
    PointSet { own_error, ..PointSet::exact("map", points) }
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
    let mut distributions: Vec<&IntensityDistribution> = Vec::new();
    let luminaires: Vec<Value> =
        parts.luminaires.iter().map(|lamp| luminaire(lamp, &mut distributions)).collect();
    let (suns, lamps): (Vec<Value>, Vec<Value>) =
        luminaires.into_iter().partition(|lamp| lamp.get("direction").is_some());
    json!({
        "name": parts.name,
        "shapes": parts.shapes.iter().map(|s| shape(s, &parts.name)).collect::<Vec<_>>(),
        "materials": parts.materials,
        "luminaires": lamps,
        "suns": suns,
        "distributions": distributions,
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

/// Where a luminaire is and how it stands, and the number of its distribution; or where parallel light goes.
fn luminaire<'a>(lamp: &'a Luminaire, known: &mut Vec<&'a IntensityDistribution>) -> Value {
    match &lamp.kind {
        LuminaireKind::Directional { direction, illuminance_lx } => json!({
            "name": lamp.name,
            "direction": direction,
            "illuminance_lx": illuminance_lx,
        }),
        LuminaireKind::Point { position, world_from_luminaire, intensity } => {
            let number = known.iter().position(|d| *d == intensity).unwrap_or_else(|| {
                known.push(intensity);
                known.len() - 1
            });
            json!({
                "name": lamp.name,
                "position": position,
                "axes": world_from_luminaire.columns,
                "colour": lamp.colour,
                "distribution": number,
            })
        }
    }
}

fn point_set(set: &PointSet) -> Value {
    let of = |f: fn(&ExactPoint) -> Value| set.points.iter().map(f).collect::<Vec<_>>();
    json!({
        "name": set.name,
        "own_error": set.own_error,
        "has_caustics": set.has_caustics,
        "positions": of(|p| json!(<[f64; 3]>::from(p.at.position))),
        "normals": of(|p| json!(<[f64; 3]>::from(p.at.normal.to_vector()))),
        "expected_lx": of(|p| json!(p.expected_lx)),
        "weights": of(|p| json!(p.weight)),
    })
}
