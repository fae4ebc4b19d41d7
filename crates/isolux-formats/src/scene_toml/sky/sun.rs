//! Where the sun of a sky stands.

use crate::epw::Weather;
use crate::scene_toml::context::Context;
use crate::scene_toml::sky_record::{SkyRecord, SunRecord};
use crate::scene_toml::spans::{At, Span};
use crate::sun::{Clock, Site, SunPosition};
use toml::value::{Datetime, Offset};

/// A sun and its day.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sun {
    pub(super) position: SunPosition,
    /// The day of the year, where it is known.
    pub(super) day: Option<u16>,
}

const OFFSET: &str = "write the difference from UTC behind it: 2026-06-21T12:00:00+02:00";

/// The sun by angles, or by place and time; nothing if neither is given, `None` after a problem.
#[expect(clippy::option_option, reason = "a problem is not the same as no sun")]
pub(super) fn of(record: &SkyRecord, context: &mut Context) -> Option<Option<Sun>> {
    match (&record.sun, &record.place, &record.time) {
        (Some(sun), None, time) => {
            let position = angles(sun, context)?;
            let day = match time {
                Some(time) => Some(clock(time, Some(0.0), context)?.day_of_year()),
                None => None,
            };
            Some(Some(Sun { position, day }))
        }
        (None, Some(place), Some(time)) => {
            let place_of = place.get_ref();
            let [latitude_deg, longitude_deg] = [place_of.latitude_deg.0, place_of.longitude_deg.0];
            if latitude_deg.abs() > 90.0 || longitude_deg.abs() > 180.0 {
                let what = format!("latitude {latitude_deg} and longitude {longitude_deg}");
                context.problem(&place.span(), what, "give -90 to 90 north and -180 to 180 east");
                return None;
            }
            let site = Site { latitude_deg, longitude_deg, height_m: 0.0 };
            let clock = clock(time, None, context)?;
            at(site, clock, &time.span(), context).map(Some)
        }
        (None, None, None) => Some(None),
        (Some(_), Some(place), _) => {
            context.problem(&place.span(), "`place` beside `sun`", "give one of them");
            None
        }
        (None, Some(place), None) => {
            let remedy = "add `time = 2026-06-21T12:00:00+02:00`";
            context.problem(&place.span(), "`place` without `time`", remedy);
            None
        }
        (None, None, Some(time)) => {
            let remedy = "add `place = { latitude_deg = ..., longitude_deg = ... }`";
            context.problem(&time.span(), "`time` without `place`", remedy);
            None
        }
    }
}

/// The sun at the place of a weather file.
pub(super) fn of_weather(
    weather: &Weather,
    clock: Clock,
    at_time: &Span,
    context: &mut Context,
) -> Option<Sun> {
    let place = &weather.place;
    let site = Site {
        latitude_deg: place.latitude_deg,
        longitude_deg: place.longitude_deg,
        height_m: place.height_m,
    };
    at(site, clock, at_time, context)
}

fn angles(sun: &At<SunRecord>, context: &mut Context) -> Option<SunPosition> {
    let [azimuth_deg, elevation_deg] = [sun.get_ref().azimuth_deg.0, sun.get_ref().elevation_deg.0];
    if elevation_deg.abs() > 90.0 || azimuth_deg.abs() > 360.0 {
        let what = format!("a sun at azimuth {azimuth_deg} and elevation {elevation_deg}");
        let remedy =
            "give the azimuth from north (0) by east (90), and the elevation above the horizon";
        context.problem(&sun.span(), what, remedy);
        return None;
    }
    Some(SunPosition { azimuth_deg, elevation_deg })
}

fn at(site: Site, clock: Clock, span: &Span, context: &mut Context) -> Option<Sun> {
    match SunPosition::at(site, clock) {
        Ok(position) => Some(Sun { position, day: Some(clock.day_of_year()) }),
        Err(what) => {
            context.problem(span, what, "correct the time");
            None
        }
    }
}

/// A time as written; one without its difference from UTC has the usual one, if there is any.
pub(super) fn clock(
    time: &At<Datetime>,
    usual_ahead_h: Option<f64>,
    context: &mut Context,
) -> Option<Clock> {
    let Datetime { date, time: of_day, offset } = time.get_ref();
    let ahead_h = match offset {
        Some(Offset::Z) => Some(0.0),
        Some(Offset::Custom { minutes }) => Some(f64::from(*minutes) / 60.0),
        None => usual_ahead_h,
    };
    let (Some(date), Some(of_day)) = (date, of_day) else {
        let what = "a time without its date, or a date without its time";
        context.problem(&time.span(), what, "write both: 2026-06-21T12:00:00+02:00");
        return None;
    };
    let Some(ahead_h) = ahead_h else {
        context.problem(&time.span(), "a time whose clock is not known", OFFSET);
        return None;
    };
    let seconds = f64::from(of_day.second.unwrap_or(0));
    let minutes = f64::from(of_day.minute) + seconds / 60.0;
    Some(Clock {
        year: i32::from(date.year),
        month: u32::from(date.month),
        day: u32::from(date.day),
        hours: f64::from(of_day.hour) + minutes / 60.0,
        ahead_h,
    })
}
