//! From the words of the command line to flags.

use crate::console;
use crate::flags::{self, Flags};
use crate::trouble::{self, Trouble};
use clap::Parser;
use clap::error::ErrorKind;
use std::ffi::OsString;

/// The exit code of arguments that are wrong.
const BAD_INPUT: u8 = 2;

/// Reads the arguments. Where they ask for help or are wrong, it prints that and gives the exit code.
pub(crate) fn read(words: impl Iterator<Item = OsString>) -> Result<Flags, u8> {
    let words: Vec<OsString> = words.collect();
    parsed(&words).map_err(|error| {
        // Nobody may be there to read it.
        let _ = error.print();
        if !is_help(&error) && asks_for_json(&words) {
            let troubles = [of_arguments(&error)];
            let _ = console::print_json(&trouble::json(&troubles, BAD_INPUT));
        }
        if is_help(&error) { 0 } else { BAD_INPUT }
    })
}

/// What arguments ask for.
pub(crate) enum Asked {
    /// Work.
    For(Box<Flags>),
    /// This text.
    Help(String),
}

/// The same without a word.
pub(crate) fn of_call(words: &[OsString]) -> Result<Asked, Trouble> {
    match parsed(words) {
        Ok(flags) => Ok(Asked::For(Box::new(flags))),
        Err(error) if is_help(&error) => Ok(Asked::Help(error.render().to_string())),
        Err(error) => Err(of_arguments(&error)),
    }
}

/// Whether nothing is wrong: what was asked for is text.
fn is_help(error: &clap::Error) -> bool {
    matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion)
}

fn parsed(words: &[OsString]) -> Result<Flags, clap::Error> {
    Flags::try_parse_from(words.iter().cloned().map(flags::with_two_dashes))
}

/// Whether `--json` is among words that cannot be read as flags.
fn asks_for_json(words: &[OsString]) -> bool {
    words.iter().skip(1).take_while(|word| *word != "--").any(|word| word == "--json")
}

/// What is wrong, without the usage that is printed below it.
fn of_arguments(error: &clap::Error) -> Trouble {
    let text = error.render().to_string();
    if matches!(
        error.kind(),
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand | ErrorKind::MissingSubcommand
    ) {
        return Trouble {
            message: "a subcommand is missing".to_owned(),
            file: None,
            place: None,
            remedy: Some("`isolux --help` lists them".to_owned()),
        };
    }
    let body = text.split("\n\nUsage:").next().unwrap_or_default();
    let lines = || body.lines().map(str::trim).filter(|line| !line.is_empty());
    let is_about = |line: &&str| !is_tip(line) && !line.starts_with("For more information");
    let message = lines().filter(is_about).collect::<Vec<&str>>().join(" ");
    let tips: Vec<&str> = lines().filter_map(|line| line.strip_prefix("tip: ")).collect();
    let help = || text.lines().find_map(|line| line.strip_prefix("For more information, "));
    let remedy = if tips.is_empty() {
        help().map(|help| help.trim_end_matches('.').to_owned())
    } else {
        Some(tips.join("; "))
    };
    let message = message.strip_prefix("error: ").unwrap_or(&message).to_owned();
    Trouble { message, file: None, place: None, remedy }
}

fn is_tip(line: &str) -> bool {
    line.starts_with("tip: ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trouble(words: &[&str]) -> Trouble {
        let words = std::iter::once("isolux").chain(words.iter().copied());
        of_arguments(&Flags::try_parse_from(words).unwrap_err())
    }

    #[test]
    fn wrong_arguments_are_told_without_the_usage() {
        let unknown = trouble(&["solve", "a.glb", "-o", "m.glb", "--acuracy", "1%"]);
        assert_eq!(unknown.message, "unexpected argument '--acuracy' found");
        assert!(unknown.remedy.as_ref().is_some_and(|r| r.contains("--accuracy")), "{unknown:?}");
        let missing = trouble(&["solve", "a.glb"]);
        assert!(missing.message.contains("--output"), "{missing:?}");
        assert_eq!(missing.remedy.as_deref(), Some("try '--help'"));
        let value = trouble(&["solve", "a.glb", "-o", "m.glb", "--accuracy", "7"]);
        assert!(value.message.contains("--accuracy") && value.message.contains("1%"), "{value:?}");
        assert_eq!(trouble(&[]).message, "a subcommand is missing");
    }

    #[test]
    fn json_is_asked_for_before_the_end_of_flags() {
        let asks = |words: &[&str]| {
            asks_for_json(&words.iter().map(OsString::from).collect::<Vec<OsString>>())
        };
        assert!(asks(&["isolux", "solve", "--json", "x"]));
        assert!(!asks(&["--json", "solve", "--", "--json"]));
    }
}
