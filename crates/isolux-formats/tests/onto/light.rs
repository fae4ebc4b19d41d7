//! Light is where it belongs.

use crate::build::File;
use crate::grafted::Glb;
use crate::scene;
use crate::written::Lit;
use isolux_formats::lightmap::Target;
use isolux_formats::onto::Options;
use serde_json::json;

/// Pages as large as it takes.
pub(crate) const ONE_PAGE: u32 = 2048;

/// A file written with its own light.
pub(crate) fn lit(file: &File, target: Target, page: u32) -> Glb {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.glb");
    std::fs::write(&path, file.glb()).unwrap();
    let (bytes, _) = Lit::of(&path, page).onto(&path, (target, Options::default())).unwrap();
    Glb::of(&bytes)
}

/// Two panels, a cloth of two sides and three stools, of two triangles each.
const LIT_TRIANGLES: usize = 2 * (2 + 2 + 3);

/// Mirrored, turned, copied, and from both sides.
#[test]
fn every_surface_reads_its_own_light() {
    let mut file = scene::file();
    let glb = lit(&file, Target::Three, ONE_PAGE);
    assert_eq!(glb.check_light(1.0), LIT_TRIANGLES);
    // Bevy reads one set besides the first.
    file.json["materials"][1]["occlusionTexture"]["texCoord"] = json!(0);
    let glb = lit(&file, Target::Bevy, ONE_PAGE);
    assert_eq!(glb.check_light(std::f64::consts::FRAC_1_PI), LIT_TRIANGLES);
}

#[test]
fn pages_have_materials_of_their_own() {
    let glb = lit(&scene::file(), Target::Three, 40);
    assert_eq!(glb.check_light(1.0), LIT_TRIANGLES);
    let pages = glb.json["images"].as_array().unwrap().len() - 1;
    assert!(pages > 1, "{pages}");
    let names = |name: &str| {
        let materials = glb.json["materials"].as_array().unwrap().iter();
        materials
            .filter(|m| m["name"] == name && m.pointer("/extensions/MOZ_lightmap").is_some())
            .count()
    };
    assert!(names("paint") > 1);
}
