//! The files of views: which kinds, and their names.

use crate::failure::Failure;
use crate::flags::RenderFlags;
use crate::output::OutputPath;
use crate::shown::name as shown_name;
use std::path::{Path, PathBuf};

/// What stands for the name of the camera in names of files.
const PLACE: &str = "{camera}";

/// What a file of a view holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Colours as seen (.png).
    Picture,
    /// Colours that stand for lux (.png).
    Chart,
    /// Luminance as OpenEXR.
    Exr,
    /// Luminance as a picture of Radiance.
    Hdr,
}

/// A file of a view.
#[derive(Clone, Debug)]
pub(super) struct Output {
    pub(super) path: OutputPath,
    pub(super) kind: Kind,
}

/// Files as asked for, before the views are known.
pub(super) struct Wanted(Vec<(PathBuf, Kind)>);

impl Wanted {
    /// Checks what can be checked before anything is read.
    pub(super) fn of(flags: &RenderFlags) -> Result<Self, Failure> {
        let kind = |path: &PathBuf| kind_of(path, flags).map(|kind| (path.clone(), kind));
        let mut all = flags.output.iter().map(kind).collect::<Result<Vec<_>, _>>()?;
        let chart = flags.look.false_colour_output.iter();
        chart.clone().chain(&flags.output).try_for_each(|path| check_places(path))?;
        if flags.look.false_colour && !all.iter().any(|(_, kind)| *kind == Kind::Chart) {
            let what = "--false-colour: no output shows it; end the name of one in .png";
            return Err(Failure::bad_input(what));
        }
        all.extend(chart.map(|path| (path.clone(), Kind::Chart)));
        let fixed = all.iter().filter(|(path, _)| !has_place(path));
        for (path, kind) in fixed {
            checked(path, *kind)?;
        }
        Ok(Self(all))
    }

    /// The files of views of these names, those of a view together.
    pub(super) fn of_views(
        &self,
        names: &[&str],
        input: &Path,
    ) -> Result<Vec<Vec<Output>>, Failure> {
        if let (true, Some((path, _))) =
            (names.len() > 1, self.0.iter().find(|(path, _)| !has_place(path)))
        {
            return Err(Failure::bad_input(format!(
                "{}: {} views cannot be written to one file; put {PLACE} into its name, as in 'view-{PLACE}.png'",
                path.display(),
                names.len()
            )));
        }
        let mut taken: Vec<PathBuf> = Vec::new();
        let mut outputs = Vec::new();
        for name in names {
            let mut of_view = Vec::new();
            for (template, kind) in &self.0 {
                let path = named(template, name);
                if taken.contains(&path) {
                    return Err(Failure::bad_input(format!(
                        "{}: two pictures cannot have this name; give each output and each camera one of its own",
                        path.display()
                    )));
                }
                let output = checked(&path, *kind)?;
                output.differs_from(input)?;
                of_view.push(Output { path: output, kind: *kind });
                taken.push(path);
            }
            outputs.push(of_view);
        }
        Ok(outputs)
    }
}

fn kind_of(path: &Path, flags: &RenderFlags) -> Result<Kind, Failure> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("png") if flags.look.false_colour => Ok(Kind::Chart),
        Some("png") => Ok(Kind::Picture),
        Some("exr") => Ok(Kind::Exr),
        Some("hdr") => Ok(Kind::Hdr),
        _ => Err(Failure::bad_input(format!(
            "{}: cannot write this kind of file; end its name in .png, .exr or .hdr",
            path.display()
        ))),
    }
}

fn checked(path: &Path, kind: Kind) -> Result<OutputPath, Failure> {
    let extension = match kind {
        Kind::Picture | Kind::Chart => "png",
        Kind::Exr => "exr",
        Kind::Hdr => "hdr",
    };
    OutputPath::check(path, extension)
}

/// Refuses words in braces that stand for nothing: `{kamera}`.
fn check_places(path: &Path) -> Result<(), Failure> {
    let text = path.to_string_lossy();
    let words =
        text.split('{').skip(1).filter_map(|rest| rest.split_once('}')).map(|(word, _)| word);
    let is_word = |word: &&str| !word.is_empty() && word.chars().all(char::is_alphabetic);
    match words.filter(is_word).find(|word| PLACE != format!("{{{word}}}")) {
        Some(word) => {
            let what =
                format!("{{{word}}} stands for nothing; write {PLACE} for the name of the camera");
            Err(Failure::of_file(path, what))
        }
        None => Ok(()),
    }
}

fn has_place(path: &Path) -> bool {
    path.to_string_lossy().contains(PLACE)
}

/// The name of the file of a camera: what could be a folder or an option in its name becomes a hyphen.
fn named(template: &Path, camera: &str) -> PathBuf {
    if !has_place(template) {
        return template.to_owned();
    }
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | ' ');
    let plain: String =
        shown_name(camera).chars().map(|c| if is_plain(c) { c } else { '-' }).collect();
    template.to_string_lossy().replace(PLACE, &plain).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_word_alone_stands_for_something() {
        for (name, is_right) in [
            ("v.png", true),
            ("{camera}/v-{camera}.png", true),
            ("{}.png", true),
            ("{12-ab}.png", true),
            ("}{.png", true),
            ("{kamera}.png", false),
            ("{camera}-{name}.png", false),
        ] {
            assert_eq!(check_places(Path::new(name)).is_ok(), is_right, "{name}");
        }
    }

    #[test]
    fn cameras_name_files() {
        let file = |template: &str, camera| named(Path::new(template), camera);
        assert_eq!(file("v.png", "door"), Path::new("v.png"));
        assert_eq!(file("view-{camera}.png", "door"), Path::new("view-door.png"));
        assert_eq!(file("out/{camera}.exr", "../a/b\n"), Path::new("out/---a-b-n.exr"));
    }
}
