//! The lines of a file, one value each.

use crate::Problem;
use crate::counted::shown;
use crate::plain_text::Line;
use std::path::Path;

/// Reads one value a line.
pub(super) struct Fields<'a> {
    file: &'a Path,
    lines: std::slice::Iter<'a, Line<'a>>,
    /// Line of the last value, from 1.
    line: usize,
}

impl<'a> Fields<'a> {
    pub(super) fn new(file: &'a Path, lines: &'a [Line<'a>]) -> Self {
        Self { file, lines: lines.iter(), line: 0 }
    }

    /// Line of the next value, from 1.
    pub(super) fn next_line(&self) -> usize {
        self.line + 1
    }

    /// A finding at the last value.
    pub(super) fn problem(&self, what: impl Into<String>, remedy: &str) -> Problem {
        Problem::new(self.file, format!("line {}", self.line), what, remedy)
    }

    /// The next line that holds anything.
    pub(super) fn rest(&mut self) -> Option<&'a str> {
        loop {
            let line = self.lines.next()?;
            self.line = line.number;
            if !line.text.trim().is_empty() {
                return Some(line.text.trim());
            }
        }
    }

    /// The next line, without blanks around it.
    pub(super) fn text(&mut self, what: &str) -> Result<&'a str, Problem> {
        let Some(line) = self.lines.next() else {
            return Err(self.problem(
                format!("the file ends where {what} should follow"),
                "the file is cut short, or its counts are too high; get it again from its maker",
            ));
        };
        self.line = line.number;
        Ok(line.text.trim())
    }

    /// The next line, a number that satisfies a condition stated in `must`. Decimals take a point
    /// or a comma.
    pub(super) fn number(
        &mut self,
        what: &str,
        must: &str,
        holds: impl Fn(f64) -> bool,
    ) -> Result<f64, Problem> {
        let text = self.text(what)?;
        let Some(value) = decimal(text) else {
            let start: String = text.chars().take(20).collect();
            return Err(self.problem(
                format!("{start:?} is not a number, where {what} should be"),
                "every value has its line; check that none is missing above",
            ));
        };
        if holds(value) {
            return Ok(value);
        }
        Err(self.problem(format!("{what} is {}, but must be {must}", shown(value)), "correct it"))
    }

    /// As [`Self::number`], for values that are often left empty: 0 then.
    pub(super) fn optional(
        &mut self,
        what: &str,
        must: &str,
        holds: impl Fn(f64) -> bool,
    ) -> Result<f64, Problem> {
        match self.lines.as_slice().first() {
            Some(line) if line.text.trim().is_empty() => self.text(what).map(|_| 0.0),
            _ => self.number(what, must, holds),
        }
    }

    /// The next line, a whole number.
    pub(super) fn count(&mut self, what: &str, least: i32, most: i32) -> Result<i32, Problem> {
        let must = format!("a whole number from {least} to {most}");
        let whole = |v: f64| v.fract() == 0.0 && (f64::from(least)..=f64::from(most)).contains(&v);
        Ok(self.number(what, &must, whole)? as i32)
    }

    /// So many angles, increasing from 0 or more to at most `most`.
    pub(super) fn angles(
        &mut self,
        what: &str,
        count: usize,
        most: f64,
    ) -> Result<Vec<f64>, Problem> {
        let mut angles: Vec<f64> = Vec::new();
        let must = format!("within 0 and {most} degrees");
        for index in 1..=count {
            let name = format!("{what} {index} of {count}");
            let angle = self.number(&name, &must, |a| (0.0..=most).contains(&a))?;
            if let Some(before) = angles.last().filter(|&&before| angle <= before) {
                return Err(self.problem(
                    format!("{name} is {}, not above {before} before it", shown(angle)),
                    "list angles in increasing order, and check the counts in lines 4 and 6",
                ));
            }
            angles.push(angle);
        }
        Ok(angles)
    }
}

/// A decimal number; not the words for infinity and not-a-number that a parser may know.
fn decimal(text: &str) -> Option<f64> {
    let known = text.bytes().all(|b| b.is_ascii_digit() || b"+-.,eE".contains(&b));
    let value: f64 = known.then(|| text.replace(',', "."))?.parse().ok()?;
    value.is_finite().then_some(value)
}
