//! Which hall: how many triangles, how many luminaires.

use std::fmt::{self, Display};
use std::ops::RangeInclusive;

/// A hall, written `hall`, `hall,triangles=1e6` or `hall,triangles=1e6,luminaires=100`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    /// The most triangles it may have; it has at least 98 % of them.
    pub triangles: u32,
    /// Exactly so many luminaires.
    pub luminaires: u32,
}

/// What is wrong with the name of a variant, and the remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}; {remedy}")]
pub struct VariantError {
    /// What is wrong.
    pub what: String,
    /// What to write instead.
    pub remedy: String,
}

impl Variant {
    /// 10,000 triangles, 2626 luminaires.
    pub const STANDARD: Self = Self { triangles: 10_000, luminaires: 2626 };
    /// Triangles that a variant may have: undivided surfaces, and what fits into the memory of a
    /// small machine.
    pub const TRIANGLES: RangeInclusive<u32> = 10_000..=10_000_000;
    /// Luminaires that a variant may have.
    pub const LUMINAIRES: RangeInclusive<u32> = 100..=100_000;

    /// From what follows `hall` in a name: nothing, or `,triangles=N` and `,luminaires=N`.
    pub fn parse(settings: &str) -> Result<Self, VariantError> {
        let mut variant = Self::STANDARD;
        let mut seen = Vec::new();
        for setting in settings.split(',').skip(1) {
            let (key, value) = setting.split_once('=').unwrap_or((setting, ""));
            let (count, range) = match key {
                "triangles" => (&mut variant.triangles, Self::TRIANGLES),
                "luminaires" => (&mut variant.luminaires, Self::LUMINAIRES),
                _ => return Err(unknown(key)),
            };
            if seen.contains(&key) {
                return Err(error(format!("`{key}` is given twice"), "give it once"));
            }
            seen.push(key);
            *count = whole_number(key, value, &range)?;
        }
        Ok(variant)
    }
}

/// `100000` or `1e5`.
fn whole_number(key: &str, value: &str, range: &RangeInclusive<u32>) -> Result<u32, VariantError> {
    let number = value.parse::<f64>().ok().filter(|n| n.fract() == 0.0);
    let within = |n: &f64| (f64::from(*range.start())..=f64::from(*range.end())).contains(n);
    number.filter(within).map(|n| n as u32).ok_or_else(|| {
        let what = format!("`{key}={value}` of the hall is out of range or no whole number");
        error(what, format!("give {key}={} to {}", range.start(), range.end()))
    })
}

fn unknown(key: &str) -> VariantError {
    let what = format!("`{key}` is nothing that can be set of the hall");
    error(what, "write hall,triangles=N,luminaires=N or leave either out")
}

fn error(what: impl Into<String>, remedy: impl Into<String>) -> VariantError {
    VariantError { what: what.into(), remedy: remedy.into() }
}

impl Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { triangles, luminaires } = *self;
        f.write_str("hall")?;
        if triangles != Self::STANDARD.triangles {
            write!(f, ",triangles={triangles}")?;
        }
        if luminaires != Self::STANDARD.luminaires {
            write!(f, ",luminaires={luminaires}")?;
        }
        Ok(())
    }
}
