//! Commands in scenes, resolved without a shell.

use super::argument_files::{self, Lookup};
use super::genbox;
use super::record::Object;
use super::sky_commands;
use super::words::{number, stages};
use super::xform::{self, Xform};
use isolux::units::Rgb;

/// What a command puts into the scene.
pub(super) struct Command {
    pub(super) source: Source,
    /// What is done with it, the first the innermost.
    pub(super) stages: Vec<Xform>,
}

/// Where the objects of a command come from.
pub(super) enum Source {
    /// Radiance files.
    Files(Vec<String>),
    /// Objects made here.
    Objects(Vec<Object>),
    /// A photometric file.
    Ies(IesCommand),
}

/// `ies2rad`.
#[derive(Debug, PartialEq)]
pub(super) struct IesCommand {
    pub(super) file: String,
    /// `-m`.
    pub(super) factor: f64,
    /// `-c`.
    pub(super) colour: Rgb,
    /// Whether the file's lamp would have been looked up for its colour and depreciation.
    pub(super) looks_up_lamp: bool,
}

/// Why a command is not done, and what to do.
pub(super) type Refusal = (String, &'static str);

/// What a command means: several commands where `xform -f` reads its arguments from the lines of a file.
pub(super) fn parse(text: &str, line: usize, lookup: Lookup) -> Result<Vec<Command>, Refusal> {
    let all = stages(text).map_err(|what| (format!("`!{}`: {what}", shown(text)), COMMANDS))?;
    let wrong = |what: String| (format!("`!{}`: {what}", shown(text)), ARGUMENTS);
    let all = argument_files::expand(all, lookup).map_err(wrong)?;
    all.iter().map(|stages| of_stages(stages, text, line)).collect()
}

const COMMANDS: &str = "commands are not run; only xform, genbox, ies2rad, gensky, gendaylit and cat, joined by pipes, are \
                        understood: run it yourself and name the file it writes by `!xform FILE`";
const ARGUMENTS: &str = "see the manual of the command";
const RUN_IT: &str = "run it yourself, and name the file with what it writes by `!xform FILE`";

/// What the stages of one command mean.
fn of_stages(all: &[Vec<String>], text: &str, line: usize) -> Result<Command, Refusal> {
    let mut all = all.iter();
    let first = all.next().map_or(&[][..], |words| words);
    let Some((program, words)) = first.split_first() else {
        return Err(("`!` without a command".into(), "remove it"));
    };
    let wrong = |what: String| (format!("`!{program}`: {what}"), ARGUMENTS);
    let sky = |what: String| (format!("`!{program}`: {what}"), RUN_IT);
    let mut stages = Vec::new();
    let source = match program.as_str() {
        "xform" => {
            let mut xform = xform::parse(words).map_err(wrong)?;
            let files = std::mem::take(&mut xform.files);
            stages.push(xform);
            Source::Files(files)
        }
        "cat" => Source::Files(words.to_vec()),
        "genbox" => Source::Objects(genbox::objects(words, line).map_err(wrong)?),
        "ies2rad" => Source::Ies(ies2rad(words).map_err(wrong)?),
        "gensky" => Source::Objects(sky_commands::gensky(words, line).map_err(sky)?),
        "gendaylit" => Source::Objects(sky_commands::gendaylit(words, line).map_err(sky)?),
        _ => return Err((format!("`!{}` is not run", shown(program)), COMMANDS)),
    };
    if matches!(&source, Source::Files(files) if files.is_empty()) {
        return Err(wrong("it names no file".into()));
    }
    for stage in all {
        let Some(("xform", words)) = stage.split_first().map(|(p, w)| (p.as_str(), w)) else {
            return Err((
                format!("`!{}`: only xform is understood after a pipe", shown(text)),
                COMMANDS,
            ));
        };
        let xform = xform::parse(words).map_err(wrong)?;
        if !xform.files.is_empty() {
            return Err(wrong("a file after a pipe".into()));
        }
        stages.push(xform);
    }
    Ok(Command { source, stages })
}

/// The beginning of a text that may be of any length.
fn shown(text: &str) -> String {
    text.trim().chars().take(60).collect()
}

fn ies2rad(words: &[String]) -> Result<IesCommand, String> {
    let mut command =
        IesCommand { file: String::new(), factor: 1.0, colour: Rgb::WHITE, looks_up_lamp: true };
    let mut words = words.iter().map(String::as_str);
    while let Some(word) = words.next() {
        let mut value = || {
            let value = words.next().ok_or_else(|| format!("{word} without its value"))?;
            number(value).filter(|&v| v >= 0.0).ok_or_else(|| format!("{word} {value}"))
        };
        match word {
            "-m" => command.factor = value()?,
            "-c" => {
                command.colour = Rgb::new(value()?, value()?, value()?);
                command.looks_up_lamp = false;
            }
            // Units and shape of the geometry that is not made, and where its files would go.
            "-i" | "-g" | "-l" | "-p" | "-o" | "-f" => {
                words.next();
            }
            "-t" => command.looks_up_lamp &= words.next() != Some("default"),
            "-u" => command.looks_up_lamp |= words.next() != Some("default"),
            "-s" => {}
            _ if word.starts_with("-d") => {}
            _ if word.starts_with('-') => return Err(format!("its option `{word}` is not read")),
            _ if command.file.is_empty() => command.file = word.to_owned(),
            _ => return Err("it names more than one file".into()),
        }
    }
    if command.file.is_empty() {
        return Err("it names no file".into());
    }
    Ok(command)
}
