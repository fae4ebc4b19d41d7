//! Files and functions of a size that can be read.

use super::code::{closing, line_at, words};
use super::finding::Finding;
use super::tree::{File, Tree};

/// Above this only tables, or a reason.
const MAX_FILE_LINES: usize = 500;
/// Longer functions deserve a second look, or a reason.
const MAX_FUNCTION_LINES: usize = 60;
/// The reason for a large file stands among its first lines.
const NEAR_TOP: usize = 20;
/// The reason for a long function stands this many lines above it at most, or on its first.
const NEAR_FUNCTION: usize = 6;

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.files.iter().flat_map(|f| file_size(f).into_iter().chain(functions(f))).collect()
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

fn functions(file: &File) -> Vec<Finding> {
    let code = &file.code;
    let long = words(code, "fn").filter_map(|at| {
        let open = body(code, at)?;
        let (first, last) = (line_at(code, at), line_at(code, closing(code, open)));
        let lines = last - first + 1;
        (lines > MAX_FUNCTION_LINES && !is_excused(file, first)).then(|| Finding {
            file: file.path.clone(),
            line: first,
            what: format!("a function of {lines} lines, more than {MAX_FUNCTION_LINES}"),
            remedy: "split it by step, or say why not in a comment `long: REASON` above it",
        })
    });
    long.collect()
}

/// The brace that opens the body of the function at `fn`; `None` for types and declarations.
fn body(code: &str, at: usize) -> Option<usize> {
    let mut depth = 0_i32;
    for (k, c) in code[at..].char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '{' if depth == 0 => return Some(at + k),
            ';' | ',' | '=' if depth == 0 => return None,
            _ if depth < 0 => return None,
            _ => {}
        }
    }
    None
}

fn is_excused(file: &File, line: usize) -> bool {
    let first = line.saturating_sub(NEAR_FUNCTION + 1);
    file.text.lines().take(line).skip(first).any(|l| l.contains("// long: "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> Vec<String> {
        check(&Tree::of(&[(path, text)])).iter().map(ToString::to_string).collect()
    }

    fn function(lines: usize) -> String {
        format!("fn f() {{\n{}}}\n", "    a();\n".repeat(lines - 2))
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

    #[test]
    fn long_functions_are_found_or_excused() {
        assert!(found("a.rs", &function(60)).is_empty());
        assert!(found("a.rs", &format!("\n{}", function(61)))[0].starts_with("a.rs:2: "));
        assert!(found("a.rs", &format!("// long: a table\n{}", function(61))).is_empty());
    }

    #[test]
    fn types_and_declarations_are_no_functions() {
        let rest = function(40);
        let text = format!("type F = fn(u8) -> u8;\ntrait T {{ fn g(); }}\n{rest}{rest}");
        assert!(found("a.rs", &text).is_empty());
        assert!(found("a.rs", &format!("fn g(a: [u8; 3], f: fn()) {{}}\n{rest}{rest}")).is_empty());
    }
}
