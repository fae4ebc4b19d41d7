//! What keeps the command from its result, with its place and its remedy where they are known.

use crate::caller;
use crate::shown::plain;
use isolux_formats::Problem;
use serde::Serialize;
use std::fmt::Display;
use std::path::Path;

/// One problem.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Trouble {
    /// All of it in one line, as it is printed.
    pub message: String,
    /// The file that it is about.
    pub file: Option<String>,
    /// The place in the file: `line 12, column 3`.
    pub place: Option<String>,
    /// What the user can do.
    pub remedy: Option<String>,
}

impl Trouble {
    /// A problem of a file.
    pub(crate) fn of_file(problem: &Problem) -> Self {
        let known = |text: &str| (!text.is_empty()).then(|| text.to_owned());
        Self {
            // One line, whatever names it holds.
            message: plain(&problem.to_string()).into_owned(),
            file: Some(problem.file.display().to_string()),
            place: known(&problem.place),
            remedy: known(&problem.remedy),
        }
    }

    /// A problem in words, `FILE: PLACE: WHAT; REMEDY`, of which only WHAT must be there. A file is recognized if it is
    /// an argument of the command, or a word of the call.
    pub(crate) fn in_words(words: impl Display) -> Self {
        let arguments = caller::here()
            .map_or_else(|| std::env::args().skip(1).collect(), |call| call.names_of_files());
        Self::among(&words.to_string(), |file| arguments.iter().any(|word| word == file))
    }

    /// The same of a file that may be no argument of its own.
    pub(crate) fn about(file: &Path, words: impl Display) -> Self {
        let file = file.display().to_string();
        Self::among(&format!("{file}: {words}"), |known| known == file)
    }

    fn among(message: &str, is_file: impl Fn(&str) -> bool) -> Self {
        let (about, remedy) = match message.rsplit_once("; ") {
            Some((about, remedy)) => (about, Some(remedy.to_owned())),
            None => (message, None),
        };
        let file = about.match_indices(": ").map(|(at, _)| &about[..at]).find(|file| is_file(file));
        let rest = file.map_or("", |file| &about[file.len() + 2..]);
        let place = rest.split_once(": ").map(|(place, _)| place).filter(|p| is_line(p));
        Self {
            message: message.to_owned(),
            file: file.map(str::to_owned),
            place: place.map(str::to_owned),
            remedy,
        }
    }
}

/// Whether this is the place of a line: `line 3`, `line 3, column 5`.
fn is_line(text: &str) -> bool {
    text.strip_prefix("line ").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

/// The one JSON value of a command without a result.
pub(crate) fn json(troubles: &[Trouble], exit_code: u8) -> serde_json::Value {
    let first = troubles.first();
    let of_first = |of: fn(&Trouble) -> Option<&String>| first.and_then(of);
    serde_json::json!({ "error": {
        "message": first.map(|t| &t.message),
        "file": of_first(|t| t.file.as_ref()),
        "place": of_first(|t| t.place.as_ref()),
        "remedy": of_first(|t| t.remedy.as_ref()),
        "exit_code": exit_code,
        "problems": troubles,
    }})
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_taken_apart() {
        let known = |file: &str| file == "a.pts" || file == "C: d.glb";
        let parts = |text: &str| {
            let Trouble { file, place, remedy, .. } = Trouble::among(text, known);
            [file, place, remedy].map(Option::unwrap_or_default)
        };
        for (text, expected) in [
            ("a.pts: line 3: 1 number; write six", ["a.pts", "line 3", "write six"]),
            ("a.pts: holds no point; write some", ["a.pts", "", "write some"]),
            ("C: d.glb: is a folder: no; a; b", ["C: d.glb", "", "b"]),
            ("--picture: a.pts has two grids; choose", ["", "", "choose"]),
            ("line 3: is bad", ["", "", ""]),
            ("", ["", "", ""]),
        ] {
            assert_eq!(parts(text), expected, "{text}");
        }
    }

    #[test]
    fn the_object_has_the_first_problem_and_all() {
        let one = Problem::new(Path::new("a\n.toml"), "line 2", "is bad", "mend it");
        let all = [Trouble::of_file(&one), Trouble::among("worse", |_| false)];
        let object = &json(&all, 2)["error"];
        assert_eq!(object["message"], "a\\n.toml: line 2: is bad; mend it");
        assert_eq!(object["file"], "a\n.toml");
        assert_eq!((&object["place"], &object["remedy"]), (&"line 2".into(), &"mend it".into()));
        assert_eq!(
            (&object["exit_code"], object["problems"][1]["file"].is_null()),
            (&2.into(), true)
        );
        assert_eq!(object["problems"].as_array().map(Vec::len), Some(2));
        assert!(json(&[], 4)["error"]["message"].is_null());
    }
}
