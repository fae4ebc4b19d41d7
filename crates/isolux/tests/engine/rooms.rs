//! Small scenes, part by part.

use isolux::geometry::{Point, Transform};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{
    Body, Dielectric, Finish, Luminaire, LuminaireKind, Material, Scene, SceneParts, Shape,
};
use isolux::units::Rgb;

/// The rectangle `corner + s u + t v` as two triangles; the front is where `u x v` points.
pub(crate) fn rectangle(corner: [f64; 3], u: [f64; 3], v: [f64; 3], material: u32) -> Shape {
    let at = |s: f64, t: f64| [0, 1, 2].map(|k| corner[k] + s * u[k] + t * v[k]);
    Shape {
        name: "rectangle".into(),
        positions: vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Shape::default()
    }
}

/// The faces of an axis-parallel box, fronts outside, two an axis from low to high; they share no
/// vertices.
pub(crate) fn outward_box(low: [f64; 3], high: [f64; 3], material: u32) -> Vec<Shape> {
    let edge = |axis: usize| {
        let mut e = [0.0; 3];
        e[axis] = high[axis] - low[axis];
        e
    };
    let faces = |axis: usize| {
        let (u, v) = (edge((axis + 1) % 3), edge((axis + 2) % 3));
        let mut far = low;
        far[axis] = high[axis];
        [rectangle(low, v, u, material), rectangle(far, u, v, material)]
    };
    (0..3).flat_map(faces).collect()
}

/// The same with fronts inside.
pub(crate) fn inward_box(low: [f64; 3], high: [f64; 3], material: u32) -> Vec<Shape> {
    let mut faces = outward_box(low, high, material);
    faces.iter_mut().flat_map(|f| &mut f.triangles).for_each(|t| t.swap(1, 2));
    faces
}

/// A luminaire that shines alike in all directions.
pub(crate) fn lamp(position: [f64; 3], intensity_cd: f64) -> Luminaire {
    Luminaire {
        name: "lamp".into(),
        group: 0,
        colour: Rgb::WHITE,
        kind: LuminaireKind::Point {
            position: Point::from(position),
            world_from_luminaire: Transform::IDENTITY,
            intensity: IntensityDistribution::Isotropic { intensity_cd },
            area: None,
        },
    }
}

/// Diffuse in front, black behind.
pub(crate) fn painted(reflectance: f64) -> Material {
    Material::one_sided("painted", Finish::diffuse(Rgb::grey(reflectance)))
}

/// A mirror in front, black behind.
pub(crate) fn mirror(reflectance: f64) -> Material {
    Material::one_sided("mirror", Finish::mirror(Rgb::grey(reflectance)))
}

/// Diffuse and emitting in front, black behind.
pub(crate) fn glowing(luminance_cd_m2: f64, reflectance: f64) -> Material {
    let luminance_cd_m2 = Rgb::grey(luminance_cd_m2);
    Material::one_sided(
        "glowing",
        Finish { luminance_cd_m2, ..Finish::diffuse(Rgb::grey(reflectance)) },
    )
}

/// Glass that absorbs nothing.
pub(crate) fn clear_glass(ior: f64, thin: bool) -> Material {
    let glass = Dielectric { ior, transmittance: Rgb::WHITE, thin };
    Material { name: "glass".into(), body: Body::Dielectric(glass) }
}

/// A scene of shapes, materials and luminaires.
pub(crate) fn scene(
    shapes: Vec<Shape>,
    materials: Vec<Material>,
    luminaires: Vec<Luminaire>,
) -> Scene {
    let parts =
        SceneParts { name: "test".into(), shapes, materials, luminaires, ..SceneParts::default() };
    Scene::assemble(parts).expect("scenes of tests are valid")
}

/// A closed room of 3 x 2 x 2.5 m whose walls reflect one half, with a lamp.
pub(crate) fn room() -> Scene {
    let shapes = inward_box([0.0; 3], [3.0, 2.0, 2.5], 0);
    scene(shapes, vec![painted(0.5)], vec![lamp([1.0, 1.2, 1.5], 100.0)])
}
