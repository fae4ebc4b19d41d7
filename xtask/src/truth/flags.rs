//! What is asked of the bench.

use super::exported::TruthScene;
use std::path::PathBuf;

const METHODS: [&str; 4] = ["hybrid", "cache", "forward", "radiosity"];

/// The flags as meant.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Flags {
    pub(super) only: Vec<String>,
    pub(super) half: Option<String>,
    pub(super) seeds: Vec<u64>,
    pub(super) methods: Vec<String>,
    pub(super) accuracy: f64,
    pub(super) time_limit_s: u64,
    /// Another command than that of this workspace.
    pub(super) isolux: Option<PathBuf>,
    /// Paths traced before are not trusted.
    pub(super) fresh: bool,
    pub(super) save: bool,
    pub(super) json: bool,
}

impl Flags {
    /// From the words of the command line.
    pub(super) fn parse(arguments: &[&str]) -> Result<Self, String> {
        let mut flags = Self {
            only: Vec::new(),
            half: None,
            seeds: vec![1],
            methods: METHODS.map(String::from).into(),
            accuracy: 0.02,
            time_limit_s: 60,
            isolux: None,
            fresh: false,
            save: false,
            json: false,
        };
        let mut words = arguments.iter().copied().peekable();
        while let Some(word) = words.next() {
            let mut value =
                || words.next_if(|w| !w.starts_with("--")).ok_or(format!("give {word} a value"));
            match word {
                "--fresh" => flags.fresh = true,
                "--save" => flags.save = true,
                "--json" => flags.json = true,
                "--only" => {
                    flags.only.push(value()?.to_owned());
                    while let Some(name) = words.next_if(|w| !w.starts_with("--")) {
                        flags.only.push(name.to_owned());
                    }
                }
                "--half" => flags.half = Some(one_of(value()?, &["tuning", "judging"])?),
                "--seeds" => {
                    flags.seeds = list(value()?, |w| w.parse().map_err(|e| format!("{w}: {e}")))?
                }
                "--methods" => flags.methods = list(value()?, |w| one_of(w, &METHODS))?,
                "--accuracy" => flags.accuracy = share(value()?)?,
                "--time-limit" => flags.time_limit_s = seconds(value()?)?,
                "--isolux" => flags.isolux = Some(value()?.into()),
                _ => return Err(format!("bench truth: no flag {word}")),
            }
        }
        Ok(flags)
    }

    /// Whether a scene is asked for.
    pub(super) fn has(&self, scene: &TruthScene) -> bool {
        let named = self.only.is_empty() || self.only.contains(&scene.name);
        named && self.half.as_ref().is_none_or(|half| *half == scene.half)
    }
}

fn list<T>(words: &str, parse: impl Fn(&str) -> Result<T, String>) -> Result<Vec<T>, String> {
    words.split(',').map(parse).collect()
}

fn one_of(word: &str, known: &[&str]) -> Result<String, String> {
    if known.contains(&word) {
        Ok(word.to_owned())
    } else {
        Err(format!("`{word}` is none of {}", known.join(", ")))
    }
}

fn share(word: &str) -> Result<f64, String> {
    let percent = word.strip_suffix('%').and_then(|w| w.parse::<f64>().ok()).map(|p| p / 100.0);
    percent.or(word.parse().ok()).filter(|s| *s > 0.0).ok_or(format!("`{word}` is no share"))
}

fn seconds(word: &str) -> Result<u64, String> {
    let bare = word.strip_suffix('s').unwrap_or(word);
    bare.parse().map_err(|_| format!("`{word}` is no time; write 60s"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_read_and_others_refused() {
        let words =
            "--only truth-01 truth-02 --seeds 1,3 --methods cache --accuracy 2% --time-limit 5s";
        let flags = Flags::parse(&words.split(' ').collect::<Vec<_>>()).unwrap();
        assert_eq!(flags.only, ["truth-01", "truth-02"]);
        assert_eq!((flags.seeds, flags.methods), (vec![1, 3], vec!["cache".to_owned()]));
        assert_eq!((flags.accuracy, flags.time_limit_s), (0.02, 5));
        for wrong in
            ["--what", "--half none", "--seeds x", "--methods magic", "--accuracy", "--only"]
        {
            assert!(Flags::parse(&wrong.split(' ').collect::<Vec<_>>()).is_err(), "{wrong}");
        }
    }
}
