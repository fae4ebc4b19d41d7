//! A scene with one of everything, and a map of it with made-up values.

use isolux::elements::{ElementArrays, Elements};
use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::map::{Accuracy, Fresh, IlluminationMap, Method, Provenance, Standing, VertexLight};
use isolux::photometry::{IntensityDistribution, PhotometricWeb};
use isolux::scene::{
    Body, CalculationGrid, Camera, Dielectric, Finish, Fitting, Gloss, Luminaire, LuminaireKind,
    Material, Reflectance, Scene, SceneParts, Shape, Texture, UpAxis,
};
use isolux::units::Rgb;
use std::sync::Arc;

const NONE: u32 = u32::MAX;

pub(crate) fn scene() -> Scene {
    Scene::assemble(parts()).unwrap()
}

pub(crate) fn parts() -> SceneParts {
    SceneParts {
        name: "one of everything".into(),
        up: UpAxis::Z,
        shapes: shapes(),
        materials: materials(),
        textures: vec![Texture {
            width: 3,
            height: 2,
            srgb: (0..18).map(|k| 13 * k + 5).collect(),
        }],
        luminaires: luminaires(),
        fittings: fittings(),
        maintenance: Some(isolux::scene::Maintenance { least: 0.7, greatest: 0.9 }),
        groups: vec!["general".into(), "task".into()],
        cameras: vec![Camera {
            name: "from the corner".into(),
            position: Point::new(0.1, 0.2, 1.7),
            direction: Vector::new(1.0, 2.0, -0.3).direction().unwrap(),
            up: Direction::Z,
            vertical_fov_rad: 1.1,
        }],
        grids: vec![CalculationGrid {
            name: "desk".into(),
            corner: Point::new(0.5, 0.5, 0.75),
            u: Vector::new(1.0, 0.0, 0.0),
            v: Vector::new(0.0, 0.7, 0.0),
            spacing_m: Some(0.1),
            border_m: 0.05,
            maintenance_factor: 0.8,
            requirements: vec![isolux_formats::requirement("Em >= 500").unwrap()],
            emergency: None,
        }],
    }
}

fn quad(name: &str, z: f64, material: u32) -> Shape {
    Shape {
        name: name.into(),
        positions: vec![[0.1, 0.0, z], [3.0, 0.0, z], [3.0, 2.0, z], [0.1, 2.0, z]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Shape::default()
    }
}

fn shapes() -> Vec<Shape> {
    let tilted = |x: f64, y: f64| [0.1 * x - 0.05, 0.3 * y, 1.0 + 1e-3 * x];
    let curtain = Shape {
        normals: Some(vec![tilted(0.0, 0.1), tilted(1.0, 0.2), tilted(1.3, 0.7), tilted(0.0, 1.0)]),
        uvs: Some(vec![[0.0, 0.0], [1.7, 0.1], [1.5, 1.0], [-0.3, 1.0]]),
        ..quad("curtain", 1.0, 1)
    };
    let mut with_sliver = quad("floor", 0.0, 0);
    with_sliver.triangles.insert(1, [0, 1, 1]);
    let empty = Shape { name: "empty".into(), ..Shape::default() };
    vec![
        with_sliver,
        curtain,
        empty,
        quad("mirror", 2.0, 2),
        quad("window", 3.0, 3),
        quad("panel", 4.0, 4),
        quad("steel", 5.0, 5),
    ]
}

fn materials() -> Vec<Material> {
    let textured = Finish {
        diffuse: Reflectance { colour: Rgb::new(0.9, 0.8, 0.7), texture: Some(0) },
        ..Finish::BLACK
    };
    let emitting = Finish { luminance_cd_m2: Rgb::grey(3000.0), ..Finish::BLACK };
    let glossy = Finish {
        gloss: Some(Gloss { f0: Rgb::grey(0.6), alpha: 0.2 }),
        ..Finish::diffuse(Rgb::grey(0.1))
    };
    let glass = Dielectric { ior: 1.52, transmittance: Rgb::new(0.9, 0.95, 0.92), thin: true };
    vec![
        Material::one_sided("plaster", Finish::diffuse(Rgb::grey(2.0 / 3.0))),
        Material::two_sided("cloth", textured),
        Material::one_sided("mirror", Finish::mirror(Rgb::grey(0.9))),
        Material { name: "glass".into(), body: Body::Dielectric(glass) },
        Material::one_sided("panel", emitting),
        Material::two_sided("steel", glossy),
    ]
}

/// Powers of some luminaires.
fn fittings() -> Vec<Fitting> {
    let power = |k: usize| k.is_multiple_of(2).then_some(10.5 * k as f64 + 1.0);
    (0..luminaires().len())
        .map(|k| Fitting { power_w: power(k), emergency_share: (k == 3).then_some(0.1) })
        .collect()
}

fn luminaires() -> Vec<Luminaire> {
    let web = PhotometricWeb::new(
        vec![0.0, 90.0, 180.0, 270.0],
        vec![0.0, 45.0, 90.0],
        (0..12).map(|k| 100.0 / f64::from(k + 1)).collect(),
    );
    let web = Arc::new(web.unwrap());
    let turned = Transform::rotation_about(Vector::new(1.0, 1.0, 0.0).direction().unwrap(), 0.4);
    let point = |k: u32, intensity: IntensityDistribution| Luminaire {
        name: format!("luminaire {k}"),
        group: k % 2,
        colour: Rgb::new(1.1, 1.0, 0.7),
        kind: LuminaireKind::Point {
            position: Point::new(f64::from(k), 1.0 / 3.0, 2.5),
            world_from_luminaire: turned,
            intensity,
            area: None,
        },
    };
    let sun = LuminaireKind::Directional {
        direction: Vector::new(0.3, 0.1, -0.9).direction().unwrap(),
        illuminance_lx: 80_000.0,
        half_angle_rad: 0.0,
    };
    vec![
        point(0, IntensityDistribution::Web(web.clone())),
        point(1, IntensityDistribution::Isotropic { intensity_cd: 100.0 }),
        point(2, IntensityDistribution::CosinePower { peak_cd: 70.0, exponent: 1.5 }),
        point(3, IntensityDistribution::Spot { peak_cd: 9.0, inner_rad: 0.2, outer_rad: 0.7 }),
        point(4, IntensityDistribution::Spot { peak_cd: 9.0, inner_rad: 0.2, outer_rad: 2.5 }),
        point(5, IntensityDistribution::Web(web)),
        Luminaire { name: "sun".into(), group: 0, colour: Rgb::WHITE, kind: sun },
    ]
}

/// A map of any scene: every side with diffuse or glossy reflection is one element, the first of
/// them four; values follow from the index of the vertex, the last vertex is unknown.
pub(crate) fn map(scene: &Scene) -> IlluminationMap {
    let elements = Elements::from_arrays(&elements(scene)).unwrap();
    let count = elements.vertices().len();
    let mut values: Vec<_> = (0..count).map(|k| Some(value(k as f64))).collect();
    values[count - 1] = None;
    values[count - 2].as_mut().unwrap().standard_error_lx = f64::INFINITY;
    IlluminationMap { elements, values, provenance: provenance() }
}

fn value(k: f64) -> VertexLight {
    VertexLight {
        direct_lx: Rgb::new(100.0 + k, 90.0 + k / 3.0, 70.0),
        caustic_lx: Rgb::grey(0.1 * k),
        indirect_lx: Rgb::new(5.0, 6.0, 7.0) * (1.0 + k / 7.0),
        standard_error_lx: 0.3 + 0.01 * k,
        indirect_standard_error_lx: 0.1,
        common_error_lx: 0.05 * k,
        interpolation_error_lx: 0.2 * k,
        standing: Standing::ALL[k as usize % 3],
        samples: 1 << (k as u32 % 40),
    }
}

fn provenance() -> Provenance {
    Provenance {
        scene: "one of everything".into(),
        scene_hash: "0123456789abcdef".into(),
        version: "0.1.0".into(),
        method: Method::Hybrid,
        seed: u64::MAX,
        increments: 24,
        rays: 1_000_000,
        accuracy_target: Some(0.01),
        fresh: Some(Fresh { above_lx: Some(0.7), in_gaps_alone: true, lookup_lx: 0.3 }),
        filter: None,
        unshot: None,
        diffuse_only: false,
        audit: None,
        mixed: Vec::new(),
        complete: true,
        accuracy: Some(Accuracy {
            reached: 0.009_3,
            statistical: 0.006,
            discretization: 0.005,
            caustics: 0.0005,
            bias: 0.005,
            interpolated: 0.04,
        }),
    }
}

fn elements(scene: &Scene) -> ElementArrays {
    let mut made = ElementArrays::default();
    for triangle in 0..scene.triangle_count() {
        let material = scene.material(triangle);
        let carries = |back| {
            let finish = material.finish(back)?;
            (!finish.diffuse.colour.is_black() || finish.gloss.is_some()).then_some(back)
        };
        let roots = [false, true].map(|back| match carries(back) {
            Some(back) => add_root(scene, triangle, back, &mut made),
            None => NONE,
        });
        made.roots.push(roots);
    }
    split_first(&mut made);
    made
}

fn add_root(scene: &Scene, triangle: u32, back: bool, made: &mut ElementArrays) -> u32 {
    let first = made.positions.len() as u32;
    let side = if back { -1.0 } else { 1.0 };
    for (k, corner) in scene.triangle(triangle).corners.into_iter().enumerate() {
        let flat = scene.geometric_normal(triangle);
        let normal = scene.corner_normals(triangle).map_or(flat, |normals| normals[k]);
        made.positions.push(corner.into());
        made.normals.push((normal * side).into());
        made.parents.push([NONE; 2]);
        made.areas_m2.push(scene.triangle(triangle).area() / 3.0);
    }
    made.nodes.push([first, first + 1, first + 2]);
    made.splits.push([NONE; 2]);
    made.nodes.len() as u32 - 1
}

/// Bisects the first element and its first child.
fn split_first(made: &mut ElementArrays) {
    for node in [0, made.nodes.len()] {
        let [a, b, c] = made.nodes[node];
        let middle = made.positions.len() as u32;
        let [p, q] = [a, b].map(|v| Point::from(made.positions[v as usize]));
        made.positions.push(p.lerp(q, 0.5).into());
        made.normals.push(made.normals[a as usize]);
        made.parents.push([a, b]);
        made.areas_m2.push(0.25);
        made.splits[node] = [0, made.nodes.len() as u32];
        for child in [[a, middle, c], [middle, b, c]] {
            made.nodes.push(child);
            made.splits.push([NONE; 2]);
        }
    }
}
