//! Luminaires of KHR_lights_punctual and EXT_lights_ies, surroundings of EXT_lights_image_based.

use crate::build::{File, assert_warns, png_rgba};
use isolux::geometry::{Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, Scene};
use isolux::units::Rgb;
use serde_json::{Value, json};

/// Numbers and rotations are stored as `f32`.
const SINGLE_ROUNDING: f64 = 1e-6;

/// The triangle and one light, on node 1.
fn with_light(light: Value, node: Value) -> File {
    let mut file = File::triangle();
    file.json["extensionsRequired"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
    file.json["nodes"] = json!([{"mesh": 0}, node]);
    file.json["nodes"][1]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    file
}

fn luminaire(file: &File) -> Luminaire {
    let mut parts = file.parts();
    assert_eq!(parts.luminaires.len(), 1);
    let luminaire = parts.luminaires.remove(0);
    parts.luminaires.push(luminaire.clone());
    Scene::assemble(parts).unwrap();
    luminaire
}

#[track_caller]
fn assert_near(found: Vector, expected: [f64; 3]) {
    let far =
        <[f64; 3]>::from(found).iter().zip(expected).any(|(a, b)| (a - b).abs() > SINGLE_ROUNDING);
    assert!(!far, "{found:?} is not {expected:?}");
}

#[test]
fn point() {
    let light = json!({"type": "point", "intensity": 100, "name": "bulb"});
    let found =
        luminaire(&with_light(light, json!({"translation": [1, 2, 3], "scale": [2, 2, 2]})));
    assert_eq!((found.name.as_str(), found.group, found.colour), ("bulb", 0, Rgb::WHITE));
    let LuminaireKind::Point { position, intensity, world_from_luminaire, .. } = found.kind else {
        panic!("no point")
    };
    assert_eq!(position, Point::new(1.0, 2.0, 3.0));
    assert_eq!(intensity, IntensityDistribution::Isotropic { intensity_cd: 100.0 });
    assert_eq!(world_from_luminaire.determinant(), 1.0);
}

/// The three channels are colour times intensity; candelas are their luminance.
#[test]
fn colour() {
    let light = json!({"type": "point", "intensity": 10, "color": [1, 0.5, 0]});
    let found = luminaire(&with_light(light, json!({"name": "sodium"})));
    assert_eq!(found.name, "sodium");
    let LuminaireKind::Point {
        intensity: IntensityDistribution::Isotropic { intensity_cd }, ..
    } = found.kind
    else {
        panic!("no isotropic point")
    };
    assert!((intensity_cd - 10.0 * (0.2126 + 0.3576)).abs() < SINGLE_ROUNDING);
    assert!((found.colour.luminance() - 1.0).abs() < SINGLE_ROUNDING);
    assert_near(Vector::from((found.colour * intensity_cd).0), [10.0, 5.0, 0.0]);
}

#[test]
fn spot_shines_along_minus_z() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let light = json!({
        "type": "spot", "intensity": 50, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5},
    });
    // A quarter turn about x takes -z to +y. The scale must not show.
    let node = json!({"rotation": [half, 0, 0, half], "scale": [3, 5, 7]});
    let found = luminaire(&with_light(light, node));
    let LuminaireKind::Point { world_from_luminaire, intensity, .. } = found.kind else {
        panic!("no point")
    };
    assert_eq!(
        intensity,
        IntensityDistribution::Spot { peak_cd: 50.0, inner_rad: 0.25, outer_rad: 0.5 }
    );
    assert_near(world_from_luminaire.vector(Vector::new(0.0, 0.0, -1.0)), [0.0, 1.0, 0.0]);
    assert_near(world_from_luminaire.vector(Vector::new(1.0, 0.0, 0.0)), [1.0, 0.0, 0.0]);
    assert!((world_from_luminaire.determinant() - 1.0).abs() < SINGLE_ROUNDING);
}

#[test]
fn spot_defaults_and_reflections() {
    let light = json!({"type": "spot"});
    let found = luminaire(&with_light(light, json!({"scale": [-2, 2, 2]})));
    let LuminaireKind::Point { world_from_luminaire, intensity, .. } = found.kind else {
        panic!("no point")
    };
    let outer_rad = std::f64::consts::FRAC_PI_4;
    assert_eq!(intensity, IntensityDistribution::Spot { peak_cd: 1.0, inner_rad: 0.0, outer_rad });
    assert_eq!(world_from_luminaire.determinant(), -1.0);
}

#[test]
fn hard_spot_and_range() {
    let light = json!({
        "type": "spot", "range": 5, "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5},
    });
    let loaded = with_light(light, json!({})).load();
    assert_warns(&loaded, "extensions.KHR_lights_punctual.lights[0].spot", "soft edge");
    assert_warns(&loaded, "extensions.KHR_lights_punctual.lights[0].range", "range");
    Scene::assemble(loaded.value).unwrap();
}

#[test]
fn a_cone_within_a_narrower_one() {
    let light = json!({"type": "spot", "spot": {"innerConeAngle": 0.6, "outerConeAngle": 0.5}});
    let loaded = with_light(light, json!({})).load();
    assert_warns(&loaded, "extensions.KHR_lights_punctual.lights[0].spot", "above the outer one");
}

#[test]
fn directional() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let light = json!({"type": "directional", "intensity": 1000, "color": [1, 1, 1]});
    let found = luminaire(&with_light(light, json!({"rotation": [-half, 0, 0, half]})));
    let LuminaireKind::Directional { direction, illuminance_lx, .. } = found.kind else {
        panic!("not directional")
    };
    assert_near(direction.to_vector(), [0.0, -1.0, 0.0]);
    assert!((illuminance_lx - 1000.0).abs() < SINGLE_ROUNDING);
}

#[test]
fn refused() {
    let table = [
        (json!({"type": "area"}), json!({}), "lights[0].type", "unknown type"),
        (json!({"type": "point", "intensity": -1}), json!({}), "lights[0].intensity", "-1"),
        (json!({"type": "point", "color": [0, 0, -1]}), json!({}), "lights[0].color", "-1"),
        (
            json!({"type": "spot", "spot": {"outerConeAngle": 2}}),
            json!({}),
            "lights[0].spot",
            "cone angles 0 and 2",
        ),
        (
            json!({"type": "spot", "spot": {"innerConeAngle": -1}}),
            json!({}),
            "lights[0].spot",
            "cone angles -1",
        ),
        (
            json!({"type": "directional"}),
            json!({"scale": [1, 1, 0]}),
            "lights[0]",
            "points nowhere",
        ),
    ];
    for (light, node, place, words) in table {
        let Err(problems) = with_light(light.clone(), node).read() else { panic!("{light}") };
        let problem = &problems.0[0];
        assert!(problem.place.ends_with(place) && problem.what.contains(words), "{problem}");
    }
    let mut file = with_light(json!({"type": "point"}), json!({}));
    file.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = json!(1);
    let problems = file.read().unwrap_err();
    assert_eq!(problems.0[0].place, "nodes[1].extensions.KHR_lights_punctual.light");
}

/// 100 cd straight on, half of it aside along C0, a quarter along C90, nothing behind.
const PROFILE: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 1 2 0 0 0\n1 1 10\n0 90 180\n0 90\n\
    100 50 0\n100 25 0\n";

fn with_profile(node: Value) -> File {
    let mut file = File::triangle();
    let view = file.view(PROFILE.as_bytes());
    file.json["extensionsRequired"] = json!(["EXT_lights_ies"]);
    file.json["extensions"] = json!({"EXT_lights_ies": {
        "lights": [{"bufferView": view, "mimeType": "application/x-ies-lm-63"}],
    }});
    file.json["nodes"] = json!([{"mesh": 0}, node]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    file
}

#[test]
fn ies_profile() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let file = with_profile(json!({
        // A quarter turn about x takes -z to +y and +y to +z.
        "name": "wall washer", "rotation": [half, 0, 0, half], "scale": [9, 9, 9],
        "extensions": {"EXT_lights_ies": {"light": 0, "multiplier": 3, "color": [1, 1, 7]}},
    }));
    let found = luminaire(&file);
    assert_eq!(found.name, "wall washer");
    assert!(found.colour.0.iter().all(|c| (c - 1.0).abs() < SINGLE_ROUNDING));
    let LuminaireKind::Point { world_from_luminaire, intensity, .. } = found.kind else {
        panic!("no point")
    };
    let luminaire_from_world = world_from_luminaire.inverse().unwrap();
    for (world, expected_cd) in [
        ([0.0, 1.0, 0.0], 300.0),
        ([0.0, -1.0, 0.0], 0.0),
        ([1.0, 0.0, 0.0], 150.0),
        ([0.0, 0.0, 1.0], 75.0),
    ] {
        let local = luminaire_from_world.vector(world.into()).direction().unwrap();
        let found_cd = intensity.intensity_cd(local);
        // Degrees of the table and the `f32` quaternion: 150 cd a right angle, 1e-7 off.
        assert!((found_cd - expected_cd).abs() < 1e-4, "{world:?}: {found_cd}");
    }
}

#[test]
fn ies_profile_as_a_file() {
    let node = json!({"extensions": {"EXT_lights_ies": {"light": 0}}});
    let mut file = with_profile(node);
    let expected = luminaire(&file);
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("lamp.ies"), PROFILE).unwrap();
    file.json["extensions"]["EXT_lights_ies"]["lights"] = json!([{"uri": "lamp.ies"}]);
    let read = crate::build::read_in(directory.path(), "a.glb", &file.glb()).unwrap();
    assert_eq!(read.value.luminaires, [expected]);
}

#[test]
fn ies_profiles_refused() {
    let table = [
        (json!({"light": 1}), "light", "lights[1] does not exist"),
        (json!({}), "EXT_lights_ies.light", "unreadable"),
        (json!({"light": 0, "multiplier": -1}), "multiplier", "unreadable"),
        (json!({"light": 0, "color": [1, 1]}), "color", "unreadable"),
    ];
    for (node, place, words) in table {
        let file = with_profile(json!({"extensions": {"EXT_lights_ies": node}}));
        let Err(problems) = file.read() else { panic!("{node}: accepted") };
        let problem = &problems.0[0];
        assert!(problem.place.ends_with(place) && problem.what.contains(words), "{problem}");
    }
    let mut file = with_profile(json!({"extensions": {"EXT_lights_ies": {"light": 0}}}));
    for (record, words) in [
        (json!({"uri": "data:,none"}), "line 1"),
        (json!({"uri": "../lamp.ies"}), "leaves the directory"),
        (json!({"bufferView": 9}), "bufferViews[9] does not exist"),
        (json!({}), "neither uri nor bufferView"),
    ] {
        file.json["extensions"]["EXT_lights_ies"]["lights"] = json!([record]);
        let problems = file.read().unwrap_err();
        assert!(problems.0[0].place.starts_with("extensions.EXT_lights_ies.lights[0]"));
        assert!(problems.0[0].what.contains(words), "{problems}");
    }
}

/// Six faces of one pixel: black but for +x, which is twice as bright as white, and -y, which is red.
fn surrounded(more: Value) -> File {
    let mut file = File::triangle();
    let mut images = Vec::new();
    for rgba in [[255, 255, 255, 128], [0; 4], [0; 4], [255, 0, 0, 255], [0; 4], [0; 4]] {
        images
            .push(json!({"bufferView": file.view(&png_rgba(1, &[rgba])), "mimeType": "image/png"}));
    }
    file.json["images"] = json!(images);
    let mut light = json!({
        "irradianceCoefficients": [[0, 0, 0]], "specularImageSize": 1, "specularImages": [[0, 1, 2, 3, 4, 5]],
    });
    for (key, value) in more.as_object().unwrap() {
        light[key] = value.clone();
    }
    file.json["extensionsUsed"] = json!(["EXT_lights_image_based"]);
    file.json["extensions"] = json!({"EXT_lights_image_based": {"lights": [light]}});
    file.json["scenes"][0]["extensions"] = json!({"EXT_lights_image_based": {"light": 0}});
    file
}

/// What is seen in a direction of the scene, cd/m2.
fn seen(of: &Luminaire, towards: [f64; 3]) -> f64 {
    let LuminaireKind::Sky { world_from_sky, sky } = &of.kind else { panic!("{of:?}") };
    let sky_from_world = world_from_sky.inverse().unwrap();
    let towards = sky_from_world.vector(towards.into()).direction().unwrap();
    sky.luminance_cd_m2(towards).luminance()
}

#[test]
fn cubes_of_pictures_are_surroundings() {
    let file = surrounded(json!({"intensity": 50, "name": "street"}));
    let read = |file: &File| file.load().value.luminaires.remove(0);
    let found = read(&file);
    assert_eq!(found.name, "street");
    // RGBD: 255 over 128. Pictures are single precision.
    let bright = 50.0 * 255.0 / 128.0;
    let red = 50.0 * Rgb::new(1.0, 0.0, 0.0).luminance();
    for (towards, expected) in [
        ([1.0, 0.0, 0.0], bright),
        ([1.0, 0.5, -0.5], bright),
        ([-1.0, 0.0, 0.0], 0.0),
        ([0.2, -1.0, 0.3], red),
        ([0.0, 1.0, 0.0], 0.0),
    ] {
        let found = seen(&found, towards);
        assert!((found - expected).abs() <= 1e-6 * bright, "{towards:?}: {found}");
    }
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = read(&surrounded(json!({"rotation": [0, half, 0, half]})));
    // A quarter turn about y takes +x to -z.
    assert!(seen(&turned, [0.0, 0.0, -1.0]) > 1.9 && seen(&turned, [1.0, 0.0, 0.0]) == 0.0);
    assert_warns(&file.load(), "EXT_lights_image_based", "cd/m2");
}

#[test]
fn odd_surroundings_are_refused() {
    for (more, place, words) in [
        (json!({"rotation": [0, 0, 0, 0]}), "rotation", "no rotation"),
        (json!({"intensity": -1}), "intensity", "no brightness"),
        (json!({"specularImages": []}), "specularImages", "no pictures"),
        (json!({"specularImages": [[0, 1, 2, 3, 4, 9]]}), "specularImages[0][5]", "images[9]"),
        (json!({"specularImages": [[0, 1]]}), "lights[0]", "length"),
    ] {
        let problems = surrounded(more.clone()).read().unwrap_err();
        let told = problems.to_string();
        assert!(told.contains(place) && told.contains(words), "{more}: {told}");
    }
    let mut nothing = surrounded(json!({}));
    nothing.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = json!(3);
    assert!(nothing.read().unwrap_err().to_string().contains("lights[3]"));
    let mut unused = surrounded(json!({}));
    unused.json["scenes"][0] = json!({"nodes": [0]});
    assert_eq!(unused.parts().luminaires, []);
}
