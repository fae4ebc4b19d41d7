//! Unsafe code is confined. (The compiler denies it where it is not lifted, clippy asks for the reason of every block.)

use super::code::{line_at, words};
use super::finding::Finding;
use super::tree::{File, Tree};

/// The only places that may lift the lint, and why it must be there.
const ALLOWED: [(&str, &str); 3] = [
    ("crates/isolux-memory/src/", "an allocator"),
    ("crates/isolux-geometry/src/", "vector instructions and unchecked reads of the ray kernel"),
    ("crates/isolux-bench/src/embree/", "calls into Embree, the C library that is measured"),
];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let elsewhere = |f: &&File| !ALLOWED.iter().any(|(folder, _)| f.path.starts_with(folder));
    let lifts = |file: &File| {
        words(&file.code, "unsafe_code")
            .map(|at| Finding {
                file: file.path.clone(),
                line: line_at(&file.code, at),
                what: "unsafe code is allowed".to_owned(),
                remedy: "only isolux-geometry may hold it: write it safely or move it there",
            })
            .collect::<Vec<_>>()
    };
    tree.files.iter().filter(elsewhere).flat_map(lifts).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsafe_is_confined() {
        let count = |path: &str, text: &str| check(&Tree::of(&[(path, text)])).len();
        let lifted = "#![allow(unsafe_code, reason = \"it is fast\")]";
        assert_eq!(count("crates/isolux/src/a.rs", lifted), 1);
        assert_eq!(count("crates/isolux-geometry/src/a.rs", lifted), 0);
        assert_eq!(count("crates/isolux-bench/src/embree/a.rs", lifted), 0);
        assert_eq!(count("crates/isolux-bench/src/a.rs", lifted), 1);
        assert_eq!(
            count("crates/isolux/src/a.rs", "// unsafe_code\n\"unsafe_code\"; unsafe { }"),
            0
        );
    }
}
