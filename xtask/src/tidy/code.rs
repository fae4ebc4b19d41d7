//! Rust source without what is not code.

/// The source with comments as blanks and literals as underscores: ASCII, line by line.
pub(super) fn mask(source: &str) -> String {
    let mut rest = source;
    let mut out = String::with_capacity(source.len());
    while let Some(first) = rest.chars().next() {
        let after_word = out.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let (length, fill) = if rest.starts_with("//") {
            (rest.find('\n').unwrap_or(rest.len()), Some(' '))
        } else if rest.starts_with("/*") {
            (block_comment(rest), Some(' '))
        } else if let Some(length) = raw_string(rest).filter(|_| !after_word) {
            (length, Some('_'))
        } else if first == '"' {
            (quoted(rest, '"'), Some('_'))
        } else if let Some(length) = character(rest) {
            (length, Some('_'))
        } else {
            (first.len_utf8(), None)
        };
        let (piece, next) = rest.split_at(length);
        match fill {
            None => out.push(if first.is_ascii() { first } else { '_' }),
            Some(fill) => out.extend(piece.chars().map(|c| if c == '\n' { c } else { fill })),
        }
        rest = next;
    }
    out
}

/// The line, counted from 1, at a byte of a text.
pub(super) fn line_at(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}

/// Where a word stands in masked code, not as part of a longer one.
pub(super) fn words<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word).map(|(at, _)| at).filter(move |&at| {
        !code[..at].ends_with(part) && !code[at + word.len()..].starts_with(part)
    })
}

/// The byte after the bracket that closes the one at `open`.
pub(super) fn closing(code: &str, open: usize) -> usize {
    let mut depth = 0_usize;
    for (at, c) in code[open..].char_indices() {
        match c {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth = depth.saturating_sub(1),
            _ => continue,
        }
        if depth == 0 {
            return open + at + 1;
        }
    }
    code.len()
}

/// Masked code with the modules that only tests compile blanked.
pub(super) fn without_tests(code: &str) -> String {
    let mut kept = code.to_owned();
    for (at, attribute) in code.match_indices("#[cfg(test)]") {
        let after = &code[at + attribute.len()..];
        let item = after.trim_start();
        let end = item.find(['{', ';']).map(|k| at + code[at..].len() - item.len() + k);
        let Some(end) = end else { continue };
        let end = if code[end..].starts_with('{') { closing(code, end) } else { end + 1 };
        let blank: String =
            code[at..end].chars().map(|c| if c == '\n' { c } else { ' ' }).collect();
        kept.replace_range(at..end, &blank);
    }
    kept
}

/// Length of the nested block comment at the start.
fn block_comment(rest: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < rest.len() {
        if rest[at..].starts_with("/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if rest[at..].starts_with("*/") {
            (depth, at) = (depth - 1, at + 2);
            if depth == 0 {
                return at;
            }
        } else {
            at += rest[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    rest.len()
}

/// Length of the raw string at the start, if there is one.
fn raw_string(rest: &str) -> Option<usize> {
    let after = rest.strip_prefix("br").or_else(|| rest.strip_prefix('r'))?;
    let hashes = after.len() - after.trim_start_matches('#').len();
    let body = after[hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let closed = body.find(&end).map_or(body.len(), |at| at + end.len());
    Some(rest.len() - body.len() + closed)
}

/// Length of the literal at the start, to the quote that is not escaped.
fn quoted(rest: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        if c == quote && !escaped {
            return at + c.len_utf8();
        }
        escaped = c == '\\' && !escaped;
    }
    rest.len()
}

/// Length of the character literal at the start; a lifetime is none.
fn character(rest: &str) -> Option<usize> {
    let mut after = rest.strip_prefix('\'')?.chars();
    let first = after.next()?;
    (first == '\\' || after.next() == Some('\'')).then(|| quoted(rest, '\''))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_literals_are_masked() {
        for (source, expected) in [
            ("a // { b\nc", "a       \nc"),
            ("/* { /* */ } */x", "               x"),
            (r#"f("{\"}") {"#, "f(______) {"),
            ("r#\"}\"\"#;", "_______;"),
            ("'{' 'a", "___ 'a"),
            (r"'\'' &'static str", "____ &'static str"),
            ("for\"x\"", "for___"),
        ] {
            assert_eq!(mask(source), expected, "{source}");
        }
    }

    #[test]
    fn words_are_whole() {
        assert_eq!(words("unsafe_code unsafe { }", "unsafe").collect::<Vec<_>>(), [12]);
    }

    #[test]
    fn tests_are_left_out_in_place() {
        let code = "use a;\n#[cfg(test)]\nmod tests {\n use b; { }\n}\nuse c;";
        let kept = without_tests(code);
        assert_eq!(kept.len(), code.len());
        assert!(!kept.contains("use b") && kept.contains("use a") && kept.contains("use c"));
        assert_eq!(line_at(&kept, kept.find("use c").unwrap()), 6);
        assert!(!without_tests("#[cfg(test)]\nmod tests;\n").contains("mod"));
    }
}
