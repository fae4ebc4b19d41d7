//! `isolux daylight`: a year of daylight on calculation grids.

mod figures;
mod found;
mod place;
mod words;
mod year;

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::{DaylightFlags, YearFlags};
use crate::grid::choice;
use crate::meter::Meter;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::shown::name;
use crate::source::{self, bad_file};
use figures::GridYear;
pub(crate) use found::Found;
use isolux::engine::{Daylight, ExactSettings, ProbePoint};
use isolux::geometry::Point;
use isolux::photometry::{GeneralSky, Sky};
use isolux::scene::{CalculationGrid, Luminaire, LuminaireKind, Scene, world_from_sky};
use isolux::units::Rgb;
use isolux_formats::epw::{self, Weather};
use place::PlaceYear;
use rayon::prelude::*;
use std::path::Path;
use year::Year;

/// Independent replicates, whose spread tells the noise.
const REPLICATES: u32 = 16;
/// Hours of a year.
const HOURS: usize = 8760;
/// Points between two looks at how far it is.
const TOGETHER: usize = 16;

/// Which year is asked for: of weather, and how.
pub(crate) type YearAsked<'a> = (&'a Path, &'a YearFlags);

/// Runs the subcommand.
pub(crate) fn run(flags: &DaylightFlags, json: bool) -> Result<Outcome, Failure> {
    let csv = flags.csv.as_deref().map(|path| OutputPath::check(path, "csv")).transpose()?;
    let scene = source::read_scene(&flags.source)?;
    let grids = choice::chosen(&flags.grid, &flags.source, &scene)?;
    let (place, found) = of_scene((&flags.weather, &flags.year), &scene, grids)?;
    if let Some(csv) = csv {
        csv.write(words::rows(&found).as_bytes())?;
    }
    if json {
        print_json(&words::Report::of(&found, &place, flags.year.hours))?;
    } else {
        print(&words::text(&found, &place, flags.year.hours))?;
    }
    Ok(Outcome::Done)
}

/// The place of the weather file, and its year on the grids of a scene, whose own light is off.
pub(crate) fn of_scene(
    (file, flags): YearAsked<'_>,
    scene: &Scene,
    grids: Vec<CalculationGrid>,
) -> Result<(String, Vec<Found>), Failure> {
    let weather = weather(file)?;
    let days = weather.daylight().map_err(|what| wrong_weather(file, &what))?;
    if days.unknown > 0 {
        let what =
            format!("{} hours of daylight have no irradiance and are left out", days.unknown);
        note(Note::Warning, format!("{}: {what}", file.display()));
    }
    let year = Year::of(&days, &weather.hours, flags.hours, flags.ground_reflectance);
    if year.used_h == 0.0 || year.hours.is_empty() {
        return Err(wrong_weather(file, "it has no daylight in the hours of use"));
    }
    let scene = below_a_sky(scene);
    let daylight = Daylight::new(&scene).expect("a sky was put in");
    let found = grids.into_iter().map(|grid| found(flags, &daylight, grid, &year));
    let found = found.collect::<Result<_, _>>();
    found.map(|found| (weather.place.name, found))
}

/// A file of weather; what it lacks of a year is refused.
pub(crate) fn weather(file: &Path) -> Result<Weather, Failure> {
    let weather = epw::read(file).map_err(bad_file)?.value;
    if weather.hours.len() < HOURS {
        let what = format!("has {} hours, where a year has {HOURS}", weather.hours.len());
        return Err(wrong_weather(file, &what));
    }
    Ok(weather)
}

fn wrong_weather(file: &Path, what: &str) -> Failure {
    Failure::bad_input(format!("{}: {what}; take a file of a whole year", file.display()))
}

/// The scene with a sky and nothing else that shines. North is where its own sky has it, else +y, or -z where y is up.
fn below_a_sky(scene: &Scene) -> Scene {
    let own = scene.luminaires().iter().find_map(|luminaire| match &luminaire.kind {
        LuminaireKind::Sky { world_from_sky, .. } => Some(*world_from_sky),
        _ => None,
    });
    let sky = Sky::General { sky: GeneralSky::uniform(1.0), ground_cd_m2: 1.0 };
    let kind =
        LuminaireKind::Sky { world_from_sky: own.unwrap_or(world_from_sky(scene.up(), 0.0)), sky };
    let luminaire = Luminaire { name: "sky".into(), group: 0, colour: Rgb::WHITE, kind };
    scene.below(luminaire)
}

fn found(
    flags: &YearFlags,
    daylight: &Daylight<'_>,
    grid: CalculationGrid,
    year: &Year,
) -> Result<Found, Failure> {
    let settings = ExactSettings {
        rays: flags.paths.div_ceil(REPLICATES),
        replicates: REPLICATES,
        seed: flags.seed,
    };
    let no_points = || Failure::bad_input(format!("grid `{}` has no points", grid.name));
    let normal = grid.normal().ok_or_else(no_points)?;
    let points = grid.points();
    let one = |&position: &Point| {
        let at = ProbePoint { position, normal };
        PlaceYear::of(daylight, at, year, &settings)
    };
    let mut meter = Meter::new(format!("daylight of {} points", points.len()), None);
    let mut years: Vec<PlaceYear> = Vec::with_capacity(points.len());
    for together in points.chunks(TOGETHER) {
        meter.tell(years.len() as f64 / points.len() as f64);
        years.par_extend(together.par_iter().map(one));
    }
    let figures = GridYear::of(&years, year).ok_or_else(no_points)?;
    if figures.daylight_factor_mean.value == 0.0 {
        let what = "no daylight reaches it";
        let grid = name(&grid.name);
        note(Note::Warning, format!("grid `{grid}`: {what}; check that the room has windows"));
    }
    Ok(Found { grid, points, years, figures })
}
