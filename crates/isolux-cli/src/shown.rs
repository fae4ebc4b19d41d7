//! Text from files as a terminal may be given it: without control characters, names of a length that can be read. JSON
//! holds them as they are, with what would act on a terminal as escapes.

use std::borrow::Cow;

/// Longest name in tables and lists, characters.
const MOST_OF_NAME: usize = 60;
/// Longest name, or path, between backticks in a sentence.
const MOST_OF_QUOTE: usize = 200;

/// Whether a character acts on a terminal instead of being seen: a control character, one that turns the direction of what follows
/// (Unicode's property Bidi_Control), or an end of a line or a paragraph.
fn acts(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns || matches!(c, '\u{2028}' | '\u{2029}')
}

/// With characters that act on a terminal as escapes: `\n`, `\u{1b}`, `\u{202e}`.
pub(crate) fn plain(text: &str) -> Cow<'_, str> {
    if !text.contains(acts) {
        return Cow::Borrowed(text);
    }
    let escaped = |c: char| match acts(c) {
        true => c.escape_default().collect(),
        false => c.to_string(),
    };
    Cow::Owned(text.chars().map(escaped).collect())
}

/// Lines, each of them plain.
pub(crate) fn lines(text: &str) -> String {
    text.split('\n').map(plain).collect::<Vec<_>>().join("\n")
}

/// Written JSON with escapes for what acts on a terminal: what is read of it is the same. Below U+0020 its strings hold escapes already.
pub(crate) fn json_text(text: &str) -> Cow<'_, str> {
    let acts = |c: char| c > '\u{1f}' && acts(c);
    if !text.contains(acts) {
        return Cow::Borrowed(text);
    }
    let escaped = |c: char| match acts(c) {
        true => format!("\\u{:04x}", u32::from(c)),
        false => c.to_string(),
    };
    Cow::Owned(text.chars().map(escaped).collect())
}

/// A name, plain, and cut if it is long.
pub(crate) fn name(text: &str) -> String {
    cut(&plain(text), MOST_OF_NAME)
}

/// Names in a row.
pub(crate) fn names<'a>(all: impl IntoIterator<Item = &'a str>) -> String {
    all.into_iter().map(name).collect::<Vec<String>>().join(", ")
}

/// A message, plain, with what stands between backticks cut if it is long: it comes from files.
pub(crate) fn sentence(text: &str) -> String {
    let text = plain(text);
    let parts: Vec<&str> = text.split('`').collect();
    let is_quote = |k: usize| k % 2 == 1 && k + 1 < parts.len();
    let shown = parts.iter().enumerate().map(|(k, part)| match is_quote(k) {
        true => cut(part, MOST_OF_QUOTE),
        false => (*part).to_owned(),
    });
    shown.collect::<Vec<String>>().join("`")
}

/// A text, with an ellipsis in place of what is longer.
pub(crate) fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some(_) => text.chars().take(most - 1).chain(['…']).collect(),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain_and_short() {
        let long = "é".repeat(100_000);
        assert_eq!(name(&long), "é".repeat(59) + "…");
        assert_eq!(name(&"é".repeat(60)), "é".repeat(60));
        assert_eq!(name("\u{1b}[31mred\n"), "\\u{1b}[31mred\\n");
        assert_eq!(names(["a", "b\t"]), "a, b\\t");
        assert_eq!(name("lamp\u{202e}gpj.\u{2066}"), "lamp\\u{202e}gpj.\\u{2066}");
        assert_eq!(lines("a\u{1b}\n\tb\u{85}\n"), "a\\u{1b}\n\\tb\\u{85}\n");
    }

    #[test]
    fn sentences_keep_what_we_say() {
        let said =
            format!("a.glb: material `{}`: is {} black", "m".repeat(1000), "quite ".repeat(9));
        let shown = sentence(&said);
        assert!(shown.starts_with("a.glb: material `mm"), "{shown}");
        assert!(shown.ends_with(&format!("mm…`: is {} black", "quite ".repeat(9))), "{shown}");
        let half = format!("a ` {}", "b".repeat(300));
        assert_eq!(sentence(&half), half);
    }
}
