//! Containers for the walk-through, read back.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

mod container;
#[path = "../lit/mod.rs"]
mod lit;

use container::Container;
use isolux::geometry::{Direction, Normal, Point};
use isolux::map::{IlluminationMap, VertexLight};
use isolux::photometry::{GeneralSky, Sky};
use isolux::scene::{
    Finish, Fitting, Luminaire, LuminaireKind, Material, Scene, SceneParts, Shape, world_from_sky,
};
use isolux::units::Rgb;
use isolux_formats::walk::{self, Embedded, Light, Mesh, Page, Told};

/// Half a step of 9 bits of the largest channel.
const LIGHT: f64 = 1.0 / 511.0;

/// A sheet of so many squares along each side, far from the origin, lit on its front.
fn sheet(squares: u32) -> Scene {
    let at = |k: u32| 0.1 * f64::from(k);
    let row = squares + 1;
    let positions =
        (0..row * row).map(|k| [5e5 + at(k % row), -3e5 + at(k / row), 2.0 + 0.01 * at(k)]);
    let square = |k: u32| {
        let first = k / squares * row + k % squares;
        [[first, first + 1, first + row + 1], [first, first + row + 1, first + row]]
    };
    let shape = Shape {
        name: "sheet".into(),
        positions: positions.collect(),
        triangles: (0..squares * squares).flat_map(square).collect(),
        material: 0,
        ..Shape::default()
    };
    let paint = Material::one_sided("paint", Finish::diffuse(Rgb::new(0.5, 0.4, 0.3)));
    let parts = SceneParts { shapes: vec![shape], materials: vec![paint], ..SceneParts::default() };
    Scene::assemble(parts).unwrap()
}

/// Light that grows along x, unknown in a corner.
fn along_x(place: Point, _: Normal) -> Option<VertexLight> {
    let x = place.x - 5e5;
    (x > 0.05 || place.y > -3e5 + 0.05).then(|| VertexLight {
        direct_lx: Rgb::new(100.0, 80.0, 60.0) * (1.0 + x),
        indirect_lx: Rgb::grey(7.0),
        standard_error_lx: 0.25,
        ..VertexLight::NOTHING
    })
}

fn luminance([r, g, b]: [f64; 3]) -> f64 {
    Rgb::new(r, g, b).luminance()
}

#[test]
fn vertices_are_where_they_were_and_as_light() {
    let scene = sheet(20);
    let map = lit::map(&scene, along_x);
    let mesh = Mesh::new(&scene, &map, 7);
    let (drawn, light) =
        (Container::read(&mesh.to_bytes()), Container::read(&Light::new(&mesh, &map).to_bytes(0)));
    let told = Container::read(&walk::scene(&scene, &told()));
    let origin = [0, 1, 2].map(|k| told.header["origin"][k].as_f64().unwrap());
    let positions = drawn.positions();
    assert_eq!(positions.len(), drawn.header["lit_vertices"].as_u64().unwrap() as usize);
    assert_eq!(drawn.header["triangles"], 800);
    let errors = light.u16s(&light.header["standard_error"]);
    let layer = &light.header["layers"][0];
    let [direct, indirect] = ["direct", "indirect"].map(|name| light.colours(&layer[name]));
    let mut unknown = 0;
    for (k, position) in positions.iter().enumerate() {
        let place = Point::from([0, 1, 2].map(|c| position[c] + origin[c]));
        // Half a step of 16 bits, over two metres.
        let near = map.elements.vertices().iter().map(|v| (v.position - place).length());
        assert!(near.fold(f64::INFINITY, f64::min) < 3e-5, "{place:?}");
        let Some(wanted) = along_x(place, Normal::Z) else {
            unknown += 1;
            continue;
        };
        let (direct, indirect) = (luminance(direct[k]), luminance(indirect[k]));
        assert!((direct / wanted.direct_lx.luminance() - 1.0).abs() < 2.0 * LIGHT);
        assert!((indirect / 7.0 - 1.0).abs() < LIGHT);
        // A quarter is exact in any binary form.
        assert_eq!(errors[k], 0x3400);
    }
    assert!(unknown > 0, "the corner that is unknown is shown as its neighbours");
}

#[test]
fn chunks_have_as_many_vertices_as_an_index_can_tell_and_meet() {
    let scene = sheet(300);
    let map = lit::map(&scene, along_x);
    let drawn = Container::read(&Mesh::new(&scene, &map, 1).to_bytes());
    let chunks = drawn.header["chunks"].as_array().unwrap();
    assert!(chunks.len() > 1);
    for chunk in chunks {
        assert!(chunk["vertices"].as_u64().unwrap() <= 65_536);
        assert_eq!((&chunk["min"], &chunk["step"]), (&chunks[0]["min"], &chunks[0]["step"]));
    }
}

#[test]
fn mirrors_come_plane_by_plane_unless_they_are_curved() {
    let facet = |k: usize, all: usize| {
        let (s, c) = (std::f64::consts::TAU * k as f64 / all as f64).sin_cos();
        let at = |by: f64, z: f64| [3.0 * c - by * s, 3.0 * s + by * c, z];
        [at(-0.1, 0.0), at(0.1, 0.0), at(0.0, 0.2)]
    };
    let chunks = |all: usize| {
        let shape = Shape {
            name: "mirrors".into(),
            positions: (0..all).flat_map(|k| facet(k, all)).collect(),
            triangles: (0..all as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
            material: 0,
            ..Shape::default()
        };
        let mirror = Material::one_sided("mirror", Finish::mirror(Rgb::grey(0.9)));
        let parts =
            SceneParts { shapes: vec![shape], materials: vec![mirror], ..SceneParts::default() };
        let scene = Scene::assemble(parts).unwrap();
        let drawn = Container::read(&Mesh::new(&scene, &lit::map(&scene, along_x), 1).to_bytes());
        drawn.header["chunks"].as_array().unwrap().len()
    };
    assert_eq!((chunks(1), chunks(2), chunks(5)), (1, 2, 5));
    assert_eq!(chunks(200), 1);
}

#[test]
fn only_blocks_that_change_are_sent_again() {
    let scene = sheet(60);
    let map = lit::map(&scene, along_x);
    let mesh = Mesh::new(&scene, &map, 1);
    let mut light = Light::new(&mesh, &map);
    let all = Container::read(&light.to_bytes(0)).header["blocks"].as_array().unwrap().len();
    assert_eq!(all, mesh.lit_vertices().div_ceil(1024));
    assert!(Container::read(&light.to_bytes(1)).header["blocks"].as_array().unwrap().is_empty());
    let mut next = map.clone();
    let last = next.values.len() - 1;
    next.values[last] = next.values[last].map(|value| value.dimmed(2.0));
    assert!(light.update(&mesh, &next));
    let sent = Container::read(&light.to_bytes(1));
    assert_eq!(
        (&sent.header["version"], sent.header["blocks"].as_array().unwrap().len()),
        (&2.into(), 1)
    );
    // Known elsewhere, or other elements: another mesh.
    next.values[last] = None;
    assert!(!light.update(&mesh, &next));
    assert!(!light.update(&mesh, &lit::map(&sheet(61), along_x)));
    assert_eq!(light.version(), 2);
}

#[test]
fn layers_and_the_other_map_lie_beside() {
    let scene = sheet(8);
    let map = lit::map(&scene, along_x);
    let brighter = |by: f64| -> Vec<Option<VertexLight>> {
        map.values.iter().map(|value| value.map(|value| value.dimmed(by))).collect()
    };
    let other = IlluminationMap { values: brighter(3.0), ..map.clone() };
    let mesh = Mesh::new(&scene, &map, 1);
    let light = Light::new(&mesh, &map)
        .with_layers(&mesh, &[brighter(0.25), brighter(0.75)])
        .beside((&scene, &mesh), &map, &other);
    let sent = Container::read(&light.to_bytes(0));
    let of = |layer: &serde_json::Value| sent.colours(&layer["direct"]);
    let layers = sent.header["layers"].as_array().unwrap();
    let [quarter, rest] = [0, 1].map(|k| of(&layers[k]));
    let other = of(&sent.header["other"]);
    let mut seen = 0;
    for ((quarter, rest), other) in quarter.iter().zip(&rest).zip(&other) {
        let [quarter, rest, other] = [quarter, rest, other].map(|&c| luminance(c));
        if quarter > 0.0 {
            seen += 1;
            assert!((rest / quarter / 3.0 - 1.0).abs() < 4.0 * LIGHT);
            assert!((other / (quarter + rest) / 3.0 - 1.0).abs() < 4.0 * LIGHT, "{other}");
        }
    }
    assert!(seen > 60);
}

fn told() -> Told {
    Told {
        file: "a</script>.glb".into(),
        about: vec![("seed".into(), "1".into())],
        light_lm: Vec::new(),
        white_cd_m2: 10.0,
        tones: Vec::new(),
        colour_maps: vec![("grey", vec![[0; 3]; 256])],
        scale_lx: (0.0, 500.0),
        layers: vec!["all".into()],
        other: None,
    }
}

#[test]
fn data_do_not_end_the_script_they_lie_in() {
    let page = Page("<html><!--isolux-data--><body>");
    let hello = r#"{"file":"</script><script>alert(1)</script>"}"#;
    let world = Embedded { scene: walk::scene(&sheet(1), &told()), ..Embedded::default() };
    let html = walk::embed(page, hello, &[world]).unwrap();
    assert_eq!(html.matches("</script>").count(), 5, "{html}");
    assert!(html.starts_with("<html><script id=\"isolux-hello\"") && html.ends_with("<body>"));
    assert!(walk::embed(Page("<html>"), hello, &[]).is_none());
}

#[test]
fn skies_are_pictures_and_the_sun_is_a_disc() {
    let mut parts = sheet(1).to_parts();
    let far =
        |name: &str, kind| Luminaire { name: name.into(), group: 0, colour: Rgb::WHITE, kind };
    let sky = Sky::General { sky: GeneralSky::uniform(1000.0), ground_cd_m2: 100.0 };
    let world_from_sky = world_from_sky(parts.up, 0.0);
    let sun = LuminaireKind::Directional {
        direction: -Direction::Z,
        illuminance_lx: 50_000.0,
        half_angle_rad: 0.1,
    };
    parts.luminaires =
        vec![far("sky", LuminaireKind::Sky { world_from_sky, sky }), far("sun", sun)];
    parts.fittings = vec![Fitting::default(); 2];
    let scene = Scene::assemble(parts).unwrap();
    let read = |scene: &Scene| Container::read(&walk::scene(scene, &told()));
    let told = read(&scene);
    let sky = &told.header["sky"];
    let [width, height] = ["width", "height"].map(|of| sky[of].as_u64().unwrap() as usize);
    let seen = told.colours(&sky["codes"]);
    assert_eq!(seen.len(), width * height);
    for (at, expected) in [(0, 1000.0), (seen.len() / 2 - 1, 1000.0), (seen.len() - 1, 100.0)] {
        let found = luminance(seen[at]);
        assert!((found / expected - 1.0).abs() < LIGHT, "{at}: {found}");
    }
    let (sun, sine) = (&told.header["sun"], 0.1_f64.sin());
    assert_eq!(sun["towards"], serde_json::json!([0.0, 0.0, 1.0]));
    let cd_m2 = sun["luminance_cd_m2"][0].as_f64().unwrap();
    let expected = 50_000.0 / (std::f64::consts::PI * sine * sine);
    assert!((cd_m2 / expected - 1.0).abs() < 1e-12, "{cd_m2}");
    let none = read(&sheet(1));
    assert!(none.header["sky"].is_null() && none.header["sun"].is_null());
}
