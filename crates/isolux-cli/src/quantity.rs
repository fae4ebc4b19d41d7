//! Quantities as people write them on a command line.

pub(crate) use isolux::units::significant;
use isolux_view::TraceSettings;
use std::fmt::Display;
use std::str::FromStr;
use std::time::Duration;

/// A share as `1%` or `0.01`, more than 0 and less than 1.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    match number_or_percent(text) {
        Some(share) if share > 0.0 && share < 1.0 => Ok(share),
        Some(_) => Err("must be more than 0 and less than 1; one per cent is 1% or 0.01".into()),
        None => Err("not a number; write 1% or 0.01".into()),
    }
}

/// A difference of colours, CIE94: from a thousandth, below the steps of any display, to 100, from black to white.
pub(crate) fn colour_difference(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(difference) if (0.001..=100.0).contains(&difference) => Ok(difference),
        Ok(_) => Err("must be from 0.001 to 100; 0.5 is usual".into()),
        Err(_) => Err("not a number; write 0.5".into()),
    }
}

/// A factor on light as `80%` or `0.8`, more than 0 and at most 1. A bare 1 is all of it, not one per cent.
pub(crate) fn maintenance_factor(text: &str) -> Result<f64, String> {
    match number_or_percent(text) {
        Some(factor) if factor > 0.0 && factor <= 1.0 => Ok(factor),
        Some(_) => Err("must be more than 0 and at most 1, or 100%; write 0.8 or 80%".into()),
        None => Err("not a number; write 0.8 or 80%".into()),
    }
}

/// A share of light that is reflected: nothing to all of it.
pub(crate) fn reflectance(text: &str) -> Result<f64, String> {
    match number_or_percent(text) {
        Some(share) if (0.0..=1.0).contains(&share) => Ok(share),
        Some(_) => Err("must be from 0 to 1; write 0.2 or 20%".into()),
        None => Err("not a number; write 0.2 or 20%".into()),
    }
}

/// A unified glare rating that is a limit.
pub(crate) fn rating(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(rating) if (5.0..=40.0).contains(&rating) => Ok(rating),
        Ok(_) => Err("must be from 5 to 40; 19 is usual in offices".into()),
        Err(_) => Err("not a number; write 19".into()),
    }
}

/// Distance over height of luminaires that fit rooms of whole heights: one over a whole number up to 20.
pub(crate) fn spacing_to_height(text: &str) -> Result<f64, String> {
    let fits = |ratio: f64| {
        let in_one = (1.0 / ratio).round();
        // As far as decimal digits tell a third.
        ((1.0..=20.0).contains(&in_one) && (in_one * ratio - 1.0).abs() < 0.01)
            .then_some(1.0 / in_one)
    };
    match text.trim().parse::<f64>() {
        Ok(ratio) if ratio > 0.0 => fits(ratio).ok_or_else(|| {
            "luminaires so far apart do not fill rooms evenly; write 0.25, 0.5, 1 or one over another whole number up to 20".into()
        }),
        _ => Err("not a ratio; write 0.25".into()),
    }
}

/// Hours of a day, from and to.
pub(crate) fn hours_of_day(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once("..").map(|(a, b)| (a.trim().parse(), b.trim().parse()));
    match parts {
        Some((Ok(from), Ok(to))) if from < to && to <= 24 => Ok((from, to)),
        Some((Ok(_), Ok(_))) => Err("must rise, up to 24; write 8..18".into()),
        _ => Err("not two hours; write 8..18".into()),
    }
}

/// A bare number as it is, one with a per cent sign as a hundredth.
fn number_or_percent(text: &str) -> Option<f64> {
    let text = text.trim();
    let (number, unit) = match text.strip_suffix('%') {
        Some(percent) => (percent.trim_end(), 100.0),
        None => (text, 1.0),
    };
    number.parse::<f64>().ok().map(|value| value / unit)
}

/// What light is multiplied by, as `30%` or `0.3`: 0 is off, more than 1 is brighter.
pub(crate) fn dimming(text: &str) -> Result<f64, String> {
    // Beyond that there is no light left to tell from rounding.
    let value =
        number_or_percent(text).filter(|value| *value == 0.0 || (1e-6..=1e6).contains(value));
    value.ok_or_else(|| format!("{text:?} is no dimming; write 30% or 0.3, 0 for off"))
}

/// A seed of random numbers.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    whole(text, 0, u64::MAX)
}

/// A number of threads. More than any machine has processors would only take memory.
pub(crate) fn threads(text: &str) -> Result<u16, String> {
    whole(text, 1, 1024)
}

/// A number of paths, of which every replicate gets some.
pub(crate) fn paths(text: &str) -> Result<u32, String> {
    whole(text, 32, u32::MAX)
}

/// A number of places of an audit.
pub(crate) fn places(text: &str) -> Result<u64, String> {
    whole(text, 16, 10_000_000)
}

/// A range of increments of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Increments {
    /// The number of the first one.
    pub first: u64,
    /// The number of the one after the last.
    pub end: u64,
}

impl Display for Increments {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}..{}", self.first, self.end)
    }
}

/// A range of increments: `0..8` are the first eight.
pub(crate) fn increments(text: &str) -> Result<Increments, String> {
    /// A run has no more.
    const MOST: u64 = 1 << 15;
    let number = |text: &str| text.trim().parse::<u64>().ok();
    let ends = text.split_once("..").and_then(|(first, end)| number(first).zip(number(end)));
    match ends {
        Some((first, end)) if first < end && end <= MOST => Ok(Increments { first, end }),
        Some((first, end)) if first >= end => {
            Err("the range is empty; write A..B with A below B: 0..8 are the first eight".into())
        }
        Some(_) => {
            Err(format!("a run has at most {MOST} increments; write A..B with B up to that"))
        }
        None => Err(
            "write two whole numbers A..B for the increments A to B - 1: 0..8 are the first eight"
                .into(),
        ),
    }
}

/// A number of receivers.
pub(crate) fn receivers(text: &str) -> Result<u32, String> {
    whole(text, 1, u32::MAX)
}

/// A number of repetitions.
pub(crate) fn repetitions(text: &str) -> Result<u32, String> {
    whole(text, 1, 10_000)
}

/// A number of significant digits. More than 17 say nothing of a number.
pub(crate) fn digits(text: &str) -> Result<u8, String> {
    whole(text, 1, 17)
}

fn whole<N: FromStr + PartialOrd + Display>(text: &str, least: N, most: N) -> Result<N, String> {
    let number = text.trim().parse::<N>().ok().filter(|n| (&least..=&most).contains(&n));
    number.ok_or_else(|| format!("write a whole number from {least} to {most}"))
}

const TIME_UNITS_S: [(&str, f64); 4] = [("ms", 1e-3), ("min", 60.0), ("s", 1.0), ("h", 3600.0)];

/// A time as `60s`, `5min`, `1.5h`.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let remedy = "write a number and a unit: 500ms, 60s, 5min, 2h";
    let seconds = scaled(text, &TIME_UNITS_S).ok_or(remedy)?;
    // Duration refuses what is negative, not finite, or too large for it.
    let duration = Duration::try_from_secs_f64(seconds).map_err(|_| remedy)?;
    if duration.is_zero() { Err(format!("no time at all; {remedy}")) } else { Ok(duration) }
}

const LENGTH_UNITS_M: [(&str, f64); 3] = [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)];

/// A length as `5cm`, `0.1m`, in metres.
pub(crate) fn length_m(text: &str) -> Result<f64, String> {
    let length_m = scaled(text, &LENGTH_UNITS_M).filter(|m| *m > 0.0);
    length_m.ok_or_else(|| "write a number above zero and a unit: 5cm, 0.1m".into())
}

const MEMORY_UNITS: [(&str, f64); 9] = [
    ("KiB", 1024.0),
    ("MiB", 1_048_576.0),
    ("GiB", 1_073_741_824.0),
    ("TiB", 1_099_511_627_776.0),
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("TB", 1e12),
    ("B", 1.0),
];

/// A size of memory as `8GiB`, `500MB`.
pub(crate) fn memory_bytes(text: &str) -> Result<u64, String> {
    match scaled(text, &MEMORY_UNITS) {
        // Above 2^63 a float no longer says which integer was meant.
        Some(bytes) if (1.0..9.2e18).contains(&bytes) => Ok(bytes as u64),
        _ => Err("write a number and a unit, at least 1B: 500MB, 8GiB (B, kB, MB, GB, TB, KiB, MiB, GiB, TiB)".into()),
    }
}

/// A number in front of one of the units, in the first unit's measure.
fn scaled(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let text = text.trim();
    let (number, scale) =
        units.iter().find_map(|(unit, scale)| Some((text.strip_suffix(unit)?, scale)))?;
    let value: f64 = number.trim_end().parse().ok()?;
    value.is_finite().then_some(value * scale)
}

/// The longest side of a picture, pixels.
const MAX_SIDE: u32 = 16_384;

/// A length in metres: `0.75`.
pub(crate) fn metres(text: &str) -> Result<f64, String> {
    let found = text.trim().trim_end_matches('m').trim().parse::<f64>();
    let metres = found.map_err(|_| "is no length; write metres, as 0.75".to_owned())?;
    if metres.is_finite() { Ok(metres) } else { Err("is not finite; write metres, as 0.75".into()) }
}

/// The width of a band in metres, which may be none.
pub(crate) fn border_m(text: &str) -> Result<f64, String> {
    metres(text).and_then(|m| {
        if m >= 0.0 { Ok(m) } else { Err("is less than 0; write metres, as 0.5".into()) }
    })
}

/// A distance in metres, above zero.
pub(crate) fn spacing_m(text: &str) -> Result<f64, String> {
    metres(text).and_then(|m| {
        if m > 0.0 { Ok(m) } else { Err("is not above zero; write metres, as 0.25".into()) }
    })
}

/// A side of an area, which has a length.
pub(crate) fn side_m(text: &str) -> Result<[f64; 3], String> {
    let side = triple(text)?;
    match side.iter().any(|m| *m != 0.0) {
        true => Ok(side),
        false => {
            Err("has no length; write how far the side goes along x,y,z in metres, as 2,0,0".into())
        }
    }
}

/// A density in texels a metre: `20`.
pub(crate) fn density(text: &str) -> Result<f64, String> {
    let found = text.trim().parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    found.ok_or_else(|| "write a number above zero: 20 texels a metre is one every 5 cm".to_owned())
}

/// Three numbers: `1,2.5,0.75`.
pub(crate) fn triple(text: &str) -> Result<[f64; 3], String> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>().ok().filter(|number| number.is_finite()))
        .collect();
    let numbers = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
    numbers.ok_or_else(|| "is not three numbers; write x,y,z, as 1,2.5,0.75".to_owned())
}

/// Width, depth and height of a room, m.
pub(crate) fn room_m(text: &str) -> Result<[f64; 3], String> {
    let sides: Option<Vec<f64>> = text.split('x').map(|side| side.trim().parse().ok()).collect();
    let sides = sides.and_then(|sides| <[f64; 3]>::try_from(sides).ok());
    let sides = sides.ok_or("is no room; write WIDTHxDEPTHxHEIGHT in metres, as 6x5x2.8")?;
    match sides.iter().find(|m| !(1.0..=200.0).contains(*m)) {
        Some(side) => Err(format!("has a side of {side} m; sides are from 1 to 200 m long")),
        None => Ok(sides),
    }
}

/// An opening angle in degrees.
pub(crate) fn angle_deg(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches("deg").trim().parse::<f64>();
    let number = number.ok().filter(|deg| *deg > 0.0 && *deg < 180.0);
    number.ok_or_else(|| "is no angle between 0 and 180 degrees; write 60".to_owned())
}

/// The illuminance that a task requires, lx.
pub(crate) fn task_lx(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches("lx").trim().parse::<f64>().ok();
    let number = number.filter(|lx| lx.is_finite() && *lx > 0.0);
    number.ok_or_else(|| "is no illuminance above 0; write 500".to_owned())
}

/// An angle in plan, in degrees.
pub(crate) fn azimuth_deg(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches("deg").trim_end_matches('\u{b0}').trim().parse();
    let number = number.ok().filter(|deg: &f64| (-360.0..=360.0).contains(deg));
    number.ok_or_else(|| "is no angle from -360 to 360 degrees; write 90".to_owned())
}

/// One coordinate, or another number, of a view of Radiance.
pub(crate) fn coordinate(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    number.ok_or_else(|| "is no number; write 1.6".to_owned())
}

/// The size of a picture as `1280x720`.
pub(crate) fn pixels(text: &str) -> Result<(u32, u32), String> {
    let side = |side: &str| side.trim().parse::<u32>().ok();
    let (width, height) = text
        .split_once('x')
        .and_then(|(width, height)| Some((side(width)?, side(height)?)))
        .ok_or("is no size; write WIDTHxHEIGHT in pixels, as 1280x720")?;
    let most = TraceSettings::FINE.most_pixels();
    if [width, height].iter().any(|side| !(1..=MAX_SIDE).contains(side)) {
        return Err(format!("each side has from 1 to {MAX_SIDE} pixels; write 1280x720, say"));
    }
    match u64::from(width) * u64::from(height) {
        pixels if pixels > most => {
            let [pixels, most] = [pixels, most].map(|count| significant(count as f64 / 1e6, 3));
            Err(format!(
                "has {pixels} million pixels, and at most {most} million are drawn; write less"
            ))
        }
        _ => Ok((width, height)),
    }
}

/// A range as `0:500`.
pub(crate) fn range(text: &str) -> Result<(f64, f64), String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    text.split_once(':')
        .and_then(|(low, high)| Some((number(low)?, number(high)?)))
        .filter(|(low, high)| low < high)
        .ok_or_else(|| "write LOW:HIGH as 0:500, the lower first".to_owned())
}

/// Luminance as written: `500 cd/m2`.
pub(crate) fn luminance_cd_m2(text: &str) -> Result<f64, String> {
    let number = text.trim().strip_suffix("cd/m2").and_then(|text| text.trim().parse().ok());
    number
        .filter(|value: &f64| *value > 0.0 && value.is_normal())
        .ok_or_else(|| "write a luminance above zero as 500cd/m2".to_owned())
}

/// Luminous flux for reading. Parallel light has none: it is given by its illuminance, and how much
/// of it enters depends on the scene.
pub(crate) fn flux(lm: f64, has_parallel: bool) -> String {
    match (lm > 0.0, has_parallel) {
        (false, true) => "none: light from infinitely far away alone".to_owned(),
        (true, true) => format!("{} lm, and light from infinitely far away", significant(lm, 3)),
        // A sum of nothing is -0.
        (_, false) => format!("{} lm", significant(lm + 0.0, 3)),
    }
}

/// Bytes for reading: `1.5 GiB`.
pub(crate) fn show_bytes(bytes: u64) -> String {
    let units = [("EiB", 60), ("PiB", 50), ("TiB", 40), ("GiB", 30), ("MiB", 20), ("KiB", 10)];
    match units.iter().find(|(_, power)| bytes >> power > 0) {
        Some((unit, power)) => format!("{:.1} {unit}", bytes as f64 / (1_u64 << power) as f64),
        None => format!("{bytes} B"),
    }
}

/// A number of bytes and one that it exceeds, for reading: exact where they would read the same.
pub(crate) fn show_more_bytes(more: u64, than: u64) -> [String; 2] {
    let shown = [more, than].map(show_bytes);
    if shown[0] == shown[1] { [more, than].map(|bytes| format!("{bytes} B")) } else { shown }
}

/// A time for reading: `0.35 s`, `12 s`, `5 min 20 s`, `3 h 5 min`, `12 days`, `more than a year`.
pub(crate) fn show_seconds(seconds: f64) -> String {
    let whole = seconds.round();
    match seconds {
        s if s < 1.0 => format!("{s:.2} s"),
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 120.0 => format!("{whole} s"),
        s if s < 7200.0 => format!("{} min {} s", (whole / 60.0).floor(), whole % 60.0),
        s if s > 365.0 * 86_400.0 => "more than a year".to_owned(),
        s if s >= 4.0 * 86_400.0 => format!("{} days", (s / 86_400.0).round()),
        _ => format!("{} h {} min", (whole / 3600.0).floor(), (whole % 3600.0 / 60.0).floor()),
    }
}

/// A share for reading: `0.95 %`.
pub(crate) fn show_share(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 2))
}

/// A count for reading: `3.1 M`.
pub(crate) fn show_count(count: f64) -> String {
    let units = [(1e12, " T"), (1e9, " G"), (1e6, " M"), (1e3, " k")];
    match units.iter().find(|(scale, _)| count >= *scale) {
        Some((scale, unit)) => format!("{}{unit}", significant(count / scale, 3)),
        None => significant(count, 3),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_light_has_no_flux() {
        assert_eq!(flux(0.0, true), "none: light from infinitely far away alone");
        assert_eq!(flux(2500.0, true), "2500 lm, and light from infinitely far away");
        assert_eq!(flux(-0.0, false), "0 lm");
    }

    #[test]
    fn shares() {
        for (text, expected) in [("1%", 0.01), ("0.01", 0.01), (" 0.3 % ", 0.003), ("1e-3", 0.001)]
        {
            let read = share(text).unwrap();
            // One division apart.
            assert!((read - expected).abs() < 4.0 * f64::EPSILON * expected, "{text}: {read}");
        }
        for text in ["", "%", "0", "1", "5", "100%", "-1%", "NaN", "inf", "1 percent"] {
            assert!(share(text).is_err(), "{text}");
        }
    }

    #[test]
    fn maintenance_factors() {
        for (text, expected) in
            [("1", 1.0), ("1.0", 1.0), ("100%", 1.0), ("80%", 0.8), ("0.8", 0.8), ("1%", 0.01)]
        {
            assert_eq!(maintenance_factor(text), Ok(expected), "{text}");
        }
        for text in ["", "%", "0", "0%", "80", "1.1", "101%", "-1", "NaN", "inf"] {
            assert!(maintenance_factor(text).is_err(), "{text}");
        }
    }

    #[test]
    fn whole_numbers_are_told_their_bounds() {
        assert_eq!((threads("1"), threads("1024"), paths("32")), (Ok(1), Ok(1024), Ok(32)));
        for text in ["", "0", "1025", "65535", "65536", "-1", "abc", "1.5", "1e3"] {
            let told = threads(text).unwrap_err();
            assert_eq!(told, "write a whole number from 1 to 1024", "{text}");
        }
    }

    #[test]
    fn durations() {
        for (text, seconds) in [("60s", 60.0), ("5min", 300.0), ("1.5h", 5400.0), ("500ms", 0.5)] {
            assert_eq!(duration(text).unwrap().as_secs_f64(), seconds, "{text}");
        }
        for text in ["", "60", "s", "-1s", "0s", "1e300h", "NaNs", "infs", "5m"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }

    #[test]
    fn memory() {
        for (text, bytes) in [("8GiB", 8 << 30), ("500MB", 500_000_000), ("1 KiB", 1024), ("7B", 7)]
        {
            assert_eq!(memory_bytes(text).unwrap(), bytes, "{text}");
        }
        for text in ["", "8", "GiB", "-1GiB", "0GiB", "1e30TiB", "8G"] {
            assert!(memory_bytes(text).is_err(), "{text}");
        }
    }

    #[test]
    fn lengths_and_places() {
        assert_eq!((metres("0.75"), metres("2 m"), metres("-1")), (Ok(0.75), Ok(2.0), Ok(-1.0)));
        assert_eq!(triple("1,-2.5, 0.75"), Ok([1.0, -2.5, 0.75]));
        for text in ["", "1", "1,2", "1,2,3,4", "1,2,x", "1,2,inf"] {
            assert!(triple(text).is_err(), "{text}");
        }
        for text in ["", "x", "NaN", "inf"] {
            assert!(metres(text).is_err(), "{text}");
        }
    }

    #[test]
    fn grids_have_lengths() {
        assert_eq!(
            (border_m("0"), spacing_m("0.25"), side_m("0,-2,0")),
            (Ok(0.0), Ok(0.25), Ok([0.0, -2.0, 0.0]))
        );
        assert!(border_m("-1").is_err() && spacing_m("0").is_err() && spacing_m("-1").is_err());
        assert!(side_m("0,0,0").unwrap_err().contains("no length"));
    }

    #[test]
    fn rooms_have_sides_of_a_length() {
        assert_eq!(room_m("6x5x2.8"), Ok([6.0, 5.0, 2.8]));
        assert_eq!(
            room_m("6x500x2.8").unwrap_err(),
            "has a side of 500 m; sides are from 1 to 200 m long"
        );
        for text in ["", "6x5", "6x5x", "6x5xNaN", "0x5x3", "6x5x-3"] {
            assert!(room_m(text).is_err(), "{text}");
        }
    }

    #[test]
    fn densities() {
        assert_eq!((density("20"), density(" 0.5 ")), (Ok(20.0), Ok(0.5)));
        for text in ["", "0", "-1", "NaN", "inf", "x", "5cm"] {
            assert!(density(text).is_err(), "{text}");
        }
    }

    #[test]
    fn pictures_and_ranges() {
        assert_eq!(pixels("1280x720"), Ok((1280, 720)));
        for text in ["", "x", "0x1", "1x0", "1280", "99999x1", "1x-1", "1x1x1", "16384x16384"] {
            assert!(pixels(text).is_err(), "{text}");
        }
        assert_eq!(range("0:500"), Ok((0.0, 500.0)));
        for text in ["", ":", "5:5", "5:1", "NaN:1", "0:inf"] {
            assert!(range(text).is_err(), "{text}");
        }
    }

    #[test]
    fn luminances() {
        assert_eq!(luminance_cd_m2("500cd/m2"), Ok(500.0));
        assert_eq!(luminance_cd_m2(" 2.5 cd/m2"), Ok(2.5));
        for text in ["", "8", "cd/m2", "0cd/m2", "-1cd/m2", "infcd/m2", "1e-310cd/m2"] {
            assert!(luminance_cd_m2(text).is_err(), "{text}");
        }
    }

    #[test]
    fn quantities_are_shown_as_people_read_them() {
        assert_eq!(show_bytes(3 << 29), "1.5 GiB");
        assert_eq!(show_bytes(u64::MAX), "16.0 EiB");
        assert_eq!(show_bytes(12), "12 B");
        assert_eq!(show_more_bytes(5_000_010, 5_000_000), ["5000010 B", "5000000 B"]);
        assert_eq!(show_more_bytes(3 << 29, 12), ["1.5 GiB", "12 B"]);
        for (seconds, text) in [
            (0.123, "0.12 s"),
            (12.3, "12 s"),
            (320.0, "5 min 20 s"),
            (11_100.0, "3 h 5 min"),
            (1e6, "12 days"),
            (1e9, "more than a year"),
        ] {
            assert_eq!(show_seconds(seconds), text);
        }
        assert_eq!(show_share(0.0095), "0.95 %");
        assert_eq!(show_count(3.14e6), "3.14 M");
    }
}
