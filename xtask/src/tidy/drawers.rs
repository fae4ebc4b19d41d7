//! No drawers: a module is named after its idea.

use super::finding::Finding;
use super::tree::Tree;

const DRAWERS: [&str; 7] = ["util", "utils", "common", "helper", "helpers", "misc", "shared"];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.files
        .iter()
        .filter_map(|f| {
            let part = f
                .path
                .split('/')
                .find(|part| DRAWERS.contains(&part.split('.').next().unwrap_or(part)))?;
            Some(Finding {
                file: f.path.clone(),
                line: 1,
                what: format!("`{part}` says nothing about what is inside"),
                remedy: "name the idea, or put each item where it is used",
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawers_are_found_as_files_and_folders() {
        let count = |path| check(&Tree::of(&[(path, "")])).len();
        assert_eq!(count("crates/a/src/util.rs"), 1);
        assert_eq!(count("crates/a/tests/common/mod.rs"), 1);
        assert_eq!(count("crates/a/src/commonplace.rs"), 0);
    }
}
