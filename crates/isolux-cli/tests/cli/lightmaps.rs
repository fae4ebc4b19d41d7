//! Maps as texels.

use crate::ran::Home;
use exr::prelude::{ReadChannels, ReadLayers, read};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

/// A page of a lightmap in an EXR file.
struct Page {
    width: usize,
    photometric: Vec<f64>,
    errors: Vec<f64>,
}

impl Page {
    fn read(path: &Path) -> Self {
        let image = read().no_deep_data().largest_resolution_level().all_channels();
        let layer = image.first_valid_layer().all_attributes().from_file(path).unwrap().layer_data;
        let channel = |name: &str| -> Vec<f64> {
            let list = &layer.channel_data.list;
            let found = list.iter().find(|c| c.name.to_string() == name).unwrap();
            found.sample_data.values_as_f32().map(f64::from).collect()
        };
        let [r, g, b] = ["R", "G", "B"].map(channel);
        let weighted = |k: usize| 0.2126 * r[k] + 0.7152 * g[k] + 0.0722 * b[k];
        Self {
            width: layer.size.0,
            photometric: (0..r.len()).map(weighted).collect(),
            errors: channel("standard_error.Y"),
        }
    }

    fn height(&self) -> usize {
        self.photometric.len() / self.width
    }
}

/// A `.glb` with its numbers.
struct Glb {
    json: Value,
    binary: Vec<u8>,
}

impl Glb {
    fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        Self { json, binary: bytes[28 + length..].to_vec() }
    }

    /// Words of four bytes behind an accessor.
    fn words(&self, accessor: &Value) -> Vec<[u8; 4]> {
        let number = |value: &Value| value.as_u64().unwrap() as usize;
        let view = &self.json["accessors"][number(accessor)]["bufferView"];
        let view = &self.json["bufferViews"][number(view)];
        let start = number(&view["byteOffset"]);
        self.binary[start..start + number(&view["byteLength"])].as_chunks().0.to_vec()
    }

    fn rows<const N: usize>(&self, accessor: &Value) -> Vec<[f64; N]> {
        let floats: Vec<f64> =
            self.words(accessor).into_iter().map(|b| f64::from(f32::from_le_bytes(b))).collect();
        floats.as_chunks().0.to_vec()
    }

    /// Centres of texels inside triangles: the texel, the place, the normal.
    fn centres(&self, (width, height): (usize, usize)) -> Vec<(usize, [f64; 3], [f64; 3])> {
        let mut found = Vec::new();
        for mesh in self.json["meshes"].as_array().unwrap() {
            let primitive = &mesh["primitives"][0];
            let attributes = &primitive["attributes"];
            let positions = self.rows::<3>(&attributes["POSITION"]);
            let normals = self.rows::<3>(&attributes["NORMAL"]);
            let uvs = self.rows::<2>(&attributes["TEXCOORD_1"]);
            let indices: Vec<usize> = self
                .words(&primitive["indices"])
                .into_iter()
                .map(|b| u32::from_le_bytes(b) as usize)
                .collect();
            for corners in indices.as_chunks::<3>().0 {
                let [a, b, c] =
                    corners.map(|k| [uvs[k][0] * width as f64, uvs[k][1] * height as f64]);
                let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
                    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
                };
                for texel in 0..width * height {
                    let at = [(texel % width) as f64 + 0.5, (texel / width) as f64 + 0.5];
                    let whole = cross(a, b, c);
                    let w =
                        [cross(b, c, at) / whole, cross(c, a, at) / whole, cross(a, b, at) / whole];
                    // Strictly inside, so that no centre is of two triangles.
                    if w.iter().all(|w| *w > 1e-6) {
                        let mix = |list: &[[f64; 3]]| {
                            [0, 1, 2].map(|k| (0..3).map(|i| w[i] * list[corners[i]][k]).sum())
                        };
                        found.push((texel, mix(&positions), mix(&normals)));
                    }
                }
            }
        }
        found
    }
}

#[test]
fn texels_agree_with_probe_within_their_errors() {
    let home = Home::new();
    let solve = ["solve", "builtin:cube", "-o", "cube.glb", "--accuracy", "1%", "--json"];
    let ran = home.run(&[&solve[..], &["--layout", "texels", "--texels-per-meter", "2"]].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    assert_eq!(home.names(), ["cube.exr", "cube.glb"]);
    let report = ran.json()["lightmap"].clone();
    assert_eq!(report["charts"], 6);
    assert_eq!(report["seams"]["edges"], 0, "all edges of a cube are creases");
    assert_eq!(report["convention"]["unit"], "lx");
    let page = Page::read(&home.path("cube.exr"));
    let centres = Glb::read(&home.path("cube.glb")).centres((page.width, page.height()));
    assert!(centres.len() > 2000, "{}", centres.len());
    let mut points = String::new();
    for (_, p, n) in &centres {
        let _ = writeln!(points, "{} {} {} {} {} {}", p[0], p[1], p[2], n[0], n[1], n[2]);
    }
    home.file("centres.pts", points);
    // The same file is still a map.
    let probed = home.run(&["probe", "cube.glb", "--points", "centres.pts", "--json"]).json();
    let probed = probed["points"].as_array().unwrap();
    let mut outside = 0;
    for ((texel, ..), probed) in centres.iter().zip(probed) {
        let expected = probed["illuminance_lx"].as_f64().unwrap();
        let error = page.errors[*texel].hypot(probed["standard_error_lx"].as_f64().unwrap());
        let off = page.photometric[*texel] - expected;
        outside += usize::from(off.abs() > 1.96 * error);
        // Five errors are no accident, even where a texel of half a metre lies in a corner.
        assert!(off.abs() < 5.0 * error, "{off} {error}");
    }
    // Both read one map, whose error they have in common: fewer than one in twenty differ by more than intervals say.
    assert!(20 * outside < centres.len(), "{outside} of {}", centres.len());
}

#[test]
fn every_target_says_what_it_gets() {
    let home = Home::new();
    home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]);
    for (target, unit, files) in [
        ("viewer", "lx", 2),
        ("three", "lx", 3),
        ("bevy", "cd/m2", 3),
        ("godot", "cd/m2", 2),
        ("unity", "cd/m2", 2),
        ("blender", "cd/m2", 2),
    ] {
        let out = format!("{target}.glb");
        let export = ["export", "m.glb", "-o", &out, "--layout", "texels", "--target", target];
        let ran = home.run(&[&export[..], &["--texels-per-meter", "0.5", "--json"]].concat());
        assert_eq!(ran.code, 0, "{ran:?}");
        let report = ran.json();
        assert_eq!(report["convention"]["unit"], unit, "{target}");
        assert_eq!(report["files"].as_array().unwrap().len(), files, "{target}");
        for file in report["files"].as_array().unwrap() {
            assert!(home.path(file.as_str().unwrap()).is_file(), "{file}");
        }
        // What is for engines has no map in it.
        assert_eq!(home.run(&["probe", &out, "--points", "m.pts"]).code, 2);
    }
    let text = home.run(&[
        "export",
        "m.glb",
        "-o",
        "l.ktx2",
        "--target",
        "bevy",
        "--texels-per-meter",
        "1",
    ]);
    assert!(text.out.contains("luminance = albedo * texel"), "{}", text.out);
}

#[test]
fn too_many_texels_are_refused() {
    let home = Home::new();
    home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]);
    for arguments in [
        &["export", "m.glb", "-o", "l.exr", "--texels-per-meter", "1e9"][..],
        &["export", "m.glb", "-o", "l.exr", "--texels-per-meter", "10", "--max-memory", "1MB"],
        &["solve", "builtin:cube", "-o", "n.glb", "--layout", "texels", "--texels-per-meter=1e300"],
    ] {
        let ran = home.run(arguments);
        assert_eq!(ran.code, 4, "{arguments:?}: {ran:?}");
        assert!(ran.err.contains("--texels-per-meter"), "{}", ran.err);
    }
    assert_eq!(home.names(), ["m.glb"]);
}

const ROOM: &str = "name = \"two lamps\"\n[materials.grey]\ndiffuse = 0.5\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [4, 3, 2.5], inward = true }\nmaterial = \"grey\"\n\
    [[luminaire]]\ngroup = \"left\"\nposition = [1, 1.5, 2]\nisotropic = { intensity_cd = 100 }\n\
    [[luminaire]]\ngroup = \"right\"\nposition = [3, 1.5, 1]\nisotropic = { intensity_cd = 60 }\n";

/// Bits of all places in the lightmap of a file.
fn places(glb: &Glb) -> Vec<[u8; 4]> {
    let meshes = glb.json["meshes"].as_array().unwrap().iter();
    let primitives = meshes.flat_map(|mesh| mesh["primitives"].as_array().unwrap());
    primitives.flat_map(|p| glb.words(&p["attributes"]["TEXCOORD_1"])).collect()
}

#[test]
fn lightmaps_of_groups_lie_alike_and_add_up() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    let dense = ["--layout", "texels", "--texels-per-meter", "3"];
    let solve = ["solve", "room.toml", "-o", "map.glb", "--group", "--accuracy", "3%", "--json"];
    let ran = home.run(&[&solve[..], &dense].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    let report = ran.json();
    assert_eq!(report["groups"][1]["lightmap"]["files"][1], "map.right.exr", "{report}");
    let names = ["map", "map.left", "map.right"];
    let [sum, left, right] = names.map(|name| Page::read(&home.path(&format!("{name}.exr"))));
    let expected = places(&Glb::read(&home.path("map.glb")));
    assert!(expected.len() > 8);
    let (mut known, mut outside) = (0, 0);
    for texel in 0..sum.photometric.len() {
        let error = sum.errors[texel].hypot(left.errors[texel]).hypot(right.errors[texel]);
        if error.is_nan() {
            continue;
        }
        known += 1;
        let off = sum.photometric[texel] - left.photometric[texel] - right.photometric[texel];
        outside += usize::from(off.abs() > 1.96 * error);
        // Of some thousand texels none by chance. Where rims were continued from beside them, six errors.
        assert!(off.abs() <= 4.0 * error, "{texel}: {off} {error}");
    }
    assert_eq!(known as u64, report["lightmap"]["texels_known"].as_u64().unwrap());
    // Intervals of 95 %.
    assert!(20 * outside < known, "{outside} of {known}");
    // However one comes to a lightmap of these surfaces, it lies as the others.
    let mixed = home.run(&["mix", "map.glb", "--dim", "left=50%", "-o", "dim.glb"]);
    assert_eq!(mixed.code, 0, "{mixed:?}");
    for from in ["map.left", "dim"] {
        let export = ["export", &format!("{from}.glb"), "-o", "export.glb", "--target", "three"];
        let ran = home.run(&[&export[..], &dense].concat());
        assert_eq!(ran.code, 0, "{ran:?}");
        assert_eq!(places(&Glb::read(&home.path("export.glb"))), expected, "{from}");
    }
    for name in names {
        assert_eq!(places(&Glb::read(&home.path(&format!("{name}.glb")))), expected, "{name}");
    }
}

#[test]
fn a_dry_run_tells_the_size_of_a_lightmap() {
    let home = Home::new();
    let solve = ["solve", "builtin:cube", "--dry-run", "--json"];
    let texels = ["--layout", "texels", "--texels-per-meter", "2"];
    assert_eq!(home.run(&solve).json()["lightmap"], Value::Null);
    let sizes = home.run(&[&solve[..], &texels].concat()).json()["lightmap"].clone();
    assert_eq!(sizes["pages"], 1, "{sizes}");
    // Six faces of 10 m, 4 texels a square metre.
    assert_eq!(sizes["texels_of_surfaces"], 2400, "{sizes}");
    let size = |name: &str| sizes[name].as_u64().unwrap();
    assert_eq!(size("texels"), size("width") * size("height"));
    let times =
        ["time_earliest_s", "time_s", "time_latest_s"].map(|name| sizes[name].as_f64().unwrap());
    assert!(0.0 < times[0] && times[0] < times[1] && times[1] < times[2], "{sizes}");
    let text = home.run(&[&["solve", "builtin:cube", "--dry-run"], &texels[..]].concat()).words();
    assert!(text.contains("on top of the time to solve"), "{text}");
    assert!(home.names().is_empty());
}

/// Writing for a second engine takes what the map holds, bit for bit what baking it anew gives.
#[test]
fn texels_in_the_map_are_those_that_would_be_baked() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    let solve = ["solve", "room.toml", "--quality", "draft", "-o"];
    let dense = ["--layout", "texels", "--texels-per-meter", "5"];
    assert_eq!(home.run(&[&solve[..], &["with.glb"], &dense].concat()).code, 0);
    assert_eq!(home.run(&[&solve[..], &["without.glb"]].concat()).code, 0);
    for target in ["viewer", "three", "blender"] {
        let written = ["with", "without"].map(|from| {
            let (map, out) = (format!("{from}.glb"), format!("{target}-{from}.glb"));
            let export = ["export", &map, "-o", &out, "--target", target, "--json"];
            let ran = home.run(&[&export[..], &dense].concat());
            assert_eq!(ran.code, 0, "{ran:?}");
            let report = ran.json();
            assert_eq!(report["taken_from_map"], from == "with", "{report}");
            assert_eq!(report["texels_per_meter"], 5.0);
            assert!(report["readings"].as_u64().unwrap() > 1000, "{report}");
            let files = report["files"].as_array().unwrap().iter();
            let read = |file: &Value| std::fs::read(home.path(file.as_str().unwrap())).unwrap();
            files.map(read).collect::<Vec<_>>()
        });
        assert!(written[0] == written[1], "{target}");
    }
    // Another density is baked; none is that of the map.
    for (more, is_held) in [(&["--texels-per-meter", "4"][..], false), (&[], true)] {
        let export = ["export", "with.glb", "-o", "l.exr", "--json"];
        let report = home.run(&[&export[..], more].concat()).json();
        assert_eq!(report["taken_from_map"], is_held, "{report}");
    }
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn below_a_dark_sky_a_room_has_few_texels_and_that_is_told() {
    let home = Home::new();
    let sky = "[[geometry]]\nbox = { min = [-500, -500, -500], max = [500, 500, 500], inward = true }\nmaterial = \"grey\"\n";
    home.file("room.toml", format!("{ROOM}{sky}"));
    home.run(&["solve", "room.toml", "--quality", "draft", "-o", "m.glb"]);
    let whole = home.run(&["export", "m.glb", "-o", "whole.exr"]);
    assert_eq!(whole.code, 0, "{whole:?}");
    assert!(whole.err.contains("has light") && whole.err.contains("--without-dark"), "{whole:?}");
    // With the sky that would be more than 10^8 texels.
    let dense = ["--without-dark", "--texels-per-meter", "4"];
    let left = home.run(&[&["export", "m.glb", "-o", "left.exr"], &dense[..]].concat());
    assert_eq!(left.code, 0, "{left:?}");
    assert!(!left.err.contains("has light"), "{left:?}");
    let without = left.out.lines().find(|line| line.contains("without texels")).unwrap();
    let count = without.split_whitespace().nth(2).unwrap();
    assert!(count.parse::<u32>().unwrap() >= 12, "{without}");
}
