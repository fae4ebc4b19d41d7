//! Where the sun is.

use isolux::geometry::{Direction, Vector};
use isolux::units::sincos_deg;
use solar_positioning::time::JulianDate;
use solar_positioning::{Location, RefractionCorrection, SolarPositions, delta_t};

/// Half of the mean angle under which the sun is seen, degrees.
pub(crate) const HALF_ANGLE_DEG: f64 = 0.2665;

/// Air for refraction, hPa and degrees Celsius: it lifts a sun at the horizon by half a degree, one at 10 degrees by a tenth.
const AIR: (f64, f64) = (1013.25, 10.0);

/// Years that clocks of the reference cover.
const YEARS: std::ops::RangeInclusive<i32> = 1900..=2100;

/// A place on Earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Site {
    /// North of the equator.
    pub(crate) latitude_deg: f64,
    /// East of Greenwich.
    pub(crate) longitude_deg: f64,
    /// Above the sea.
    pub(crate) height_m: f64,
}

/// A day and the time of a clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock {
    pub(crate) year: i32,
    pub(crate) month: u32,
    pub(crate) day: u32,
    /// Hours since midnight, below 24.
    pub(crate) hours: f64,
    /// How far the clock is ahead of UTC, hours.
    pub(crate) ahead_h: f64,
}

/// A position of the sun as seen from a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SunPosition {
    /// From north by east.
    pub(crate) azimuth_deg: f64,
    /// Above the horizon.
    pub(crate) elevation_deg: f64,
}

impl SunPosition {
    /// Where the sun is seen, lifted by refraction: I. Reda and A. Andreas, "Solar position algorithm for solar radiation
    /// applications", Solar Energy 76 (2004) 577-589, within 0.0003 degrees. What is wrong is told.
    pub(crate) fn at(site: Site, clock: Clock) -> Result<Self, String> {
        let Clock { year, month, day, hours, ahead_h } = clock;
        if !YEARS.contains(&year) {
            return Err(format!(
                "the year {year}; from {} to {} are read",
                YEARS.start(),
                YEARS.end()
            ));
        }
        let told = |error: solar_positioning::Error| error.to_string();
        let terrestrial_s = delta_t::estimate_from_date(year, month).map_err(told)?;
        let midnight = JulianDate::from_utc(year, month, day, 0, 0, 0.0, terrestrial_s);
        let days = midnight.map_err(told)?.julian_date() + (hours - ahead_h) / 24.0;
        let time = JulianDate::new(days, terrestrial_s).map_err(told)?;
        let location = Location { latitude: site.latitude_deg, longitude: site.longitude_deg };
        let air = RefractionCorrection::new(AIR.0, AIR.1).map_err(told)?;
        let seen = SolarPositions::new().at_from_julian(time, location, site.height_m, Some(air));
        let seen = seen.map_err(told)?;
        Ok(Self { azimuth_deg: seen.azimuth(), elevation_deg: seen.elevation_angle() })
    }

    /// Towards the sun in the frame of skies.
    pub(crate) fn direction(self) -> Direction {
        let (up, flat) = sincos_deg(self.elevation_deg);
        let (east, north) = sincos_deg(self.azimuth_deg);
        Vector::new(flat * east, flat * north, up).direction().unwrap_or(Direction::Z)
    }
}

impl Clock {
    /// The day of the year, from 1.
    pub(crate) fn day_of_year(&self) -> u16 {
        let is_leap = self.year % 4 == 0 && (self.year % 100 != 0 || self.year % 400 == 0);
        let before = |month: u32| match month {
            2 => 28 + u16::from(is_leap),
            4 | 6 | 9 | 11 => 30,
            _ => 31,
        };
        (1..self.month).map(before).sum::<u16>() + self.day as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `get_solarposition(time, latitude, longitude, pressure=101325, temperature=10, method="nrel_numpy", delta_t=None)` of pvlib 0.16.1:
    /// clock, latitude, longitude, azimuth, apparent elevation.
    const PVLIB: [([f64; 5], f64, f64, f64, f64); 9] = [
        ([2026.0, 6.0, 21.0, 12.0, 2.0], 52.5, 13.4, 149.33867, 58.17164),
        ([2026.0, 12.0, 21.0, 9.5, 1.0], 52.5, 13.4, 144.78661, 7.07070),
        ([2026.0, 3.0, 20.0, 6.0 + 5.0 / 60.0, 0.0], 0.0, 0.0, 90.14289, -0.04452),
        ([2026.0, 6.0, 21.0, 23.0, 2.0], 69.65, 18.96, 335.72149, 5.17379),
        ([2026.0, 2.0, 10.0, 15.0, -5.0], 40.7, -74.0, 225.12073, 22.55816),
        ([2026.0, 12.0, 21.0, 12.0, 11.0], -33.9, 151.2, 51.39965, 74.38297),
        ([2026.0, 9.0, 1.0, 5.75, 9.0], 35.7, 139.7, 83.68070, 5.75789),
        ([1998.0, 7.0, 1.0, 17.0 + 20.5 / 60.0, 2.0], 47.0, 8.0, 262.82319, 38.84821),
        ([2026.0, 11.0, 29.0, 18.0, 0.0], 51.5, -0.1, 258.25348, -18.42347),
    ];

    /// Both programs follow one algorithm; they take the difference of clocks (delta T) of a year to within some seconds, in which the
    /// sun goes 0.004 degrees a second at most.
    #[test]
    fn the_sun_is_where_pvlib_has_it() {
        for ([year, month, day, hours, ahead_h], latitude_deg, longitude_deg, azimuth, up) in PVLIB
        {
            let site = Site { latitude_deg, longitude_deg, height_m: 0.0 };
            let (month, day) = (month as u32, day as u32);
            let clock = Clock { year: year as i32, month, day, hours, ahead_h };
            let found = SunPosition::at(site, clock).unwrap();
            assert!((found.azimuth_deg - azimuth).abs() < 1e-3, "{clock:?}: {found:?}");
            assert!((found.elevation_deg - up).abs() < 1e-3, "{clock:?}: {found:?}");
        }
    }

    #[test]
    fn days_of_the_year() {
        let of =
            |year, month, day| Clock { year, month, day, hours: 0.0, ahead_h: 0.0 }.day_of_year();
        assert_eq!([of(2026, 1, 1), of(2026, 12, 31), of(2024, 12, 31)], [1, 365, 366]);
        assert_eq!([of(1900, 3, 1), of(2000, 3, 1)], [60, 61]);
    }

    #[test]
    fn directions_are_by_north_and_east() {
        let of = |azimuth_deg, elevation_deg| {
            <[f64; 3]>::from(SunPosition { azimuth_deg, elevation_deg }.direction().to_vector())
        };
        assert_eq!(of(90.0, 0.0), [1.0, 0.0, 0.0]);
        assert_eq!(of(180.0, 0.0), [0.0, -1.0, 0.0]);
        assert_eq!(of(0.0, 90.0), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn dates_that_there_are_none_of_are_told() {
        let site = Site { latitude_deg: 0.0, longitude_deg: 0.0, height_m: 0.0 };
        for (year, month, day) in [(1066, 10, 14), (2026, 2, 30), (2026, 13, 1)] {
            let clock = Clock { year, month, day, hours: 0.0, ahead_h: 0.0 };
            assert!(SunPosition::at(site, clock).is_err(), "{clock:?}");
        }
    }
}
