//! OBJ and MTL: real files, the reading of every property, and hostile ones.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use isolux::scene::{Body, Finish, Scene, SceneParts, UpAxis};
use isolux::units::Rgb;
use isolux_formats::obj::{self, Materials};
use isolux_formats::{Loaded, Problems, Reach};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

fn read_text(obj_text: &str, mtl_text: &str) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("thing.obj");
    std::fs::write(&path, obj_text).unwrap();
    std::fs::write(dir.path().join("thing.mtl"), mtl_text).unwrap();
    obj::read(&path)
}

const TRIANGLE: &str = "mtllib thing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";

fn material(mtl_body: &str) -> (Body, Vec<String>) {
    let loaded = read_text(TRIANGLE, &format!("newmtl m\n{mtl_body}\n")).unwrap();
    let warnings = loaded.warnings.iter().map(ToString::to_string).collect();
    (loaded.value.materials[0].body.clone(), warnings)
}

fn area(parts: &SceneParts) -> f64 {
    let scene = Scene::assemble(parts.clone()).unwrap();
    (0..scene.triangle_count()).map(|t| scene.triangle(t).area()).sum()
}

#[test]
fn mcguire_cornell_box() {
    let loaded = obj::read(&scenes().join("cornell_mcguire/CornellBox-Original.obj")).unwrap();
    let parts = loaded.value;
    assert_eq!(parts.name, "CornellBox-Original");
    assert_eq!(parts.up, UpAxis::Y);
    assert_eq!(parts.shapes.len(), 8);
    // 18 quadrilaterals, of which two (sides of the boxes) are there twice.
    assert_eq!(parts.shapes.iter().map(|s| s.triangles.len()).sum::<usize>(), 32);
    let left = parts.materials.iter().find(|m| m.name == "leftWall").unwrap();
    assert_eq!(left.finish(false).unwrap().diffuse.colour, Rgb::new(0.63, 0.065, 0.05));
    let scene = Scene::assemble(parts).unwrap();
    let light = &scene.area_luminaires()[0];
    assert_eq!(light.luminance_cd_m2, Rgb::new(17.0, 12.0, 4.0));
    // 0.47 m x 0.38 m, in single precision.
    assert!((light.area_m2 - 0.47 * 0.38).abs() < 1e-6);
}

#[test]
fn mcguire_spheres_are_a_mirror_and_glass_with_smooth_normals() {
    let loaded = obj::read(&scenes().join("cornell_mcguire/CornellBox-Sphere.obj")).unwrap();
    let parts = loaded.value;
    let body = |name: &str| &parts.materials.iter().find(|m| m.name == name).unwrap().body;
    let Body::Opaque { front, back } = body("leftSphere") else { panic!("a mirror is opaque") };
    assert_eq!((front.mirror, front), (Rgb::grey(0.95), back));
    let Body::Dielectric(glass) = body("rightSphere") else { panic!("illum 7 is glass") };
    assert_eq!((glass.ior, glass.transmittance, glass.thin), (2.5, Rgb::grey(0.1), false));
    let sphere = parts.shapes.iter().find(|s| s.name == "leftSphere").unwrap();
    let normals = sphere.normals.as_ref().unwrap();
    let centre = [0, 1, 2].map(|k| {
        let all = sphere.positions.iter().map(|p| p[k]);
        0.5 * (all.clone().fold(f64::MAX, f64::min) + all.fold(f64::MIN, f64::max))
    });
    for (p, n) in sphere.positions.iter().zip(normals) {
        let dot: f64 = (0..3).map(|k| (p[k] - centre[k]) * n[k]).sum();
        let radius: f64 = (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum::<f64>().sqrt();
        // The middle of the box around so coarse a mesh misses the centre by one in a hundred.
        assert!(dot > 0.99 * radius, "{dot} {radius}");
    }
    Scene::assemble(parts).unwrap();
}

#[test]
fn embree_cornell_box_has_no_light_and_no_unit() {
    let loaded = obj::read(&scenes().join("cornell_embree/cornell_box.obj")).unwrap();
    assert!(loaded.warnings.iter().any(|w| w.what.contains("556 m") || w.what.contains("559 m")));
    let scene = Scene::assemble(loaded.value).unwrap();
    assert_eq!(scene.luminous_flux_lm(), 0.0);
}

#[test]
fn furniture_loads_with_its_textures() {
    let mut count = 0;
    for entry in std::fs::read_dir(scenes().join("demo/models")).unwrap() {
        let folder = entry.unwrap().path();
        let name = folder.file_name().unwrap().to_owned();
        let path = folder.join(&name).with_extension("obj");
        if !path.exists() {
            continue;
        }
        let parts = obj::read(&path).unwrap_or_else(|p| panic!("{p}")).value;
        let pictures = std::fs::read_dir(&folder)
            .unwrap()
            .filter(|f| f.as_ref().unwrap().path().extension().is_some_and(|e| e == "jpg"))
            .count();
        assert_eq!(parts.textures.len(), pictures, "{name:?}");
        Scene::assemble(parts).unwrap();
        count += 1;
    }
    assert_eq!(count, 8);
}

#[test]
fn concave_face_keeps_its_area() {
    let text = "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6\n";
    let parts = read_text(text, "").unwrap().value;
    assert_eq!(parts.shapes[0].triangles.len(), 4);
    assert_eq!(area(&parts), 5.0);
}

#[test]
fn objects_groups_and_materials_split_and_rejoin() {
    let text = "mtllib thing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\no desk\nusemtl a\nf 1 2 3\n\
                usemtl b\nf 1 2 3\ng legs\nf 1 2 3\nusemtl a\ng\nf 3 2 4\n";
    let parts = read_text(text, "newmtl a\nKd 0.2\nnewmtl b\nKd 0.4 0.4 0.4\n").unwrap().value;
    let found: Vec<_> =
        parts.shapes.iter().map(|s| (s.name.as_str(), s.material, s.triangles.len())).collect();
    assert_eq!(found, [("desk", 0, 2), ("desk", 1, 1), ("desk/legs", 1, 1)]);
}

#[test]
fn texture_coordinates_turn_downwards_and_corners_are_shared() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.75\n\
                vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\nf -4 -3 -2\n";
    let shape = read_text(text, "").unwrap().value.shapes.remove(0);
    assert_eq!(shape.uvs.unwrap()[..4], [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.25]]);
    assert_eq!(shape.positions.len(), 7, "corners without vt and vn are vertices of their own");
    assert_eq!(shape.normals.unwrap()[3..5], [[0.0, 0.0, 1.0], [0.0; 3]]);
}

#[test]
fn copies_of_a_face_are_left_out() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -0 0\nv 1 0 0\nf 1 2 3\nf 3 5 4\nf 1 2 3\ng other\nf 1 2 3\n";
    let loaded = read_text(text, "").unwrap();
    assert_eq!(loaded.value.shapes.iter().map(|s| s.triangles.len()).collect::<Vec<_>>(), [1, 1]);
    let warning =
        loaded.warnings.iter().find(|w| w.what.contains("lies exactly on another")).unwrap();
    assert!(warning.place == "line 7" && warning.what.contains("(and 1 more)"), "{warning}");
}

#[test]
fn mtl_properties() {
    let opaque = |text: &str| match material(text) {
        (Body::Opaque { front, back }, warnings) => {
            assert_eq!(front, back, "two-sided");
            (front, warnings.join("\n"))
        }
        (body, _) => panic!("{body:?}"),
    };
    let glass = |text: &str| match material(text) {
        (Body::Dielectric(glass), warnings) => (glass, warnings.join("\n")),
        (body, _) => panic!("{body:?}"),
    };
    let (finish, warnings) = opaque("Kd 0.1 0.2 0.3\nKa 1 1 1\nNs 10\nKs 0 0 0\nillum 2");
    assert_eq!((finish.diffuse.colour, warnings.as_str()), (Rgb::new(0.1, 0.2, 0.3), ""));
    let (finish, warnings) = opaque("Kd 1.5 0.2 0.3");
    assert_eq!(finish.diffuse.colour, Rgb::new(1.0, 0.2, 0.3));
    assert!(warnings.contains("cut at 1"));
    let (finish, warnings) = opaque("Kd 0.5\nKs 0.5 0.5 0.5\nillum 2");
    assert!(finish.mirror.is_black() && warnings.contains("gloss"));
    let (finish, warnings) = opaque("Kd 0.5\nKs 0.7 0.2 0.2\nillum 3");
    assert_eq!(finish.mirror, Rgb::new(0.5, 0.2, 0.2));
    assert!(warnings.contains("at most 1"));
    let (finish, warnings) = opaque("Kd 0\nKe 10 20 30");
    assert_eq!(finish.luminance_cd_m2, Rgb::new(10.0, 20.0, 30.0));
    assert!(warnings.contains("cd/m2"));
    let (pane, warnings) = glass("d 0.4\nNi 1.0\nillum 2");
    assert_eq!((pane.thin, pane.ior, pane.transmittance), (true, 1.5, Rgb::grey(0.6)));
    assert!(warnings.contains("thin pane"));
    assert_eq!(glass("Tr 0.25\nNi 1.4").0.transmittance, Rgb::grey(0.25));
    assert_eq!(glass("illum 4\nTf 0.9 0.8 0.7").0.transmittance, Rgb::new(0.9, 0.8, 0.7));
    let (solid, _) = glass("illum 6\nNi 1.33");
    assert_eq!((solid.thin, solid.ior, solid.transmittance), (false, 1.33, Rgb::WHITE));
    assert!(opaque("Kd 0.5\nPr 0.3\nmap_Bump x.png").1.contains("`Pr`, `map_Bump`"));
    // Regression: refused, though programs that know no index write 0 everywhere.
    assert!(opaque("Kd 0.5\nNi 0").1.contains("`Ni 0`"));
}

/// The bodies and warnings of a library, by name, read as meant or as written.
fn library(mtl: &str, materials: Materials) -> (HashMap<String, Body>, Vec<String>) {
    let names: Vec<&str> = mtl.lines().filter_map(|line| line.strip_prefix("newmtl ")).collect();
    let faces: String = (0..).zip(&names).fold(String::new(), |text, (k, name)| {
        let corners = format!("v 0 0 {k}\nv 1 0 {k}\nv 0 1 {k}\n");
        text + &corners + &format!("usemtl {name}\nf -3 -2 -1\n")
    });
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("thing.obj");
    std::fs::write(&path, format!("mtllib thing.mtl\n{faces}")).unwrap();
    std::fs::write(dir.path().join("thing.mtl"), mtl).unwrap();
    let loaded = obj::read_with(&path, materials, Reach::Inside).unwrap();
    let bodies = loaded.value.materials.into_iter().map(|m| (m.name, m.body)).collect();
    (bodies, loaded.warnings.iter().map(ToString::to_string).collect())
}

const MAYA: &str = "illum 4\nKd 0.50 0.50 0.50\nKa 0 0 0\nTf 1.00 1.00 1.00\nNi 1.00\n";

/// What each program writes for opaque materials, with the names of those that are opaque, and of those that are glass.
const WRITERS: &[(&str, &[&str], &[&str])] = &[
    // Maya: a whole room was glass.
    ("newmtl a\n{maya}", &["a"], &[]),
    (
        "newmtl a\n{maya}newmtl b\n{maya}newmtl g\nillum 4\nKd 0 0 0\nTf 0.1 0.1 0.1\nNi 1.0\n",
        &["a", "b"],
        &["g"],
    ),
    ("newmtl a\n{maya}newmtl g\nillum 4\nKd 0 0 0\nTf 0.9 0.9 0.9\nNi 1.5\n", &["a"], &["g"]),
    // MeshLab and OpenMVS.
    ("newmtl a\nKd 0.5\nTr 1.000000\nillum 2\n", &["a"], &[]),
    (
        "newmtl a\nKd 0.5\nTr 1\nnewmtl b\nKd 0.2\nTr 1\nnewmtl g\nKd 1\nTr 0.3\n",
        &["a", "b"],
        &["g"],
    ),
    // Most agree with the letter, so it counts.
    ("newmtl a\nKd 0.5\nTr 0\nnewmtl b\nKd 0.2\nTr 0\nnewmtl g\nKd 1\nTr 1\n", &["a", "b"], &["g"]),
    ("newmtl a\nKd 0.5\nd 0\nnewmtl b\nKd 0.2\nd 0.0\n", &["a", "b"], &[]),
    ("newmtl a\nKd 0.5\nd 1\nnewmtl b\nKd 0.2\nd 1\nnewmtl g\nKd 1\nd 0\n", &["a", "b"], &["g"]),
    (
        "newmtl a\nKd 0.5\nillum 7\nnewmtl b\nKd 0.5\nillum 7\nnewmtl c\nKd 0.5\nillum 7\n",
        &["a", "b", "c"],
        &[],
    ),
    // One of glass among others.
    ("newmtl a\nKd 0.5\nillum 2\nnewmtl g\nKd 0.5\nillum 7\nNi 1.5\n", &["a"], &["g"]),
];

#[test]
fn materials_are_what_their_writers_mean() {
    for (mtl, opaque, glass) in WRITERS {
        let mtl = mtl.replace("{maya}", MAYA);
        let (bodies, warnings) = library(&mtl, Materials::AsMeant);
        for name in *opaque {
            let Body::Opaque { front, .. } = &bodies[*name] else { panic!("{name} of {mtl}") };
            assert!(!front.diffuse.colour.is_black(), "{name} of {mtl}");
        }
        for name in *glass {
            assert!(matches!(bodies[*name], Body::Dielectric(_)), "{name} of {mtl}");
        }
        let (letter, _) = library(&mtl, Materials::AsWritten);
        if letter != bodies {
            assert!(warnings.iter().any(|w| w.contains("as-written")), "{mtl}: {warnings:?}");
        }
    }
    let (letter, warnings) = library(&format!("newmtl a\n{MAYA}"), Materials::AsWritten);
    let Body::Dielectric(pane) = &letter["a"] else { panic!("{letter:?}") };
    assert_eq!((pane.ior, pane.transmittance), (1.0, Rgb::WHITE));
    assert!(warnings[0].contains("of index 1, transmitting 1 1 1"), "{warnings:?}");
}

#[test]
fn a_missing_library_is_looked_for() {
    for (statement, file, told) in [
        ("mtllib Thing.MTL\n", "thing.mtl", "`thing.mtl` is read"),
        ("mtllib gone.mtl\n", "thing.mtl", "`thing.mtl` is read"),
        ("mtllib C:\\work\\gone.mtl\n", "THING.mtl", "`THING.mtl` is read"),
        ("", "thing.mtl", "`thing.mtl` is read"),
    ] {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("thing.obj");
        std::fs::write(&path, TRIANGLE.replace("mtllib thing.mtl\n", statement)).unwrap();
        std::fs::write(dir.path().join(file), "newmtl m\nKd 0.7\n").unwrap();
        let loaded = obj::read(&path).unwrap();
        let colour = loaded.value.materials[0].finish(false).unwrap().diffuse.colour;
        assert_eq!(colour, Rgb::grey(0.7), "{statement}");
        assert!(loaded.warnings.iter().any(|w| w.what.contains(told)), "{:?}", loaded.warnings);
    }
}

/// As MeshLab writes it: numbers behind the place, of eight bits. The second half has a material.
const COLOURED: &str = "mtllib thing.mtl\nv 0 0 0 0.737255 0.000000 1.000000\nv 1 0 0 0.737255 0.000000 1.000000\n\
                        v 1 1 0 0.737255 0.000000 1.000000\nv 0 1 0 0.737255 0.000000 1.000000\nf 1 2 3\n\
                        usemtl m\nf 1 3 4\n";

fn read_coloured(obj_text: &str, entry: &str) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("thing.obj"), obj_text).unwrap();
    std::fs::write(dir.path().join("thing.mtl"), "newmtl m\nKd 0.3\n").unwrap();
    let scene = dir.path().join("scene.toml");
    std::fs::write(&scene, format!("[[geometry]]\nfile = 'thing.obj'\n{entry}\n")).unwrap();
    isolux_formats::scene_toml::read(&scene)
}

#[test]
fn colours_of_vertices_are_reflectances_where_that_is_asked_for() {
    let of_bytes = COLOURED.replace("0.737255", "188").replace("1.000000", "255");
    for text in [COLOURED, &of_bytes] {
        let loaded = read_coloured(text, "vertex_colours = true").unwrap();
        assert_eq!(loaded.warnings, []);
        let SceneParts { shapes, materials, textures, .. } = loaded.value;
        let finish = |k: usize| materials[shapes[k].material as usize].finish(false).unwrap();
        let texture = &textures[finish(0).diffuse.texture.unwrap() as usize];
        // Code 188 of sRGB is 0.503 of the light.
        assert_eq!(texture.srgb[..3], [188, 0, 255], "{text}");
        assert_eq!(finish(1), &Finish::diffuse(Rgb::grey(0.3)));
    }
    let warned = read_text(COLOURED, "newmtl m\nKd 0.3\n").unwrap().warnings;
    let told: Vec<_> = warned.iter().filter(|w| w.what.contains("colours of 4 vertices")).collect();
    assert!(told.len() == 1 && told[0].place == "line 2", "{warned:?}");
    let weights = "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n";
    let warned = read_text(weights, "").unwrap().warnings;
    assert!(!warned.iter().any(|w| w.what.contains("colours")), "{warned:?}");
    let none = read_coloured(weights, "vertex_colours = true").unwrap_err().to_string();
    assert!(none.contains("its vertices have no colours"), "{none}");
    let both = "vertex_colours = true\nmaterial = 'p'\n[materials.p]\ndiffuse = 0.5";
    let both = read_coloured(COLOURED, both).unwrap_err().to_string();
    assert!(both.contains("`vertex_colours` beside a material"), "{both}");
}

#[test]
fn a_picture_without_kd_is_the_reflectance() {
    let home = tempfile::tempdir().unwrap();
    image::RgbImage::from_pixel(1, 1, image::Rgb([188; 3]))
        .save(home.path().join("a.png"))
        .unwrap();
    std::fs::write(home.path().join("thing.mtl"), "newmtl m\nmap_Kd a.png\n").unwrap();
    let path = home.path().join("thing.obj");
    std::fs::write(&path, TRIANGLE).unwrap();
    let loaded = obj::read(&path).unwrap();
    let finish = loaded.value.materials[0].finish(false).unwrap();
    assert_eq!((finish.diffuse.colour, finish.diffuse.texture), (Rgb::WHITE, Some(0)));
    assert_eq!(loaded.warnings, []);
}

#[test]
fn missing_things_become_grey_or_untextured_with_a_warning() {
    for (text, mtl, expected) in [
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "", "no material"),
        (TRIANGLE, "newmtl other\nKd 0.1\n", "`m` is not known"),
        ("mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n", "", "does not exist"),
        (TRIANGLE, "newmtl m\nKd 0.5\nmap_Kd gone.png\n", "does not exist"),
        (TRIANGLE, "newmtl m\nKd 0.5\nmap_Kd ../../gone.png\n", "does not exist"),
        (TRIANGLE, "newmtl m\nKd 0.5\nmap_Kd /dev/zero\n", "outside"),
        (TRIANGLE, "newmtl m\nKd 0.5\nmap_Kd thing.obj\n", "not a usable picture"),
        (TRIANGLE, "newmtl m\nKd 0.5\nmap_Kd -s 2 2 1 -clamp on thing.obj\n", "option `-s`"),
        (TRIANGLE, "newmtl m\n", "no Kd"),
    ] {
        let loaded = read_text(text, mtl).unwrap();
        let finish = loaded.value.materials[0].finish(false).unwrap().clone();
        assert_eq!(finish.diffuse.colour, Rgb::grey(0.5), "{mtl}");
        assert_eq!(finish.diffuse.texture, None);
        let said = loaded.warnings.iter().any(|w| w.to_string().contains(expected));
        assert!(said, "{expected}: {:?}", loaded.warnings);
    }
}

#[test]
fn problems_name_the_line_and_come_together() {
    let text = "v 0 0 0\nv 1 0 nan\nv 0 1\nvt x\nf 1 2 9\nf 1 2\nf 0 1 2\nf 1/1 a 1\nf 1 -4 1\n";
    let Problems(list) = read_text(text, "").unwrap_err();
    let places: Vec<_> = list.iter().map(|p| p.place.as_str()).collect();
    let lines = [2, 3, 4, 5, 6, 7, 8, 9].map(|line| format!("line {line}"));
    assert_eq!(places, lines);
    assert!(list.iter().all(|p| !p.remedy.is_empty()));
}

#[test]
fn degenerate_and_hostile_files() {
    let many = "f 1 2 9\n".repeat(100_000);
    let long = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf{}\n", " 1".repeat(5000));
    for (text, expected) in [
        ("", "no faces"),
        ("\0\0\0", "no faces"),
        ("v 0 0 0\n", "no faces"),
        ("v 0 0 0\nf 1 1 1\n", "no faces"),
        ("v 1e400 0 0\nf 1 1 1\n", "finite"),
        ("f 9223372036854775807 1 1\n", "index"),
        ("f -9223372036854775808 1 1\n", "index"),
        ("f 99999999999999999999999 1 1\n", "index"),
        ("\\", "no faces"),
        (&many, "further findings"),
        (&long, "more than 4096 corners"),
    ] {
        let problems = read_text(text, "").unwrap_err().to_string();
        assert!(problems.contains(expected), "{problems}");
    }
    let Problems(list) = read_text(&many, "").unwrap_err();
    assert!(list.len() <= 101);
    let crossing = "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 3 0\nf 1 2 3 4\n";
    let loaded = read_text(crossing, "").unwrap();
    assert!(loaded.warnings.iter().any(|w| w.what.contains("crosses itself")));
    let flat = format!("{TRIANGLE}v 2 0 0\nf 1 2 4\nf 2 2 2\n");
    let loaded = read_text(&flat, "").unwrap();
    let found = loaded.warnings.iter().find(|w| w.what.contains("no area")).unwrap();
    assert!(found.what.contains("(and 1 more)"), "{found}");
    let Problems(list) = read_text("v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", "").unwrap_err();
    assert_eq!(list.len(), 1, "the vertex is wrong, not the face: {list:?}");
}

#[test]
fn broken_mtl_is_a_problem_of_the_mtl_file() {
    let mtl = "Kd 1\nnewmtl m\nKd a b c\nKs xyz 1 nan\nKe -1\nTf\n";
    let Problems(list) = read_text(TRIANGLE, mtl).unwrap_err();
    let places: Vec<_> = list.iter().map(|p| p.place.as_str()).collect();
    assert_eq!(places, ["line 1", "line 3", "line 4", "line 5", "line 6"]);
    assert!(list.iter().all(|p| p.file.ends_with("thing.mtl")));
}

/// Regression: each of these lines refused the whole file.
#[test]
fn odd_lines_of_materials_are_told_with_what_is_taken() {
    for (line, told) in [
        ("Tf xyz 0.9505 1 1.089", "is read as 1 1 0.9999 in linear Rec. 709"),
        ("Tf xyz 0.5", "is read as 0.6025"),
        ("Tf spectral glass.rfl 1.0", "is a spectrum, which is not read: the line is left out"),
        ("Ke spectral lamp.rfl", "is a spectrum"),
        ("illum 99", "`illum 99` is no model from 0 to 10: the line is left out"),
        ("illum glass", "is no model"),
        ("Ni -1", "`Ni -1` is no index of refraction"),
        ("d 100", "`d 100` is not from 0 to 1: 1 is taken"),
        ("d all", "is no number from 0 to 1"),
    ] {
        let (body, warnings) = material(&format!("Kd 0.3\n{line}"));
        let Body::Opaque { front, .. } = body else { panic!("{line}: {body:?}") };
        assert_eq!(front, Finish::diffuse(Rgb::grey(0.3)), "{line}");
        let [warning] = warnings.as_slice() else { panic!("{line}: {warnings:?}") };
        assert!(warning.contains("line 3") && warning.contains(told), "{warning}");
    }
    let glass = |lines: &str| match material(lines) {
        (Body::Dielectric(glass), _) => glass.transmittance,
        (body, _) => panic!("{lines}: {body:?}"),
    };
    // D65 is white, up to the four digits of its numbers.
    let white = glass("Tf xyz 0.9505 1 1.089\nillum 4\nNi 1.5");
    assert!((white - Rgb::WHITE).0.iter().all(|c| c.abs() < 1e-3), "{white:?}");
    // What is left out says nothing: 1 - d passes.
    assert_eq!(glass("Tf spectral glass.rfl\nillum 4\nNi 1.5\nd 0.25"), Rgb::grey(0.75));
    // Regression: 0.19999999999999996.
    let (_, warnings) = material("d 0.8");
    assert!(warnings[0].contains("transmitting 0.2 0.2 0.2"), "{warnings:?}");
}

#[test]
fn file_that_cannot_be_read() {
    let problems = obj::read(Path::new("no such.obj")).unwrap_err().to_string();
    assert!(problems.contains("no such.obj"), "{problems}");
    assert!(obj::read(&scenes()).unwrap_err().to_string().contains("not a regular file"));
}

#[test]
fn gloss_that_is_left_out_is_one_warning() {
    let obj = format!("{TRIANGLE}usemtl n\nf 1 3 2\nusemtl o\nf 3 2 1\n");
    let mtl = "newmtl m\nKd 1 1 1\nKs 1 1 1\nnewmtl n\nKd 1 1 1\nKs 1 1 1\nnewmtl o\nKd 1 1 1\n";
    let loaded = read_text(&obj, mtl).unwrap();
    let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    let gloss: Vec<&String> = warnings.iter().filter(|w| w.contains("gloss Ks")).collect();
    assert_eq!(gloss.len(), 1, "{warnings:#?}");
    assert!(gloss[0].contains("`m` (and 1 more)"), "{}", gloss[0]);
}
