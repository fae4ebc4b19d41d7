//! The reference of the hall: a table of places and what the path tracer finds there.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Darker places are left out, lx: a thousandth of the root mean square. They lie in gaps of a
/// millimetre between solids.
const LEAST_LX: f64 = 0.3;

const COLUMNS: &str = "x,y,z,nx,ny,nz,total_lx,direct_lx,indirect_lx,stderr_lx,kind,surface";

/// A place of the hall and its light.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    /// As `isolux probe` reads it.
    pub(super) point: String,
    pub(super) total_lx: f64,
    pub(super) direct_lx: f64,
    pub(super) indirect_lx: f64,
    pub(super) standard_error_lx: f64,
    pub(super) kind: Kind,
    pub(super) surface: String,
}

/// How a place was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// By area.
    Area,
    /// A corner of a triangle: a vertex of every map of the standard division.
    Corner,
}

/// Traces the paths and keeps the table.
pub(super) fn make(root: &Path) -> Result<String, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["run", "--release", "--quiet", "--package", "isolux-compare"]);
    command.args(["--example", "hall_reference"]);
    let output = command.current_dir(root).stderr(Stdio::inherit()).output();
    let output = output.map_err(|e| format!("cannot run hall_reference: {e}"))?;
    if !output.status.success() {
        return Err(format!("hall_reference: {}", output.status));
    }
    let file = file(root);
    std::fs::write(&file, output.stdout).map_err(|e| format!("{}: {e}", file.display()))?;
    Ok(format!("{} is made anew", file.display()))
}

/// Reads the table, without places that are as good as dark.
pub(super) fn read(root: &Path) -> Result<Vec<Place>, String> {
    let file = file(root);
    let text = std::fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
    parse(&text).map_err(|what| format!("{}: {what}", file.display()))
}

fn file(root: &Path) -> PathBuf {
    root.join("benchmarks").join("hall").join("reference.csv")
}

fn parse(text: &str) -> Result<Vec<Place>, String> {
    let mut lines = text.lines();
    if lines.next() != Some(COLUMNS) {
        return Err(format!("the columns are not {COLUMNS}"));
    }
    let place = |(k, line)| place(line).ok_or_else(|| format!("line {} is no place", k + 2));
    let places: Vec<Place> = lines.enumerate().map(place).collect::<Result<_, _>>()?;
    Ok(places.into_iter().filter(|place| place.total_lx >= LEAST_LX).collect())
}

fn place(line: &str) -> Option<Place> {
    let fields: Vec<&str> = line.split(',').collect();
    let &[x, y, z, nx, ny, nz, total, direct, indirect, error, kind, surface] = &fields[..] else {
        return None;
    };
    Some(Place {
        point: [x, y, z, nx, ny, nz].join(" "),
        total_lx: total.parse().ok()?,
        direct_lx: direct.parse().ok()?,
        indirect_lx: indirect.parse().ok()?,
        standard_error_lx: error.parse().ok()?,
        kind: match kind {
            "area" => Kind::Area,
            "corner" => Kind::Corner,
            _ => return None,
        },
        surface: surface.to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_read_and_dark_ones_left_out() {
        let lit = "1,2,0,0,0,1,300,200,100,1.5,area,parquet";
        let dark = "1,2,0,0,0,1,0.01,0,0.01,0.001,corner,beech";
        let places = parse(&format!("{COLUMNS}\n{lit}\n{dark}\n")).unwrap();
        assert_eq!(places.len(), 1);
        assert_eq!(places[0].point, "1 2 0 0 0 1");
        assert_eq!((places[0].kind, places[0].standard_error_lx), (Kind::Area, 1.5));
        let problem = parse(&format!("{COLUMNS}\n{lit}\n1,2,3\n")).unwrap_err();
        assert!(problem.contains("line 3"), "{problem}");
    }

    #[test]
    fn the_reference_is_there_and_good_enough() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        for (kind, count) in [(Kind::Area, 1400), (Kind::Corner, 450)] {
            let places: Vec<Place> =
                read(root).unwrap().into_iter().filter(|p| p.kind == kind).collect();
            assert!(places.len() >= count, "{kind:?}: {}", places.len());
            let norm = |f: &dyn Fn(&Place) -> f64| places.iter().map(f).map(|x| x * x).sum::<f64>();
            let own = norm(&|p| p.standard_error_lx) / norm(&|p| p.total_lx);
            assert!(own.sqrt() < 0.01, "{kind:?}: {own}");
        }
    }
}
