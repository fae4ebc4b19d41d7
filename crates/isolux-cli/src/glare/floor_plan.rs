//! Ratings over calculation grids: at each point the worst of several ways to look.

use super::observer::{NO_GLARE, Observed, observed, written};
use crate::console::table;
use crate::failure::Failure;
use crate::flags::{GlareFlags, GridChoice};
use crate::grid::choice::chosen;
use crate::notes::{Note, note};
use crate::quantity::show_share;
use crate::shown::name;
use isolux::engine::MapReader;
use isolux::geometry::{Direction, Point, Ray, Vector};
use isolux::map::Figure;
use isolux::scene::{CalculationGrid, Camera, Scene};
use isolux_formats::counted;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;

/// A floor is looked for so far below a point, m: working planes are lower.
const FLOOR_WITHIN_M: f64 = 1.0;
/// Surfaces looked at on the way down.
const MOST_SURFACES: usize = 16;
/// The floor that a point lies in is found from so far above, m.
const ABOVE_M: f64 = 1e-3;

/// Rays know a metre to a tenth of a micrometre: floors are written to whole ones.
const ROUNDED_TO: f64 = 1e6;

/// The height of the eyes of people who sit, m (EN 12464-1).
const SEATED_M: f64 = 1.2;

/// Eyes over grids.
pub(super) struct Request {
    grids: Vec<Eyes>,
    limit: f64,
}

/// The eyes of a grid.
struct Eyes {
    grid: String,
    points: Vec<Point>,
    ways: Vec<Direction>,
    up: Direction,
}

/// What is found on a grid.
#[derive(Serialize)]
pub(super) struct Rated {
    grid: String,
    points: usize,
    /// Of the eyes, inside of something or where nothing is known of the background; left out.
    unknown: usize,
    limit: f64,
    /// Of the known points, those that keep the limit whichever way one looks.
    share_within_limit: Option<Figure>,
    /// The worst view; `None` where no source is seen from anywhere.
    worst: Option<Observed>,
    #[serde(skip)]
    views: Vec<Option<Observed>>,
    /// Luminaires without a luminous area.
    luminaires_left_out: usize,
}

impl Request {
    pub(super) fn of(flags: &GlareFlags, scene: &Scene) -> Result<Self, Failure> {
        let grids = grids(flags, scene)?;
        let way = (flags.eye_height, flags.direction.as_slice());
        let eyes = |grid: &CalculationGrid| Eyes::of(grid, way, scene);
        let grids = grids.iter().map(eyes).collect::<Result<_, _>>()?;
        Ok(Self { grids, limit: flags.limit })
    }
}

/// The grids named, or all of them.
fn grids(flags: &GlareFlags, scene: &Scene) -> Result<Vec<CalculationGrid>, Failure> {
    let of = |name: Option<String>| {
        let choice = GridChoice {
            name,
            height: None,
            corner: None,
            u: None,
            v: None,
            spacing: None,
            border: None,
        };
        chosen(&choice, &flags.map, scene)
    };
    if flags.all_grids {
        return of(None);
    }
    let named: Result<Vec<_>, _> = flags.grid.iter().map(|name| of(Some(name.clone()))).collect();
    named.map(|grids| grids.concat())
}

impl Eyes {
    fn of(
        grid: &CalculationGrid,
        (eye_height_m, directions): (f64, &[[f64; 3]]),
        scene: &Scene,
    ) -> Result<Self, Failure> {
        let up = scene.up().direction();
        let own = name(&grid.name);
        let is_level =
            grid.normal().is_some_and(|n| n.to_vector().dot(up.to_vector()).abs() > 1.0 - 1e-6);
        if !is_level {
            return Err(Failure::bad_input(format!(
                "grid `{own}` is not level; people stand on level ones: choose another by --grid"
            )));
        }
        let points = grid.points();
        let Some(floor_m) = floor_below(scene, &points, up) else {
            return Err(Failure::bad_input(format!(
                "grid `{own}` has no floor within {FLOOR_WITHIN_M} m below it; give it as --eye"
            )));
        };
        let level_m = floor_m + eye_height_m;
        let raised = |point: &Point| {
            let height_m = point.to_vector().dot(up.to_vector());
            *point + up.to_vector() * (level_m - height_m)
        };
        let points = points.iter().map(raised).collect();
        Ok(Self { grid: grid.name.clone(), points, ways: ways(grid, directions, up)?, up })
    }
}

/// Ways to look: those asked for, level; or along the sides of the grid, to and fro.
fn ways(
    grid: &CalculationGrid,
    directions: &[[f64; 3]],
    up: Direction,
) -> Result<Vec<Direction>, Failure> {
    if directions.is_empty() {
        let sides = [grid.u, -grid.u, grid.v, -grid.v];
        return Ok(sides.into_iter().filter_map(Vector::direction).collect());
    }
    let level = |way: &[f64; 3]| {
        let way = Vector::from(*way);
        let level = way - up.to_vector() * way.dot(up.to_vector());
        // A millionth of its length is what is left of a way straight up.
        let is_ahead = level.length() > 1e-6 * way.length();
        level.direction().filter(|_| is_ahead).ok_or_else(|| {
            Failure::bad_input(
                "--direction points straight up or down, or nowhere; look ahead, as 1,0,0",
            )
        })
    };
    directions.iter().map(level).collect()
}

/// The height of the floor that most points stand on: of what lies below them and faces up, the lowest; of what faces down, where
/// nothing faces up.
fn floor_below(scene: &Scene, points: &[Point], up: Direction) -> Option<f64> {
    let mut heights: Vec<f64> =
        points.iter().filter_map(|point| floor_below_one(scene, *point, up)).collect();
    heights.sort_by(f64::total_cmp);
    let middle = heights.get(heights.len() / 2)?;
    Some((middle * ROUNDED_TO).round() / ROUNDED_TO)
}

fn floor_below_one(scene: &Scene, point: Point, up: Direction) -> Option<f64> {
    let height = |at: Point| at.to_vector().dot(up.to_vector());
    let mut ray = Ray::new(point + up.to_vector() * ABOVE_M, -up).up_to(FLOOR_WITHIN_M as f32);
    let (mut facing_up, mut any) = (None, None);
    for _ in 0..MOST_SURFACES {
        let Some(hit) = scene.bvh().closest_hit(&ray) else { break };
        let at = point + up.to_vector() * (ABOVE_M - f64::from(hit.t));
        any = Some(height(at));
        if scene.geometric_normal(hit.triangle).to_vector().dot(up.to_vector()) > 0.0 {
            facing_up = any;
        }
        let left_m = FLOOR_WITHIN_M - (height(point) + ABOVE_M - height(at));
        ray = Ray::new(at, -up).up_to(left_m as f32).skipping(hit.triangle);
    }
    facing_up.or(any)
}

/// The worst rating on a grid, of people who sit and look along its sides: [`NO_GLARE`] where nothing that shines is in view.
pub(crate) fn worst(
    (scene, reader): (&Scene, &MapReader),
    grid: &CalculationGrid,
) -> Result<Figure, Failure> {
    let eyes = Eyes::of(grid, (SEATED_M, &[]), scene)?;
    let rated = Rated::of(&eyes, 0.0, (scene, reader));
    let own = name(&grid.name);
    if rated.luminaires_left_out > 0 {
        let lamps = counted(rated.luminaires_left_out, "luminaire has", "luminaires have");
        return Err(Failure::bad_input(format!(
            "UGR on grid `{own}`: {lamps} no luminous area and so no luminance; give them one, or leave UGR out"
        )));
    }
    if rated.unknown == rated.points {
        return Err(Failure::bad_input(format!(
            "UGR on grid `{own}`: nothing is known at the height of eyes; put it into a lit room"
        )));
    }
    Ok(rated.worst.and_then(|of| of.ugr).unwrap_or(Figure::exact(NO_GLARE)))
}

/// Looks from all points all ways.
pub(super) fn rated(request: &Request, scene: &Scene, reader: &MapReader) -> Vec<Rated> {
    let of = |eyes: &Eyes| Rated::of(eyes, request.limit, (scene, reader));
    request.grids.iter().map(of).collect()
}

impl Rated {
    fn of(eyes: &Eyes, limit: f64, (scene, reader): (&Scene, &MapReader)) -> Self {
        let looks: Vec<(Point, Direction)> =
            eyes.points.iter().flat_map(|&p| eyes.ways.iter().map(move |&way| (p, way))).collect();
        let look = |&(position, direction): &(Point, Direction)| {
            let name = eyes.grid.clone();
            let up = eyes.up;
            observed(
                scene,
                reader,
                &Camera { name, position, direction, up, vertical_fov_rad: 1.0 },
            )
        };
        let views: Vec<Option<Observed>> = looks.par_iter().map(look).collect();
        let mut rated = Self {
            grid: eyes.grid.clone(),
            points: eyes.points.len(),
            unknown: 0,
            limit,
            share_within_limit: None,
            worst: None,
            luminaires_left_out: views.iter().flatten().map(|of| of.points).max().unwrap_or(0),
            views,
        };
        rated.sum_up(eyes.ways.len());
        rated
    }

    /// The figures of all points, each with so many ways to look.
    fn sum_up(&mut self, ways: usize) {
        let [mut surely, mut likely, mut maybe, mut known] = [0_u32; 4];
        for views in self.views.chunks(ways) {
            let all: Option<Vec<&Observed>> =
                views.iter().map(|of| of.as_ref().filter(|of| is_known(of))).collect();
            let Some(all) = all else {
                self.unknown += 1;
                continue;
            };
            known += 1;
            let keeps = |end: fn(&Figure) -> f64| {
                let keeps =
                    |of: &&Observed| of.ugr.as_ref().is_none_or(|ugr| end(ugr) <= self.limit);
                u32::from(all.iter().all(keeps))
            };
            surely += keeps(|ugr| ugr.high);
            likely += keeps(|ugr| ugr.value);
            maybe += keeps(|ugr| ugr.low);
        }
        let share = |count: u32| f64::from(count) / f64::from(known);
        self.share_within_limit = (known > 0).then(|| Figure {
            value: share(likely),
            low: share(surely),
            high: share(maybe),
        });
        let value = |of: &&Observed| of.ugr.map_or(f64::NEG_INFINITY, |ugr| ugr.value);
        let all = self.views.iter().flatten();
        // The first of equals.
        let worst = all
            .filter(|of| of.ugr.is_some())
            .reduce(|a, b| if value(&b) > value(&a) { b } else { a });
        self.worst = worst.cloned();
    }

    /// What the figures do not say.
    pub(super) fn warn(&self) {
        let own = name(&self.grid);
        let warn = |what: String| note(Note::Warning, format!("grid `{own}`: {what}"));
        if self.unknown > 0 {
            let are = counted(self.points, "point is", "points are");
            warn(format!(
                "{} of {are} left out: inside an object, or where no light is known",
                self.unknown
            ));
        }
        if self.luminaires_left_out > 0 {
            let lamps = counted(self.luminaires_left_out, "luminaire has", "luminaires have");
            warn(format!("{lamps} no luminous area and so no luminance, and are left out"));
        }
        if self.worst.is_none() && self.unknown < self.points {
            warn("nothing that shines is in view; skies and the sun are not counted".into());
        }
    }
}

/// Whether a view has a rating, or surely none as nothing that shines is seen.
fn is_known(of: &Observed) -> bool {
    of.ugr.is_some() || (of.sources_in_view == 0 && of.background_cd_m2 > 0.0)
}

/// For people.
pub(super) fn text(rated: &[Rated]) -> String {
    let row = |of: &Rated| {
        let triple =
            |v: [f64; 3]| v.map(|x| format!("{}", (x * 100.0).round() / 100.0 + 0.0)).join(",");
        let worst = of.worst.as_ref();
        let share = of.share_within_limit.map_or("-".to_owned(), |Figure { value, low, high }| {
            let [value, low, high] = [value, low, high].map(show_share);
            if low == high { value } else { format!("{value} ({low} to {high})") }
        });
        vec![
            name(&of.grid),
            (of.points - of.unknown).to_string(),
            written(worst.and_then(|of| of.ugr)),
            worst.map_or("-".into(), |of| triple(of.position)),
            worst.map_or("-".into(), |of| triple(of.direction)),
            share,
        ]
    };
    let within = format!("UGR <= {}", rated.first().map_or(0.0, |of| of.limit));
    let header = ["grid", "points", "worst UGR", "at", "looking", &within];
    table(&header, &rated.iter().map(row).collect::<Vec<_>>())
}

/// All views, one a line.
pub(super) fn rows(rated: &[Rated]) -> String {
    let mut text =
        "grid,x_m,y_m,z_m,looking_x,looking_y,looking_z,ugr,ugr_low,ugr_high,background_cd_m2,sources_in_view\n".to_owned();
    for Rated { grid, views, .. } in rated {
        let name = format!("\"{}\"", grid.replace('"', "\"\""));
        for of in views.iter().flatten() {
            let ([x, y, z], [dx, dy, dz]) = (of.position, of.direction);
            let ugr = of.ugr.map_or(String::from(",,"), |Figure { value, low, high }| {
                format!("{value:.3},{low:.3},{high:.3}")
            });
            let (background, sources) = (of.background_cd_m2, of.sources_in_view);
            let _ =
                writeln!(text, "{name},{x},{y},{z},{dx},{dy},{dz},{ugr},{background:.4},{sources}");
        }
    }
    text
}
