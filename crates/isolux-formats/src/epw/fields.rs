//! Numbers between commas.

use crate::counted::shown;

/// What a column holds.
#[derive(Clone, Copy)]
pub(super) struct Column {
    /// From 0.
    pub(super) index: usize,
    pub(super) name: &'static str,
    /// From this number on there is no value.
    pub(super) missing_from: f64,
    /// The least and the most that is believed.
    pub(super) range: [f64; 2],
}

/// No surface gets more from the sun.
const MOST_W_M2: f64 = 2000.0;
const MOST_LX: f64 = 300_000.0;

const fn irradiance(index: usize, name: &'static str) -> Column {
    Column { index, name, missing_from: 9999.0, range: [0.0, MOST_W_M2] }
}

const fn illuminance(index: usize, name: &'static str) -> Column {
    Column { index, name, missing_from: 999_900.0, range: [0.0, MOST_LX] }
}

pub(super) const DEW_POINT: Column =
    Column { index: 7, name: "dew point", missing_from: 99.9, range: [-100.0, 99.0] };
pub(super) const GLOBAL_W_M2: Column = irradiance(13, "global horizontal irradiance");
pub(super) const DIRECT_W_M2: Column = irradiance(14, "direct normal irradiance");
pub(super) const DIFFUSE_W_M2: Column = irradiance(15, "diffuse horizontal irradiance");
pub(super) const GLOBAL_LX: Column = illuminance(16, "global horizontal illuminance");
pub(super) const DIRECT_LX: Column = illuminance(17, "direct normal illuminance");
pub(super) const DIFFUSE_LX: Column = illuminance(18, "diffuse horizontal illuminance");

/// The text of a field.
pub(super) fn text<'a>(fields: &[&'a str], index: usize) -> &'a str {
    fields.get(index).map_or("", |field| field.trim())
}

/// A finite number; what is wrong is told.
pub(super) fn number(fields: &[&str], index: usize, name: &str) -> Result<f64, String> {
    let word = text(fields, index);
    let value = word.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| {
        let shown: String = word.chars().take(40).collect();
        format!("the {name} is `{shown}`, which is no number")
    })
}

/// A whole number in a range.
pub(super) fn count(
    fields: &[&str],
    index: usize,
    name: &str,
    range: std::ops::RangeInclusive<u32>,
) -> Result<u32, String> {
    let value = number(fields, index, name)?;
    let is_whole = value >= f64::from(*range.start())
        && value <= f64::from(*range.end())
        && value.fract() == 0.0;
    is_whole.then_some(value as u32).ok_or_else(|| {
        format!("the {name} is {}, not one of {} to {}", shown(value), range.start(), range.end())
    })
}

/// The value of a column; `None` where the field is empty, or says that there is none.
pub(super) fn value(fields: &[&str], column: Column) -> Result<Option<f64>, String> {
    if text(fields, column.index).is_empty() {
        return Ok(None);
    }
    let value = number(fields, column.index, column.name)?;
    if value >= column.missing_from {
        return Ok(None);
    }
    let [least, most] = column.range;
    match (least..=most).contains(&value) {
        true => Ok(Some(value)),
        false => {
            Err(format!("the {} is {}, not one of {least} to {most}", column.name, shown(value)))
        }
    }
}
