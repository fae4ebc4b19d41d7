//! A year of daylight as text, CSV and JSON.

use super::figures::{GridYear, interval};
use super::found::Found;
use super::place::PlaceYear;
use crate::console::facts;
use crate::shown::name;
use isolux::geometry::Point;
use isolux::map::Figure;
use isolux::units::to_error;
use serde::Serialize;
use std::fmt::Write;

/// Nobody reads finer than this.
const LEAST_PERCENT: f64 = 0.05;
const LEAST_LX: f64 = 0.5;

/// What people read: a list for each grid.
pub(super) fn text(found: &[Found], place: &str, hours: (u32, u32)) -> String {
    let lists: Vec<String> = found.iter().map(|of| list(of, place, hours)).collect();
    lists.join("\n")
}

fn list(found: &Found, place: &str, (from, to): (u32, u32)) -> String {
    let GridYear { target_daylight_factor, useful_daylight, .. } = &found.figures;
    let of = &found.figures;
    let [dark, some, good, much] = useful_daylight.map(percent);
    let target = target_daylight_factor.map_or("-".into(), |[target, minimum]| {
        format!("{:.1} % at half of the points, {:.1} % at 95 %", 100.0 * target, 100.0 * minimum)
    });
    let levels: Vec<String> =
        of.levels().map(|(level, verdict)| format!("{level} {}", verdict.text())).collect();
    facts(&[
        ("grid", format!("{}, {} points", name(&found.grid.name), found.points.len())),
        ("weather", format!("{}, hours of use {from} to {to}", name(place))),
        ("daylight factor, mean", percent(of.daylight_factor_mean)),
        ("of it straight from the sky", percent(of.sky_component_mean)),
        ("daylight factor, median", percent(of.daylight_factor_median)),
        ("at 95 % of the points", percent(of.daylight_factor_95)),
        ("target of EN 17037 here", target),
        (
            "half of daylight hours",
            format!(
                "{} lx at half of the points, {} lx at 95 %",
                lux(of.target_lx),
                lux(of.minimum_target_lx)
            ),
        ),
        ("EN 17037", levels.join(", ")),
        ("DA 300 lx, mean", percent(of.daylight_autonomy)),
        (
            "sDA 300/50%",
            format!(
                "{}; 55 %: {}, 75 %: {}",
                percent(of.spatial_daylight_autonomy),
                of.sda_accepted.text(),
                of.sda_preferred.text()
            ),
        ),
        (
            "ASE 1000,250h",
            format!(
                "{:.0} %; at most 10 %: {}",
                100.0 * of.annual_sunlight_exposure,
                of.ase_acceptable.text()
            ),
        ),
        ("UDI", format!("below 100 lx {dark}, to 300 lx {some}, to 3000 lx {good}, above {much}")),
        ("blinds", "none".to_owned()),
    ])
}

/// A share in per cent with its interval.
fn percent(of: Figure) -> String {
    let scaled = Figure { value: 100.0 * of.value, low: 100.0 * of.low, high: 100.0 * of.high };
    format!("{} %", to_half(scaled, LEAST_PERCENT))
}

fn lux(of: Figure) -> String {
    to_half(of, LEAST_LX)
}

/// A figure in digits of half of its interval, and of no less than this.
fn to_half(of: Figure, least: f64) -> String {
    let half = (0.5 * (of.high - of.low)).max(least);
    let [value, low, high] = [of.value, of.low, of.high].map(|n| to_error(n, half));
    if low == value && high == value { value } else { format!("{value} ({low} to {high})") }
}

/// What `daylight --json` prints.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    weather: &'a str,
    hours_of_use: [u32; 2],
    /// Intervals hold the noise of paths at this share.
    confidence: f64,
    grids: Vec<GridReport<'a>>,
}

#[derive(Serialize)]
struct GridReport<'a> {
    name: &'a str,
    #[serde(flatten)]
    figures: GridYear,
    points: Vec<PointReport>,
}

#[derive(Serialize)]
struct PointReport {
    position: [f64; 3],
    daylight_factor: Figure,
    sky_component: Figure,
    daylight_autonomy: Figure,
    median_lx: Figure,
    useful_daylight: [f64; 4],
    sunny_h: f64,
}

impl<'a> Report<'a> {
    pub(super) fn of(found: &'a [Found], place: &'a str, hours: (u32, u32)) -> Self {
        let grid = |of: &'a Found| GridReport {
            name: &of.grid.name,
            figures: of.figures,
            points: of.points.iter().zip(&of.years).map(PointReport::of).collect(),
        };
        Self {
            weather: place,
            hours_of_use: hours.into(),
            confidence: 0.95,
            grids: found.iter().map(grid).collect(),
        }
    }
}

impl PointReport {
    fn of((&position, of): (&Point, &PlaceYear)) -> Self {
        Self {
            position: position.into(),
            daylight_factor: interval(&of.daylight_factor),
            sky_component: interval(&of.sky_component),
            daylight_autonomy: interval(&of.autonomy),
            median_lx: interval(&of.median_lx),
            useful_daylight: [0, 1, 2, 3].map(|k| of.useful[k].value),
            sunny_h: of.sunny_h,
        }
    }
}

const HEADER: &str = "grid,x,y,z,daylight_factor,standard_error,sky_component,daylight_autonomy,median_lx,udi_below_100,udi_100_300,\
                      udi_300_3000,udi_above_3000,sunny_h\n";

/// All points as CSV; shares are fractions.
pub(super) fn rows(found: &[Found]) -> String {
    let mut text = HEADER.to_owned();
    for of in found {
        let name = format!("\"{}\"", of.grid.name.replace('"', "\"\""));
        for (&Point { x, y, z }, year) in of.points.iter().zip(&of.years) {
            let error = year.daylight_factor.standard_error();
            let factors =
                [&year.daylight_factor, &year.sky_component].map(|f| to_error(f.value, error));
            let useful = [0, 1, 2, 3].map(|k| format!("{:.4}", year.useful[k].value)).join(",");
            let _ = writeln!(
                text,
                "{name},{x},{y},{z},{},{error:.1e},{},{:.4},{},{useful},{}",
                factors[0],
                factors[1],
                year.autonomy.value,
                to_error(year.median_lx.value, year.median_lx.standard_error()),
                year.sunny_h,
            );
        }
    }
    text
}
