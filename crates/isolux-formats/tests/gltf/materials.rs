//! Metallic-roughness and its extensions to finishes.

use crate::build::{FLOAT, File, U8, U16, assert_warns, floats, png, push};
use isolux::scene::{Body, Dielectric, Finish, Gloss, Material, Scene, SceneParts};
use isolux::units::Rgb;
use serde_json::{Value, json};

/// Factors are stored as `f32`.
const SINGLE_ROUNDING: f64 = 1e-7;
/// Mean over the cosine-weighted hemisphere of Schlick's reflectance for f0 = 0.04.
const GLASS_ALBEDO: f64 = 0.04 + 0.96 / 21.0;

fn with_material(material: Value) -> File {
    let mut file = File::triangle();
    file.json["materials"][0] = material;
    file
}

fn front(parts: &SceneParts) -> &Finish {
    parts.materials[0].finish(false).expect("opaque")
}

#[track_caller]
fn assert_near(found: Rgb, expected: [f64; 3]) {
    let far = found.0.iter().zip(expected).any(|(a, b)| (a - b).abs() > SINGLE_ROUNDING);
    assert!(!far, "{found:?} is not {expected:?}");
}

#[test]
fn dielectric_metal_and_between() {
    let finish = |metallic: f64, roughness: f64| {
        let parts = with_material(json!({"pbrMetallicRoughness": {
            "baseColorFactor": [0.8, 0.4, 0.2, 1],
            "metallicFactor": metallic, "roughnessFactor": roughness,
        }}))
        .parts();
        let finish = front(&parts).clone();
        Scene::assemble(parts).unwrap();
        (finish.diffuse.colour, finish.gloss.unwrap())
    };
    let (diffuse, gloss) = finish(0.0, 0.5);
    assert_near(diffuse, [0.8, 0.4, 0.2].map(|b| b * (1.0 - GLASS_ALBEDO)));
    assert_near(gloss.f0, [0.04; 3]);
    assert_eq!(gloss.alpha, 0.25);
    let (diffuse, gloss) = finish(1.0, 1.0);
    assert_near(diffuse, [0.0; 3]);
    assert_near(gloss.f0, [0.8, 0.4, 0.2]);
    assert_eq!(gloss.alpha, 1.0);
    let (diffuse, gloss) = finish(0.5, 0.0);
    assert_near(diffuse, [0.8, 0.4, 0.2].map(|b| 0.5 * b * (1.0 - GLASS_ALBEDO)));
    assert_near(gloss.f0, [0.42, 0.22, 0.12]);
    assert_eq!(gloss.alpha, 1e-3);
}

/// "metallic 1, roughness 0" is a Fresnel mirror, not [`Finish::mirror`], the same at every angle.
#[test]
fn smooth_metal_is_no_constant_mirror() {
    let parts = with_material(json!({"pbrMetallicRoughness": {"roughnessFactor": 0}})).parts();
    assert!(front(&parts).mirror.is_black());
    assert_eq!(front(&parts).gloss, Some(Gloss { f0: Rgb::WHITE, alpha: 1e-3 }));
}

#[test]
fn sides() {
    let mut file = with_material(json!({"name": "card"}));
    let material = file.parts().materials.remove(0);
    assert_eq!(material.name, "card");
    assert_eq!(material.finish(true), Some(&Finish::BLACK));
    file.json["materials"][0]["doubleSided"] = json!(true);
    let material = file.parts().materials.remove(0);
    assert_eq!(material.finish(true), material.finish(false));
}

#[test]
fn no_material() {
    let mut file = File::triangle();
    file.primitive().as_object_mut().unwrap().remove("material");
    let loaded = file.load();
    assert_warns(&loaded, "meshes[0].primitives[0]", "no material");
    assert_eq!(front(&loaded.value).gloss, Some(Gloss { f0: Rgb::WHITE, alpha: 1.0 }));
}

#[test]
fn refused() {
    let table = [
        ("baseColorFactor", json!({"pbrMetallicRoughness": {"baseColorFactor": [1.1, 0, 0, 1]}})),
        ("metallicFactor", json!({"pbrMetallicRoughness": {"metallicFactor": -0.1}})),
        ("roughnessFactor", json!({"pbrMetallicRoughness": {"roughnessFactor": 2}})),
        ("emissiveFactor", json!({"emissiveFactor": [-1, 0, 0]})),
        (
            "emissiveFactor",
            json!({"emissiveFactor": [1, 1, 1],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": -1}}}),
        ),
        ("KHR_materials_ior.ior", json!({"extensions": {"KHR_materials_ior": {"ior": 0.5}}})),
        (
            "transmissionFactor",
            json!({"extensions":
            {"KHR_materials_transmission": {"transmissionFactor": 7}}}),
        ),
    ];
    for (place, material) in table {
        let Err(problems) = with_material(material).read() else { panic!("{place}: accepted") };
        let [problem] = &problems.0[..] else { panic!("{problems}") };
        assert!(problem.place.starts_with("materials[0].") && problem.place.ends_with(place));
    }
}

#[test]
fn emission() {
    let mut file = with_material(json!({
        "emissiveFactor": [1, 0.5, 0.25],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 200}},
    }));
    let parts = file.parts();
    assert_near(front(&parts).luminance_cd_m2, [200.0, 100.0, 50.0]);
    assert!(!parts.materials[0].finish(true).unwrap().is_emitter());
    // White and black: linear mean one half.
    let view = file.view(&png(&[[255; 3], [0; 3]]));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    file.json["textures"] = json!([{"source": 0}]);
    file.json["materials"][0]["emissiveTexture"] = json!({"index": 0});
    for (uvs, share, warnings) in [
        ([0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 0.75, 1),
        ([0.1, 0.1, 0.4, 0.1, 0.1, 0.4], 1.0, 0),
        ([0.6, 0.1, 0.9, 0.1, 0.6, 0.4], 0.0, 0),
    ] {
        let mut file = file.clone();
        let accessor = file.accessor(&floats(&uvs), "VEC2", FLOAT, 3);
        file.primitive()["attributes"]["TEXCOORD_0"] = json!(accessor);
        let loaded = file.load();
        let expected = [200.0, 100.0, 50.0].map(|luminance| share * luminance);
        assert_near(front(&loaded.value).luminance_cd_m2, expected);
        assert_eq!(loaded.warnings.len(), warnings, "{:?}", loaded.warnings);
        if warnings > 0 {
            assert_warns(&loaded, "meshes[0].primitives[0]", "by the mean of the emissiveTexture");
        }
        assert_eq!(loaded.value.textures, []);
    }
}

#[test]
fn index_of_refraction() {
    let ior = |ior: f64| {
        let parts = with_material(json!({
            "pbrMetallicRoughness": {"metallicFactor": 0},
            "extensions": {"KHR_materials_ior": {"ior": ior}},
        }))
        .parts();
        front(&parts).clone()
    };
    assert_near(ior(2.0).gloss.unwrap().f0, [1.0 / 9.0; 3]);
    assert_eq!((ior(1.0).gloss, ior(1.0).diffuse.colour), (None, Rgb::WHITE));
    assert_eq!(ior(0.0).gloss.unwrap().f0, Rgb::WHITE);
    assert!(ior(0.0).diffuse.colour.is_black());
}

#[test]
fn glass() {
    let mut file = with_material(json!({
        "pbrMetallicRoughness":
            {"baseColorFactor": [0.5, 0.75, 1, 1], "metallicFactor": 0, "roughnessFactor": 0},
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_ior": {"ior": 1.25},
        },
    }));
    let body = |parts: SceneParts| match parts.materials[0].body {
        Body::Dielectric(dielectric) => dielectric,
        Body::Opaque { .. } => panic!("opaque"),
    };
    let tint = Rgb::new(0.5, 0.75, 1.0);
    let pane = Dielectric { ior: 1.25, transmittance: tint, thin: true };
    assert_eq!(body(file.parts()), pane);
    let extensions = &mut file.json["materials"][0]["extensions"];
    extensions["KHR_materials_volume"] = json!({"thicknessFactor": 0.1});
    assert_eq!(body(file.parts()), Dielectric { thin: false, ..pane });
    let extensions = &mut file.json["materials"][0]["extensions"];
    extensions["KHR_materials_volume"] = json!({"thicknessFactor": 0});
    extensions["KHR_materials_transmission"]["transmissionFactor"] = json!(0.5);
    file.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = json!(0.5);
    let loaded = file.load();
    assert_warns(&loaded, "materials[0].extensions.KHR_materials_transmission", "absorbed");
    assert_warns(&loaded, "materials[0].extensions.KHR_materials_transmission", "smooth");
    assert_eq!(body(loaded.value), Dielectric { transmittance: tint * 0.5, ..pane });
    file.json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = json!(1);
    assert!(matches!(file.load().value.materials[0].body, Body::Opaque { .. }));
}

#[test]
fn left_out_with_a_warning() {
    let mut file = with_material(json!({
        "alphaMode": "BLEND", "normalTexture": {"index": 0}, "occlusionTexture": {"index": 0},
    }));
    let loaded = file.load();
    assert_warns(&loaded, "materials[0].alphaMode", "opaque everywhere");
    assert_warns(&loaded, "materials[0].normalTexture", "normal maps");
    assert_warns(&loaded, "materials[0].occlusionTexture", "occlusion maps");
    file.json["materials"][0]["alphaMode"] = json!("MASK");
    assert_warns(&file.load(), "materials[0].alphaMode", "opaque everywhere");
}

/// Red left, blue right, on texture coordinates u = v = 0, 1, 0.5.
fn textured() -> File {
    let mut file = File::triangle();
    let view = file.view(&png(&[[255, 0, 0], [0, 0, 255]]));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    file.json["textures"] = json!([{"source": 0}]);
    let uvs = file.accessor(&floats(&[0.0, 0.0, 1.0, 1.0, 0.5, 0.5]), "VEC2", FLOAT, 3);
    file.primitive()["attributes"]["TEXCOORD_0"] = json!(uvs);
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
    file
}

#[test]
fn texture_of_the_base_colour() {
    let parts = textured().parts();
    let [texture] = &parts.textures[..] else { panic!("{:?}", parts.textures) };
    assert_eq!((texture.width, texture.height), (2, 1));
    assert_eq!(texture.srgb, [255, 0, 0, 0, 0, 255]);
    let diffuse = front(&parts).diffuse;
    assert_eq!(diffuse.texture, Some(0));
    assert_near(diffuse.colour, [0.5 * (1.0 - GLASS_ALBEDO); 3]);
    assert_eq!(parts.shapes[0].uvs.as_deref(), Some(&[[0.0, 0.0], [1.0, 1.0], [0.5, 0.5]][..]));
    Scene::assemble(parts).unwrap();
}

#[test]
fn jpeg_as_data_uri_shared_by_two_materials() {
    let mut jpeg = std::io::Cursor::new(Vec::new());
    let grey = image::RgbImage::from_pixel(8, 8, image::Rgb([128; 3]));
    grey.write_to(&mut jpeg, image::ImageFormat::Jpeg).unwrap();
    let percent: String = jpeg.into_inner().iter().map(|b| format!("%{b:02x}")).collect();
    let mut file = textured();
    file.json["images"] = json!([{"uri": format!("data:image/jpeg,{percent}")}]);
    let second = file.json["materials"][0].clone();
    push(&mut file.json["materials"], second);
    let mut primitive = file.primitive().clone();
    primitive["material"] = json!(1);
    push(&mut file.json["meshes"][0]["primitives"], primitive);
    let parts = file.parts();
    assert_eq!((parts.materials.len(), parts.textures.len()), (2, 1));
    // JPEG codes a flat grey within one step.
    assert!(parts.textures[0].srgb.iter().all(|&b| b.abs_diff(128) <= 1));
}

#[test]
fn second_set_and_integer_coordinates() {
    let mut file = textured();
    let bytes = file.accessor(&[0, 255, 0, 0, 255, 0, 0, 0, 51, 51, 0, 0], "VEC2", U8, 3);
    file.json["accessors"][bytes]["normalized"] = json!(true);
    file.json["bufferViews"][3]["byteStride"] = json!(4);
    file.primitive()["attributes"]["TEXCOORD_1"] = json!(bytes);
    assert!(file.shape().lightmap_uvs.is_some());
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = json!(1);
    assert_eq!(file.shape().uvs.unwrap(), [[0.0, 1.0], [1.0, 0.0], [0.2, 0.2]]);
    assert_eq!(file.shape().lightmap_uvs, None, "they are those of the picture");
    file.primitive()["attributes"].as_object_mut().unwrap().remove("TEXCOORD_1");
    let loaded = file.load();
    assert_warns(&loaded, "meshes[0].primitives[0]", "no texture coordinates");
    Scene::assemble(loaded.value).unwrap();
}

#[test]
fn texture_transform() {
    let mut file = textured();
    file.json["extensionsRequired"] = json!(["KHR_texture_transform"]);
    let texture = &mut file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"] =
        json!({"KHR_texture_transform": {"offset": [0.25, 0.5], "scale": [2, 4]}});
    assert_eq!(file.shape().uvs.unwrap(), [[0.25, 0.5], [2.25, 4.5], [1.25, 2.5]]);
    let texture = &mut file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"] = json!({"KHR_texture_transform": {"scale": "wide"}});
    let problems = file.read().unwrap_err();
    assert!(
        problems.0[0].place.ends_with("baseColorTexture.extensions.KHR_texture_transform.scale")
    );
}

#[test]
fn clamped_textures_repeat() {
    let mut file = textured();
    file.json["samplers"] = json!([{"wrapS": 33071}]);
    file.json["textures"][0]["sampler"] = json!(0);
    file.parts();
    let outside = file.accessor(&floats(&[0.0, 0.0, 1.5, 0.0, 0.0, 1.0]), "VEC2", FLOAT, 3);
    file.primitive()["attributes"]["TEXCOORD_0"] = json!(outside);
    assert_warns(&file.load(), "meshes[0].primitives[0]", "is repeated");
}

#[test]
fn textured_metal() {
    let mut file = textured();
    file.json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = json!(1);
    let loaded = file.load();
    assert_warns(&loaded, "baseColorTexture", "specular colour of a textured metal");
    assert_near(front(&loaded.value).gloss.unwrap().f0, [0.25, 0.0, 0.25]);
    assert_eq!((loaded.value.textures.len(), &loaded.value.shapes[0].uvs), (0, &None));
}

#[test]
fn metallic_roughness_texture() {
    let mut file = File::triangle();
    // Green is roughness, blue is metal, both without transfer function.
    let view = file.view(&png(&[[0, 51, 255], [0, 51, 0]]));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    file.json["textures"] = json!([{"source": 0}]);
    file.json["materials"][0]["pbrMetallicRoughness"] =
        json!({"metallicRoughnessTexture": {"index": 0}, "baseColorFactor": [0.5, 0.5, 0.5, 1]});
    let loaded = file.load();
    assert_warns(&loaded, "metallicRoughnessTexture", "only the mean");
    let gloss = front(&loaded.value).gloss.unwrap();
    assert_near(gloss.f0, [0.27; 3]);
    assert!((gloss.alpha - 0.04).abs() < SINGLE_ROUNDING);
}

#[test]
fn vertex_colours() {
    let mut file = File::triangle();
    let colours = floats(&[1.0, 0.5, 0.0, 1.0].repeat(3));
    let even = file.accessor(&colours, "VEC4", FLOAT, 3);
    file.primitive()["attributes"]["COLOR_0"] = json!(even);
    let expected = [0.5, 0.25, 0.0].map(|b| b * (1.0 - GLASS_ALBEDO));
    assert_near(front(&file.parts()).diffuse.colour, expected);

    let shorts = [[65535, 0, 0], [0, 65535, 0], [0, 0, 65535_u16]];
    let shorts: Vec<u8> = shorts.as_flattened().iter().flat_map(|c| c.to_le_bytes()).collect();
    let uneven = file.accessor(&shorts, "VEC3", U16, 3);
    file.json["accessors"][uneven]["normalized"] = json!(true);
    let mut second = file.primitive().clone();
    second["attributes"]["COLOR_0"] = json!(uneven);
    push(&mut file.json["meshes"][0]["primitives"], second);
    let loaded = file.load();
    assert_warns(&loaded, "meshes[0].primitives[1]", "vertex colours");
    let [_, mean] = &loaded.value.materials[..] else { panic!("{:?}", loaded.value.materials) };
    let diffuse = |m: &Material| m.finish(false).unwrap().diffuse.colour;
    assert_near(diffuse(mean), [(1.0 - GLASS_ALBEDO) / 6.0; 3]);
    assert_eq!(loaded.value.shapes[1].material, 1);
}
