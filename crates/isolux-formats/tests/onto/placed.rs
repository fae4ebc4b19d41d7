//! Files that a `scene.toml` places.

use crate::grafted::Glb;
use crate::light::ONE_PAGE;
use crate::scene;
use crate::written::Lit;
use isolux_formats::lightmap::Target;
use isolux_formats::onto::Options;
use std::path::Path;

const LAMP: &str =
    "[[luminaire]]\ndirection = [0, 0, -1]\ndirectional = { illuminance_lx = 1e-9 }\n";
const FLOOR: &str = "[materials.grey]\ndiffuse = 0.4\n[[geometry]]\nname = \"floor\"\nmaterial = \"grey\"\n\
                     rectangle = { corner = [0, 0, -9], u = [1, 0, 0], v = [0, 1, 0] }\n";

fn write(home: &Path, geometry: &str) -> Result<(Vec<u8>, String), String> {
    let file = home.join("room.glb");
    std::fs::write(&file, scene::file().glb()).unwrap();
    let path = home.join("scene.toml");
    std::fs::write(&path, format!("{LAMP}{geometry}")).unwrap();
    let light = Lit::of(&path, ONE_PAGE);
    let written = light.onto(&file, (Target::Three, Options::default()));
    let text = |warnings: Vec<isolux_formats::Problem>| {
        warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    written
        .map(|(bytes, warnings)| (bytes, text(warnings)))
        .map_err(|problems| problems.to_string())
}

/// z-up scenes turn files, units and placements scale and move them; other geometry may stand about.
#[test]
fn files_are_found_where_they_were_placed() {
    for place in [
        "",
        "up = \"z\"\n",
        "units = \"mm\"\n",
        "transform = { scale = 3, rotate_deg = [10, 20, 30], translate = [100, -7, 3] }\n",
    ] {
        let home = tempfile::tempdir().unwrap();
        let geometry = format!("{FLOOR}[[geometry]]\nfile = \"room.glb\"\n{place}{FLOOR_AGAIN}");
        let (bytes, warnings) =
            write(home.path(), &geometry).unwrap_or_else(|e| panic!("{place}: {e}"));
        let glb = Glb::of(&bytes);
        let lit = glb.json["meshes"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|m| m["primitives"].as_array().unwrap());
        let lit = lit.filter(|p| {
            let material = &glb.json["materials"][p["material"].as_u64().unwrap() as usize];
            material.pointer("/extensions/MOZ_lightmap").is_some()
        });
        assert_eq!(lit.count(), 2 + 2 + 3, "{place}");
        assert!(warnings.contains("the map has 4 triangles besides"), "{warnings}");
    }
}

const FLOOR_AGAIN: &str = "[[geometry]]\nname = \"roof\"\nmaterial = \"grey\"\n\
                           rectangle = { corner = [0, 0, 99], u = [1, 0, 0], v = [0, 1, 0] }\n";

#[test]
fn copies_and_stretched_files_are_refused() {
    for (place, words) in [
        (
            "placements = [{ translate = [0, 0, 0] }, { translate = [0, 50, 0] }]\n",
            "stands more than once",
        ),
        ("transform = { scale = [1, 2, 1] }\n", "is not what the map was made of"),
    ] {
        let home = tempfile::tempdir().unwrap();
        let refused =
            write(home.path(), &format!("[[geometry]]\nfile = \"room.glb\"\n{place}")).unwrap_err();
        assert!(refused.contains(words), "{refused}");
        assert!(refused.contains("room.glb"), "{refused}");
    }
}
