//! Bytes to lines: encodings and line ends that photometric files are found in.

use crate::Problem;
use std::borrow::Cow;
use std::path::Path;

/// A line and its number, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Line<'a> {
    /// Number in the file, from 1.
    pub(super) number: usize,
    /// The line without its end.
    pub(super) text: &'a str,
}

/// The text of a file: UTF-8 with or without a byte order mark, or else Latin-1; up to the Ctrl-Z
/// that ends files from DOS.
pub(super) fn decode<'a>(bytes: &'a [u8], file: &Path) -> Result<Cow<'a, str>, Problem> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let end = bytes.iter().position(|&b| b == 0x1a).unwrap_or(bytes.len());
    let bytes = &bytes[..end];
    if bytes.contains(&0) {
        return Err(Problem::new(
            file,
            "",
            "is not plain text",
            "give an LM-63 file in ASCII, Latin-1 or UTF-8",
        ));
    }
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()),
    })
}

/// Lines that end with CR LF, LF or CR.
pub(super) fn lines(text: &str) -> Vec<Line<'_>> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(end) = rest.find(['\r', '\n']) {
        found.push(Line { number: found.len() + 1, text: &rest[..end] });
        let skip = if rest[end..].starts_with("\r\n") { 2 } else { 1 };
        rest = &rest[end + skip..];
    }
    found.push(Line { number: found.len() + 1, text: rest });
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_end_ends_a_line() {
        let texts: Vec<_> = lines("a\r\nb\rc\n\nd").iter().map(|l| (l.number, l.text)).collect();
        assert_eq!(texts, [(1, "a"), (2, "b"), (3, "c"), (4, ""), (5, "d")]);
    }

    #[test]
    fn encodings_are_told_apart() {
        let text = |bytes| decode(bytes, Path::new("x.ies")).map(Cow::into_owned);
        assert_eq!(text(b"\xef\xbb\xbfM\xc3\xbcller"), Ok("Müller".into()));
        assert_eq!(text(b"M\xfcller"), Ok("Müller".into()));
        assert_eq!(text(b"one\x1atwo \x00"), Ok("one".into()));
        assert!(text(b"\xff\xfeI\0E\0S\0").is_err());
    }
}
