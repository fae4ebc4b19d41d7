//! A scene file of any kind.

use crate::obj::Materials;
use crate::{
    Loaded, Problem, Problems, Reach, bounds, gltf, mitsuba, obj, ply, product_file, rad,
    scene_toml, source, stl,
};
use isolux::scene::{Lowered, MOST_REFLECTANCE, SceneParts};
use std::path::Path;

/// Reads a scene by the extension of its file. Surfaces reflect no more than some do.
pub fn load(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    load_with(path, Materials::AsMeant, Reach::Inside)
}

/// Reads a scene whose materials are read as meant or as written, and the files that it may name.
pub fn load_with(
    path: &Path,
    materials: Materials,
    reach: Reach,
) -> Result<Loaded<SceneParts>, Problems> {
    finished(path, read(path, materials, reach)?)
}

/// Reads a scene that several Radiance files make up, in their order.
pub fn load_several(paths: &[&Path], reach: Reach) -> Result<Loaded<SceneParts>, Problems> {
    check_together(paths)?;
    let first = paths.first().copied().unwrap_or(Path::new(""));
    finished(first, rad::read_several(paths, reach)?)
}

/// Whether files can make up one scene.
pub fn check_together(paths: &[&Path]) -> Result<(), Problems> {
    let is_radiance = |path: &Path| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("rad"));
    let mut problems = Vec::new();
    for path in paths {
        if !is_radiance(path) {
            let what = "is no Radiance file (.rad), and only those are read together";
            let remedy = "name one scene; a scene.toml joins files of all kinds";
            problems.push(Problem::new(path, "", what, remedy));
        } else if let Err(problem) = source::check_present(path) {
            problems.push(problem);
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(Problems(problems)) }
}

/// What was read, within the bounds of numbers and of reflectances.
fn finished(path: &Path, read: Loaded<SceneParts>) -> Result<Loaded<SceneParts>, Problems> {
    let Loaded { mut value, mut warnings } = read;
    bounds::check(path, &value)?;
    warnings.extend(value.hold_reflectances().iter().map(|lowered| held(path, lowered)));
    Ok(Loaded { value, warnings })
}

/// A warning of a material that reflected too much.
fn held(path: &Path, Lowered { material, texture, reflectance }: &Lowered) -> Problem {
    let place = match texture {
        Some(number) => format!("material `{material}`, textures[{number}]"),
        None => format!("material `{material}`"),
    };
    let what = format!(
        "reflects {reflectance:.3} of the light and is taken to reflect {MOST_REFLECTANCE}: nothing that scatters light \
         reflects more, and in a closed room of such surfaces light would never end"
    );
    Problem::new(path, place, what, "lower it: fresh white paint reflects 0.85")
}

fn read(path: &Path, materials: Materials, reach: Reach) -> Result<Loaded<SceneParts>, Problems> {
    source::check_present(path)?;
    if std::fs::metadata(path).is_ok_and(|known| known.is_file() && known.len() == 0) {
        return Err(Problem::new(path, "", "is empty", "copy or export it again").into());
    }
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("gltf" | "glb") => gltf::read_with(path, reach),
        Some("obj") => obj::read_with(path, materials, reach),
        Some("ply") => ply::read(path),
        Some("rad") => rad::read_with(path, reach),
        Some("stl") => stl::read(path),
        Some("xml") => mitsuba::read_with(path, reach),
        Some("toml") => scene_toml::read_with(path, materials, reach),
        other => Err(product_file::by_extension(path)
            .unwrap_or_else(|| {
                let what = "is not a scene by its extension";
                Problem::new(path, "", what, instead_of(other.unwrap_or_default()))
            })
            .into()),
    }
}

/// What to name instead of a file that is near a scene.
fn instead_of(extension: &str) -> &'static str {
    match extension {
        "ies" | "ldt" => "name it in a [[luminaire]] of a scene.toml",
        "mtl" => "name the .obj file that refers to it",
        "oct" => "name the .rad file that the octree was made from",
        "jpg" | "jpeg" | "png" => "name it as the `texture` of a material of a scene.toml",
        "wrl" | "x3d" | "vtu" | "csv" | "res" => {
            "name the scene, or the map, that it was made from"
        }
        "epw" => "name it as the weather of a scene: --sky \"place.epw, time=2026-06-21T12:00:00\"",
        "bin" => "name the .gltf file that refers to it",
        "3ds" | "abc" | "blend" | "dae" | "dxf" | "dwg" | "fbx" | "ifc" | "max" | "skp"
        | "step" | "stp" | "usd" | "usda" | "usdc" | "usdz" => {
            "export it as .glb from the program that made it"
        }
        "exr" | "hdr" => {
            "name it as the picture of the sky of a scene: --sky \"sky.hdr, luminance_factor=179\""
        }
        "pbrt" => "convert it to Mitsuba 3 (.xml) or export it as .glb",
        "vf" => "name the .rad file of the scene, and views of it in a scene.toml",
        _ => "name a .toml, .gltf, .glb, .obj, .ply, .rad, .stl or .xml file",
    }
}
