//! The parts of a written `.glb`.

use image::DynamicImage;
use isolux_formats::lightmap::Target;
use isolux_formats::map_glb::{self, Preview, TexelFile, write_texels};
use serde_json::Value;

/// A file for a target, as its JSON and its bytes.
pub(crate) struct Glb {
    pub json: Value,
    binary: Vec<u8>,
}

impl Glb {
    pub(crate) fn of(target: Target) -> Self {
        let scene = crate::card::scene();
        let map = crate::card::map(&scene);
        let lightmap = crate::card::lightmap(&scene, &map);
        let preview = Preview { exposure_m2_cd: 0.01, white_cd_m2: 400.0 };
        let file = TexelFile {
            scene: &scene,
            map: &map,
            lightmap: &lightmap,
            preview,
            target,
            with_record: false,
        };
        let bytes = write_texels(&file).unwrap();
        assert_eq!(bytes, write_texels(&file).unwrap());
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&bytes[20..20 + word(12)]).unwrap();
        Self { json, binary: bytes[28 + word(12)..].to_vec() }
    }

    pub(crate) fn material(&self, name: &str) -> &Value {
        let materials = self.json["materials"].as_array().unwrap();
        materials.iter().find(|m| m["name"] == name).unwrap()
    }

    /// The picture of a texture.
    pub(crate) fn picture(&self, texture: &Value) -> DynamicImage {
        let source = self.json["textures"][texture.as_u64().unwrap() as usize]["source"].as_u64();
        let image = &self.json["images"][source.unwrap() as usize];
        let view = &self.json["bufferViews"][image["bufferView"].as_u64().unwrap() as usize];
        let start = view["byteOffset"].as_u64().unwrap() as usize;
        let length = view["byteLength"].as_u64().unwrap() as usize;
        image::load_from_memory(&self.binary[start..start + length]).unwrap()
    }
}

#[test]
fn every_lit_surface_has_its_place_in_the_lightmap_and_the_others_have_none() {
    let glb = Glb::of(Target::Viewer);
    for mesh in glb.json["meshes"].as_array().unwrap() {
        for primitive in mesh["primitives"].as_array().unwrap() {
            let attributes = &primitive["attributes"];
            let is_lit = mesh["name"] != "mirror";
            assert_eq!(attributes.get("TEXCOORD_1").is_some(), is_lit, "{mesh}");
            // glTF numbers sets from 0 on.
            assert_eq!(attributes.get("TEXCOORD_0").is_some(), is_lit, "{mesh}");
        }
    }
    // Of the card one side, of the table both, of the mirror one.
    let counts: Vec<usize> = glb.json["meshes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|mesh| mesh["primitives"].as_array().unwrap().len())
        .collect();
    assert_eq!(counts, [1, 2, 1]);
}

#[test]
fn extensions_are_declared_where_they_are_used() {
    for (target, _) in Target::ALL {
        let glb = Glb::of(target);
        let declared: Vec<&str> = glb.json["extensionsUsed"]
            .as_array()
            .unwrap()
            .iter()
            .map(|name| name.as_str().unwrap())
            .collect();
        let text = glb.json["materials"].to_string();
        for name in ["KHR_materials_specular", "KHR_materials_emissive_strength", "MOZ_lightmap"] {
            assert_eq!(declared.contains(&name), text.contains(name), "{target:?} {name}");
        }
        assert_eq!(glb.json["extras"]["isolux_lightmap"]["target"], target.name());
        assert!(glb.json.get("extensions").is_none(), "no light beside the lightmap: {target:?}");
    }
}

/// The texels of a map come back with every bit, and do not stand in the way of the map.
#[test]
fn a_map_keeps_its_texels() {
    let scene = crate::card::scene();
    let map = crate::card::map(&scene);
    let lightmap = crate::card::lightmap(&scene, &map);
    let preview = Preview { exposure_m2_cd: 0.01, white_cd_m2: 400.0 };
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("map.glb");
    let file = TexelFile {
        scene: &scene,
        map: &map,
        lightmap: &lightmap,
        preview,
        target: Target::Viewer,
        with_record: true,
    };
    std::fs::write(&path, write_texels(&file).unwrap()).unwrap();
    let read = map_glb::read_with_texels(&path).unwrap().value;
    assert_eq!((read.lightmap, &read.map), (Some(lightmap), &map));
    assert_eq!(map_glb::read(&path).unwrap().value.1, map);
    std::fs::write(&path, map_glb::write(&scene, &map, &preview).unwrap()).unwrap();
    assert_eq!(map_glb::read_with_texels(&path).unwrap().value.lightmap, None);
}
