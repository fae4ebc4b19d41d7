//! Spectra: colours of light and of surfaces.

use super::property::numbers;
use super::record::{Element, Wrong};
use crate::srgb::linear;
use isolux::units::Rgb;

/// What a spectrum is the spectrum of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A share of light.
    Surface,
    /// Light.
    Light,
}

/// Light of the same power at every wavelength, in linear Rec. 709 (XYZ 1, 1, 1 by IEC 61966-2-1): what
/// Mitsuba makes of a `spectrum` of one number that is emitted.
const EQUAL_ENERGY: Rgb = Rgb::new(1.204_8, 0.948_3, 0.908_9);

const REMEDY: &str = "give an `rgb`";

/// The colour that a property is, three channels of linear Rec. 709, not negative.
pub(super) fn colour(property: &Element, of: Of) -> Result<Rgb, Wrong> {
    let value = property.attribute("value").unwrap_or_default();
    let shown: String = value.chars().take(60).collect();
    let label = format!("{} `{}`", property.tag, property.slot());
    let bad = |what: &str| (format!("{label}: `{shown}` is not {what}"), REMEDY);
    let colour = match property.tag.as_str() {
        "float" | "integer" => {
            let grey = numbers(value).filter(|list| list.len() == 1);
            Rgb::grey(grey.ok_or_else(|| bad("a number"))?[0])
        }
        "rgb" => rgb(value).ok_or_else(|| bad("one or three numbers, or #rrggbb"))?,
        "spectrum" => {
            if property.attribute("filename").is_some() || value.contains(':') {
                let what = format!("{label}: spectra by wavelength are not read");
                return Err((what, "give its colour as `rgb`"));
            }
            let list = numbers(value).filter(|list| list.len() == 1);
            let level = list.ok_or_else(|| bad("a number"))?[0];
            match of {
                Of::Surface => Rgb::grey(level),
                Of::Light => EQUAL_ENERGY.chromaticity() * level,
            }
        }
        "blackbody" => {
            let what = format!(
                "{label}: black bodies are not read, whose power Mitsuba takes in W/(m2 sr nm)"
            );
            return Err((what, "give the light as `rgb`"));
        }
        other => return Err((format!("`{other}` is not a colour that is read"), REMEDY)),
    };
    if colour.min_channel() < 0.0 {
        return Err(bad("zero or more"));
    }
    Ok(colour)
}

fn rgb(value: &str) -> Option<Rgb> {
    if let Some(hex) = value.trim().strip_prefix('#') {
        let code = u32::from_str_radix(hex, 16).ok().filter(|_| hex.len() == 6)?;
        let channel = |shift: u32| linear(f64::from(code >> shift & 0xff) / 255.0);
        return Some(Rgb::new(channel(16), channel(8), channel(0)));
    }
    match numbers(value)?.as_slice() {
        [grey] => Some(Rgb::grey(*grey)),
        [r, g, b] => Some(Rgb::new(*r, *g, *b)),
        _ => None,
    }
}
