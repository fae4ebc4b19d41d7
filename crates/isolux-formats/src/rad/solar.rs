//! Where Radiance's `gensky` and `gendaylit` have the sun (`gen/sun.c`).

use super::words::number;
use isolux::geometry::{Direction, Vector};
use std::f64::consts::PI;

/// Berkeley, where both programs are unless told otherwise, in radians west.
const BERKELEY: Site = Site { latitude: 0.66, longitude: 2.13, meridian: 2.0944 };

/// A place, in radians north and west, and the meridian of its clocks.
#[derive(Clone, Copy)]
struct Site {
    latitude: f64,
    longitude: f64,
    meridian: f64,
}

/// What both programs are told of the sun, and what is left of their arguments.
pub(super) struct Solar<'a> {
    moment: Moment,
    site: Site,
    /// Options without those of the place.
    pub(super) rest: Vec<&'a str>,
}

enum Moment {
    /// In radians, the azimuth west of south.
    Angles {
        altitude: f64,
        azimuth: f64,
    },
    Time {
        day: u16,
        hour: f64,
        is_solar: bool,
    },
}

/// Days before a month.
const BEFORE: [u16; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];

impl<'a> Solar<'a> {
    /// Reads `month day hour` or `-ang altitude azimuth`, and the options of the place.
    pub(super) fn parse(words: &'a [String]) -> Result<Self, String> {
        let [first, second, third, options @ ..] = words else {
            return Err("it needs month, day and hour, or -ang altitude azimuth".into());
        };
        let moment = match first.as_str() {
            "-ang" => Moment::Angles {
                altitude: value(second)?.to_radians(),
                azimuth: value(third)?.to_radians(),
            },
            _ => time(first, second, third)?,
        };
        let (mut site, mut rest) = (BERKELEY, Vec::new());
        let mut options = options.iter().map(String::as_str);
        while let Some(option) = options.next() {
            let place = match option {
                "-a" => &mut site.latitude,
                "-o" => &mut site.longitude,
                "-m" => &mut site.meridian,
                _ => {
                    rest.push(option);
                    continue;
                }
            };
            *place = value(options.next().ok_or_else(|| format!("{option} without its value"))?)?
                .to_radians();
        }
        Ok(Self { moment, site, rest })
    }

    /// Altitude in radians, and towards the sun: x east, y north, z up. A sun above 87 degrees is taken there, but for overcast skies.
    pub(super) fn sun(&self, is_overcast: bool) -> (f64, Direction) {
        let (mut altitude, azimuth) = self.angles();
        if !is_overcast {
            altitude = altitude.min(87.0_f64.to_radians());
        }
        let ((sin, cos), (up, flat)) = (libm::sincos(azimuth), libm::sincos(altitude));
        let towards = Vector::new(-sin * flat, -cos * flat, up).direction();
        (altitude, towards.unwrap_or(Direction::Z))
    }

    /// The day of the year, where it is known.
    pub(super) fn day(&self) -> Option<u16> {
        match self.moment {
            Moment::Angles { .. } => None,
            Moment::Time { day, .. } => Some(day),
        }
    }

    fn angles(&self) -> (f64, f64) {
        let (day, hour, is_solar) = match self.moment {
            Moment::Angles { altitude, azimuth } => return (altitude, azimuth),
            Moment::Time { day, hour, is_solar } => (f64::from(day), hour, is_solar),
        };
        let Site { latitude, longitude, meridian } = self.site;
        let declination = 0.4093 * libm::sin(2.0 * PI / 365.0 * (day - 81.0));
        let adjusted = 0.170 * libm::sin(4.0 * PI / 373.0 * (day - 80.0))
            - 0.129 * libm::sin(2.0 * PI / 355.0 * (day - 8.0))
            + 12.0 / PI * (meridian - longitude);
        let turn = PI / 12.0 * if is_solar { hour } else { hour + adjusted };
        let (sin_d, cos_d) = libm::sincos(declination);
        let (sin_l, cos_l) = libm::sincos(latitude);
        let (sin_t, cos_t) = libm::sincos(turn);
        let altitude = libm::asin((sin_l * sin_d - cos_l * cos_d * cos_t).clamp(-1.0, 1.0));
        let azimuth = -libm::atan2(cos_d * sin_t, -cos_l * sin_d - sin_l * cos_d * cos_t);
        (altitude, azimuth)
    }
}

/// A finite number.
pub(super) fn value(word: &str) -> Result<f64, String> {
    number(word).ok_or_else(|| format!("`{word}` is not a finite number"))
}

fn time(month: &str, day: &str, hour: &str) -> Result<Moment, String> {
    let whole = |word: &str, most: u16| {
        let value: Option<u16> = word.parse().ok();
        value.filter(|v| (1..=most).contains(v)).ok_or_else(|| format!("`{word}` of 1 to {most}"))
    };
    let (month, day) = (whole(month, 12)?, whole(day, 31)?);
    let (is_solar, clock) = match hour.strip_prefix('+') {
        Some(rest) => (true, rest),
        None => (false, hour),
    };
    let (hours, minutes) = clock.split_once(':').unwrap_or((clock, "0"));
    let hour = value(hours).and_then(|h| Ok(h + value(minutes)? / 60.0));
    let hour = hour.map_err(|_| format!("the hour `{clock}`: time zones are given by -m"))?;
    if !(0.0..24.0).contains(&hour) {
        return Err(format!("the hour {hour}"));
    }
    Ok(Moment::Time { day: BEFORE[usize::from(month) - 1] + day, hour, is_solar })
}
