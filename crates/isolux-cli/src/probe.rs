//! `isolux probe`: values of a map, or of a scene by tracing paths, at points.

use crate::caller::{look, lookout};
use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::ProbeFlags;
use crate::maintained::Maintained;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::unlit::{known_dark, without_unknown};
use crate::{beside, map_file, points, source};
use isolux::engine::{ExactSettings, MapReader, PathTracer, ProbePoint};
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::Scene;
use isolux::units::Digits;
use isolux_formats::counted;
use isolux_formats::rad::irradiance_lines;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// One a point, in the order asked; `None` where it is not known.
type Values = Vec<Option<Illuminance>>;

/// What is found at points.
struct Found {
    values: Values,
    /// How much of each is ambient light.
    ambient_lx: f64,
    light: Maintained,
}

/// Runs the subcommand.
pub(crate) fn run(flags: &ProbeFlags, json: bool) -> Result<Outcome, Failure> {
    let output = flags.output.as_deref().map(|path| OutputPath::check(path, "res")).transpose()?;
    if let Some(output) = &output {
        output.differs_from(&flags.source)?;
        output.differs_from(&flags.points)?;
    }
    let points = points::read(&flags.points)?;
    let Found { values, ambient_lx, light } = if map_file::is_map(&flags.source) {
        read_map(flags, &points)?
    } else {
        trace_paths(flags, &points)?
    };
    if let Some(output) = &output {
        write_irradiances(output, &values)?;
    }
    if json {
        let ambient_lx = Some(ambient_lx).filter(|lx| *lx != 0.0);
        let points = values.iter().map(|v| Reading::of(v.as_ref())).collect();
        print_json(&Readings { points, maintained: light, ambient_lx })?;
    } else if !light.are_initial() {
        note(Note::Info, format!("values are {}", light.text()));
    }
    if !json && output.is_none() {
        let digits = flags.digits.map_or(Digits::ByError, Digits::Significant);
        print(HEADER)?;
        for (points, values) in points.chunks(ROWS_AT_ONCE).zip(values.chunks(ROWS_AT_ONCE)) {
            print(&rows(points, values, digits))?;
        }
    }
    Ok(Outcome::Done)
}

/// Radiance's lines have no word for a value that is not known.
fn write_irradiances(output: &OutputPath, values: &Values) -> Result<(), Failure> {
    let known: Vec<Illuminance> = values.iter().flatten().copied().collect();
    if known.len() < values.len() {
        return Err(Failure::bad_input(format!(
            "{}: {} no value, which lines of irradiance cannot say; use --exact, move points onto a \
             surface of the scene, or ask for the table",
            output.path().display(),
            counted(values.len() - known.len(), "point has", "points have")
        )));
    }
    output.write(irradiance_lines(known.iter().map(Illuminance::total_lx)).as_bytes())
}

/// How a map is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Direct light afresh, indirect light afresh where the map is not to be trusted.
    Probe,
    /// All light afresh.
    Exact,
    /// All light as the map has it.
    Interpolated,
}

fn read_map(flags: &ProbeFlags, points: &[ProbePoint]) -> Result<Found, Failure> {
    let unused = [("--paths", flags.paths.is_some()), ("--seed", flags.seed.is_some())];
    refuse(flags, &unused, "a map, whose points are not traced; leave it out or give a scene")?;
    let (scene, map) = map_file::read(&flags.source)?;
    if !flags.interpolated {
        map_file::warn_of_unknown_error(&flags.source, &map);
    }
    let way = match (flags.exact, flags.interpolated) {
        (true, _) => Way::Exact,
        (_, true) => Way::Interpolated,
        _ => Way::Probe,
    };
    let values = readings((&scene, &map), points, way);
    let (ambient_lx, light) = (map.ambient_lx().luminance(), Maintained::of(&scene));
    Ok(Found { values, ambient_lx, light })
}

/// Reads a map at points, and tells of those where nothing is known.
pub(crate) fn readings(
    (scene, map): (&Scene, &IlluminationMap),
    points: &[ProbePoint],
    way: Way,
) -> Values {
    let reader = MapReader::new(scene, map);
    let exactly = |at| Some(reader.estimate(at, &ExactSettings::default()));
    let dark = |at| {
        let is_on_surface = reader.is_on_surface(at);
        is_on_surface.then(|| known_dark((scene, &reader), at)).flatten()
    };
    let is_left = lookout();
    let read = |at: &ProbePoint| match way {
        _ if is_left() => None,
        Way::Exact => beside::read(scene, *at, exactly),
        Way::Interpolated => reader.interpolated(*at),
        Way::Probe => reader.probe(*at).or_else(|| dark(*at)),
    };
    let values: Values = points.par_iter().map(read).collect();
    look();
    if way == Way::Exact {
        return without_unknown(scene, points, values);
    }
    tell_of_unknown(&values);
    values
}

fn tell_of_unknown(values: &Values) {
    let unknown = values.iter().filter(|value| value.is_none()).count();
    if unknown > 0 {
        let text = format!(
            "{unknown} of {} on no surface with a known value; move points onto a lit one, or use --exact",
            counted(values.len(), "point lies", "points lie")
        );
        note(Note::Warning, text);
    }
}

fn trace_paths(flags: &ProbeFlags, points: &[ProbePoint]) -> Result<Found, Failure> {
    let unused = [("--exact", flags.exact), ("--interpolated", flags.interpolated)];
    refuse(flags, &unused, "a scene, which has no map to read; leave it out or give a map")?;
    let scene = source::read_scene(&flags.source)?;
    let values = traced((&scene, &flags.source), points, &settings(flags.paths, flags.seed))?;
    Ok(Found { values, ambient_lx: 0.0, light: Maintained::of(&scene) })
}

/// Traces paths of a scene at points, and tells of those where nothing is known.
pub(crate) fn traced(
    (scene, source): (&Scene, &Path),
    points: &[ProbePoint],
    settings: &ExactSettings,
) -> Result<Values, Failure> {
    if scene.luminaires().is_empty() && scene.area_luminaires().is_empty() {
        return Err(source::no_light(source, scene));
    }
    let tracer = PathTracer::new(scene);
    // Rays that end where they begin are direct light, which has all that is asked for.
    if tracer.leaves_caustics() && settings.rays > 1 {
        note(
            Note::Warning,
            "light that glass, gloss and curved mirrors throw on surfaces is left out of paths, and of their standard \
             errors; solve for a map to have it",
        );
    }
    let is_left = lookout();
    let trace = |at| (!is_left()).then(|| tracer.estimate(at, settings));
    let traced = points.par_iter().map(|at| beside::read(scene, *at, trace)).collect();
    look();
    Ok(without_unknown(scene, points, traced))
}

/// Flags that the source has no use for are mistakes.
fn refuse(flags: &ProbeFlags, unused: &[(&str, bool)], reason: &str) -> Result<(), Failure> {
    match unused.iter().find(|(_, is_given)| *is_given) {
        Some((flag, _)) => {
            Err(Failure::bad_input(format!("{flag}: {} is {reason}", flags.source.display())))
        }
        None => Ok(()),
    }
}

/// As many replicates as there are without a word, of so many paths that all are traced.
pub(crate) fn settings(paths: Option<u32>, seed: Option<u64>) -> ExactSettings {
    let default = ExactSettings::default();
    ExactSettings {
        rays: paths.map_or(default.rays, |paths| paths.div_ceil(default.replicates)),
        seed: seed.unwrap_or(default.seed),
        ..default
    }
}

/// What `probe --json` prints.
#[derive(Serialize)]
struct Readings {
    points: Vec<Reading>,
    #[serde(flatten)]
    maintained: Maintained,
    /// How much of the indirect light of every point is an ambient term in place of what was not
    /// computed, lx.
    #[serde(skip_serializing_if = "Option::is_none")]
    ambient_lx: Option<f64>,
}

/// A value in the order asked for; `null` where it is not known.
#[derive(Serialize)]
struct Reading {
    illuminance_lx: Option<f64>,
    standard_error_lx: Option<f64>,
    direct_lx: Option<f64>,
    /// The part of it that particles alone find, through glass, gloss and curved mirrors.
    caustic_lx: Option<f64>,
    indirect_lx: Option<f64>,
    rgb_lx: Option<[f64; 3]>,
}

impl Reading {
    fn of(value: Option<&Illuminance>) -> Self {
        Self {
            illuminance_lx: value.map(Illuminance::illuminance_lx),
            standard_error_lx: value.map(|v| v.standard_error_lx),
            direct_lx: value.map(|v| v.direct_lx.luminance()),
            caustic_lx: value.map(|v| v.caustic_lx.luminance()),
            indirect_lx: value.map(|v| v.indirect_lx.luminance()),
            rgb_lx: value.map(|v| v.total_lx().0),
        }
    }

    /// In the order of the header, but for the colours.
    fn photometric(&self) -> [Option<f64>; 4] {
        [self.illuminance_lx, self.standard_error_lx, self.direct_lx, self.indirect_lx]
    }
}

const HEADER: &str = "x,y,z,nx,ny,nz,illuminance_lx,standard_error_lx,direct_lx,indirect_lx,red_lx,\
                      green_lx,blue_lx\n";
/// Rows made before they are printed: the text of ten million would need gigabytes.
const ROWS_AT_ONCE: usize = 1 << 14;

fn rows(points: &[ProbePoint], values: &[Option<Illuminance>], digits: Digits) -> String {
    let mut text = String::new();
    for (point, value) in points.iter().zip(values) {
        let reading = Reading::of(value.as_ref());
        let colours = reading.rgb_lx.map_or([None; 3], |rgb| rgb.map(Some));
        let place = <[f64; 3]>::from(point.position).into_iter();
        let normal = <[f64; 3]>::from(point.normal.to_vector()).into_iter();
        let error_lx = reading.standard_error_lx.unwrap_or(f64::NAN);
        let light = reading.photometric().into_iter().chain(colours);
        let light = light.map(|field| field.map_or(String::new(), |v| digits.number(v, error_lx)));
        let fields: Vec<String> = place.chain(normal).map(|v| v.to_string()).chain(light).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", fields.join(","));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::{Normal, Point, Vector};

    fn at(x: f64) -> ProbePoint {
        let normal: Normal = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
        ProbePoint { position: Point::new(x, 0.0, 0.5), normal }
    }

    #[test]
    fn unknown_values_are_empty_fields() {
        let text = rows(&[at(1.5)], &[None], Digits::ByError);
        assert_eq!(text, "1.5,0,0.5,0,0,1,,,,,,,\n");
        assert_eq!(HEADER.split(',').count(), text.split(',').count());
    }

    #[test]
    fn unknown_values_are_null_in_json() {
        let json = serde_json::to_value(Reading::of(None)).unwrap();
        assert!(json["illuminance_lx"].is_null() && json["rgb_lx"].is_null());
    }
}
