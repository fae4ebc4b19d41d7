//! Plain text of unknown encoding: bounded reading, decoding, lines.

use crate::Problem;
use crate::source::{from_utf16, without_mark};
use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Windows-1252 between 0x80 and 0x9f, where Latin-1 has control characters.
const WINDOWS_1252: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}',
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// A line and its number, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Line<'a> {
    /// Number in the file, from 1.
    pub(crate) number: usize,
    /// The line without its end.
    pub(crate) text: &'a str,
}

/// The bytes of a file of at most so many.
pub(crate) fn read_bounded(path: &Path, most: u64) -> Result<Vec<u8>, Problem> {
    // A pipe or a device may have no end, or never begin.
    if !path.metadata().map_err(|error| Problem::unreadable(path, &error))?.is_file() {
        return Err(Problem::new(path, "", "is not a regular file", "give a photometric file"));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(most + 1).read_to_end(&mut bytes))
        .map_err(|error| Problem::unreadable(path, &error))?;
    if bytes.len() as u64 > most {
        let what = format!("is larger than {} MiB", most >> 20);
        return Err(Problem::new(path, "", what, "give a photometric file"));
    }
    Ok(bytes)
}

/// The text of a file: UTF-16 or UTF-8 by its byte order mark, UTF-8 without one, or else Windows-1252, of which
/// Latin-1 is a part; up to the Ctrl-Z that ends files from DOS.
pub(crate) fn decode<'a>(bytes: &'a [u8], file: &Path) -> Result<Cow<'a, str>, Problem> {
    if let Some(text) = from_utf16(bytes) {
        return decode(text.as_bytes(), file).map(|text| Cow::Owned(text.into_owned()));
    }
    let bytes = without_mark(bytes);
    let end = bytes.iter().position(|&b| b == 0x1a).unwrap_or(bytes.len());
    let bytes = &bytes[..end];
    if bytes.contains(&0) {
        return Err(Problem::new(
            file,
            "",
            "is not plain text",
            "give a photometric file in ASCII, Latin-1 or UTF-8",
        ));
    }
    if bytes.trim_ascii().is_empty() {
        return Err(Problem::new(file, "", "is empty", "copy it again, or get it from its maker"));
    }
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| windows_1252(b)).collect()),
    })
}

fn windows_1252(byte: u8) -> char {
    match byte {
        0x80..=0x9f => WINDOWS_1252[usize::from(byte - 0x80)],
        _ => char::from(byte),
    }
}

/// Lines that end with CR LF, LF or CR.
pub(crate) fn lines(text: &str) -> Vec<Line<'_>> {
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
        assert_eq!(text(b"\x80 5 \x96 M\xfc"), Ok("€ 5 – Mü".into()));
        assert_eq!(text(b"one\x1atwo \x00"), Ok("one".into()));
        assert_eq!(text(b"\xff\xfeI\0E\0S\0"), Ok("IES".into()));
        assert_eq!(text(b"\xfe\xff\0I\0E\0S"), Ok("IES".into()));
        for empty in [&b""[..], b"\r\n \n", b"\xef\xbb\xbf", b"\x1a"] {
            assert_eq!(text(empty).unwrap_err().what, "is empty", "{empty:?}");
        }
    }
}
