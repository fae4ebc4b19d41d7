//! A sky that is asked for beside a scene of any format.

use super::resolve::luminaires;
use crate::reach::Root;
use crate::scene_toml::context::Context;
use crate::scene_toml::parse;
use crate::scene_toml::spans::At;
use crate::scene_toml::{groups, text};
use crate::{Problem, Problems, Reach, bounds};
use isolux::scene::SceneParts;
use std::path::{Path, PathBuf};

/// The keys of a `[sky]`, given apart from the scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SkyAsked {
    /// A TOML file that has them, or has a table `[sky]` with them.
    File(PathBuf),
    /// Lines of TOML.
    Lines(String),
}

/// What stands in place of a file where keys were given in words.
const WORDS: &str = "--sky";

impl SkyAsked {
    /// From words: the path of a `.toml`, or items between commas. The first may be a type alone, or a file of weather or a picture;
    /// texts need no quotation marks.
    pub fn parse(words: &str) -> Self {
        if is_of(words.trim(), &["toml"]) && !words.contains('=') {
            return Self::File(words.trim().into());
        }
        Self::Lines(items(words).iter().map(|item| line(item)).collect())
    }
}

fn is_of(name: &str, extensions: &[&str]) -> bool {
    let extension = Path::new(name).extension().map(|e| e.to_string_lossy().to_lowercase());
    extension.is_some_and(|e| extensions.contains(&e.as_str()))
}

/// Parts between the commas that stand in no bracket and in no quotation marks.
fn items(words: &str) -> Vec<&str> {
    let (mut depth, mut quote, mut from) = (0_usize, None, 0);
    let mut found = Vec::new();
    for (at, c) in words.char_indices() {
        match (quote, c) {
            (Some(open), _) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '{' | '[') => depth += 1,
            (None, '}' | ']') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                found.push(&words[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    found.push(&words[from..]);
    found.into_iter().map(str::trim).filter(|item| !item.is_empty()).collect()
}

/// An item as a line of TOML.
fn line(item: &str) -> String {
    let (key, value) = match item.split_once('=') {
        Some((key, value)) => (key.trim(), value.trim()),
        None if is_of(item, &["epw"]) => ("weather", item),
        None if is_of(item, &["hdr", "exr", "pic"]) => ("picture", item),
        None => ("type", item),
    };
    let is_toml = format!("x = {value}").parse::<toml::Table>().is_ok();
    let value = if is_toml { value.to_owned() } else { toml::Value::from(value).to_string() };
    format!("{key} = {value}\n")
}

/// Puts a sky into a scene, in place of all light that comes from infinitely far away there. Files that words name may lie anywhere, those
/// that a file names where `reach` says. Gives warnings.
pub fn put_sky(
    parts: &mut SceneParts,
    asked: &SkyAsked,
    reach: Reach,
) -> Result<Vec<Problem>, Problems> {
    let (path, content, reach) = match asked {
        SkyAsked::File(path) => (path.as_path(), text::of(path)?, reach),
        SkyAsked::Lines(lines) => (Path::new(WORDS), lines.clone(), Reach::Anywhere),
    };
    let mut context = Context::new(path, &content);
    (context.up, context.root) = (parts.up, Root::of(path, reach));
    let found = match parse::parse_sky(&content, &mut context) {
        Some(record) => luminaires(&At::new(0..0, record), &mut context),
        None => Vec::new(),
    };
    let replaced: Vec<String> = parts
        .luminaires
        .iter()
        .filter(|l| l.kind.is_infinitely_far())
        .map(|l| l.name.clone())
        .collect();
    if !replaced.is_empty() {
        let shown = replaced.iter().take(5).map(|name| format!("`{name}`")).collect::<Vec<_>>();
        let what = format!(
            "stands in place of what the scene has infinitely far away: {}",
            shown.join(", ")
        );
        context.findings.warning("", what, "nothing needs to be done if that is meant");
    }
    let in_words = matches!(asked, SkyAsked::Lines(_));
    let without_place = |problem| without_place(problem, in_words);
    let loaded = context
        .finish(found)
        .map_err(|Problems(all)| Problems(all.into_iter().map(without_place).collect()))?;
    let before = (parts.luminaires.clone(), parts.fittings.clone(), parts.groups.clone());
    leave_out_far(parts);
    groups::put(parts, loaded.value);
    if let Err(problems) = bounds::check(path, parts) {
        (parts.luminaires, parts.fittings, parts.groups) = before;
        return Err(problems);
    }
    Ok(loaded.warnings.into_iter().map(without_place).collect())
}

/// Takes out what is infinitely far away.
fn leave_out_far(parts: &mut SceneParts) {
    let is_near: Vec<bool> = parts.luminaires.iter().map(|l| !l.kind.is_infinitely_far()).collect();
    let mut is_kept = is_near.iter();
    parts.luminaires.retain(|_| *is_kept.next().unwrap_or(&true));
    let mut is_kept = is_near.iter();
    parts.fittings.retain(|_| *is_kept.next().unwrap_or(&true));
}

/// Words have no lines.
fn without_place(mut problem: Problem, in_words: bool) -> Problem {
    if in_words && problem.file == Path::new(WORDS) {
        problem.place.clear();
    }
    problem
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_become_lines() {
        for (words, expected) in [
            ("overcast", "type = \"overcast\"\n"),
            ("cie 12, horizontal_lx=2e4", "type = \"cie 12\"\nhorizontal_lx = 2e4\n"),
            (
                "clear,sun={azimuth_deg=180, elevation_deg=40},group=day",
                "type = \"clear\"\nsun = {azimuth_deg=180, elevation_deg=40}\ngroup = \"day\"\n",
            ),
            (
                "a/b.epw, time=2026-06-21T12:00:00+02:00",
                "weather = \"a/b.epw\"\ntime = 2026-06-21T12:00:00+02:00\n",
            ),
            ("sky.HDR,luminance_factor=179", "picture = \"sky.HDR\"\nluminance_factor = 179\n"),
            ("uniform,sun.azimuth_deg=3", "type = \"uniform\"\nsun.azimuth_deg = 3\n"),
        ] {
            assert_eq!(SkyAsked::parse(words), SkyAsked::Lines(expected.to_owned()), "{words}");
        }
        assert_eq!(SkyAsked::parse("day.toml"), SkyAsked::File("day.toml".into()));
    }
}
