//! Radiance text into its record.

use super::limits;
use super::record::{Item, Kind, Object, kind_of};
use super::words::{Words, number};
use crate::lines::{At, Notes};
use std::path::Path;
use std::rc::Rc;

/// Reads all statements of a file; what is wrong goes to the notes with its line. Arguments are
/// counted in the file: after a wrong count nothing can be told, and the rest is left.
pub(super) fn parse(text: &str, file: &Rc<Path>, notes: &mut Notes) -> Vec<Item> {
    let mut words = Words::new(text);
    let mut items = Vec::new();
    while let Some(first) = words.peek() {
        let line = words.line();
        match first {
            '#' => {
                words.rest_of_line();
            }
            '!' => items.push(Item::Command { line, text: command(&mut words) }),
            _ => match object(&mut words, file, notes) {
                Ok(object) => items.extend(object.map(Item::Object)),
                Err(what) => {
                    let remedy = "after it, the rest of the file cannot be read; correct it";
                    notes.problem(&At { file: file.clone(), line }, what, remedy);
                    break;
                }
            },
        }
    }
    items
}

/// A command without its mark, over all lines that end in a backslash.
fn command(words: &mut Words) -> String {
    let mut text = words.rest_of_line()[1..].to_owned();
    while text.ends_with('\\') {
        text.pop();
        text.push(' ');
        text.push_str(words.rest_of_line());
    }
    text
}

/// An object; `None` if it cannot be used but its end is known.
fn object(words: &mut Words, file: &Rc<Path>, notes: &mut Notes) -> Result<Option<Object>, String> {
    let at = At { file: file.clone(), line: words.line() };
    let mut next = |what: &str| {
        words.word().map(str::to_owned).ok_or_else(|| format!("the file ends before {what}"))
    };
    let (modifier, type_, name) = (next("a type")?, next("a type")?, next("an identifier")?);
    let Some(kind) = kind_of(&type_) else {
        let shown: String = type_.chars().take(40).collect();
        return Err(format!("`{shown}` is not a type of Radiance"));
    };
    if kind == Kind::Alias {
        let strings = vec![next("what the alias stands for")?];
        return Ok(Some(Object { line: at.line, modifier, type_, name, strings, numbers: vec![] }));
    }
    let label = format!("{type_} `{name}`");
    let strings = strings(words, &label)?;
    if !list(words, &label, "integer")?.is_empty() {
        return Err(format!("{label} has integer arguments, which Radiance does not use"));
    }
    let mut is_whole = true;
    let mut numbers = Vec::new();
    for word in list(words, &label, "real")? {
        match number(word) {
            Some(value) => numbers.push(value),
            None => {
                is_whole = false;
                let shown: String = word.chars().take(40).collect();
                let what = format!("{label}: `{shown}` is not a finite number");
                notes.problem(&at, what, "write a number");
            }
        }
    }
    Ok(is_whole.then_some(Object { line: at.line, modifier, type_, name, strings, numbers }))
}

fn strings(words: &mut Words, label: &str) -> Result<Vec<String>, String> {
    Ok(list(words, label, "string")?.into_iter().map(str::to_owned).collect())
}

/// A count and so many words.
fn list<'a>(words: &mut Words<'a>, label: &str, what: &str) -> Result<Vec<&'a str>, String> {
    let word = words.word().unwrap_or_default();
    let count: usize = word.parse().map_err(|_| {
        let shown: String = word.chars().take(40).collect();
        format!("{label}: `{shown}` where the number of {what} arguments is expected")
    })?;
    if count as u64 > limits::BYTES {
        return Err(format!("{label}: {count} {what} arguments"));
    }
    let mut found = Vec::new();
    for k in 0..count {
        let word = words.word().ok_or_else(|| {
            format!("{label}: the file ends after {k} of {count} {what} arguments")
        })?;
        found.push(word);
    }
    Ok(found)
}
