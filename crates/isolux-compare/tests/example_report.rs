//! The report in the repository is what its study says, of scenes as they are.

use isolux::scene::Scene;
use isolux_compare::study::Study;
use isolux_compare::{builtin, report};
use std::path::PathBuf;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/compare")
}

fn text(name: &str) -> String {
    let path = folder().join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn study() -> Study {
    serde_json::from_str(&text("study.json")).expect("study.json is a study")
}

/// How to mend it.
const REMEDY: &str = "differs from its study: cargo run --release -p isolux-compare --example report -- docs/compare/study.json docs/compare";

#[test]
fn tables_and_graphs_are_made_of_the_study() {
    let study = study();
    let picture = |name: &str| std::fs::read(folder().join(name)).ok();
    let made = [
        ("report.md", report::markdown(&study)),
        ("study.csv", report::csv(&study)),
        ("report.html", report::html(&study, &picture)),
    ];
    for (name, made) in made {
        assert!(made == text(name), "docs/compare/{name} {REMEDY}");
    }
    for graph in report::graphs(&study) {
        assert!(graph.svg == text(&graph.name), "docs/compare/{} {REMEDY}", graph.name);
    }
}

#[test]
fn its_scenes_are_those_of_today() {
    let study = study();
    for name in ["cube", "sphere", "hall"] {
        let scene = Scene::assemble(builtin(name).unwrap()).unwrap();
        assert_eq!(study.case(name).expect(name).scene_hash, scene.hash(), "{name}");
    }
}
