//! What is printed on standard error: everything but results.

use crate::caller::{self, Told};
use crate::shown::{json_text, plain, sentence};
use anstyle::{AnsiColor, Style};
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether all lines on standard error are JSON objects.
static NOTES_ARE_JSON: AtomicBool = AtomicBool::new(false);

/// From now on every line on standard error is a JSON object.
pub(crate) fn note_as_json() {
    NOTES_ARE_JSON.store(true, Ordering::Relaxed);
}

/// Whether they are.
pub(crate) fn are_json() -> bool {
    NOTES_ARE_JSON.load(Ordering::Relaxed)
}

/// What a line on standard error is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Note {
    /// Keeps the command from its result.
    Error,
    /// The machine, or a limit, keeps the command from its result.
    Refused,
    /// Left out or guessed.
    Warning,
    /// Good to know.
    Info,
}

impl Note {
    /// In front of the line, or the key of its object.
    fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Refused => "refused",
            Self::Warning => "warning",
            Self::Info => "note",
        }
    }

    /// How a terminal shows the name.
    const fn style(self) -> Style {
        let colour = match self {
            Self::Error | Self::Refused => AnsiColor::Red,
            Self::Warning => AnsiColor::Yellow,
            Self::Info => return Style::new(),
        };
        colour.on_default().bold()
    }

    /// The line, with its style.
    fn line(self, text: &str, as_json: bool) -> String {
        let style = self.style();
        match (as_json, self) {
            (true, _) => json_text(&serde_json::json!({ self.name(): text }).to_string()).into(),
            (false, Self::Info) => sentence(text),
            (false, _) => format!("{style}{}:{style:#} {}", self.name(), sentence(text)),
        }
    }
}

/// Prints a line for the user to standard error, in colour where a terminal shows it: `NO_COLOR` and `CLICOLOR_FORCE`
/// decide before that.
pub(crate) fn note(kind: Note, text: impl std::fmt::Display) {
    let text = text.to_string();
    if let Some(call) = caller::here() {
        return call.tell(Told::Note(kind.name(), plain(&text).into_owned()));
    }
    let _ = writeln!(anstream::stderr(), "{}", kind.line(&text, are_json()));
}

/// Prints a line of JSON to standard error. Nobody may be there to read it.
pub(crate) fn line(line: impl std::fmt::Display) {
    debug_assert!(caller::here().is_none(), "a caller asks for no lines");
    let _ = writeln!(std::io::stderr(), "{}", json_text(&line.to_string()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_note_is_a_line_or_an_object() {
        let text = "a \"b\": c";
        let shown =
            |note: Note, text| anstream::adapter::strip_str(&note.line(text, false)).to_string();
        assert_eq!(shown(Note::Warning, text), "warning: a \"b\": c");
        assert_eq!(Note::Info.line(text, false), text);
        assert_eq!(shown(Note::Warning, "a\u{1b}"), "warning: a\\u{1b}");
        assert_eq!(Note::Error.line("a", false), "\u{1b}[1m\u{1b}[31merror:\u{1b}[0m a");
        assert_eq!(Note::Error.line(text, true), r#"{"error":"a \"b\": c"}"#);
    }
}
