//! Places in a text, as people count them.

use std::ops::Range;

/// A value and the bytes of the text it was read from.
pub(super) type At<T> = toml::Spanned<T>;

/// A stretch of bytes of the text.
pub(super) type Span = Range<usize>;

/// Where the lines of a text start.
#[derive(Debug)]
pub(super) struct Lines {
    starts: Vec<usize>,
    text: String,
}

impl Lines {
    pub(super) fn new(text: &str) -> Self {
        let after_breaks = text.match_indices('\n').map(|(at, _)| at + 1);
        Self { starts: std::iter::once(0).chain(after_breaks).collect(), text: text.to_owned() }
    }

    /// `line 3, column 5`, both from 1, columns in characters.
    pub(super) fn place(&self, span: &Span) -> String {
        let line = self.starts.partition_point(|&start| start <= span.start).max(1);
        let before = self.text.get(self.starts[line - 1]..span.start).unwrap_or("");
        format!("line {line}, column {}", before.chars().count() + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::Lines;

    #[test]
    fn lines_and_columns_count_from_one() {
        let lines = Lines::new("a\nbäd\n");
        for (at, expected) in [
            (0, "line 1, column 1"),
            (1, "line 1, column 2"),
            (2, "line 2, column 1"),
            (5, "line 2, column 3"),
            (7, "line 3, column 1"),
            (99, "line 3, column 1"),
        ] {
            assert_eq!(lines.place(&(at..at)), expected);
        }
        assert_eq!(Lines::new("").place(&(0..0)), "line 1, column 1");
    }
}
