//! Radiance view files: the last `-vtv -vp … -vd … -vu … -vh … -vv …` of a text.

use super::overview::looking;
use isolux::geometry::{Point, Vector};
use isolux::scene::Camera;
use std::path::Path;

/// The largest view file, in bytes; a view takes some hundred.
const MOST_BYTES: u64 = 1 << 20;

/// The camera of a view file, or what is wrong with it.
pub(super) fn read(path: &Path) -> Result<Camera, String> {
    let cannot = |problem: String| format!("{}: {problem}", path.display());
    let size = std::fs::metadata(path).map_err(|e| cannot(format!("cannot be read ({e})")))?.len();
    if size > MOST_BYTES {
        return Err(cannot("is too large for a view file of Radiance".to_owned()));
    }
    let bytes = std::fs::read(path).map_err(|e| cannot(format!("cannot be read ({e})")))?;
    parsed(&String::from_utf8_lossy(&bytes)).map_err(cannot)
}

/// The camera that view options describe. Each option counts from where it stands, as in Radiance.
fn parsed(text: &str) -> Result<Camera, String> {
    let line = text.lines().rfind(|line| line.contains("-v")).ok_or_else(|| {
        "has no view; a view file of Radiance has a line as `rvu -vtv -vp 0 0 1.6 -vd 0 1 0`"
            .to_owned()
    })?;
    let mut words = line.split_whitespace();
    let (mut at, mut towards, mut up) = ([0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let mut vertical_deg = 45.0;
    while let Some(word) = words.next() {
        let mut number = || -> Result<f64, String> {
            let word = words.next().unwrap_or_default();
            let number = word.parse().ok().filter(|n: &f64| n.is_finite());
            number.ok_or_else(|| format!("view: `{word}` is no number"))
        };
        match word {
            "-vp" => at = [number()?, number()?, number()?],
            "-vd" => towards = [number()?, number()?, number()?],
            "-vu" => up = [number()?, number()?, number()?],
            "-vv" => vertical_deg = number()?,
            "-vh" | "-vo" | "-va" | "-vs" | "-vl" => _ = number()?,
            "-vtv" => {}
            other if other.starts_with("-vt") => {
                return Err(format!("view: {other} is no perspective view; only -vtv is drawn"));
            }
            _ => {}
        }
    }
    let vector = |[x, y, z]: [f64; 3]| Vector::new(x, y, z);
    looking(Point::new(at[0], at[1], at[2]), vector(towards), vector(up), vertical_deg)
        .map_err(|problem| format!("view: {problem}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_view_counts() {
        let text = "rvu -vtv -vp 9 9 9 -vd 1 0 0\nVIEW= -vtv -vp 1 2 1.6 -vd 0 1 -.1 -vu 0 0 1 -vh 60 -vv 40 -vs 0\n";
        let camera = parsed(text).unwrap();
        assert_eq!(<[f64; 3]>::from(camera.position), [1.0, 2.0, 1.6]);
        assert!((camera.vertical_fov_rad.to_degrees() - 40.0).abs() < 1e-12);
        assert!(camera.direction.dot(camera.up).abs() < 0.2);
    }

    #[test]
    fn other_projections_and_broken_views_are_refused() {
        assert!(parsed("rvu -vta -vp 0 0 0").unwrap_err().contains("-vta"));
        assert!(parsed("rvu -vtv -vp 0 x 0").unwrap_err().contains("`x`"));
        assert!(parsed("rvu -vtv -vd 0 0 1 -vu 0 0 1").unwrap_err().contains("up"));
        assert!(parsed("nothing here").unwrap_err().contains("no view"));
    }
}
