//! Every file among the scenes of the repository is read, or refused for what it is.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use isolux::scene::Scene;
use isolux_formats::{Problems, load};
use std::path::{Path, PathBuf};

const FOLDERS: [&str; 3] = ["scenes", "checks/mitsuba", "crates/isolux-formats/tests/data"];
/// What is a scene by its extension.
const SCENES: [&str; 8] = ["glb", "gltf", "obj", "ply", "rad", "stl", "toml", "xml"];

fn files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut open: Vec<PathBuf> = FOLDERS.iter().map(|folder| root.join(folder)).collect();
    let mut files = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() { open.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    files
}

#[test]
fn every_file_is_read_or_refused_for_what_it_is() {
    let (mut read, mut refused) = (0, 0);
    for path in files() {
        let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        match load(&path) {
            Ok(loaded) => {
                for warning in &loaded.warnings {
                    assert!(!warning.what.is_empty() && !warning.remedy.is_empty(), "{warning:?}");
                }
                Scene::assemble(loaded.value)
                    .unwrap_or_else(|p| panic!("{}: {p:?}", path.display()));
                read += 1;
            }
            Err(Problems(list)) => {
                let is_scene = SCENES.contains(&extension.as_str());
                assert!(!is_scene, "{}: {}", path.display(), Problems(list));
                let [problem] = &list[..] else { panic!("{list:?}") };
                assert!(problem.what == "is not a scene by its extension", "{problem}");
                assert!(problem.remedy.starts_with("name "), "{problem}");
                refused += 1;
            }
        }
    }
    // Both kinds are there.
    assert!(read >= 10 && refused >= 10, "{read} read, {refused} refused");
}
