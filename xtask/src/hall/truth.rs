//! True errors: what `isolux probe` reads of a map, beside the reference.

use super::reference::{Kind, Place};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Standard errors to either side of an interval of 95 %.
const INTERVAL_95: f64 = 1.96;

/// What is read at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reading {
    total_lx: f64,
    direct_lx: f64,
    indirect_lx: f64,
    standard_error_lx: f64,
}

/// Errors of a map, by the kind of place: with direct light afresh, and of the bare map.
pub(super) fn errors(
    root: &Path,
    map: &Path,
    places: &[Place],
    kinds: &[Kind],
) -> Result<Value, String> {
    let fresh = read(root, map, places, &[])?;
    let bare = read(root, map, places, &["--interpolated"])?;
    let name = |kind: &Kind| match kind {
        Kind::Area => "by_area",
        Kind::Corner => "at_corners",
    };
    let of = |kind: &Kind| json!({ "probe": judged(places, &fresh, *kind), "interpolated": judged(places, &bare, *kind) });
    Ok(kinds
        .iter()
        .map(|kind| (name(kind).to_owned(), of(kind)))
        .collect::<serde_json::Map<_, _>>()
        .into())
}

fn read(
    root: &Path,
    map: &Path,
    places: &[Place],
    flags: &[&str],
) -> Result<Vec<Option<Reading>>, String> {
    let points: Vec<&str> = places.iter().map(|place| place.point.as_str()).collect();
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["run", "--release", "--quiet", "--package", "isolux-cli", "--", "probe"]);
    command.arg(map).args(["--points", "-", "--json"]).args(flags).current_dir(root);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    let fail = |e| format!("cannot run isolux probe: {e}");
    let mut child = command.spawn().map_err(fail)?;
    let mut input = child.stdin.take().ok_or("isolux probe takes no input")?;
    input.write_all(points.join("\n").as_bytes()).map_err(fail)?;
    drop(input);
    let output = child.wait_with_output().map_err(fail)?;
    let json: Value = serde_json::from_slice(&output.stdout)
        .map_err(|e| format!("isolux probe: {}: {e}", output.status))?;
    let values = json["points"].as_array().ok_or("isolux probe gave no points")?;
    Ok(values.iter().map(reading).collect())
}

fn reading(value: &Value) -> Option<Reading> {
    // The reference lacks caustics.
    let caustic_lx = value["caustic_lx"].as_f64()?;
    Some(Reading {
        total_lx: value["illuminance_lx"].as_f64()? - caustic_lx,
        direct_lx: value["direct_lx"].as_f64()? - caustic_lx,
        indirect_lx: value["indirect_lx"].as_f64()?,
        standard_error_lx: value["standard_error_lx"].as_f64()?,
    })
}

/// Sums over places.
#[derive(Clone, Copy, Default)]
struct Sums {
    places: u32,
    truth2: f64,
    own2: f64,
    total2: f64,
    direct2: f64,
    indirect2: f64,
    in_interval: u32,
}

impl Sums {
    fn add(&mut self, place: &Place, read: &Reading) {
        let error_lx = read.total_lx - place.total_lx;
        let allowed_lx = INTERVAL_95 * read.standard_error_lx.hypot(place.standard_error_lx);
        self.places += 1;
        self.truth2 += place.total_lx.powi(2);
        self.own2 += place.standard_error_lx.powi(2);
        self.total2 += error_lx.powi(2);
        self.direct2 += (read.direct_lx - place.direct_lx).powi(2);
        self.indirect2 += (read.indirect_lx - place.indirect_lx).powi(2);
        self.in_interval += u32::from(error_lx.abs() <= allowed_lx);
    }

    /// Squared error that is not the reference's own. (Its direct light is exact.)
    fn excess2(&self) -> f64 {
        (self.total2 - self.own2).max(0.0)
    }

    fn relative(&self, squared: f64) -> f64 {
        (squared / self.truth2).sqrt()
    }
}

/// Errors relative to the root mean square of the light, and where they are.
fn judged(places: &[Place], readings: &[Option<Reading>], kind: Kind) -> Value {
    let (mut all, mut unknown) = (Sums::default(), 0);
    let mut surfaces: BTreeMap<&str, Sums> = BTreeMap::new();
    for (place, reading) in places.iter().zip(readings).filter(|(place, _)| place.kind == kind) {
        match reading {
            Some(reading) => {
                all.add(place, reading);
                surfaces.entry(&place.surface).or_default().add(place, reading);
            }
            None => unknown += 1,
        }
    }
    let mut surfaces: Vec<(&str, Sums)> = surfaces.into_iter().collect();
    surfaces.sort_by(|(_, a), (_, b)| b.excess2().total_cmp(&a.excess2()));
    let sum2: f64 = surfaces.iter().map(|(_, sums)| sums.excess2()).sum();
    let surface = |(name, sums): &(&str, Sums)| {
        let share = if sum2 > 0.0 { sums.excess2() / sum2 } else { 0.0 };
        let error = sums.relative(sums.excess2());
        json!({ "surface": name, "places": sums.places, "share": share, "error": error })
    };
    json!({
        "places": all.places,
        "unknown": unknown,
        "error": all.relative(all.excess2()),
        "error_direct": all.relative(all.direct2),
        "error_indirect": all.relative((all.indirect2 - all.own2).max(0.0)),
        "error_of_reference": all.relative(all.own2),
        "in_interval": f64::from(all.in_interval) / f64::from(all.places),
        "surfaces": surfaces.iter().map(surface).collect::<Vec<Value>>(),
    })
}

/// A line for every way of reading and kind of place, and the surfaces that err most.
pub(super) fn text(errors: &Value) -> String {
    let percent =
        |value: &Value| value.as_f64().map_or("unknown".into(), |v| format!("{:.2}", 100.0 * v));
    let mut text = String::from(
        "places       read          error %  direct %  indirect %  in 95 % interval  unknown  of the squared error\n",
    );
    for (kind, read) in [
        ("by_area", "probe"),
        ("by_area", "interpolated"),
        ("at_corners", "probe"),
        ("at_corners", "interpolated"),
    ] {
        let row = &errors[kind][read];
        if row.is_null() {
            continue;
        }
        let surfaces = row["surfaces"].as_array().into_iter().flatten().take(MOST_SURFACES);
        let surface = |s: &Value| {
            format!("{} {} %", s["surface"].as_str().unwrap_or_default(), percent(&s["share"]))
        };
        text += &format!(
            "{kind:<11}  {read:<12}  {:>7}  {:>8}  {:>10}  {:>16}  {:>7}  {}\n",
            percent(&row["error"]),
            percent(&row["error_direct"]),
            percent(&row["error_indirect"]),
            percent(&row["in_interval"]),
            row["unknown"],
            surfaces.map(surface).collect::<Vec<_>>().join(", "),
        );
    }
    text
}

/// Surfaces named in a line of text; JSON has them all.
const MOST_SURFACES: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;

    fn place(total_lx: f64, kind: Kind, surface: &str) -> Place {
        Place {
            point: String::new(),
            total_lx,
            direct_lx: total_lx,
            indirect_lx: 0.0,
            standard_error_lx: 3.0,
            kind,
            surface: surface.into(),
        }
    }

    fn reads(total_lx: f64, standard_error_lx: f64) -> Option<Reading> {
        Some(Reading { total_lx, direct_lx: total_lx, indirect_lx: 0.0, standard_error_lx })
    }

    /// Errors of 5 and 13 lx, each with 3 lx of the reference's own, over 300 and 400 lx.
    #[test]
    fn the_references_own_error_is_taken_off() {
        let (wall, floor) = (place(300.0, Kind::Area, "wall"), place(400.0, Kind::Area, "floor"));
        let dark = place(99.0, Kind::Area, "wall");
        let corner = place(50.0, Kind::Corner, "wall");
        let readings = [reads(305.0, 4.0), reads(387.0, 4.0), None, reads(70.0, 1.0)];
        let found = judged(&[wall, floor, dark, corner], &readings, Kind::Area);
        let squares: f64 = 5.0 * 5.0 + 13.0 * 13.0 - 2.0 * 3.0 * 3.0;
        assert_eq!(found["error"].as_f64(), Some((squares / 250_000.0).sqrt()));
        assert_eq!((&found["places"], &found["unknown"]), (&json!(2), &json!(1)));
        // 1.96 times 5 lx holds 5 lx and not 13 lx.
        assert_eq!(found["in_interval"], 0.5);
        assert_eq!(found["surfaces"][0]["surface"], "floor");
        assert_eq!(found["surfaces"][0]["share"].as_f64(), Some(160.0 / 176.0));
    }

    #[test]
    fn every_kind_and_way_has_its_line() {
        let places = [place(300.0, Kind::Area, "wall")];
        let one = judged(&places, &[reads(310.0, 1.0)], Kind::Area);
        let text = text(&json!({ "by_area": { "probe": one, "interpolated": one } }));
        assert_eq!(text.lines().count(), 3);
        assert!(text.lines().nth(1).unwrap().ends_with("wall 100.00 %"), "{text}");
    }
}
