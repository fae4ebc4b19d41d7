//! Inside the core, modules know only those before them.

use super::code::{line_at, without_tests};
use super::finding::Finding;
use super::paths::{Path, expressions, uses};
use super::tree::{File, Tree};

const SOURCES: &str = "crates/isolux/src/";
const ORDER: [&str; 10] = [
    "ablation",
    "units",
    "quadrature",
    "photometry",
    "scene",
    "elements",
    "map",
    "sampling",
    "engine",
    "lightmap",
];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.rust_under(SOURCES).flat_map(check_file).collect()
}

fn check_file(file: &File) -> Vec<Finding> {
    let inside = &file.path[SOURCES.len()..];
    let module = inside.split(['/', '.']).next().unwrap_or_default();
    // Tests may use what comes later, in files of their own as in modules.
    if inside == "lib.rs" || inside.contains("/tests/") {
        return Vec::new();
    }
    let finding = |at: usize, what: String, remedy| Finding {
        file: file.path.clone(),
        line: line_at(&file.code, at),
        what,
        remedy,
    };
    let Some(own) = place(module) else {
        let what = format!("module `{module}` has no place in the order of the core");
        return vec![finding(0, what, "put it inside a module, or into ORDER of module_order.rs")];
    };
    let code = without_tests(&file.code);
    let declared = uses(&code);
    let mut paths: Vec<Path> = declared.iter().flat_map(|u| u.paths.clone()).collect();
    paths.extend(expressions(&code, &declared));
    paths
        .into_iter()
        .filter_map(|path| {
            let other = top_module(&path)?;
            (place(other)? > own).then(|| {
                let what = format!("`{module}` must not know `{other}`, which comes after it");
                finding(path.at, what, "move what both need into the earlier module")
            })
        })
        .collect()
}

fn place(module: &str) -> Option<usize> {
    ORDER.iter().position(|m| *m == module)
}

/// The module of the core that a path names from the root of the crate.
fn top_module(path: &Path) -> Option<&str> {
    match path.segments.as_slice() {
        [first, second, ..] if first == "crate" => Some(second),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> Vec<String> {
        check(&Tree::of(&[(path, text)])).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn leftwards_passes_and_rightwards_is_found() {
        assert!(found("crates/isolux/src/map/mod.rs", "use crate::units::Rgb;").is_empty());
        let path = "crates/isolux/src/scene/check.rs";
        let found = found(
            path,
            "//! x\nuse crate::{units::Rgb,\n map::Method};\nfn f() { crate::engine::solve() }",
        );
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].starts_with("crates/isolux/src/scene/check.rs:3: `scene`"), "{found:?}");
    }

    #[test]
    fn comments_tests_and_the_root_may_name_anything() {
        let text = "// crate::engine\n#[cfg(test)]\nmod tests { use crate::engine::solve; }";
        assert!(found("crates/isolux/src/units/rgb.rs", text).is_empty());
        assert!(found("crates/isolux/src/lib.rs", "pub use crate::engine::solve;").is_empty());
    }

    #[test]
    fn a_new_module_needs_a_place() {
        assert_eq!(found("crates/isolux/src/extra.rs", "").len(), 1);
    }
}
