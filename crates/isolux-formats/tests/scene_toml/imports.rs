//! Geometry from files.

use super::{near, read_with, scenes, triangles};
use isolux::geometry::Vector;
use isolux::scene::{Scene, SceneParts};
use isolux::units::Rgb;
use isolux_formats::{Loaded, Problems, scene_toml};

const OBJ: &str = "mtllib thing.mtl\nv 0 0 0\nv 100 0 0\nv 100 200 0\nv 0 200 0\nv 0 0 50\nusemtl a\n\
                   f 1 2 3 4\nusemtl b\nf 1 2 5\n";
const MTL: &str =
    "newmtl a\nKd 0.1 0.2 0.3\nnewmtl b\nKd 0.5\nKs 1 1 1\nillum 2\nmap_Kd none.png\n";

fn import(geometry: &str) -> Result<Loaded<SceneParts>, Problems> {
    let text =
        format!("[materials.m]\ndiffuse = 0.7\n[[geometry]]\nfile = 'thing.obj'\n{geometry}\n");
    read_with(&text, &[("thing.obj", OBJ), ("thing.mtl", MTL)])
}

fn highest(parts: &SceneParts) -> Vector {
    let corners = triangles(parts).into_iter().flat_map(|t| t.corners);
    corners.fold(Vector::new(-1e9, -1e9, -1e9), |m, p| {
        Vector::new(m.x.max(p.x), m.y.max(p.y), m.z.max(p.z))
    })
}

#[test]
fn obj_stands_up_in_its_own_units() {
    let parts = import("units = 'cm'").unwrap().value;
    assert!(near(highest(&parts), [1.0, 0.0, 2.0]), "y of the file is up");
    let parts = import("units = 'cm'\nup = 'z'").unwrap().value;
    assert!(near(highest(&parts), [1.0, 2.0, 0.5]), "as it says");
    let names: Vec<_> = parts.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["thing/a", "thing/b"]);
}

#[test]
fn without_units_obj_takes_those_of_the_scene() {
    let text = "units = 'mm'\n[[geometry]]\nfile = 'thing.obj'\n";
    let parts = read_with(text, &[("thing.obj", OBJ), ("thing.mtl", MTL)]).unwrap().value;
    assert!(near(highest(&parts), [0.1, 0.0, 0.2]));
}

#[test]
fn materials_by_name_and_the_rest_from_the_file() {
    let loaded = import("materials = { b = 'm' }").unwrap();
    assert_eq!(loaded.warnings, [], "what is replaced is not warned of");
    let parts = loaded.value;
    let of = |shape: usize| &parts.materials[parts.shapes[shape].material as usize];
    assert_eq!(of(0).name, "thing/a");
    assert_eq!(of(0).finish(false).unwrap().diffuse.colour, Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(of(1).name, "m");
    let parts = import("material = 'm'").unwrap().value;
    assert!(parts.shapes.iter().all(|s| s.material == 0));
    let parts = import("material = 'm'\nmaterials = { a = 'm' }").unwrap().value;
    assert_eq!(parts.materials.len(), 1);
    let problem = import("materials = { glass = 'm' }").unwrap_err().to_string();
    assert!(problem.contains("line 5") && problem.contains("`a`, `b`"), "{problem}");
}

#[test]
fn copies_share_what_the_file_brings() {
    let copies = "placements = [{ translate = [0,0,0] }, { translate = [5,0,0] }]\nname = 'x'";
    let parts = import(copies).unwrap().value;
    assert_eq!((parts.shapes.len(), parts.materials.len()), (4, 3));
    assert_eq!(parts.shapes[3].name, "x[1]/b");
}

#[test]
fn problems_of_the_file_name_the_file() {
    let text = "[[geometry]]\nfile = 'thing.obj'\n[[geometry]]\nfile = 'gone.obj'\n\
                [[geometry]]\nfile = 'scene.toml'\n[[geometry]]\nfile = '../thing.obj'\n";
    let Problems(list) = read_with(text, &[("thing.obj", "v 0 0\nf 1 2 3\n")]).unwrap_err();
    let of_obj = list.iter().filter(|p| p.file.ends_with("thing.obj")).count();
    assert_eq!((of_obj, list.len()), (2, 5), "{list:?}");
    assert!(list[0].to_string().contains("line 4, column 8: file `gone.obj` does not exist"));
    assert!(list[1].what.contains("not geometry by its extension"));
}

/// A room whose walls, light and mirror ball come from a public model.
#[test]
fn cornell_box_with_assigned_materials() {
    let loaded = scene_toml::read(&scenes().join("cornell_mcguire/scene.toml")).unwrap();
    let scene = Scene::assemble(loaded.value).unwrap();
    let light = &scene.area_luminaires()[0];
    assert_eq!(scene.area_luminaires().len(), 1, "one-sided");
    assert!(light.luminous_flux_lm() > 0.0);
    let normal = scene.geometric_normal(light.triangles[0]).to_vector();
    let towards_the_room = if light.back { normal.y > 0.0 } else { normal.y < 0.0 };
    assert!(towards_the_room);
}

/// What the book shows first is a scene.
#[test]
fn example_of_the_book() {
    let root = scenes().join("..");
    let book = std::fs::read_to_string(root.join("docs/book/scenes.md")).unwrap();
    let example = book.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let lamp = std::fs::read_to_string(root.join("scenes/photometry/own/linear_1200.ies")).unwrap();
    let loaded = read_with(example, &[("panel.ies", &lamp)]).unwrap_or_else(|p| panic!("{p}"));
    assert_eq!(loaded.warnings, []);
    assert_eq!(Scene::assemble(loaded.value).unwrap().luminaires().len(), 4);
}
