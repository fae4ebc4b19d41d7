//! `isolux scene`: the files of a scene, to open and edit.

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::SceneFlags;
use crate::output::create_folder;
use crate::source;
use isolux_compare::hall::{Lamp, lamps};
use isolux_formats::ies::Photometry;
use isolux_formats::scene_toml::{NamedPhotometry, SceneFile, write};
use isolux_formats::{Loaded, atomic};
use serde::Serialize;
use std::path::PathBuf;

/// Runs the subcommand.
pub(crate) fn run(flags: &SceneFlags, json: bool) -> Result<Outcome, Failure> {
    let Loaded { value: parts, warnings } = source::read_parts(&flags.scene)?;
    source::show_warnings(&warnings);
    let known: Vec<NamedPhotometry> = lamps().into_iter().map(photometry).collect();
    let files = write(&parts, &known).map_err(Failure::bad_input)?;
    create_folder(&flags.output)?;
    let paths: Vec<PathBuf> = files.iter().map(|file| flags.output.join(&file.name)).collect();
    refuse_to_replace(&paths, flags.force)?;
    for (SceneFile { bytes, .. }, path) in files.iter().zip(&paths) {
        atomic::write(path, bytes).map_err(|problem| Failure::Refused(problem.to_string()))?;
    }
    let paths = paths.iter().map(|path| path.display().to_string()).collect();
    let written = Written { scene: parts.name, files: paths };
    if json {
        print_json(&written)?
    } else {
        print(&format!("{}\n", written.files.join("\n")))?
    }
    Ok(Outcome::Done)
}

/// What was written.
#[derive(Serialize)]
struct Written {
    scene: String,
    files: Vec<String>,
}

/// A folder may hold what somebody has edited.
fn refuse_to_replace(paths: &[PathBuf], force: bool) -> Result<(), Failure> {
    match paths.iter().find(|path| !force && path.exists()) {
        Some(path) => Err(Failure::bad_input(format!(
            "{}: exists; choose another folder, or replace it with --force",
            path.display()
        ))),
        None => Ok(()),
    }
}

fn photometry(lamp: Lamp) -> NamedPhotometry {
    let keyword = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    NamedPhotometry {
        name: format!("{}.ies", lamp.name),
        photometry: Photometry {
            keywords: vec![
                keyword("TEST", "computed from a closed form, measured by nobody"),
                keyword("TESTLAB", "none"),
                keyword("ISSUEDATE", "2026-11-21"),
                keyword("MANUFAC", "isolux"),
                keyword("LUMCAT", lamp.name),
                keyword("LUMINAIRE", lamp.description),
                keyword("LAMP", "LED"),
            ],
            input_watts: lamp.watts,
            opening_m: lamp.opening_m,
            planes_deg: lamp.planes_deg,
            gammas_deg: lamp.gammas_deg,
            candela: lamp.candela,
            ..Photometry::default()
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Point;
    use isolux::scene::{Luminaire, LuminaireKind, Scene};
    use isolux_compare::truth::TruthScene;
    use std::path::Path;

    fn hash(source: &Path) -> String {
        Scene::assemble(source::read_parts(source).unwrap().value).unwrap().hash()
    }

    /// Arrays that fill their rows and arrays that do not, single luminaires, turned and not.
    #[test]
    fn files_give_the_scene_again() {
        for name in [
            "builtin:hall",
            "builtin:hall,triangles=12000,luminaires=101",
            "builtin:hall,luminaires=5000",
        ] {
            let home = tempfile::tempdir().unwrap();
            let output = home.path().join("made");
            let scene = PathBuf::from(name);
            run(
                &SceneFlags {
                    scene: scene.clone(),
                    further: Vec::new(),
                    output: output.clone(),
                    force: false,
                },
                true,
            )
            .unwrap();
            let written = output.join("scene.toml");
            let Loaded { value, warnings } = source::read_parts(&written).unwrap();
            assert_eq!(warnings, [], "{name}");
            assert_eq!(value.name, name.strip_prefix("builtin:").unwrap());
            assert_eq!(hash(&written), hash(&scene), "{name}");
            assert_eq!(
                value.cameras.len(),
                source::read_parts(&scene).unwrap().value.cameras.len()
            );
        }
    }

    /// Scenes like those that people have. A tilt is written in decimals, normals of balls are, and positions far from the origin are
    /// coarser in files than in the kernel: of those it is compared what there is of everything.
    #[test]
    fn files_give_scenes_to_be_judged_again() {
        for made in TruthScene::all() {
            let name = made.name();
            let home = tempfile::tempdir().unwrap();
            let scene = PathBuf::from(format!("builtin:{name}"));
            let flags = SceneFlags {
                scene,
                further: Vec::new(),
                output: home.path().to_owned(),
                force: false,
            };
            run(&flags, true).unwrap();
            let written = home.path().join("scene.toml");
            let Loaded { value, warnings } = source::read_parts(&written).unwrap();
            // A room of some kilometres is read with a question about its unit.
            let is_large = made.kind() == "millimetres and kilometres";
            assert!(is_large || warnings.is_empty(), "{name}: {warnings:?}");
            let is_rounded = made.parts().luminaires.iter().any(is_tilted)
                || made.parts().shapes.iter().any(|shape| shape.normals.is_some());
            let [read, made] = [value, made.parts()].map(|parts| Scene::assemble(parts).unwrap());
            let is_rounded = is_rounded || made.bvh().mesh().origin != Point::ORIGIN;
            let counts =
                |s: &Scene| (s.triangle_count(), s.luminaires().len(), s.materials().len());
            assert_eq!(counts(&read), counts(&made), "{name}");
            assert!(is_rounded || read.hash() == made.hash(), "{name}");
        }
    }

    fn is_tilted(luminaire: &Luminaire) -> bool {
        let LuminaireKind::Point { world_from_luminaire, .. } = &luminaire.kind else {
            return true;
        };
        world_from_luminaire.columns[2].z.abs() != 1.0
    }

    /// Floodlights of types A and B, one of them of a library, the other a tube, on varnished walls.
    #[test]
    fn files_give_floodlights_again() {
        let home = tempfile::tempdir().unwrap();
        let lamp = |name: &str, kind: u32| {
            let text = format!(
                "IESNA91\nTILT=NONE\n1 -1 1 3 3 {kind} 2 0.2 0.4 0\n1 1 20\n-30.1 0 20\n-50 10.3 45\n\
                 0 10 0\n20 900 70\n0 30 0\n"
            );
            std::fs::write(home.path().join(name), text).unwrap();
        };
        lamp("a.ies", 3);
        lamp("b.ies", 2);
        let library = "[luminaires.flood]\nies = 'b.ies'\nmaintenance_factor = 0.7\n";
        std::fs::write(home.path().join("lamps.toml"), library).unwrap();
        let scene = home.path().join("scene.toml");
        let text = "libraries = ['lamps.toml']\n[materials.grey]\ndiffuse = 0.5\ngloss = { f0 = 0.3, roughness = 0.7 }\n\
                    coat = { cover = 0.7, roughness = 0.1 }\n\
                    [[geometry]]\nbox = { min = [0,0,0], max = [4,4,3], inward = true }\nmaterial = 'grey'\n\
                    [[luminaire]]\ntype = 'flood'\nposition = [1,2,2]\ngroup = 'a'\n\
                    [[luminaire]]\nies = 'a.ies'\nposition = [2,2,2]\n\
                    luminous_area = { shape = 'cylinder_x', size_m = [0.4,0.2,0.2] }\n";
        std::fs::write(&scene, text).unwrap();
        let output = home.path().join("made");
        let flags = SceneFlags {
            scene: scene.clone(),
            further: Vec::new(),
            output: output.clone(),
            force: false,
        };
        run(&flags, true).unwrap();
        let written = output.join("scene.toml");
        assert_eq!(source::read_parts(&written).unwrap().warnings, []);
        assert_eq!(hash(&written), hash(&scene));
    }

    #[test]
    fn files_are_not_replaced_unasked() {
        let home = tempfile::tempdir().unwrap();
        let flags = |force| SceneFlags {
            further: Vec::new(),
            scene: "builtin:cube".into(),
            output: home.path().to_owned(),
            force,
        };
        assert!(run(&flags(false), true).is_ok());
        assert!(matches!(run(&flags(false), true), Err(Failure::BadInput(_))));
        assert!(run(&flags(true), true).is_ok());
    }
}
