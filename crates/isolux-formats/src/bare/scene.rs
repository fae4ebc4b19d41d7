//! Parts without materials into a scene.

use crate::counted;
use crate::extent::{IMPLAUSIBLE_EXTENT_M, largest_side_m};
use crate::findings::Findings;
use isolux::scene::{Finish, Material, Reflectance, SceneParts, Shape, Texture, UpAxis};
use isolux::units::Rgb;
use std::collections::{HashMap, HashSet};

/// What a surface reflects of which nothing is known.
const UNKNOWN_REFLECTANCE: f64 = 0.5;
/// The material of parts without a name.
pub(crate) const UNNAMED: &str = "unnamed";

/// What is known of a file from elsewhere.
pub(crate) struct Reading<'a> {
    /// Whether its unit of length is known, so that its size surprises nobody.
    pub(crate) unit_is_known: bool,
    /// Whether a material is replaced by another: then nothing is said of it, and it comes out black.
    pub(crate) is_replaced: &'a dyn Fn(&str) -> bool,
    /// Whether colours of vertices are to be read as diffuse reflectance.
    pub(crate) vertex_colours: bool,
}

/// Nothing: the file is a scene by itself.
pub(crate) const ALONE: Reading<'static> =
    Reading { unit_is_known: false, is_replaced: &|_| false, vertex_colours: false };

/// A kind of file, by name.
pub(crate) struct Kind(pub(crate) &'static str);

/// The mesh of one part.
#[derive(Debug, Default)]
pub(crate) struct Part {
    pub(crate) name: String,
    /// The name by which a material is assigned to it.
    pub(crate) material: String,
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) normals: Option<Vec<[f64; 3]>>,
    pub(crate) uvs: Option<Vec<[f64; 2]>>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Its diffuse reflectance, where it says one.
    pub(crate) texture: Option<Texture>,
}

/// The scene of a file: z up, both sides of surfaces alike, of faces that lie on each other one.
pub(crate) fn scene(
    parts: Vec<Part>,
    kind: &Kind,
    reading: &Reading,
    findings: &mut Findings,
) -> SceneParts {
    let mut scene = SceneParts {
        name: findings.file().file_stem().map_or_else(String::new, |s| s.to_string_lossy().into()),
        up: UpAxis::Z,
        ..SceneParts::default()
    };
    let mut indices = HashMap::new();
    let (mut unknown, mut copies) = (0, 0);
    for mut part in parts {
        copies += drop_copies(&mut part.triangles);
        let is_replaced = (reading.is_replaced)(&part.material);
        unknown += usize::from(!is_replaced && part.texture.is_none());
        let material = match indices.get(&part.material) {
            Some(&known) if part.texture.is_none() => known,
            _ => {
                let made = scene.materials.len() as u32;
                let finish = finish(part.texture.take(), is_replaced, &mut scene.textures);
                scene.materials.push(Material::two_sided(part.material.clone(), finish));
                indices.insert(part.material, made);
                made
            }
        };
        let Part { name, positions, normals, uvs, triangles, .. } = part;
        scene.shapes.push(Shape {
            name,
            positions,
            normals,
            uvs,
            triangles,
            material,
            ..Shape::default()
        });
    }
    scene.shapes.retain(|shape| !shape.triangles.is_empty());
    if scene.shapes.is_empty() {
        findings.problem("", "there are no faces", "export triangles or polygons");
        return scene;
    }
    say(&scene, kind, reading, [unknown, copies], findings);
    scene
}

fn finish(texture: Option<Texture>, is_replaced: bool, textures: &mut Vec<Texture>) -> Finish {
    if is_replaced {
        return Finish::BLACK;
    }
    let Some(texture) = texture else {
        return Finish::diffuse(Rgb::grey(UNKNOWN_REFLECTANCE));
    };
    textures.push(texture);
    let texture = Some(textures.len() as u32 - 1);
    Finish { diffuse: Reflectance { colour: Rgb::WHITE, texture }, ..Finish::BLACK }
}

fn say(
    scene: &SceneParts,
    Kind(kind): &Kind,
    reading: &Reading,
    [unknown, copies]: [usize; 2],
    findings: &mut Findings,
) {
    if unknown > 0 {
        let what = format!("{kind} names no material: taken as grey {UNKNOWN_REFLECTANCE}");
        let remedy =
            "name the file in a scene.toml, as [[geometry]] with `file`, and give it a `material`";
        findings.warning("", what, remedy);
    }
    if copies > 0 {
        let what = counted(
            copies,
            "face lies exactly on another and is left out",
            "faces lie exactly on others and are left out",
        );
        findings.warning("", what, "remove them; every face has both sides");
    }
    let largest_m = largest_side_m(&scene.shapes);
    if largest_m > IMPLAUSIBLE_EXTENT_M && !reading.unit_is_known {
        let what = format!("{kind} names no unit; read as metres, it is {largest_m:.0} m large");
        let remedy =
            "if it was written in another unit, refer to it from a scene.toml with `units`";
        findings.warning("", what, remedy);
    }
}

/// Leaves out triangles with the corners of one before; how many.
fn drop_copies(triangles: &mut Vec<[u32; 3]>) -> usize {
    let before = triangles.len();
    let mut seen = HashSet::with_capacity(before);
    triangles.retain(|corners| {
        let mut sorted = *corners;
        sorted.sort_unstable();
        seen.insert(sorted)
    });
    before - triangles.len()
}
