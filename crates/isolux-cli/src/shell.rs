//! `isolux completions` and `isolux man`: help for shells and manual pages.

use crate::console::{print, print_json, print_raw};
use crate::failure::{Failure, Outcome};
use crate::flags::{CompletionsFlags, Flags, ManFlags};
use crate::output::create_folder;
use clap::{Command, CommandFactory};
use clap_mangen::Man;
use isolux_formats::atomic;
use serde::Serialize;

/// Prints the completions of a shell.
pub(crate) fn completions(flags: &CompletionsFlags, json: bool) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(flags.shell, &mut Flags::command(), "isolux", &mut script);
    let script = String::from_utf8_lossy(&script);
    if json {
        print_json(&serde_json::json!({ "shell": flags.shell.to_string(), "script": script }))?;
    } else {
        print_raw(&script)?;
    }
    Ok(Outcome::Done)
}

/// The manual pages written.
#[derive(Serialize)]
struct Pages {
    files: Vec<String>,
}

/// Writes a manual page of the command and one of each subcommand.
pub(crate) fn man(flags: &ManFlags, json: bool) -> Result<Outcome, Failure> {
    create_folder(&flags.output)?;
    let mut whole = Flags::command();
    whole.build();
    let subcommands = whole.get_subcommands().filter(|command| !command.is_hide_set());
    let named = |command: &Command| {
        let name = format!("isolux-{}", command.get_name());
        let title = name.clone();
        (name, command.clone().display_name(title))
    };
    let pages: Vec<(String, Command)> = std::iter::once(("isolux".to_owned(), whole.clone()))
        .chain(subcommands.map(named))
        .collect();
    let mut files = Vec::new();
    for (name, command) in pages {
        let path = flags.output.join(format!("{name}.1"));
        let mut page = Vec::new();
        let refused = |problem: String| Failure::Refused(format!("{}: {problem}", path.display()));
        Man::new(command).render(&mut page).map_err(|e| refused(e.to_string()))?;
        atomic::write(&path, &page).map_err(|problem| Failure::Refused(problem.to_string()))?;
        files.push(path.display().to_string());
    }
    if json {
        print_json(&Pages { files })?;
    } else {
        print(&format!("{}\n", files.join("\n")))?;
    }
    Ok(Outcome::Done)
}
