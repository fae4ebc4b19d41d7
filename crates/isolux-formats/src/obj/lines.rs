//! The line structure that OBJ and MTL share.

use std::borrow::Cow;

/// A statement: its line number, its keyword and the rest.
#[derive(Debug, PartialEq)]
pub(super) struct Statement<'a> {
    pub(super) line: usize,
    pub(super) text: Cow<'a, str>,
}

impl Statement<'_> {
    /// The keyword and what follows it.
    pub(super) fn split(&self) -> (&str, &str) {
        match self.text.split_once(char::is_whitespace) {
            Some((keyword, rest)) => (keyword, rest.trim()),
            None => (&self.text, ""),
        }
    }

    /// Where it stands.
    pub(super) fn place(&self) -> String {
        place(self.line)
    }
}

/// A line as a place.
pub(super) fn place(line: usize) -> String {
    format!("line {line}")
}

/// The statements of a text: without comments and blank lines, continued lines joined.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        loop {
            let (index, first) = lines.next()?;
            let mut text = Cow::Borrowed(without_comment(first));
            while let Some(open) = text.strip_suffix('\\') {
                let mut joined = open.to_owned();
                joined.push(' ');
                joined.push_str(lines.next().map_or("", |(_, more)| without_comment(more)));
                text = Cow::Owned(joined);
            }
            if !text.is_empty() {
                return Some(Statement { line: index + 1, text });
            }
        }
    })
}

/// Statements whose rest is a name, which may hold a `#`.
const NAMING: [&str; 6] = ["g", "map_Kd", "mtllib", "newmtl", "o", "usemtl"];

fn without_comment(line: &str) -> &str {
    let line = line.trim();
    match line.split_whitespace().next() {
        Some(keyword) if NAMING.contains(&keyword) => line,
        _ => line.split('#').next().unwrap_or(line).trim(),
    }
}

/// Finite numbers separated by blanks; `None` if one is not.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split_whitespace().map(number).collect()
}

/// A finite number.
pub(super) fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_keep_their_lines() {
        let text = "# head\r\n\r\nv 1 2 3 # tail\r\nf 1 2 \\\r\n 3 \\\n4\no\tname of it\\";
        let found: Vec<_> = statements(text).map(|s| (s.line, s.text.into_owned())).collect();
        let expected = [(3, "v 1 2 3"), (4, "f 1 2  3  4"), (7, "o\tname of it ")];
        assert_eq!(found, expected.map(|(line, text)| (line, text.to_owned())));
    }

    #[test]
    fn names_were_cut_at_a_number_sign() {
        let text = "newmtl Map #1\n  usemtl Wood#2\n#newmtl no\nmap_Kd a#b.png";
        let found: Vec<_> = statements(text).map(|s| s.text.into_owned()).collect();
        assert_eq!(found, ["newmtl Map #1", "usemtl Wood#2", "map_Kd a#b.png"]);
    }

    #[test]
    fn only_finite_numbers() {
        assert_eq!(numbers(" 1 -2.5e3\t0 "), Some(vec![1.0, -2500.0, 0.0]));
        for bad in ["nan", "inf", "1e999", "0x10", "1,5", "one"] {
            assert_eq!(number(bad), None, "{bad}");
        }
    }
}
