//! The lines before the numbers: edition, keywords, labels and `TILT=`.

use super::{Edition, Keyword};
use crate::Problem;
use crate::plain_text::Line;
use std::path::Path;

/// What stands before the numbers.
pub(super) struct Header<'a> {
    pub(super) edition: Edition,
    /// The version line, if it names no edition that there is.
    pub(super) unknown_edition: Option<&'a str>,
    pub(super) keywords: Vec<Keyword>,
    pub(super) labels: Vec<String>,
    /// What follows `TILT=`.
    pub(super) tilt: &'a str,
    /// Line of `TILT=`, from 1.
    pub(super) tilt_line: usize,
}

/// Splits a file into its header and the lines of numbers.
pub(super) fn split<'a>(
    lines: &'a [Line<'a>],
    file: &Path,
) -> Result<(Header<'a>, &'a [Line<'a>]), Problem> {
    let found = lines.iter().enumerate().find_map(|(k, line)| Some((k, tilt_value(line.text)?)));
    let Some((at, tilt)) = found else {
        let is_ies = lines.first().is_some_and(|first| is_version(first.text));
        let (what, remedy) = match is_ies {
            true => ("the file ends before its TILT= line", "get it again from its maker"),
            false => {
                ("there is no TILT= line", "give an IES LM-63 file; EULUMDAT files end in .ldt")
            }
        };
        return Err(Problem::new(file, format!("line {}", lines.len()), what, remedy));
    };
    let mut header = Header {
        edition: Edition::E1986,
        unknown_edition: None,
        keywords: Vec::new(),
        labels: Vec::new(),
        tilt,
        tilt_line: lines[at].number,
    };
    let mut before = lines[..at].iter().filter(|l| !l.text.trim().is_empty()).peekable();
    if let Some(first) = before.next_if(|l| is_version(l.text)) {
        header.edition = Edition::from_line(first.text).unwrap_or(Edition::E2002);
        header.unknown_edition =
            Edition::from_line(first.text).is_none().then_some(first.text.trim());
    }
    for line in before {
        header.take(line);
    }
    Ok((header, &lines[at + 1..]))
}

impl Header<'_> {
    fn take(&mut self, line: &Line) {
        let text = line.text.trim();
        let Some((name, value)) = text.strip_prefix('[').and_then(|t| t.split_once(']')) else {
            self.labels.push(text.into());
            return;
        };
        let (name, value) = (name.trim(), value.trim());
        match self.keywords.last_mut().filter(|_| name.eq_ignore_ascii_case("MORE")) {
            Some(last) => {
                last.value.push('\n');
                last.value.push_str(value);
            }
            None => self.keywords.push(Keyword {
                name: name.into(),
                value: value.into(),
                line: line.number,
            }),
        }
    }
}

fn tilt_value(text: &str) -> Option<&str> {
    let (name, value) = text.split_once('=')?;
    name.trim().eq_ignore_ascii_case("TILT").then_some(value.trim())
}

fn is_version(text: &str) -> bool {
    let text = text.trim_start();
    text.get(..3).is_some_and(|start| start.eq_ignore_ascii_case("IES"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_labels_and_continuations_keep_their_order() {
        let text = "IESNA91\n[TEST] one\nfree text\n[MORE] two\n [ lamp ]x\n\ntilt = None\n1 2";
        let lines = crate::plain_text::lines(text);
        let (header, rest) = split(&lines, Path::new("x")).unwrap();
        let keyword = |name: &str, value: &str, line| Keyword {
            name: name.into(),
            value: value.into(),
            line,
        };
        assert_eq!(header.keywords, [keyword("TEST", "one\ntwo", 2), keyword("lamp", "x", 5)]);
        assert_eq!(header.labels, ["free text"]);
        assert_eq!((header.tilt, header.tilt_line, rest[0].text), ("None", 7, "1 2"));
    }
}
