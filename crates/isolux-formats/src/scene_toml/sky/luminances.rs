//! Luminances of skies by kind.

use super::kind::{Kind, TRADITIONAL};
use super::sun::{self, Sun};
use crate::epw::{self, Instant, USUAL_DEW_POINT_C, Weather};
use crate::scene_toml::context::Context;
use crate::scene_toml::quantity::NonNegative;
use crate::scene_toml::sky_record::SkyRecord;
use crate::scene_toml::spans::{At, Span};
use crate::sky_formula::{self, traditional_overcast};
use crate::sky_picture;
use isolux::geometry::Direction;
use isolux::photometry::{AllWeather, GeneralSky, Sky, SkyPicture, SkyWeather};
use std::f64::consts::PI;
use std::sync::Arc;

/// Light of sky and sun.
pub(super) struct Light {
    pub(super) sky: Sky,
    /// Of a surface that faces the sun.
    pub(super) sun_normal_lx: f64,
    pub(super) sun: Option<Sun>,
}

/// Illuminance of a horizontal surface where nothing is said of it: a bright overcast day.
const USUAL_LX: f64 = 10_000.0;
/// Share of light that the ground beyond the scene reflects, as most programs have it.
const USUAL_GROUND: f64 = 0.2;
/// A day on which the sun is as far as in the mean, within 0.1 %.
const USUAL_DAY: u16 = 95;

/// Sky and sun of a kind; `None` after a problem.
pub(super) fn of(
    kind: Kind,
    record: &SkyRecord,
    at: &Span,
    context: &mut Context,
) -> Option<Light> {
    if kind == Kind::Weather {
        return of_weather(record, at, context);
    }
    let sun = sun::of(record, context)?;
    match kind {
        Kind::Cie(number) => cie(number, record, sun, context),
        Kind::Formula => formula(record, sun, at, context),
        Kind::Picture => picture(record, sun, at, context),
        Kind::Perez | Kind::Weather => perez(record, sun, at, context),
    }
}

/// Towards the sun; for skies without any it makes no difference.
fn towards(sun: Option<&Sun>) -> Direction {
    sun.map_or(Direction::Z, |sun| sun.position.direction())
}

fn cie(number: u8, record: &SkyRecord, sun: Option<Sun>, context: &mut Context) -> Option<Light> {
    if number == TRADITIONAL {
        let relative = Sky::Picture(Arc::new(sky_formula::sampled(traditional_overcast)));
        let present = (relative.horizontal_lx(), 1.0);
        let factor = brightness(record, present, context)?;
        let ground = ground_cd_m2(record, factor * present.0, sun.as_ref());
        let sky = Sky::Picture(Arc::new(sky_formula::sampled(|towards| {
            let up = towards.to_vector().z;
            if up < 0.0 { ground } else { factor * traditional_overcast(towards) }
        })));
        return Some(with_sun(sky, record, sun));
    }
    let relative = GeneralSky::cie(number, towards(sun.as_ref()))?;
    general(relative, record, sun, context)
}

fn formula(
    record: &SkyRecord,
    sun: Option<Sun>,
    at: &Span,
    context: &mut Context,
) -> Option<Light> {
    let (Some(gradation), Some(indicatrix)) = (&record.gradation, &record.indicatrix) else {
        let remedy = "give `gradation = [a, b]` and `indicatrix = [f, c, d, e]`";
        context.problem(at, "a formula without its parameters", remedy);
        return None;
    };
    let relative = GeneralSky {
        gradation: gradation.get_ref().map(|n| n.0),
        indicatrix: indicatrix.get_ref().map(|n| n.0),
        sun: towards(sun.as_ref()),
        scale_cd_m2: 1.0,
    };
    general(relative, record, sun, context)
}

/// A sky whose form is known, as bright as is said.
fn general(
    relative: GeneralSky,
    record: &SkyRecord,
    sun: Option<Sun>,
    context: &mut Context,
) -> Option<Light> {
    let [_, c, _, e] = relative.indicatrix;
    if sun.is_none() && (c != 0.0 || e != 0.0) {
        let at = record.kind.as_ref().map_or(0..0, At::span);
        let remedy =
            "give `sun = { azimuth_deg = ..., elevation_deg = ... }`, or `place` and `time`";
        context.problem(&at, "this sky is brighter about the sun, which is not given", remedy);
        return None;
    }
    let present = (relative.horizontal_lx(), relative.luminance_cd_m2(Direction::Z));
    let factor = brightness(record, present, context)?;
    let ground_cd_m2 = ground_cd_m2(record, factor * present.0, sun.as_ref());
    let sky = GeneralSky { scale_cd_m2: factor, ..relative };
    Some(with_sun(Sky::General { sky, ground_cd_m2 }, record, sun))
}

/// The factor that makes a sky as bright as is said, of which it has these lx and cd/m2 without it.
fn brightness(
    record: &SkyRecord,
    (present_lx, present_cd_m2): (f64, f64),
    context: &mut Context,
) -> Option<f64> {
    let (wanted, present) = match (&record.horizontal_lx, &record.zenith_cd_m2) {
        (Some(lx), None) => (at_value(lx), present_lx),
        (None, Some(zenith)) => (at_value(zenith), present_cd_m2),
        (Some(_), Some(zenith)) => {
            context.problem(
                &zenith.span(),
                "`horizontal_lx` and `zenith_cd_m2`",
                "give one of them",
            );
            return None;
        }
        (None, None) => {
            let at = record.kind.as_ref().map_or(0..0, At::span);
            let what = format!("nothing says how bright the sky is: {USUAL_LX} lx are taken");
            context.warning(&at, what, "give `horizontal_lx`, its illuminance on open ground");
            (USUAL_LX, present_lx)
        }
    };
    let factor = wanted / present;
    if factor.is_finite() {
        return Some(factor);
    }
    let at = record.kind.as_ref().map_or(0..0, At::span);
    context.problem(&at, "a sky without light cannot be made as bright", "correct its parameters");
    None
}

fn at_value(value: &At<NonNegative>) -> f64 {
    value.get_ref().0
}

/// Luminance of the ground beyond the scene, which sky and sun light.
fn ground_cd_m2(record: &SkyRecord, sky_lx: f64, sun: Option<&Sun>) -> f64 {
    let sun_normal_lx = record.sun_normal_lx.as_ref().map_or(0.0, at_value);
    ground_by(record, sky_lx, sun_normal_lx, sun)
}

fn ground_by(record: &SkyRecord, sky_lx: f64, sun_normal_lx: f64, sun: Option<&Sun>) -> f64 {
    let reflectance = record.ground_reflectance.as_ref().map_or(USUAL_GROUND, |r| r.get_ref().0);
    let up = sun.map_or(0.0, |sun| sun.position.direction().to_vector().z.max(0.0));
    reflectance * (sky_lx + sun_normal_lx * up) / PI
}

fn with_sun(sky: Sky, record: &SkyRecord, sun: Option<Sun>) -> Light {
    let sun_normal_lx = record.sun_normal_lx.as_ref().map_or(0.0, at_value);
    Light { sky, sun_normal_lx, sun }
}

fn perez(record: &SkyRecord, sun: Option<Sun>, at: &Span, context: &mut Context) -> Option<Light> {
    let given = (&record.direct_normal_w_m2, &record.diffuse_horizontal_w_m2, sun);
    let (Some(direct), Some(diffuse), Some(sun)) = given else {
        let remedy =
            "give `direct_normal_w_m2`, `diffuse_horizontal_w_m2`, and `sun` or `place` and `time`";
        context.problem(at, "irradiances and sun of a Perez sky are not all given", remedy);
        return None;
    };
    let instant = Instant {
        direct_normal_w_m2: at_value(direct),
        diffuse_horizontal_w_m2: at_value(diffuse),
        dew_point_c: record.dew_point_c.as_ref().map(|t| t.get_ref().0),
    };
    Some(all_weather(record, instant, sun))
}

fn all_weather(record: &SkyRecord, instant: Instant, sun: Sun) -> Light {
    let weather = SkyWeather {
        direct_normal_w_m2: instant.direct_normal_w_m2,
        diffuse_horizontal_w_m2: instant.diffuse_horizontal_w_m2,
        day: sun.day.unwrap_or(USUAL_DAY),
        dew_point_c: instant.dew_point_c.unwrap_or(USUAL_DEW_POINT_C),
    };
    let AllWeather { sky, sun_normal_lx, .. } = weather.light(sun.position.direction());
    let sun_normal_lx = record.sun_normal_lx.as_ref().map_or(sun_normal_lx, at_value);
    let ground_cd_m2 = ground_by(record, sky.horizontal_lx(), sun_normal_lx, Some(&sun));
    Light { sky: Sky::General { sky, ground_cd_m2 }, sun_normal_lx, sun: Some(sun) }
}

fn of_weather(record: &SkyRecord, at: &Span, context: &mut Context) -> Option<Light> {
    let (Some(file), Some(time)) = (&record.weather, &record.time) else {
        let remedy = "give `weather = \"place.epw\"` and `time = 2026-06-21T12:00:00`, by the clock of the file";
        context.problem(at, "a sky by weather without its file or its time", remedy);
        return None;
    };
    let path = context.path_of(&file.span(), file.get_ref())?;
    let weather: Weather = context.absorb(&file.span(), file.get_ref(), epw::read(&path))?;
    let clock = sun::clock(time, Some(weather.place.ahead_h), context)?;
    if clock.ahead_h != weather.place.ahead_h {
        let what = format!("a clock that is {} h ahead of UTC", clock.ahead_h);
        let remedy = format!(
            "the file's is {} h ahead: write the time by it, without an offset",
            weather.place.ahead_h
        );
        context.problem(&time.span(), what, remedy);
        return None;
    }
    let Some(instant) = weather.at(clock.month, clock.day, clock.hours) else {
        let what = format!("`{}` has no light of that hour", file.get_ref());
        context.problem(&time.span(), what, "choose another time");
        return None;
    };
    let sun = sun::of_weather(&weather, clock, &time.span(), context)?;
    Some(all_weather(record, instant, sun))
}

fn picture(
    record: &SkyRecord,
    sun: Option<Sun>,
    at: &Span,
    context: &mut Context,
) -> Option<Light> {
    let Some(file) = &record.picture else {
        context.problem(at, "a sky by picture without its file", "give `picture = \"sky.hdr\"`");
        return None;
    };
    let picture = picture_of(file, record, context)?;
    Some(with_sun(Sky::Picture(Arc::new(picture)), record, sun))
}

fn picture_of(file: &At<String>, record: &SkyRecord, context: &mut Context) -> Option<SkyPicture> {
    let path = context.path_of(&file.span(), file.get_ref())?;
    let read = context.absorb(&file.span(), file.get_ref(), sky_picture::read(&path))?;
    let unit_cd_m2 = record.luminance_factor.as_ref().map(|f| f.get_ref().0).or(read.unit_cd_m2);
    let factor = match (&record.horizontal_lx, unit_cd_m2) {
        (Some(lx), _) if record.luminance_factor.is_none() => {
            at_value(lx) / read.picture.horizontal_lx()
        }
        (Some(lx), _) => {
            let what = "`horizontal_lx` and `luminance_factor`";
            context.problem(&lx.span(), what, "give one of them");
            return None;
        }
        (None, Some(unit)) => unit,
        (None, None) => {
            let remedy = "give `luminance_factor`, the cd/m2 of a value of 1 (179 for pictures that Radiance made), or \
                          `horizontal_lx`";
            context.problem(&file.span(), "the picture does not say how bright it is", remedy);
            return None;
        }
    };
    if !factor.is_finite() {
        context.problem(&file.span(), "is black above the horizon", "give `luminance_factor`");
        return None;
    }
    Some(brighter(read.picture, factor))
}

fn brighter(picture: SkyPicture, factor: f64) -> SkyPicture {
    if factor == 1.0 {
        return picture;
    }
    let scaled = |rgb: &[f32; 3]| rgb.map(|c| (f64::from(c) * factor) as f32);
    SkyPicture { rgb_cd_m2: picture.rgb_cd_m2.iter().map(scaled).collect(), ..picture }
}
