//! Files that other programs wrote; their origin is in `tests/data/gltf/SOURCES.md`.

use isolux::scene::Scene;
use isolux_formats::gltf;
use std::path::Path;

/// Blender's Cornell box: one emissive quadrangle, two boxes, the room in three parts.
#[test]
fn cornell_box() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/gltf/CornellBox.glb");
    let loaded = gltf::read(&path).unwrap();
    let parts = loaded.value;
    let names: Vec<&str> = parts.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "Light",
            "large.box",
            "small.box",
            "cornell.box [0]",
            "cornell.box [1]",
            "cornell.box [2]"
        ]
    );
    let scene = Scene::assemble(parts).unwrap();
    assert_eq!(scene.triangle_count(), 36);
    // Two-sided, 130 by 105 units, 100 cd/m2.
    let [front, back] = scene.area_luminaires() else { panic!("{:?}", scene.area_luminaires()) };
    assert_eq!(front.area_m2, back.area_m2);
    assert_eq!(front.luminance_cd_m2.0, [100.0; 3]);
}
