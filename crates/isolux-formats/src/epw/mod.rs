//! Weather files of EnergyPlus (`.epw`): a place, and the light of every hour of a year there.
//!
//! The format is that of the "Auxiliary Programs" of EnergyPlus, chapter "EnergyPlus Weather File (EPW) Data Dictionary". Of a file are
//! read the place, the dew point, irradiances and illuminances. Files are taken as hostile: sizes are bounded, and every number is
//! checked.

mod fields;
mod parse;
mod record;
mod year;

use crate::plain_text::read_bounded;
use crate::{Loaded, Problems};
use std::path::Path;

pub use parse::parse;
pub use record::{Hour, Instant, Weather, WeatherPlace};
pub(crate) use year::USUAL_DEW_POINT_C;
pub use year::{DaylightHour, DaylightYear};

/// Largest file read, bytes: a year of hours has two million.
const MOST_BYTES: u64 = 16 << 20;

/// Reads a weather file.
pub fn read(path: &Path) -> Result<Loaded<Weather>, Problems> {
    let bytes = read_bounded(path, MOST_BYTES)?;
    parse(&bytes, path)
}
