//! The white card: written for a consumer and read back by its documented formula, it must have the luminance rho E / pi.

use crate::card::{self, ILLUMINANCE_LX, REFLECTANCE};
use crate::glb::Glb;
use image::DynamicImage;
use isolux_formats::lightmap::{Target, write_exr, write_ktx2};
use std::f64::consts::PI;

/// Luminance of the card, cd/m2.
fn expected(channel: usize) -> f64 {
    REFLECTANCE * ILLUMINANCE_LX[channel] / PI
}

/// IEC 61966-2-1.
fn linear(code: f64) -> f64 {
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

/// Linear texel in the middle of the card, between 0 and 1.
fn texel(picture: &DynamicImage) -> [f64; 3] {
    let scene = card::scene();
    let (x, y) = card::middle(&card::lightmap(&scene, &card::map(&scene)));
    match picture {
        DynamicImage::ImageRgb8(p) => p.get_pixel(x, y).0.map(|c| linear(f64::from(c) / 255.0)),
        DynamicImage::ImageRgb16(p) => p.get_pixel(x, y).0.map(|c| linear(f64::from(c) / 65_535.0)),
        other => panic!("{:?}", other.color()),
    }
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap()
}

/// Half a code of sRGB at its steep end, relative: 2.4 / 255 / 2 for 8 bits near white.
const EIGHT_BITS: f64 = 0.005;
const SIXTEEN_BITS: f64 = 2e-5;

fn check(target: Target, found: [f64; 3], tolerance: f64) {
    for (channel, found) in found.into_iter().enumerate() {
        let off = found / expected(channel) - 1.0;
        assert!(off.abs() < tolerance, "{target:?} channel {channel}: off by {off}");
    }
}

/// KHR_materials_emissive_strength: radiance = texture x factor x strength, in cd/m2; what glTFast (Unity), Godot with
/// physical light units and Blender take it for. No light of the consumer may add to it: the base is black.
#[test]
fn emission_is_luminance() {
    for target in [Target::Godot, Target::Unity, Target::Blender] {
        let glb = Glb::of(target);
        let card = glb.material("card");
        let texture = &card["emissiveTexture"];
        assert_eq!(texture["texCoord"], 1);
        assert_eq!(card["pbrMetallicRoughness"]["baseColorFactor"][0], 0.0);
        assert_eq!(card["extensions"]["KHR_materials_specular"]["specularFactor"], 0.0);
        let strength =
            number(&card["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"]);
        let factor = [0, 1, 2].map(|k| number(&card["emissiveFactor"][k]));
        let texel = texel(&glb.picture(&texture["index"]));
        let found = [0, 1, 2].map(|k| texel[k] * factor[k] * strength);
        check(target, found, SIXTEEN_BITS);
    }
}

/// three.js: irradiance += texel x lightMapIntensity (lights_fragment_maps), outgoing = irradiance x albedo / pi
/// (BRDF_Lambert), nothing taken away for a coat, as specularIntensity is 0.
#[test]
fn three_divides_by_pi() {
    let glb = Glb::of(Target::Three);
    let card = glb.material("card");
    let lightmap = &card["extensions"]["MOZ_lightmap"];
    assert_eq!(lightmap["texCoord"], 1);
    let albedo = number(&card["pbrMetallicRoughness"]["baseColorFactor"][0]);
    let texel = texel(&glb.picture(&lightmap["index"]));
    let found = texel.map(|c| c * number(&lightmap["intensity"]) * albedo / PI);
    check(Target::Three, found, EIGHT_BITS);
}

/// Bevy: indirect_light += texel x lightmap_exposure x diffuse_color (pbr_functions.wgsl).
#[test]
fn bevy_does_not() {
    let glb = Glb::of(Target::Bevy);
    let card = glb.material("card");
    let lightmap = &card["extensions"]["MOZ_lightmap"];
    let albedo = number(&card["pbrMetallicRoughness"]["baseColorFactor"][0]);
    let texel = texel(&glb.picture(&lightmap["index"]));
    let found = texel.map(|c| c * number(&lightmap["intensity"]) * albedo);
    check(Target::Bevy, found, EIGHT_BITS);
}

/// The lightmaps beside: albedo x texel, over pi where the convention says so.
#[test]
fn files_beside_hold_what_the_formula_says() {
    let scene = card::scene();
    let lightmap = card::lightmap(&scene, &card::map(&scene));
    let (x, y) = card::middle(&lightmap);
    let at = lightmap.layout.index(0, x, y);
    for (target, _) in Target::ALL {
        let convention = target.convention();
        let over = match convention.formula {
            "luminance = albedo * texel / pi" => PI,
            "luminance = albedo * texel" => 1.0,
            other => panic!("{other}"),
        };
        let exr = crate::files::colours(&write_exr(&lightmap, 0, &convention).unwrap());
        check(target, exr[at].map(|c| REFLECTANCE * f64::from(c) / over), SINGLE);
        let ktx2 = write_ktx2(&lightmap, 0, &convention).unwrap().bytes;
        let reader = ktx2::Reader::new(&ktx2[..]).unwrap();
        let words = reader.levels().next().unwrap().data.to_vec();
        let word = u32::from_le_bytes(words[4 * at..4 * at + 4].try_into().unwrap());
        let scale = 2_f64.powi((word >> 27) as i32 - 24);
        let texel = [0, 9, 18].map(|shift| f64::from(word >> shift & 0x1ff) * scale);
        check(target, texel.map(|c| REFLECTANCE * c / over), NINE_BITS);
    }
}

/// Rounding to 32-bit floats, twice.
const SINGLE: f64 = 1e-6;
/// Half a step of 256 or more.
const NINE_BITS: f64 = 1.0 / 512.0;

/// A viewer of finished colours shows what the tone curve of the preview makes of the luminance.
#[test]
fn viewers_get_finished_colours() {
    let glb = Glb::of(Target::Viewer);
    let card = glb.material("card");
    let texture = &card["emissiveTexture"];
    assert_eq!(card["extensions"].get("KHR_materials_emissive_strength"), None);
    let texel = texel(&glb.picture(&texture["index"]));
    let (exposure, white) = (0.01, 400.0);
    let luminance = 0.2126 * expected(0) + 0.7152 * expected(1) + 0.0722 * expected(2);
    let (x, w) = (exposure * luminance, exposure * white);
    let scale = exposure * (1.0 + x / (w * w)) / (1.0 + x);
    for (k, texel) in texel.into_iter().enumerate() {
        let off = texel / (scale * expected(k)) - 1.0;
        // Half a code of sRGB in the middle greys.
        assert!(off.abs() < 0.01, "{off}");
    }
}

/// Cycles shows both sides of everything: of a front and a back in one place it took either, and the card was black.
#[test]
fn backs_stand_off_for_blender() {
    for (target, _) in Target::ALL {
        let json = Glb::of(target).json;
        let meshes = json["meshes"].as_array().unwrap();
        let table = meshes.iter().find(|mesh| mesh["name"] == "table").unwrap();
        let heights = [0, 1].map(|side| {
            let positions = table["primitives"][side]["attributes"]["POSITION"].as_u64().unwrap();
            number(&json["accessors"][positions as usize]["max"][2])
        });
        // A hundred thousandth of three metres from the table to the mirror, below.
        let stand_off_m = if target == Target::Blender { 3e-5 } else { 0.0 };
        let off = (heights[0] - heights[1] - stand_off_m).abs();
        assert_eq!(heights[0], -1.0, "{target:?}");
        assert!(off < f64::from(f32::EPSILON), "{target:?}: {heights:?}");
    }
}
