//! Text to weather.

use super::fields::{self, count, number, text, value};
use super::record::{Hour, Weather, WeatherPlace};
use crate::counted::{counted, shown};
use crate::findings::Findings;
use crate::plain_text::{Line, decode, lines};
use crate::{Loaded, Problem, Problems};
use std::path::Path;

/// Lines before the hours; files have eight.
const MOST_HEAD: usize = 100;
/// Hours of a leap year.
const MOST_HOURS: usize = 8784;
/// Hours of other years.
const USUAL_HOURS: usize = 8760;
/// Fields of an hour that has irradiances.
const FEWEST_FIELDS: usize = 16;
/// Days of the months, of which there may be one less in February.
const DAYS: [u32; 12] = [31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

const COPY: &str = "get the file again, or another of the same place";

/// Reads weather from the bytes of a file.
pub fn parse(bytes: &[u8], file: &Path) -> Result<Loaded<Weather>, Problems> {
    let content = decode(bytes, file)?;
    let all = lines(&content);
    let mut findings = Findings::new(file);
    let head = Head::of(&all, file)?;
    let mut hours: Vec<Hour> = Vec::new();
    for line in all[head.length..].iter().filter(|line| !line.text.trim().is_empty()) {
        let read = hour(line).and_then(|hour| after(hours.last(), hour));
        match read {
            Ok(_) if hours.len() == MOST_HOURS => {
                let what = format!("more than {MOST_HOURS} hours");
                return Err(Problem::new(file, place(line), what, "keep one year").into());
            }
            Ok(hour) => hours.push(hour),
            Err(what) => findings.problem(place(line), what, COPY),
        }
    }
    if hours.is_empty() && !findings.has_problems() {
        findings.problem("", "has no hours", COPY);
    }
    warn(&hours, &mut findings);
    findings.finish(Weather { place: head.place, hours })
}

fn place(line: &Line) -> String {
    format!("line {}", line.number)
}

fn split<'a>(line: &Line<'a>) -> Vec<&'a str> {
    line.text.split(',').collect()
}

/// What stands before the hours.
struct Head {
    place: WeatherPlace,
    /// Lines.
    length: usize,
}

impl Head {
    fn of(all: &[Line], file: &Path) -> Result<Self, Problem> {
        let first = all.first().map(split).unwrap_or_default();
        if !text(&first, 0).eq_ignore_ascii_case("LOCATION") {
            let what = "is no weather file of EnergyPlus: it does not begin with LOCATION";
            return Err(Problem::new(file, "line 1", what, "give an .epw file"));
        }
        let wrong = |what| Problem::new(file, "line 1", what, COPY);
        let place = location(&first).map_err(wrong)?;
        let is_last = |line: &&Line| {
            split(line).first().is_some_and(|f| f.trim().eq_ignore_ascii_case("DATA PERIODS"))
        };
        let Some(last) = all.iter().take(MOST_HEAD).find(is_last) else {
            let what = "has no line DATA PERIODS before its hours";
            return Err(Problem::new(file, "", what, COPY));
        };
        let an_hour = text(&split(last), 2).to_owned();
        if an_hour != "1" {
            let shown: String = an_hour.chars().take(40).collect();
            let what = format!("has `{shown}` records an hour, and only those with 1 are read");
            return Err(Problem::new(file, self::place(last), what, "convert it to hours"));
        }
        Ok(Self { place, length: last.number })
    }
}

fn location(first: &[&str]) -> Result<WeatherPlace, String> {
    let within = |index, name: &str, most: f64| {
        let value = number(first, index, name)?;
        let is_in = value.abs() <= most;
        is_in.then_some(value).ok_or_else(|| format!("the {name} is {}", shown(value)))
    };
    let words = (1..4).map(|index| text(first, index)).filter(|w| !w.is_empty() && *w != "-");
    Ok(WeatherPlace {
        name: words.collect::<Vec<_>>().join(", "),
        latitude_deg: within(6, "latitude", 90.0)?,
        longitude_deg: within(7, "longitude", 180.0)?,
        ahead_h: within(8, "time zone", 14.0)?,
        height_m: within(9, "elevation", 9000.0)?,
    })
}

fn hour(line: &Line) -> Result<Hour, String> {
    let fields = split(line);
    if fields.len() < FEWEST_FIELDS {
        return Err(format!("{} fields, where an hour has {FEWEST_FIELDS} or more", fields.len()));
    }
    let month = count(&fields, 1, "month", 1..=12)?;
    Ok(Hour {
        month,
        day: count(&fields, 2, "day", 1..=DAYS[month as usize - 1])?,
        hour: count(&fields, 3, "hour", 1..=24)?,
        dew_point_c: value(&fields, fields::DEW_POINT)?,
        global_horizontal_w_m2: value(&fields, fields::GLOBAL_W_M2)?,
        direct_normal_w_m2: value(&fields, fields::DIRECT_W_M2)?,
        diffuse_horizontal_w_m2: value(&fields, fields::DIFFUSE_W_M2)?,
        global_horizontal_lx: value(&fields, fields::GLOBAL_LX)?,
        direct_normal_lx: value(&fields, fields::DIRECT_LX)?,
        diffuse_horizontal_lx: value(&fields, fields::DIFFUSE_LX)?,
    })
}

/// The hour, if it comes after the one before.
fn after(before: Option<&Hour>, hour: Hour) -> Result<Hour, String> {
    let order = |h: &Hour| (h.month, h.day, h.hour);
    match before {
        Some(before) if order(before) >= order(&hour) => Err(format!(
            "the hour {} of {}-{} does not come after the one before it",
            hour.hour, hour.month, hour.day
        )),
        _ => Ok(hour),
    }
}

fn warn(hours: &[Hour], findings: &mut Findings) {
    if hours.len() != USUAL_HOURS && hours.len() != MOST_HOURS {
        let what = format!("has {} hours, where a year has {USUAL_HOURS}", hours.len());
        findings.warning("", what, "times that it lacks cannot be asked for");
    }
    let is_empty =
        |h: &&Hour| h.direct_normal_w_m2.is_none() || h.diffuse_horizontal_w_m2.is_none();
    let empty = hours.iter().filter(is_empty).count();
    if empty > 0 {
        let what = counted(empty, "hour has", "hours have") + " no direct or no diffuse irradiance";
        findings.warning("", what, "the light is not known then, and cannot be asked for");
    }
}
