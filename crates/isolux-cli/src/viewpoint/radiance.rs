//! Views as Radiance writes them: in view files and as options (`-vtv -vp … -vd … -vu … -vh … -vv …`).

use super::overview::{Gaze, gaze};
use crate::failure::Failure;
use crate::flags::RadianceFlags;
use crate::source::bad_file;
use isolux::geometry::{Point, Vector};
use isolux_formats::Problem;
use isolux_view::{Projection, View};
use std::path::Path;

/// The largest view file, in bytes; a view takes some hundred.
const MOST_BYTES: u64 = 1 << 20;
/// The types of views that are drawn, as written after `-vt`.
const TYPES: [&str; 5] = ["v", "l", "h", "a", "c"];

/// The other options of a view.
const OPTIONS: [&str; 9] = ["-vp", "-vd", "-vu", "-vh", "-vv", "-vo", "-va", "-vs", "-vl"];

/// A view as options say it, each with the value that it has in Radiance unless it is given.
#[derive(Clone, Debug)]
struct Options {
    kind: String,
    at: [f64; 3],
    towards: [f64; 3],
    up: [f64; 3],
    horizontal: f64,
    vertical: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            kind: "v".to_owned(),
            at: [0.0; 3],
            towards: [0.0, 1.0, 0.0],
            up: [0.0, 0.0, 1.0],
            horizontal: 45.0,
            vertical: 45.0,
        }
    }
}

/// The view of a view file, with the options beside it, or what is wrong with them. Nothing if neither is given.
pub(super) fn asked(flags: &RadianceFlags) -> Result<Option<View>, Failure> {
    let RadianceFlags { radiance_view, vt, vp, vd, vu, vh, vv, .. } = flags;
    let is_given =
        [vp, vd, vu].iter().any(|option| option.is_some()) || vh.or(*vv).is_some() || vt.is_some();
    let mut options = match radiance_view {
        Some(path) => read(path)?,
        None if is_given => Options::default(),
        None => return Ok(None),
    };
    let set = |to: &mut [f64; 3], given: &Option<Vec<f64>>| {
        // The flags take three numbers each.
        if let Some([x, y, z]) = given.as_deref().and_then(|three| three.first_chunk()) {
            *to = [*x, *y, *z];
        }
    };
    set(&mut options.at, vp);
    set(&mut options.towards, vd);
    set(&mut options.up, vu);
    options.horizontal = vh.unwrap_or(options.horizontal);
    options.vertical = vv.unwrap_or(options.vertical);
    if let Some(kind) = vt {
        options.kind.clone_from(kind);
    }
    options.view().map(Some).map_err(|problem| match radiance_view {
        Some(path) => Failure::of_file(path, problem),
        None => Failure::bad_input(format!("view: {problem}")),
    })
}

/// A type of views, as written after `-vt`.
fn kind(text: &str) -> Result<String, String> {
    match TYPES.contains(&text) {
        true => Ok(text.to_owned()),
        false => Err(format!("-vt{text} is not drawn; {}", drawn())),
    }
}

fn drawn() -> String {
    "choose perspective (-vtv), parallel (-vtl), hemispherical (-vth), angular (-vta) or cylindrical (-vtc)".to_owned()
}

/// The options of a view file, or what is wrong with it.
fn read(path: &Path) -> Result<Options, Failure> {
    let unreadable = |e: std::io::Error| bad_file(Problem::unreadable(path, &e).into());
    let size = std::fs::metadata(path).map_err(unreadable)?.len();
    if size > MOST_BYTES {
        let what = "is too large for a view file of Radiance; give one of at most a megabyte";
        return Err(Failure::of_file(path, what));
    }
    let bytes = std::fs::read(path).map_err(unreadable)?;
    parsed(&String::from_utf8_lossy(&bytes)).map_err(|what| Failure::of_file(path, what))
}

/// The options of the last view of a text. Each counts from where it stands, as in Radiance.
fn parsed(text: &str) -> Result<Options, String> {
    let is_option = |word: &str| {
        OPTIONS.contains(&word) || word.strip_prefix("-vt").is_some_and(|of| of.len() == 1)
    };
    let has_view = |line: &&str| line.split_whitespace().any(is_option);
    let line = text.lines().rfind(has_view).ok_or_else(|| {
        "has no view; a view file of Radiance has a line as `rvu -vtv -vp 0 0 1.6 -vd 0 1 0`"
            .to_owned()
    })?;
    let mut words = line.split_whitespace();
    let mut view = Options::default();
    while let Some(word) = words.next() {
        let mut number = || {
            let value = words.next().unwrap_or_default();
            let number = value.parse().ok().filter(|n: &f64| n.is_finite());
            number.ok_or_else(|| format!("view: {word} has `{value}`, which is no number"))
        };
        match word {
            "-vp" => view.at = [number()?, number()?, number()?],
            "-vd" => view.towards = [number()?, number()?, number()?],
            "-vu" => view.up = [number()?, number()?, number()?],
            "-vh" => view.horizontal = number()?,
            "-vv" => view.vertical = number()?,
            "-vo" | "-va" | "-vs" | "-vl" => {
                if number()? != 0.0 {
                    return Err(format!("view: {word} can only be 0; leave it out"));
                }
            }
            _ => {
                if let Some(of) = word.strip_prefix("-vt") {
                    view.kind = kind(of).map_err(|problem| format!("view: {problem}"))?;
                }
            }
        }
    }
    Ok(view)
}

impl Options {
    fn view(&self) -> Result<View, String> {
        let vector = |[x, y, z]: [f64; 3]| Vector::new(x, y, z);
        let [x, y, z] = self.at;
        let Gaze { direction, up } = gaze(vector(self.towards), vector(self.up))
            .map_err(|problem| format!("{problem}; give another -vd, or another -vu"))?;
        let projection = self.projection()?;
        Ok(View { position: Point::new(x, y, z), direction, up, projection })
    }

    fn projection(&self) -> Result<Projection, String> {
        let Self { horizontal, vertical, .. } = *self;
        let within = |option: &str, value: f64, most: f64, is_open: bool| {
            let is_right = value > 0.0 && (value < most || value == most && !is_open);
            let end = if is_open { "less than" } else { "up to" };
            is_right.then_some(value).ok_or_else(|| match most.is_finite() {
                true => format!(
                    "{option} {value}: -vt{} takes more than 0 and {end} {most} degrees",
                    self.kind
                ),
                false => format!("{option} {value}: -vt{} takes a length above 0", self.kind),
            })
        };
        let across = |most: f64| within("-vh", horizontal, most, false).map(f64::to_radians);
        let down = |most: f64, is_open| within("-vv", vertical, most, is_open).map(f64::to_radians);
        Ok(match self.kind.as_str() {
            "l" => Projection::Parallel {
                width_m: within("-vh", horizontal, f64::INFINITY, true)?,
                height_m: within("-vv", vertical, f64::INFINITY, true)?,
            },
            "h" => Projection::Hemispherical {
                horizontal_rad: across(180.0)?,
                vertical_rad: down(180.0, false)?,
            },
            "a" => Projection::Angular {
                horizontal_rad: across(360.0)?,
                vertical_rad: down(360.0, false)?,
            },
            "c" => Projection::Cylindrical {
                horizontal_rad: across(360.0)?,
                vertical_rad: down(180.0, true)?,
            },
            _ => Projection::Perspective { vertical_rad: down(180.0, true)? },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(text: &str) -> Result<View, String> {
        parsed(text)?.view()
    }

    #[test]
    fn the_last_view_counts() {
        let text = "rvu -vtv -vp 9 9 9 -vd 1 0 0\nVIEW= -vtv -vp 1 2 1.6 -vd 0 1 -.1 -vu 0 0 1 -vh 60 -vv 40 -vs 0\n";
        let view = view(text).unwrap();
        assert_eq!(<[f64; 3]>::from(view.position), [1.0, 2.0, 1.6]);
        let vertical_rad = 40_f64.to_radians();
        assert_eq!(view.projection, Projection::Perspective { vertical_rad });
        assert!(view.direction.dot(view.up).abs() < 0.2);
    }

    #[test]
    fn all_types_but_one_are_drawn() {
        let angles = |kind| view(&format!("rvu -vt{kind} -vh 180 -vv 90")).unwrap().projection;
        let [horizontal_rad, vertical_rad] = [180_f64, 90.0].map(f64::to_radians);
        assert_eq!(angles('h'), Projection::Hemispherical { horizontal_rad, vertical_rad });
        assert_eq!(angles('a'), Projection::Angular { horizontal_rad, vertical_rad });
        assert_eq!(angles('c'), Projection::Cylindrical { horizontal_rad, vertical_rad });
        assert_eq!(angles('l'), Projection::Parallel { width_m: 180.0, height_m: 90.0 });
    }

    #[test]
    fn other_projections_and_broken_views_are_refused() {
        for (text, word) in [
            ("rvu -vts -vp 0 0 0", "-vts"),
            ("rvu -vtv -vp 0 x 0", "`x`"),
            ("rvu -vtv -vd 0 0 1 -vu 0 0 1", "along up; give another -vd, or another -vu"),
            ("rvu -vth -vh 190", "up to 180"),
            ("rvu -vtc -vv 180", "less than 180"),
            ("rvu -vtl -vv -3", "a length above 0"),
            ("rvu -vtv -vo 2", "-vo"),
            ("nothing here", "no view"),
            ("hello -v world", "no view"),
        ] {
            let refused = view(text).unwrap_err();
            assert!(refused.contains(word), "{text}: {refused}");
        }
    }
}
