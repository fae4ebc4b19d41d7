//! Luminances of the points of a grid, as a luminance meter sees them from an eye.

use super::figures::{cd_m2, ratio};
use crate::console::{facts, print, print_json, table};
use crate::failure::Failure;
use crate::flags::GridFlags;
use crate::meter::Meter;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::shown::name;
use crate::traced::Watched;
use isolux::geometry::{Direction, Hit, Point, Ray, Vector};
use isolux::map::{Figure, GridFigures, Illuminance, IlluminationMap, Standing};
use isolux::scene::{Body, CalculationGrid, Scene};
use isolux::units::{Digits, Rgb};
use isolux_formats::counted;
use isolux_view::{LuminanceImage, Projection, Size, View};
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;

/// The field of the meter, radians: six minutes of arc.
const FIELD_RAD: f64 = 0.1 * std::f64::consts::PI / 180.0;
/// Pixels across the field, and fields with noise of their own.
const ACROSS: u32 = 3;
const ROUNDS: u32 = 4;
/// Points lie on a surface that is nearer than this, m.
const ON_SURFACE_M: f64 = 0.01;
/// Panes in a row that are looked through.
const MOST_PANES: usize = 16;
/// Points between two looks at how far it is.
const TOGETHER: usize = 16;

/// What is asked: grids, seen from an eye.
pub(super) struct Request<'a> {
    pub(super) eye: Point,
    pub(super) grids: &'a [CalculationGrid],
    pub(super) csv: Option<OutputPath>,
    pub(super) digits: Digits,
}

/// A luminance with its standard error, cd/m2.
#[derive(Clone, Copy, Debug)]
struct Reading {
    cd_m2: f64,
    error_cd_m2: f64,
}

/// What an eye has of a point.
#[derive(Clone, Copy, Debug)]
enum Look {
    Seen(Reading),
    /// Something is before it.
    Hidden,
    /// There is no surface, or no light is known of it.
    Unknown,
}

/// A grid with what was seen.
struct Seen<'a> {
    grid: &'a CalculationGrid,
    points: Vec<Point>,
    looks: Vec<Look>,
    figures: Option<GridFigures>,
}

/// Refuses flags that say nothing of luminances; the eye.
pub(super) fn eye(flags: &GridFlags) -> Result<Point, Failure> {
    let refused = |flag: &str| {
        let what = format!("--quantity luminance: {flag} is for illuminances; leave it out");
        Err(Failure::bad_input(what))
    };
    if !flags.required.require.is_empty() {
        return refused("--require");
    }
    if flags.picture.is_some() {
        return refused("--picture");
    }
    let eye = flags.eye.ok_or_else(|| {
        Failure::bad_input("--quantity luminance: needs the eye that looks; add --eye X,Y,Z")
    })?;
    Ok(eye.into())
}

/// Looks at all points and tells of them.
pub(super) fn tell(
    request: Request<'_>,
    (scene, map): (&Scene, &IlluminationMap),
    json: bool,
) -> Result<(), Failure> {
    let watched = Watched::new(scene, map);
    let seen: Vec<Seen<'_>> = request
        .grids
        .iter()
        .map(|grid| seen(grid, request.eye, (scene, &watched)))
        .collect::<Result<_, _>>()?;
    seen.iter().for_each(Seen::warn);
    if let Some(csv) = request.csv {
        csv.write(rows(&seen, request.digits).as_bytes())?;
    }
    if json {
        let grids: Vec<Report> = seen.iter().map(|of| Report::of(of, request.eye)).collect();
        return print_json(&serde_json::json!({ "grids": grids }));
    }
    print(&text(&seen))
}

fn seen<'a>(
    grid: &'a CalculationGrid,
    eye: Point,
    (scene, watched): (&Scene, &Watched<'_>),
) -> Result<Seen<'a>, Failure> {
    let points = grid.points();
    let mut meter = Meter::new(format!("luminances of {} points", points.len()), None);
    let mut looks = Vec::with_capacity(points.len());
    for together in points.chunks(TOGETHER) {
        meter.tell(looks.len() as f64 / points.len() as f64);
        let all = together.par_iter().map(|point| look(eye, *point, (scene, watched)));
        looks.extend(all.collect::<Result<Vec<_>, _>>()?);
    }
    let values: Vec<Option<Illuminance>> = looks.iter().map(|look| number(*look)).collect();
    let figures = GridFigures::of(grid, &values);
    Ok(Seen { grid, points, looks, figures })
}

/// The luminance as a number with its error, for figures that do not depend on the unit.
fn number(look: Look) -> Option<Illuminance> {
    let Look::Seen(Reading { cd_m2, error_cd_m2 }) = look else { return None };
    Some(Illuminance {
        direct_lx: Rgb::grey(cd_m2),
        caustic_lx: Rgb::BLACK,
        indirect_lx: Rgb::BLACK,
        standard_error_lx: error_cd_m2,
        indirect_standard_error_lx: 0.0,
        common_error_lx: 0.0,
        interpolation_error_lx: 0.0,
        bias_lx: 0.0,
        standing: Standing::Open,
        samples: 1,
    })
}

fn look(eye: Point, point: Point, (scene, watched): (&Scene, &Watched)) -> Result<Look, Failure> {
    let Some(direction) = (point - eye).direction() else { return Ok(Look::Unknown) };
    match meets(scene, eye, (point, direction)) {
        Met::Point => {}
        Met::Before => return Ok(Look::Hidden),
        Met::Nothing => return Ok(Look::Unknown),
    }
    let projection = Projection::Perspective { vertical_rad: FIELD_RAD };
    let view = View { position: eye, direction, up: across(direction), projection };
    let size = Size::new(ACROSS, ACROSS).map_err(Failure::bad_input)?;
    let rounds: Vec<LuminanceImage> =
        (0..ROUNDS).map(|round| watched.glimpse((view, size), round)).collect::<Result<_, _>>()?;
    Ok(reading(&rounds).map_or(Look::Unknown, Look::Seen))
}

/// Any direction at right angles.
fn across(direction: Direction) -> Direction {
    let v = direction.to_vector();
    let aside =
        if v.z.abs() < 0.9 { Vector::new(0.0, 0.0, 1.0) } else { Vector::new(1.0, 0.0, 0.0) };
    v.cross(aside).direction().unwrap_or(Direction::X)
}

/// What a look at a point meets.
enum Met {
    Point,
    Before,
    Nothing,
}

/// Panes are looked through.
fn meets(scene: &Scene, eye: Point, (point, direction): (Point, Direction)) -> Met {
    let distance_m = (point - eye).length();
    let mut ray = Ray::new(eye, direction);
    for _ in 0..MOST_PANES {
        let Some(hit) = scene.bvh().closest_hit(&ray) else { return Met::Nothing };
        let at = scene.hit_point(&hit);
        let normal = scene.geometric_normal(hit.triangle);
        if (point - at).dot(normal.to_vector()).abs() <= ON_SURFACE_M
            && slanted_m(direction.cos(normal)) >= (point - at).length()
        {
            return Met::Point;
        }
        let is_before = (at - eye).length() < distance_m;
        if !(is_before && is_pane(scene, &hit)) {
            return if is_before { Met::Before } else { Met::Nothing };
        }
        ray = Ray::new(at, direction).skipping(hit.triangle);
    }
    Met::Before
}

/// How far a look comes while it comes nearer to a surface by [`ON_SURFACE_M`].
fn slanted_m(cosine: f64) -> f64 {
    ON_SURFACE_M / cosine.abs().max(1e-3)
}

fn is_pane(scene: &Scene, hit: &Hit) -> bool {
    matches!(scene.material(hit.triangle).body, Body::Dielectric(_))
}

/// The mean of all rounds. Its error is that of what they have in common, the map, and their spread; `None` where the map knows nothing.
fn reading(rounds: &[LuminanceImage]) -> Option<Reading> {
    let count = rounds.len() as f64;
    let pixels = rounds.first()?.size().pixels();
    let mean = |image: &LuminanceImage| {
        (0..pixels).map(|pixel| image.luminance_cd_m2(pixel).luminance()).sum::<f64>()
            / pixels as f64
    };
    let of_rounds: Vec<f64> = rounds.iter().map(mean).collect();
    let cd_m2 = of_rounds.iter().sum::<f64>() / count;
    let squares: f64 = of_rounds.iter().map(|of| (of - cd_m2) * (of - cd_m2)).sum();
    let own_cd_m2 = (squares / (count * (count - 1.0))).sqrt();
    let first = rounds.first()?;
    let is_unknown =
        |pixel| first.samples(pixel).iter().any(|s| s.sight == isolux_view::Sight::Unknown);
    if (0..pixels).any(is_unknown) {
        return None;
    }
    let of_map = first.reading(pixels / 2).filter(|of| of.illuminance_lx > 0.0);
    let share = of_map.map_or(0.0, |of| f64::from(of.standard_error_lx / of.illuminance_lx));
    Some(Reading { cd_m2, error_cd_m2: libm::hypot(own_cd_m2, share * cd_m2) })
}

impl Seen<'_> {
    fn count(&self, is: fn(&Look) -> bool) -> usize {
        self.looks.iter().filter(|look| is(look)).count()
    }

    fn warn(&self) {
        let grid = name(&self.grid.name);
        let (hidden, unknown) = (self.hidden(), self.count(|look| matches!(look, Look::Unknown)));
        if hidden > 0 {
            let are = counted(hidden, "point is", "points are");
            let what = format!("{are} hidden from the eye and left out");
            note(Note::Warning, format!("grid `{grid}`: {what}"));
        }
        if unknown > 0 {
            let are = counted(unknown, "point is", "points are");
            let what = format!("{are} not on a surface with known light and left out");
            note(
                Note::Warning,
                format!("grid `{grid}`: {what}; put the grid on what is looked at"),
            );
        }
    }

    fn hidden(&self) -> usize {
        self.count(|look| matches!(look, Look::Hidden))
    }

    /// Luminances of all points with their errors, as they are maintained.
    fn maintained(&self) -> impl Iterator<Item = Option<Reading>> + '_ {
        let factor = self.grid.maintenance_factor;
        self.looks.iter().map(move |look| match look {
            Look::Seen(of) => {
                Some(Reading { cd_m2: factor * of.cd_m2, error_cd_m2: factor * of.error_cd_m2 })
            }
            Look::Hidden | Look::Unknown => None,
        })
    }
}

const HEADER: [&str; 7] =
    ["grid", "Lm, cd/m2", "Lmin, cd/m2", "Lmax, cd/m2", "U0", "points", "hidden"];

fn text(seen: &[Seen]) -> String {
    let row = |of: &Seen| {
        let mut row = vec![name(&of.grid.name)];
        row.extend(match &of.figures {
            Some(f) => [f.mean_lx, f.least_lx, f.greatest_lx].map(cd_m2).to_vec(),
            None => vec!["-".to_owned(); 3],
        });
        row.push(of.figures.map_or("-".to_owned(), |f| ratio(f.uniformity)));
        row.push(of.points.len().to_string());
        row.push(of.hidden().to_string());
        row
    };
    match seen {
        [one] => facts(&HEADER.into_iter().zip(row(one)).collect::<Vec<_>>()),
        several => table(&HEADER, &several.iter().map(row).collect::<Vec<_>>()),
    }
}

#[derive(Serialize)]
struct Report {
    name: String,
    quantity: &'static str,
    eye: [f64; 3],
    maintenance_factor: f64,
    counts: [u32; 2],
    points: usize,
    known: usize,
    hidden: usize,
    mean_cd_m2: Option<Figure>,
    least_cd_m2: Option<Figure>,
    greatest_cd_m2: Option<Figure>,
    uniformity: Option<Figure>,
    /// At every point, along `u` first; null where not known.
    values: Vec<Value>,
}

#[derive(Serialize)]
struct Value {
    position: [f64; 3],
    luminance_cd_m2: Option<f64>,
    standard_error_cd_m2: Option<f64>,
}

impl Report {
    fn of(seen: &Seen, eye: Point) -> Self {
        let figure = |read: fn(&GridFigures) -> Figure| seen.figures.as_ref().map(read);
        let value = |(&position, of): (&Point, Option<Reading>)| Value {
            position: position.into(),
            luminance_cd_m2: of.map(|of| of.cd_m2),
            standard_error_cd_m2: of.map(|of| of.error_cd_m2),
        };
        Self {
            name: seen.grid.name.clone(),
            quantity: "luminance",
            eye: eye.into(),
            maintenance_factor: seen.grid.maintenance_factor,
            counts: seen.grid.counts(),
            points: seen.points.len(),
            known: seen.figures.map_or(0, |f| f.known),
            hidden: seen.hidden(),
            mean_cd_m2: figure(|f| f.mean_lx),
            least_cd_m2: figure(|f| f.least_lx),
            greatest_cd_m2: figure(|f| f.greatest_lx),
            uniformity: figure(|f| f.uniformity),
            values: seen.points.iter().zip(seen.maintained()).map(value).collect(),
        }
    }
}

/// All points as CSV.
fn rows(seen: &[Seen], digits: Digits) -> String {
    let mut text =
        "grid,i,j,x,y,z,luminance_cd_m2,standard_error_cd_m2,maintenance_factor\n".to_owned();
    for of in seen {
        let across = of.grid.counts()[0] as usize;
        let grid = format!("\"{}\"", of.grid.name.replace('"', "\"\""));
        for (index, (&Point { x, y, z }, value)) in
            of.points.iter().zip(of.maintained()).enumerate()
        {
            let (i, j) = (index % across, index / across);
            let [cd_m2, error] = value.map_or([const { String::new() }; 2], |of| {
                [of.cd_m2, of.error_cd_m2].map(|number| digits.number(number, of.error_cd_m2))
            });
            let factor = of.grid.maintenance_factor;
            _ = writeln!(text, "{grid},{i},{j},{x},{y},{z},{cd_m2},{error},{factor}");
        }
    }
    text
}
