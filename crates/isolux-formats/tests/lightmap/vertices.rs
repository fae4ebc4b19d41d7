//! The white card with its light at vertices: written for a consumer and read back by its formula, it must have the
//! luminance rho E / pi.

use crate::card::{self, ILLUMINANCE_LX, REFLECTANCE};
use isolux::map::IlluminationMap;
use isolux::scene::{Finish, Material, Scene, SceneParts, Shape};
use isolux::units::Rgb;
use isolux_formats::lightmap::Target;
use isolux_formats::map_glb::{Preview, VertexColours, VertexFile, write_vertices};
use serde_json::Value;
use std::f64::consts::PI;

const PREVIEW: Preview = Preview { exposure_m2_cd: 0.01, white_cd_m2: 400.0 };
/// Of a lamp beside the card.
const LAMP_CD_M2: [f64; 3] = [9000.0, 8000.0, 5000.0];
/// Rounding to 32-bit floats.
const SINGLE: f64 = 1e-7;

/// The card, and two lamps that are brighter than any paper. One reflects a little, so that it carries the map.
fn scene() -> Scene {
    let mut parts: SceneParts = card::scene().to_parts();
    let luminance_cd_m2 = Rgb(LAMP_CD_M2);
    let reflectance = Rgb::grey(1e-9);
    for (name, finish, y) in
        [("lamp", Finish::BLACK, 0.0), ("grey lamp", Finish::diffuse(reflectance), 2.0)]
    {
        let finish = Finish { luminance_cd_m2, ..finish };
        parts.materials.push(Material::one_sided(name, finish));
        parts.shapes.push(Shape {
            name: name.into(),
            positions: vec![[3.0, y, 0.0], [4.0, y, 0.0], [4.0, y + 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            material: parts.materials.len() as u32 - 1,
            ..Shape::default()
        });
    }
    Scene::assemble(parts).unwrap()
}

struct Written {
    json: Value,
    binary: Vec<u8>,
    made: VertexColours,
}

impl Written {
    fn of(target: Target, white_cd_m2: Option<f64>) -> Self {
        let scene = scene();
        let map = card::map(&scene);
        Self::with((&scene, &map), (target, white_cd_m2))
    }

    fn with(
        (scene, map): (&Scene, &IlluminationMap),
        (target, white_cd_m2): (Target, Option<f64>),
    ) -> Self {
        let file = VertexFile { scene, map, preview: PREVIEW, target, white_cd_m2, lux: None };
        let made = write_vertices(&file).unwrap();
        assert_eq!(made, write_vertices(&file).unwrap());
        let bytes = &made.bytes;
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&bytes[20..20 + word(12)]).unwrap();
        Self { json, binary: bytes[28 + word(12)..].to_vec(), made }
    }

    fn primitives(&self, mesh: &str) -> &[Value] {
        let meshes = self.json["meshes"].as_array().unwrap();
        let found = meshes.iter().find(|found| found["name"] == mesh).unwrap();
        found["primitives"].as_array().unwrap()
    }

    /// Colours of a primitive as a consumer takes them.
    fn colours(&self, primitive: &Value) -> Vec<[f64; 3]> {
        let at = |value: &Value| value.as_u64().unwrap() as usize;
        let accessor = &self.json["accessors"][at(&primitive["attributes"]["COLOR_0"])];
        let view = &self.json["bufferViews"][at(&accessor["bufferView"])];
        let bytes = &self.binary[at(&view["byteOffset"])..][..at(&view["byteLength"])];
        let count = at(&accessor["count"]);
        let found: Vec<[f64; 3]> = match (at(&accessor["componentType"]), accessor["type"].as_str())
        {
            (5126, Some("VEC3")) => {
                let floats = bytes.as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b));
                floats.map(f64::from).collect::<Vec<_>>().as_chunks::<3>().0.to_vec()
            }
            (5123, Some("VEC4")) => {
                assert_eq!(accessor["normalized"], true);
                let words = bytes.as_chunks::<2>().0.iter().map(|b| u16::from_le_bytes(*b));
                let shares: Vec<f64> = words.map(|w| f64::from(w) / 65_535.0).collect();
                shares.as_chunks::<4>().0.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
            }
            other => panic!("{other:?}"),
        };
        assert_eq!(found.len(), count);
        found
    }

    /// What is shown of a mesh that carries no map: the base colour of its material, linear.
    fn colour_of_material(&self, mesh: &str) -> [f64; 3] {
        let primitive = &self.primitives(mesh)[0];
        assert!(primitive["attributes"].get("COLOR_0").is_none());
        let material = primitive["material"].as_u64().unwrap() as usize;
        let look = &self.json["materials"][material]["pbrMetallicRoughness"];
        let factor = &look["baseColorFactor"];
        [0, 1, 2].map(|k| factor[k].as_f64().unwrap())
    }

    /// Of all vertices of the front of a mesh, luminance by the formula of the file, cd/m2.
    fn luminances(&self, mesh: &str) -> Vec<[f64; 3]> {
        let note = &self.json["extras"]["isolux_vertices"];
        assert_eq!(note["formula"], "luminance = COLOR_0 * base colour texture * white_cd_m2");
        let white = note["white_cd_m2"].as_f64().unwrap();
        assert!((note["exposure_m2_cd"].as_f64().unwrap() * white - 1.0).abs() < f64::EPSILON);
        let colours = self.colours(&self.primitives(mesh)[0]).into_iter();
        colours.map(|rgb| rgb.map(|c| c * white)).collect()
    }
}

fn expected() -> [f64; 3] {
    ILLUMINANCE_LX.map(|lx| REFLECTANCE * lx / PI)
}

#[track_caller]
fn assert_all(found: &[[f64; 3]], expected: [f64; 3], tolerance: f64) {
    assert!(!found.is_empty());
    for rgb in found {
        for (found, expected) in rgb.iter().zip(expected) {
            assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
        }
    }
}

/// Engines show the base colour of unlit materials times COLOR_0, both linear.
#[test]
fn engines_get_luminance_in_proportion() {
    for (target, _) in Target::ALL.into_iter().filter(|(target, _)| *target != Target::Viewer) {
        let written = Written::of(target, None);
        let white = written.made.white_cd_m2;
        // Of the paper the brightest channel has 132.4 cd/m2: the lamp does not count, and is cut.
        assert_eq!(white, 140.0, "{target:?}");
        assert_all(&written.luminances("card"), expected(), SINGLE * white);
        assert_all(&written.luminances("grey lamp"), [white; 3], SINGLE * white);
        assert_eq!(written.colour_of_material("lamp"), [1.0; 3], "{target:?}");
        assert_eq!(written.made.above_white, 3, "{target:?}");
        assert!((written.made.largest * white / LAMP_CD_M2[0] - 1.0).abs() < SINGLE);
        let wide = Written::of(target, Some(10_000.0));
        assert_all(&wide.luminances("card"), expected(), SINGLE * 1e4);
        assert_all(&wide.luminances("grey lamp"), LAMP_CD_M2, SINGLE * 1e4);
        let lamp = wide.colour_of_material("lamp");
        assert_all(&[lamp.map(|c| c * 1e4)], LAMP_CD_M2, SINGLE * 1e4);
        assert_eq!((wide.made.above_white, wide.made.white_cd_m2), (0, 10_000.0));
    }
}

/// Finished colours: the same numbers as in the map itself.
#[test]
fn viewers_get_the_colours_of_the_map() {
    let written = Written::of(Target::Viewer, None);
    let [r, g, b] = expected();
    let shown = PREVIEW.colour(Rgb::new(r, g, b));
    assert_all(&written.colours(&written.primitives("card")[0]), shown, 0.5 / 65_535.0);
    assert_eq!((written.made.exposure_m2_cd, written.made.white_cd_m2), (0.01, 400.0));
    assert_eq!(written.made.above_white, 0);
}

/// What has a map is unlit, carries nothing but its colour and leaves the map and its lights out.
#[test]
fn files_hold_what_is_shown_and_no_more() {
    for (target, name) in Target::ALL {
        let written = Written::of(target, None);
        let json = &written.json;
        assert_eq!(json["extensionsUsed"], serde_json::json!(["KHR_materials_unlit"]));
        assert!(json.get("extensions").is_none() && json["extras"].get("isolux").is_none());
        assert_eq!(json["extras"]["isolux_vertices"]["target"], name);
        for material in json["materials"].as_array().unwrap() {
            assert!(material["extensions"]["KHR_materials_unlit"].is_object());
        }
        for (mesh, is_lit) in [("card", true), ("table", true), ("mirror", false)] {
            for primitive in written.primitives(mesh) {
                let attributes = primitive["attributes"].as_object().unwrap();
                let names: Vec<&str> = attributes.keys().map(String::as_str).collect();
                let due = if is_lit {
                    &["COLOR_0", "NORMAL", "POSITION"][..]
                } else {
                    &["NORMAL", "POSITION"]
                };
                assert_eq!(names, due, "{mesh}");
            }
        }
        // The table is seen from both sides, the back standing off for Blender alone.
        let heights = written.primitives("table").iter().map(|primitive| {
            let positions = primitive["attributes"]["POSITION"].as_u64().unwrap();
            json["accessors"][positions as usize]["max"][2].as_f64().unwrap()
        });
        let heights: Vec<f64> = heights.collect();
        assert_eq!(heights.len(), 2);
        assert_eq!(heights[0] != heights[1], target == Target::Blender, "{heights:?}");
    }
}

/// Where nothing is known there is no white to go by, and no light to show.
#[test]
fn a_map_of_nothing_is_black() {
    let scene = card::scene();
    let mut map = card::map(&scene);
    map.values.fill(None);
    let written = Written::with((&scene, &map), (Target::Three, None));
    assert_eq!(written.made.white_cd_m2, 1.0);
    assert_all(&written.colours(&written.primitives("card")[0]), [0.0; 3], SINGLE);
}
