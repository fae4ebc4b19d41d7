//! Paths of Rust code: `a::b::{c, d as e}`.

/// One path as written, with the byte where it starts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Path {
    /// Place in the masked code.
    pub at: usize,
    /// Its segments; `*` last for a glob.
    pub segments: Vec<String>,
    /// The name it is known by: the last segment, or what follows `as`.
    pub name: String,
}

/// One `use` declaration, flattened.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Use {
    /// Whether it is `pub` in any way.
    pub is_public: bool,
    /// Bytes of the declaration.
    pub span: std::ops::Range<usize>,
    /// What it names.
    pub paths: Vec<Path>,
}

/// All `use` declarations of masked code.
pub(super) fn uses(code: &str) -> Vec<Use> {
    super::code::words(code, "use")
        .filter_map(|at| {
            // `impl Trait + use<'a>` is not a declaration.
            let start = at + "use".len();
            if code[start..].trim_start().starts_with('<') {
                return None;
            }
            let end = code[start..].find(';').map_or(code.len(), |k| start + k);
            let before = code[..at].trim_end();
            let is_public = before.ends_with("pub")
                || before.ends_with(')')
                    && before.rfind('(').is_some_and(|k| before[..k].ends_with("pub"));
            let mut paths = Vec::new();
            tree(&code[start..end], start, &[], &mut paths);
            Some(Use { is_public, span: at..end, paths })
        })
        .collect()
}

/// All paths with more than one segment in masked code, `use` declarations left out.
pub(super) fn expressions(code: &str, uses: &[Use]) -> Vec<Path> {
    let bytes = code.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while at < code.len() {
        if let Some(declared) = uses.iter().find(|u| u.span.start == at) {
            at = declared.span.end;
            continue;
        }
        let length = word_length(&code[at..]);
        let continues = code[..at].ends_with("::");
        if length == 0 || continues || bytes[at].is_ascii_digit() {
            at += length.max(1);
            continue;
        }
        let (segments, end) = segments(code, at);
        if segments.len() > 1 {
            let name = segments.last().cloned().unwrap_or_default();
            found.push(Path { at, segments, name });
        }
        at = end;
    }
    found
}

/// The segments of the path at a byte, and the byte after them.
fn segments(code: &str, start: usize) -> (Vec<String>, usize) {
    let mut list = Vec::new();
    let mut at = start;
    loop {
        let length = word_length(&code[at..]);
        if length == 0 {
            return (list, at);
        }
        list.push(code[at..at + length].to_owned());
        at += length;
        if !code[at..].starts_with("::") {
            return (list, at);
        }
        at += 2;
    }
}

/// Flattens the tree of a `use` declaration.
fn tree(text: &str, offset: usize, prefix: &[String], found: &mut Vec<Path>) {
    let blank = text.len() - text.trim_start().len();
    let (text, at) = (text.trim(), offset + blank);
    let (mut own, mut end) = segments(text, 0);
    // A leading `::` names a crate.
    if own.is_empty() && text.starts_with("::") {
        (own, end) = segments(text, 2);
    }
    let segments: Vec<String> = prefix.iter().cloned().chain(own).collect();
    let rest = text[end..].trim_start();
    if let Some(group) = rest.strip_prefix('{') {
        let inside = group.strip_suffix('}').unwrap_or(group);
        let base = at + (text.len() - group.len());
        for (start, piece) in split_at_commas(inside) {
            tree(piece, base + start, &segments, found);
        }
    } else if rest.starts_with('*') {
        let segments = segments.into_iter().chain(["*".to_owned()]).collect();
        found.push(Path { at, segments, name: "*".to_owned() });
    } else if !segments.is_empty() {
        let renamed = rest.strip_prefix("as").map(|r| r.trim().to_owned());
        let segments = without_self(segments);
        let name = renamed.or_else(|| segments.last().cloned()).unwrap_or_default();
        found.push(Path { at, segments, name });
    }
}

/// `a::{self}` is `a`.
fn without_self(mut segments: Vec<String>) -> Vec<String> {
    if segments.len() > 1 && segments.last().is_some_and(|s| s == "self") {
        segments.pop();
    }
    segments
}

/// Pieces between the commas outside braces, with their places.
fn split_at_commas(text: &str) -> Vec<(usize, &str)> {
    let mut pieces = Vec::new();
    let (mut depth, mut start) = (0_i32, 0);
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                pieces.push((start, &text[start..at]));
                start = at + 1;
            }
            _ => {}
        }
    }
    pieces.push((start, &text[start..]));
    pieces.retain(|(_, piece)| !piece.trim().is_empty());
    pieces
}

fn word_length(text: &str) -> usize {
    text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(code: &str) -> Vec<String> {
        uses(code)
            .iter()
            .flat_map(|u| &u.paths)
            .map(|p| format!("{} = {}", p.name, p.segments.join("::")))
            .collect()
    }

    #[test]
    fn trees_are_flattened() {
        assert_eq!(
            written("use crate::{a::{b, self}, c as d};\npub use super::e::*;"),
            ["b = crate::a::b", "a = crate::a", "d = crate::c", "* = super::e::*"]
        );
        assert_eq!(written("use a;use ::b::c;"), ["a = a", "c = b::c"]);
        assert!(written("fn f() -> impl A + use<'a> {}").is_empty());
    }

    #[test]
    fn visibility_is_seen() {
        let found = uses("use a::b; pub use c::d; pub(super) use e::f;");
        assert_eq!(found.iter().map(|u| u.is_public).collect::<Vec<_>>(), [false, true, true]);
    }

    #[test]
    fn paths_in_code_are_found_with_their_places() {
        let code = "use a::b; fn f(x: crate::c::D) { super::g(); y.h::<i::J>() }";
        let found = expressions(code, &uses(code));
        let texts: Vec<String> = found.iter().map(|p| p.segments.join("::")).collect();
        assert_eq!(texts, ["crate::c::D", "super::g", "i::J"]);
        assert!(code[found[0].at..].starts_with("crate::c"));
    }
}
