//! Who knows whom: the edges between crates.

use super::finding::Finding;
use super::tree::Tree;

const COMMAND: &[&str] = &[
    "isolux",
    "isolux-formats",
    "isolux-compare",
    "isolux-memory",
    "isolux-view",
    "isolux-serve",
    "isolux-report",
];

/// Every crate and the crates of ours it may depend on.
const ALLOWED: &[(&str, &[&str])] = &[
    ("isolux-geometry", &[]),
    ("isolux", &["isolux-geometry"]),
    ("isolux-formats", &["isolux"]),
    ("isolux-compare", &["isolux"]),
    ("isolux-view", &["isolux"]),
    ("isolux-report", &["isolux", "isolux-view"]),
    ("isolux-memory", &[]),
    ("isolux-serve", &[]),
    ("isolux-cli", COMMAND),
    ("isolux-python", &["isolux", "isolux-cli", "isolux-compare", "isolux-view"]),
    ("isolux-bench", &["isolux-compare", "isolux-geometry"]),
];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.crates().into_iter().flat_map(|name| check_crate(tree, name)).collect()
}

fn check_crate(tree: &Tree, name: &str) -> Vec<Finding> {
    let path = format!("crates/{name}/Cargo.toml");
    let text = tree.file(&path).map_or("", |f| f.text.as_str());
    let Some((_, allowed)) = ALLOWED.iter().find(|(known, _)| *known == name) else {
        let what = format!("crate `{name}` has no place among the layers");
        let remedy = "add it to ALLOWED in xtask/src/tidy/layers.rs, or make it a module";
        return vec![Finding { file: path, line: 1, what, remedy }];
    };
    let manifest: toml::Table = match text.parse() {
        Ok(manifest) => manifest,
        Err(e) => {
            let what = format!("not TOML: {}", e.message());
            return vec![Finding { file: path, line: 1, what, remedy: "mend the manifest" }];
        }
    };
    dependencies(&manifest)
        .into_iter()
        .filter(|d| d.starts_with("isolux") && !allowed.contains(&d.as_str()))
        .map(|d| Finding {
            file: path.clone(),
            line: text.lines().position(|l| l.starts_with(&d)).map_or(1, |at| at + 1),
            what: format!("`{name}` must not know `{d}`"),
            remedy: "move what it needs down into `isolux`, or hand it in as a value",
        })
        .collect()
}

/// Names of all dependencies, of any kind and target.
fn dependencies(manifest: &toml::Table) -> Vec<String> {
    let kinds = ["dependencies", "dev-dependencies", "build-dependencies"];
    let targets = manifest.get("target").and_then(toml::Value::as_table);
    let targets = targets.into_iter().flat_map(|t| t.values()).filter_map(toml::Value::as_table);
    std::iter::once(manifest)
        .chain(targets)
        .flat_map(|table| kinds.iter().filter_map(|kind| table.get(*kind)?.as_table()))
        .flat_map(|list| list.iter().map(|(name, spec)| package(name, spec)))
        .collect()
}

/// The package behind a dependency that may be renamed.
fn package(name: &str, spec: &toml::Value) -> String {
    spec.get("package").and_then(toml::Value::as_str).unwrap_or(name).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(name: &str, manifest: &str) -> Vec<String> {
        let path = format!("crates/{name}/Cargo.toml");
        check(&Tree::of(&[(&path, manifest)])).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn allowed_edges_pass() {
        assert!(found("isolux-view", "[dependencies]\nisolux.workspace = true\n").is_empty());
        assert!(found("isolux-cli", "[dependencies]\nisolux-view.workspace = true\n").is_empty());
    }

    #[test]
    fn edges_upwards_and_sideways_are_found() {
        for (name, manifest) in [
            ("isolux", "[dependencies]\nisolux-formats.workspace = true\n"),
            ("isolux-view", "[dev-dependencies]\nisolux-compare.workspace = true\n"),
            ("isolux-geometry", "[target.'cfg(unix)'.dependencies]\nisolux.workspace = true\n"),
            ("isolux", "[dependencies]\nrenamed = { package = \"isolux-view\" }\n"),
            ("isolux-cli", "[dependencies]\nisolux-bench.workspace = true\n"),
        ] {
            let found = found(name, manifest);
            assert_eq!(found.len(), 1, "{name}: {manifest}: {found:?}");
        }
    }

    #[test]
    fn an_edge_is_found_at_its_line() {
        let found = found("isolux", "[dependencies]\nserde = \"1\"\nisolux-view = \"0\"\n");
        assert!(found[0].starts_with("crates/isolux/Cargo.toml:3: `isolux`"), "{found:?}");
    }

    #[test]
    fn strangers_and_broken_manifests_are_found() {
        assert_eq!(found("isolux-helpers", "").len(), 1);
        assert_eq!(found("isolux", "[dependencies").len(), 1);
    }
}
