//! Every crate takes the lints of the workspace, and those ask for documentation.

use super::finding::Finding;
use super::tree::Tree;

const REQUIRED: [&str; 2] = ["missing_docs", "unsafe_code"];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let missing = REQUIRED.into_iter().filter(|lint| !asks_for(tree, lint)).map(|lint| Finding {
        file: "Cargo.toml".to_owned(),
        line: 1,
        what: format!("`{lint}` is not in [workspace.lints.rust]"),
        remedy: "every public item is documented, unsafe code is confined",
    });
    missing.chain(tree.crates().into_iter().filter_map(|name| check_crate(tree, name))).collect()
}

fn manifest(tree: &Tree, path: &str) -> toml::Table {
    tree.file(path).and_then(|f| f.text.parse().ok()).unwrap_or_default()
}

fn asks_for(tree: &Tree, lint: &str) -> bool {
    let root = manifest(tree, "Cargo.toml");
    let lints = root.get("workspace").and_then(|w| w.get("lints")?.get("rust")?.get(lint));
    lints.and_then(toml::Value::as_str).is_some_and(|level| level != "allow")
}

fn check_crate(tree: &Tree, name: &str) -> Option<Finding> {
    let file = format!("crates/{name}/Cargo.toml");
    let lints = manifest(tree, &file);
    let shared = lints.get("lints").and_then(|l| l.get("workspace")?.as_bool());
    (shared != Some(true)).then(|| Finding {
        file,
        line: 1,
        what: format!("`{name}` does not take the lints of the workspace"),
        remedy: "add `[lints]` with `workspace = true`",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOT: &str = "[workspace.lints.rust]\nmissing_docs = \"warn\"\nunsafe_code = \"deny\"\n";

    #[test]
    fn lints_are_asked_for_and_taken() {
        let count = |root, manifest| {
            check(&Tree::of(&[("Cargo.toml", root), ("crates/a/Cargo.toml", manifest)])).len()
        };
        assert_eq!(count(ROOT, "[lints]\nworkspace = true\n"), 0);
        assert_eq!(count(ROOT, ""), 1);
        assert_eq!(count("", "[lints]\nworkspace = true\n"), 2);
    }
}
