//! Unsafe code is confined and explained.

use super::code::{line_at, words};
use super::finding::Finding;
use super::tree::{File, Tree};

/// The only places for it, and why it must be there.
const ALLOWED: [(&str, &str); 2] = [
    ("crates/isolux-geometry/src/", "vector instructions and unchecked reads of the ray kernel"),
    ("crates/isolux-bench/src/embree/", "calls into Embree, the C library that is measured"),
];
/// The sentence stands at most this many lines above the block, without a blank line between.
const NEAR: usize = 8;

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.files.iter().flat_map(check_file).collect()
}

fn check_file(file: &File) -> Vec<Finding> {
    let allowed = ALLOWED.iter().any(|(folder, _)| file.path.starts_with(folder));
    words(&file.code, "unsafe")
        .filter_map(|at| {
            let line = line_at(&file.code, at);
            let (what, remedy) = if !allowed {
                (
                    "unsafe code",
                    "only isolux-geometry may hold it: write it safely or move it there",
                )
            } else if !is_declaration(&file.code[at..]) && !is_explained(&file.text, line) {
                ("unsafe without a reason", "say above it in a comment `SAFETY: ` why it is sound")
            } else {
                return None;
            };
            Some(Finding { file: file.path.clone(), line, what: what.to_owned(), remedy })
        })
        .collect()
}

/// `unsafe fn` and `unsafe trait` pass the duty on, in their documentation (`clippy::missing_safety_doc`).
fn is_declaration(code: &str) -> bool {
    let after = code["unsafe".len()..].trim_start();
    ["fn ", "extern ", "trait "].iter().any(|item| after.starts_with(item))
}

fn is_explained(text: &str, line: usize) -> bool {
    let above: Vec<&str> = text.lines().take(line).collect();
    above
        .iter()
        .rev()
        .take(NEAR + 1)
        .take_while(|l| !l.trim().is_empty())
        .any(|l| l.contains("// SAFETY: "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(path: &str, text: &str) -> usize {
        check(&Tree::of(&[(path, text)])).len()
    }

    #[test]
    fn unsafe_is_confined() {
        let explained = "// SAFETY: it is.\nunsafe { f() }\n";
        assert_eq!(count("crates/isolux/src/a.rs", explained), 1);
        assert_eq!(count("crates/isolux-geometry/src/a.rs", explained), 0);
        assert_eq!(count("crates/isolux-bench/src/embree/a.rs", explained), 0);
        assert_eq!(count("crates/isolux-bench/src/a.rs", explained), 1);
        assert_eq!(count("crates/isolux/src/a.rs", "// unsafe\n\"unsafe\"; unsafe_code\n"), 0);
    }

    #[test]
    fn unsafe_is_explained() {
        let path = "crates/isolux-geometry/src/a.rs";
        for (text, expected) in [
            ("unsafe { f() }", 1),
            ("// SAFETY: a\n\nunsafe { f() }", 1),
            ("// SAFETY: a\nlet x =\n    unsafe { f() };", 0),
            ("/// # Safety\n/// a\nunsafe fn f() {}", 0),
            ("unsafe impl Send for A {}", 1),
        ] {
            assert_eq!(count(path, text), expected, "{text}");
        }
    }
}
