//! Files of a size that can be read. (Functions are counted by clippy.)

use super::finding::Finding;
use super::tree::{File, Tree};

/// Above this only tables, or a reason.
const MAX_FILE_LINES: usize = 500;
/// The reason for a large file stands among its first lines.
const NEAR_TOP: usize = 20;

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.files.iter().filter_map(file_size).collect()
}

fn file_size(file: &File) -> Option<Finding> {
    let comment = match file.path.rsplit('.').next() {
        Some("rs" | "ts" | "js" | "mjs") => "//",
        Some("py" | "sh") => "#",
        _ => return None,
    };
    let text = if file.code.is_empty() { &file.text } else { &file.code };
    let is_code = |l: &&str| !l.trim().is_empty() && !l.trim_start().starts_with(comment);
    let lines = text.lines().filter(is_code).count();
    let reason = format!("{comment} size: ");
    let excused = file.text.lines().take(NEAR_TOP).any(|l| l.trim().starts_with(&reason));
    (lines > MAX_FILE_LINES && !excused).then(|| Finding {
        file: file.path.clone(),
        line: 1,
        what: format!("{lines} lines of code, more than {MAX_FILE_LINES}"),
        remedy: "split it by idea, or say why not in a comment `size: REASON` near the top",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> Vec<String> {
        check(&Tree::of(&[(path, text)])).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn large_files_are_found_or_excused() {
        let code = |n| "const A: u8 = 1;\n".repeat(n);
        assert!(found("a.rs", &code(500)).is_empty());
        assert_eq!(found("a.rs", &code(501)).len(), 1);
        assert!(found("a.rs", &format!("// size: a table\n{}", code(501))).is_empty());
        assert!(found("a.rs", &"// comment\n\n".repeat(501)).is_empty());
        assert_eq!(found("a.ts", &"a();\n".repeat(501)).len(), 1);
        assert!(found("a.md", &"a\n".repeat(501)).is_empty());
    }
}
