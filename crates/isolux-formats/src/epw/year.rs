//! The sun and the sky of every hour.

use super::record::{Hour, Weather};
use crate::sun::{Clock, Site, SunPosition};
use isolux::geometry::Direction;
use isolux::photometry::{AllWeather, SkyWeather};

/// The year that positions of the sun are those of: one without a leap day. From year to year they differ by half a degree.
const YEAR: i32 = 2025;
/// The same for files with a leap day.
const LEAP_YEAR: i32 = 2024;

/// Dew point where none is told, degrees Celsius: two centimetres of water in the air, as gendaylit of Radiance takes it. It changes
/// illuminances by a per cent.
pub(crate) const USUAL_DEW_POINT_C: f64 = 11.0;

/// An hour with the sun above the horizon in its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DaylightHour {
    /// The hour that ends so many hours after midnight, by standard time: from 1 to 24.
    pub hour: u32,
    /// Towards the sun, in the frame of skies.
    pub sun: Direction,
    /// Its light.
    pub light: AllWeather,
}

/// The hours of a year with the sun above the horizon.
#[derive(Clone, Debug, PartialEq)]
pub struct DaylightYear {
    /// Those with their light known.
    pub hours: Vec<DaylightHour>,
    /// How many have no irradiance in the file.
    pub unknown: usize,
}

impl Weather {
    /// The daylight of the year. What is wrong with the place is told.
    pub fn daylight(&self) -> Result<DaylightYear, String> {
        let is_leap = self.hours.iter().any(|hour| (hour.month, hour.day) == (2, 29));
        let year = if is_leap { LEAP_YEAR } else { YEAR };
        let mut found = DaylightYear { hours: Vec::new(), unknown: 0 };
        for hour in &self.hours {
            let clock = Clock {
                year,
                month: hour.month,
                day: hour.day,
                hours: f64::from(hour.hour) - 0.5,
                ahead_h: self.place.ahead_h,
            };
            let position = SunPosition::at(self.place.site(), clock)?;
            if position.elevation_deg <= 0.0 {
                continue;
            }
            match hour.weather(clock.day_of_year()) {
                Some(weather) => {
                    let sun = position.direction();
                    let light = weather.light(sun);
                    found.hours.push(DaylightHour { hour: hour.hour, sun, light });
                }
                None => found.unknown += 1,
            }
        }
        Ok(found)
    }
}

impl Hour {
    fn weather(&self, day: u16) -> Option<SkyWeather> {
        Some(SkyWeather {
            direct_normal_w_m2: self.direct_normal_w_m2?,
            diffuse_horizontal_w_m2: self.diffuse_horizontal_w_m2?,
            day,
            dew_point_c: self.dew_point_c.unwrap_or(USUAL_DEW_POINT_C),
        })
    }
}

impl super::WeatherPlace {
    fn site(&self) -> Site {
        Site {
            latitude_deg: self.latitude_deg,
            longitude_deg: self.longitude_deg,
            height_m: self.height_m,
        }
    }
}
