//! What is asked of the bench.

use std::path::PathBuf;

const USE: &str = "use --only kills|disk|foreign|twice|same|sizes|hostile, --seed N, --count N, --isolux PATH, --other PATH, --arm PATH, --save";

/// Its flags.
pub(super) struct Flags<'a> {
    pub(super) only: Option<&'a str>,
    pub(super) seed: u64,
    /// Runs that are disturbed; the other parts do more or less in proportion.
    pub(super) count: u64,
    /// Another command than that of this workspace.
    pub(super) isolux: Option<PathBuf>,
    /// The command built in another way, whose bytes are to be the same.
    pub(super) other: Option<PathBuf>,
    /// The command built for 64-bit Arm, which is played.
    pub(super) arm: Option<PathBuf>,
    pub(super) save: bool,
}

impl<'a> Flags<'a> {
    pub(super) fn parse(arguments: &[&'a str]) -> Result<Self, String> {
        let (seed, count) = (1, 70);
        let (isolux, other, arm) = (None, None, None);
        let mut flags = Self { only: None, seed, count, isolux, other, arm, save: false };
        let mut words = arguments.iter().copied();
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(format!("reliability: give {word} a value"));
            match word {
                "--only" => flags.only = Some(value()?),
                "--seed" => flags.seed = number(value()?)?,
                "--count" => flags.count = number(value()?)?.max(1),
                "--isolux" => flags.isolux = Some(path(value()?)?),
                "--other" => flags.other = Some(path(value()?)?),
                "--arm" => flags.arm = Some(path(value()?)?),
                "--save" => flags.save = true,
                _ => return Err(format!("reliability: {word}: {USE}")),
            }
        }
        Ok(flags)
    }

    /// What makes the rows of a part again.
    pub(super) fn command(&self, part: &str) -> String {
        let other = self.other.as_ref().map_or("", |_| " --other PATH");
        let arm = self.arm.as_ref().map_or("", |_| " --arm PATH");
        let Self { seed, count, .. } = self;
        match part {
            "hostile" => format!("cargo xtask reliability --only {part} --seed {seed}"),
            "sizes" => format!("cargo xtask reliability --only {part}"),
            "same" => format!("cargo xtask reliability --only {part} --count {count}{other}{arm}"),
            "foreign" => {
                format!(
                    "cargo xtask reliability --only {part} --seed {seed} --count {count}{other}"
                )
            }
            _ => format!("cargo xtask reliability --only {part} --seed {seed} --count {count}"),
        }
    }
}

fn number(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("reliability: {text}: give a whole number"))
}

/// Runs are made in folders of their own.
fn path(text: &str) -> Result<PathBuf, String> {
    std::fs::canonicalize(text).map_err(|e| format!("{text}: {e}"))
}
