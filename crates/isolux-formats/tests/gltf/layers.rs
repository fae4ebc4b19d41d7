//! Extensions of materials: specular, clear coat, volume, unlit, textures of other kinds.

use crate::build::{File, assert_warns, png, read_in};
use isolux::scene::{Body, Dielectric, Finish, Scene, SceneParts};
use isolux::units::Rgb;
use isolux_formats::{load, scene_toml};
use serde_json::{Value, json};

/// Factors are stored as `f32`.
const SINGLE_ROUNDING: f64 = 1e-7;

/// Mean of Schlick's reflectance over the cosine-weighted hemisphere.
fn mean_albedo(f0: f64) -> f64 {
    f0 + (1.0 - f0) / 21.0
}

fn with_extensions(extensions: Value) -> File {
    let mut file = File::triangle();
    file.json["materials"][0]["extensions"] = extensions;
    file.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = json!(0.5);
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
fn specular() {
    let finish = |specular: Value| {
        let parts = with_extensions(json!({"KHR_materials_specular": specular})).parts();
        let finish = front(&parts).clone();
        Scene::assemble(parts).unwrap();
        finish
    };
    // Nothing said, nothing changed.
    assert_near(finish(json!({})).gloss.unwrap().f0, [0.04; 3]);
    let none = finish(json!({"specularFactor": 0}));
    assert_eq!(none.gloss, None);
    assert_near(none.diffuse.colour, [0.5; 3]);
    let half = finish(json!({"specularFactor": 0.5, "specularColorFactor": [1, 2, 0.5]}));
    assert_near(half.gloss.unwrap().f0, [0.02, 0.04, 0.01]);
    // What is left for diffuse reflection is the same in all channels, as the extension asks.
    assert_near(half.diffuse.colour, [0.5 * (1.0 - mean_albedo(0.04)); 3]);
    // Cut at one before the factor is applied.
    let strong = finish(json!({"specularFactor": 0.5, "specularColorFactor": [100, 100, 100]}));
    assert_near(strong.gloss.unwrap().f0, [0.5; 3]);
}

/// The strength is in alpha, the colour in sRGB: half of the pixels are white and opaque, the others clear.
#[test]
fn specular_textures() {
    let mut file = with_extensions(json!({"KHR_materials_specular": {
        "specularTexture": {"index": 0}, "specularColorTexture": {"index": 1},
    }}));
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = image::RgbaImage::from_raw(2, 1, vec![255, 255, 255, 255, 255, 255, 255, 0]);
    picture.unwrap().write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    let clear = file.view(&bytes.into_inner());
    let colour = file.view(&png(&[[255, 0, 0], [0, 0, 0]]));
    file.json["images"] = json!([{"bufferView": clear}, {"bufferView": colour}]);
    file.json["textures"] = json!([{"source": 0}, {"source": 1}]);
    let loaded = file.load();
    let place = "materials[0].extensions.KHR_materials_specular";
    assert_warns(&loaded, place, "only the mean of the specularTexture");
    assert_warns(&loaded, place, "only the mean of the specularColorTexture");
    assert_near(front(&loaded.value).gloss.unwrap().f0, [0.04 * 0.5 * 0.5, 0.0, 0.0]);
}

#[test]
fn clear_coat() {
    let finish = |extensions: Value| {
        let parts = with_extensions(extensions).parts();
        let finish = front(&parts).clone();
        Scene::assemble(parts).unwrap();
        finish
    };
    let bare = finish(json!({}));
    assert_eq!(finish(json!({"KHR_materials_clearcoat": {}})), bare);
    let coat = json!({"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.1});
    let coated = finish(json!({"KHR_materials_clearcoat": coat}));
    let of_coat = 0.5 * mean_albedo(0.04);
    assert_near(coated.diffuse.colour, [bare.diffuse.colour.0[0] * (1.0 - of_coat); 3]);
    // The base keeps its gloss below: the coat takes from it by the angle.
    assert_eq!(coated.gloss, bare.gloss);
    let coat = coated.coat.unwrap();
    assert!((coat.cover - 0.5).abs() < SINGLE_ROUNDING);
    assert!((coat.alpha - 0.01).abs() < SINGLE_ROUNDING);
    // Over nothing that shines it is the coat alone.
    let alone = finish(json!({
        "KHR_materials_specular": {"specularFactor": 0},
        "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.2},
    }));
    assert_eq!(alone.gloss, None);
    assert!((alone.coat.unwrap().alpha - 0.04).abs() < SINGLE_ROUNDING);
    assert_near(alone.glossy_f0(), [0.04; 3]);
}

#[test]
fn specular_glossiness() {
    let material = |extension: Value| {
        let parts =
            with_extensions(json!({"KHR_materials_pbrSpecularGlossiness": extension})).parts();
        let finish = front(&parts).clone();
        Scene::assemble(parts).unwrap();
        finish
    };
    let paint = material(json!({
        "diffuseFactor": [0.8, 0.4, 0.2, 1], "specularFactor": [0.1, 0.2, 0.1], "glossinessFactor": 0.5,
    }));
    assert_near(paint.diffuse.colour, [0.8, 0.4, 0.2].map(|c| c * (1.0 - mean_albedo(0.2))));
    assert_near(paint.gloss.unwrap().f0, [0.1, 0.2, 0.1]);
    assert_eq!(paint.gloss.unwrap().alpha, 0.25);
    // What the extension leaves out is a white mirror.
    let default = material(json!({}));
    assert!(default.diffuse.colour.is_black());
    assert_near(default.gloss.unwrap().f0, [1.0; 3]);
}

/// The diffuse texture is read with its own coordinates, and the means of the other are in colour and alpha.
#[test]
fn specular_glossiness_textures() {
    let mut file = textured(json!({"source": 0}), json!([{}]));
    let view = file.view(&png(&[[255, 0, 0], [0, 0, 0]]));
    file.json["images"] = json!([{"bufferView": view}]);
    let shifted =
        json!({"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0]}}});
    file.json["materials"][0]["extensions"] = json!({"KHR_materials_pbrSpecularGlossiness": {
        "diffuseTexture": shifted, "specularGlossinessTexture": {"index": 0},
    }});
    let loaded = file.load();
    assert_warns(&loaded, "specularGlossinessTexture", "only the mean");
    assert_near(front(&loaded.value).gloss.unwrap().f0, [0.5, 0.0, 0.0]);
    assert_eq!(front(&loaded.value).diffuse.texture, Some(0));
    assert_eq!(loaded.value.shapes[0].uvs.as_deref(), Some(&[[0.25, 0.0]; 3][..]));
}

#[test]
fn refused() {
    let table = [
        ("specularFactor", json!({"KHR_materials_specular": {"specularFactor": 1.5}})),
        (
            "specularColorFactor",
            json!({"KHR_materials_specular": {"specularColorFactor": [-1, 0, 0]}}),
        ),
        ("KHR_materials_specular", json!({"KHR_materials_specular": {"specularFactor": "much"}})),
        ("clearcoatFactor", json!({"KHR_materials_clearcoat": {"clearcoatFactor": -1}})),
        ("KHR_materials_clearcoat", json!({"KHR_materials_clearcoat": 7})),
        (
            "thicknessFactor",
            json!({"KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_volume": {"thicknessFactor": -1}}),
        ),
        (
            "attenuationDistance",
            json!({"KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 0,
                "attenuationColor": [0.5, 0.5, 0.5]}}),
        ),
    ];
    for (place, extensions) in table {
        let Err(problems) = with_extensions(extensions).read() else { panic!("{place}: accepted") };
        let [problem] = &problems.0[..] else { panic!("{problems}") };
        assert!(problem.place.ends_with(place), "{place}: {problems}");
    }
}

/// A body 0.2 m thick of glass that leaves a quarter of green after 0.1 m: a sixteenth on the whole way, and
/// a quarter at each of the two borders.
#[test]
fn absorption_in_a_volume() {
    let mut file = with_extensions(json!({
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {
            "thicknessFactor": 0.2, "attenuationDistance": 0.1, "attenuationColor": [1, 0.25, 1],
        },
    }));
    file.json["materials"][0]["pbrMetallicRoughness"] =
        json!({"metallicFactor": 0, "roughnessFactor": 0});
    let loaded = file.load();
    assert_warns(&loaded, "materials[0].extensions.KHR_materials_volume", "absorption");
    let Body::Dielectric(Dielectric { transmittance, thin, .. }) = loaded.value.materials[0].body
    else {
        panic!("opaque")
    };
    assert!(!thin);
    assert_near(transmittance, [1.0, 0.25, 1.0]);
    // Without a colour nothing is absorbed, and nothing is to be said.
    file.json["materials"][0]["extensions"]["KHR_materials_volume"] =
        json!({"thicknessFactor": 0.2, "attenuationDistance": 0.1});
    file.parts();
}

/// Red in sRGB of 188 is 0.503 in linear light.
fn unlit() -> File {
    let mut file = with_extensions(json!({"KHR_materials_unlit": {}}));
    file.json["materials"][0]["pbrMetallicRoughness"] =
        json!({"baseColorFactor": [0.8, 0.4, 0.2, 1]});
    file
}

/// Without more said an unlit surface is diffuse, though the file leaves its metal at glTF's 1.
#[test]
fn unlit_is_diffuse() {
    let loaded = unlit().load();
    assert_warns(&loaded, "materials[0].extensions.KHR_materials_unlit", "taken as diffuse");
    let finish = front(&loaded.value);
    assert_near(finish.diffuse.colour, [0.8, 0.4, 0.2]);
    assert_eq!(finish.gloss, None);
    assert!(!finish.is_emitter());
}

#[test]
fn unlit_shines_where_asked() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("sign.glb"), unlit().glb()).unwrap();
    let write = |more: &str| {
        let path = directory.path().join("scene.toml");
        let text = format!("[[geometry]]\nfile = \"sign.glb\"\n{more}\n");
        std::fs::write(&path, text).unwrap();
        scene_toml::read(&path)
    };
    let loaded = write("unlit_luminance_cd_m2 = 500").unwrap();
    assert_eq!(loaded.warnings, []);
    let finish = front(&loaded.value);
    assert_near(finish.luminance_cd_m2 / 500.0, [0.8, 0.4, 0.2]);
    assert!(finish.diffuse.colour.is_black());
    let problems = write("unlit_luminance_cd_m2 = 0").unwrap_err();
    assert!(problems.to_string().contains("above 0"), "{problems}");
    std::fs::write(directory.path().join("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let text = "[[geometry]]\nfile = \"a.obj\"\nunlit_luminance_cd_m2 = 5\n";
    std::fs::write(directory.path().join("b.toml"), text).unwrap();
    let problems = load(&directory.path().join("b.toml")).unwrap_err();
    assert!(problems.to_string().contains("not glTF"), "{problems}");
}

fn textured(texture: Value, images: Value) -> File {
    let mut file = File::triangle();
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
    file.json["textures"] = json!([texture]);
    file.json["images"] = images;
    let uvs = file.accessor(&[0; 24], "VEC2", 5126, 3);
    file.primitive()["attributes"]["TEXCOORD_0"] = json!(uvs);
    file
}

/// WebP is read; of a texture with a PNG beside it the PNG is taken.
#[test]
fn webp_and_fallbacks() {
    let mut webp = std::io::Cursor::new(Vec::new());
    let picture = image::RgbImage::from_pixel(2, 1, image::Rgb([10, 20, 30]));
    picture.write_to(&mut webp, image::ImageFormat::WebP).unwrap();
    let mut file =
        textured(json!({"extensions": {"EXT_texture_webp": {"source": 0}}}), json!([{}]));
    let view = file.view(&webp.into_inner());
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/webp"}]);
    file.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
    assert_eq!(file.parts().textures[0].srgb, [10, 20, 30, 10, 20, 30]);

    let mut file = textured(
        json!({"source": 1, "extensions": {"KHR_texture_basisu": {"source": 0}}}),
        json!([{}, {}]),
    );
    let view = file.view(&png(&[[1, 2, 3]]));
    file.json["images"] = json!([{"uri": "no.ktx2"}, {"bufferView": view}]);
    file.json["extensionsUsed"] = json!(["KHR_texture_basisu"]);
    let loaded = file.load();
    assert_warns(&loaded, "extensionsUsed", "KHR_texture_basisu");
    assert_eq!(loaded.value.textures[0].srgb, [1, 2, 3]);

    file.json["textures"][0].as_object_mut().unwrap().remove("source");
    let problems = file.read().unwrap_err();
    assert_eq!(problems.0[0].place, "textures[0]");
    assert!(problems.0[0].what.contains("KHR_texture_basisu"), "{problems}");
    assert!(problems.0[0].remedy.contains("ktxdecompress"), "{problems}");
}

/// A WebP cut short, or with a byte turned over, is read or refused.
#[test]
fn spoilt_webp() {
    let mut webp = std::io::Cursor::new(Vec::new());
    let picture = image::RgbImage::from_fn(16, 16, |x, y| image::Rgb([x as u8, y as u8, 9]));
    picture.write_to(&mut webp, image::ImageFormat::WebP).unwrap();
    let webp = webp.into_inner();
    let directory = tempfile::tempdir().unwrap();
    let read = |bytes: &[u8]| {
        let texture = json!({"extensions": {"EXT_texture_webp": {"source": 0}}});
        let mut file = textured(texture, json!([{}]));
        let view = file.view(bytes);
        file.json["images"] = json!([{"bufferView": view}]);
        read_in(directory.path(), "a.glb", &file.glb())
    };
    assert!(read(&webp).is_ok());
    for at in 0..webp.len() {
        assert!(read(&webp[..at]).is_err(), "{at}");
        let mut bytes = webp.clone();
        bytes[at] = !bytes[at];
        let _ = read(&bytes);
    }
}
