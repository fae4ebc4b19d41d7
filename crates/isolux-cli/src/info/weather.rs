//! What a weather file holds.

use crate::console::{facts, print, print_json};
use crate::failure::Failure;
use crate::quantity::significant;
use crate::shown::name;
use crate::source::{bad_file, show_warnings};
use isolux_formats::epw::{self, Hour, Weather};
use serde::Serialize;
use std::path::Path;

/// From this irradiance on the sun shines (World Meteorological Organization).
const SUNSHINE_W_M2: f64 = 120.0;

/// Prints a weather file.
pub(super) fn show(path: &Path, json: bool) -> Result<(), Failure> {
    let loaded = epw::read(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    let contents = Contents::of(&loaded.value);
    if json { print_json(&contents) } else { print(&contents.text()) }
}

/// What `info --json` prints of a weather file.
#[derive(Serialize)]
struct Contents {
    kind: &'static str,
    place: String,
    latitude_deg: f64,
    longitude_deg: f64,
    /// Of clocks, without summer time.
    ahead_of_utc_h: f64,
    height_m: f64,
    hours: usize,
    /// Hours with more than 120 W/m2 of direct light.
    sunshine_h: usize,
    /// Sums over all hours; none where no hour has a value.
    global_horizontal_kwh_m2: Option<f64>,
    direct_normal_kwh_m2: Option<f64>,
    diffuse_horizontal_kwh_m2: Option<f64>,
    /// The greatest illuminance that is written; none where none is.
    most_global_horizontal_lx: Option<f64>,
}

impl Contents {
    fn of(weather: &Weather) -> Self {
        let values = |of: fn(&Hour) -> Option<f64>| weather.hours.iter().filter_map(of);
        let sum = |of: fn(&Hour) -> Option<f64>| {
            let is_known = values(of).next().is_some();
            is_known.then(|| values(of).sum::<f64>() / 1000.0)
        };
        let place = &weather.place;
        Self {
            kind: "weather",
            place: place.name.clone(),
            latitude_deg: place.latitude_deg,
            longitude_deg: place.longitude_deg,
            ahead_of_utc_h: place.ahead_h,
            height_m: place.height_m,
            hours: weather.hours.len(),
            sunshine_h: values(|h| h.direct_normal_w_m2).filter(|w| *w > SUNSHINE_W_M2).count(),
            global_horizontal_kwh_m2: sum(|h| h.global_horizontal_w_m2),
            direct_normal_kwh_m2: sum(|h| h.direct_normal_w_m2),
            diffuse_horizontal_kwh_m2: sum(|h| h.diffuse_horizontal_w_m2),
            // Files without illuminances have zeros, or nothing.
            most_global_horizontal_lx: values(|h| h.global_horizontal_lx)
                .reduce(f64::max)
                .filter(|lx| *lx > 0.0),
        }
    }

    fn text(&self) -> String {
        let energy = |sum: Option<f64>| {
            sum.map_or("not known".to_owned(), |sum| format!("{} kWh/m2", significant(sum, 4)))
        };
        facts(&[
            ("weather of", name(&self.place)),
            (
                "latitude, longitude",
                format!("{} north, {} east", self.latitude_deg, self.longitude_deg),
            ),
            ("clocks", format!("{} h ahead of UTC", self.ahead_of_utc_h)),
            ("height", format!("{} m", self.height_m)),
            ("hours", self.hours.to_string()),
            ("sunshine", format!("{} h", self.sunshine_h)),
            ("global horizontal", energy(self.global_horizontal_kwh_m2)),
            ("direct normal", energy(self.direct_normal_kwh_m2)),
            ("diffuse horizontal", energy(self.diffuse_horizontal_kwh_m2)),
            (
                "brightest hour",
                self.most_global_horizontal_lx
                    .map_or("not known".to_owned(), |lx| format!("{} lx", significant(lx, 3))),
            ),
        ])
    }
}
