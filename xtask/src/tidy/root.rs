//! Few entries at the root of the repository.

use super::finding::Finding;
use super::tree::Tree;

/// There must be fewer than this; names that start with a dot do not count. One of them is `fuzz/`, which cargo fuzz looks for at the root, one `loaders/`, whose users
/// know no other folder.
const LIMIT: usize = 17;

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let mut entries: Vec<&str> = tree
        .files
        .iter()
        .filter_map(|f| f.path.split('/').next())
        .filter(|entry| !entry.starts_with('.'))
        .collect();
    entries.dedup();
    let finding = || Finding {
        file: ".".to_owned(),
        line: 1,
        what: format!("{} entries at the root: {}", entries.len(), entries.join(", ")),
        remedy: "keep fewer than seventeen: put one into a folder",
    };
    if entries.len() >= LIMIT { vec![finding()] } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_counted_once() {
        let many = |n| {
            let names: Vec<String> = (0..n).map(|k| format!("f{k:02}/a")).collect();
            let mut files: Vec<(&str, &str)> = names.iter().map(|n| (n.as_str(), "")).collect();
            files.extend([(".hidden", ""), ("f00/b", "")]);
            files.sort_unstable();
            check(&Tree::of(&files)).len()
        };
        assert_eq!((many(LIMIT - 1), many(LIMIT)), (0, 1));
    }
}
