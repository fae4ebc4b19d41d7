//! The numbers of a file, one after the other, each with its place.

use crate::Problem;
use crate::counted::shown;
use crate::plain_text::Line;
use std::path::Path;

/// Reads numbers separated by blanks, tabs, commas and line ends.
pub(super) struct Numbers<'a> {
    file: &'a Path,
    /// Lines from the current one on.
    lines: &'a [Line<'a>],
    /// Byte of the current line from which to go on.
    at: usize,
    /// Line and column of the last word, from 1.
    place: (usize, usize),
}

impl<'a> Numbers<'a> {
    pub(super) fn new(file: &'a Path, lines: &'a [Line<'a>]) -> Self {
        Self { file, lines, at: 0, place: (lines.first().map_or(1, |l| l.number), 1) }
    }

    /// Whether nothing is left.
    pub(super) fn is_at_end(&self) -> bool {
        Self { ..*self }.word().is_none()
    }

    /// Line of the next number, from 1.
    pub(super) fn next_line(&self) -> usize {
        let mut ahead = Self { ..*self };
        ahead.word();
        ahead.place.0
    }

    /// Line of the last number, from 1.
    pub(super) fn line(&self) -> u32 {
        u32::try_from(self.place.0).unwrap_or(u32::MAX)
    }

    /// A finding at the last number.
    pub(super) fn problem(&self, what: impl Into<String>, remedy: impl Into<String>) -> Problem {
        let (line, column) = self.place;
        Problem::new(self.file, format!("line {line}, column {column}"), what, remedy)
    }

    /// The next word, if any.
    pub(super) fn word(&mut self) -> Option<&'a str> {
        let separator = |c: char| c.is_whitespace() || c == ',';
        while let Some((line, later)) = self.lines.split_first() {
            let rest = &line.text[self.at..];
            if let Some(start) = rest.find(|c| !separator(c)) {
                let word = &rest[start..];
                let word = &word[..word.find(separator).unwrap_or(word.len())];
                let column = line.text[..self.at + start].chars().count() + 1;
                self.place = (line.number, column);
                self.at += start + word.len();
                return Some(word);
            }
            (self.lines, self.at) = (later, 0);
        }
        None
    }

    /// The next number; `what` names it in messages.
    pub(super) fn number(&mut self, what: impl Fn() -> String) -> Result<f64, Problem> {
        let Some(word) = self.word() else {
            return Err(Problem::new(
                self.file,
                format!("line {}", self.place.0),
                format!("the file ends where {} should follow", what()),
                "the file is cut short, or its counts are too high; get it again from its maker",
            ));
        };
        finite(word).ok_or_else(|| {
            self.problem(
                format!("{:?} is not a number, where {} should be", shortened(word), what()),
                "correct it, or the counts before it; decimals take a point, not a comma",
            )
        })
    }

    /// The next number, which must satisfy a condition stated in `must`.
    pub(super) fn number_that(
        &mut self,
        what: impl Fn() -> String,
        must: &str,
        holds: impl Fn(f64) -> bool,
    ) -> Result<f64, Problem> {
        let value = self.number(&what)?;
        if holds(value) {
            return Ok(value);
        }
        Err(self
            .problem(format!("{} is {}, but must be {must}", what(), shown(value)), "correct it"))
    }

    /// The next number, a whole one from `least` to `most`.
    pub(super) fn count(&mut self, what: &str, least: u32, most: u32) -> Result<u32, Problem> {
        let must = format!("a whole number from {least} to {most}");
        let whole = |v: f64| v.fract() == 0.0 && (f64::from(least)..=f64::from(most)).contains(&v);
        Ok(self.number_that(|| what.into(), &must, whole)? as u32)
    }

    /// So many numbers, each above the one before it, within bounds.
    pub(super) fn angles(
        &mut self,
        what: &str,
        count: u32,
        [least, most]: [f64; 2],
    ) -> Result<Vec<f64>, Problem> {
        let mut angles: Vec<f64> = Vec::new();
        for index in 1..=count {
            let name = || format!("{what} {index} of {count}");
            let must = format!("within {least} and {most} degrees");
            let angle = self.number_that(name, &must, |a| (least..=most).contains(&a))?;
            if let Some(before) = angles.last().filter(|&&before| angle <= before) {
                return Err(self.problem(
                    format!("{} is {}, not above {before} before it", name(), shown(angle)),
                    "list angles in increasing order, and check the counts before them",
                ));
            }
            angles.push(angle);
        }
        Ok(angles)
    }
}

/// A decimal number; not the words for infinity and not-a-number that a parser may know.
fn finite(word: &str) -> Option<f64> {
    let decimal = word.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    word.parse().ok().filter(|v: &f64| decimal && v.is_finite())
}

/// At most twenty characters of a word, for messages.
fn shortened(word: &str) -> String {
    if word.chars().count() > 20 {
        word.chars().take(19).chain(['…']).collect()
    } else {
        word.into()
    }
}
