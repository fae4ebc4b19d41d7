//! Spectra: colours of light and of surfaces.

use super::property::{float, numbers, string};
use super::record::{Element, Wrong};
pub(super) use super::spectral::Of;
use super::spectral::Spectrum;
use crate::srgb::linear;
use isolux::units::Rgb;

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
        "spectrum" => spectrum(property, of)?,
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

/// What a `spectrum` is: by its type, else one number or values by wavelength.
fn spectrum(property: &Element, of: Of) -> Result<Rgb, Wrong> {
    let label = format!("spectrum `{}`", property.slot());
    let (kind, value) = (property.kind(), property.attribute("value").unwrap_or_default());
    let number_of = |name: &str, usual| Ok(float(property, name)?.unwrap_or(usual));
    match kind {
        "d65" => Ok(Rgb::grey(number_of("scale", 1.0)?)),
        "uniform" => Ok(level(number_of("value", 1.0)?, of)),
        "regular" | "irregular" => by_wavelength(property, of),
        "" if value.contains(':') => pairs(value)
            .and_then(Spectrum::new)
            .map(|spectrum| spectrum.colour(of))
            .ok_or_else(|| (format!("{label}: no list of `wavelength:value`"), WAVELENGTHS)),
        "" => match numbers(value).as_deref() {
            Some(&[only]) => Ok(level(only, of)),
            _ => {
                let shown: String = value.chars().take(60).collect();
                Err((format!("{label}: `{shown}` is not a number"), REMEDY))
            }
        },
        other => {
            let shown: String = other.chars().take(60).collect();
            let what = format!("{label}: spectra of the type `{shown}` are not read");
            Err((what, "use d65, uniform, regular or irregular, or give an `rgb`"))
        }
    }
}

const WAVELENGTHS: &str = "give wavelengths in nm that increase, and as many values";

/// The same value at all wavelengths.
fn level(level: f64, of: Of) -> Rgb {
    match of {
        Of::Surface => Rgb::grey(level),
        Of::Light => EQUAL_ENERGY.chromaticity() * level,
    }
}

/// `regular` has the ends of its wavelengths, `irregular` all.
fn by_wavelength(property: &Element, of: Of) -> Result<Rgb, Wrong> {
    let list = |name: &str| string(property, name).and_then(numbers);
    let values = list("values").unwrap_or_default();
    let spectrum = match (property.kind(), list("wavelengths")) {
        ("irregular", Some(nm)) if nm.len() == values.len() => {
            Spectrum::new(nm.into_iter().zip(values).map(|(nm, value)| [nm, value]).collect())
        }
        ("regular", _) => {
            let ends = [float(property, "wavelength_min")?, float(property, "wavelength_max")?];
            match ends {
                [Some(first), Some(last)] => Spectrum::even(first, last, &values),
                _ => None,
            }
        }
        _ => None,
    };
    let none = || {
        let what = format!("spectrum `{}`: no {} list of values", property.slot(), property.kind());
        (what, WAVELENGTHS)
    };
    spectrum.map(|spectrum| spectrum.colour(of)).ok_or_else(none)
}

/// `400:0.5, 500:0.7`.
fn pairs(value: &str) -> Option<Vec<[f64; 2]>> {
    let words = value.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty());
    let pair = |word: &str| match numbers(&word.replacen(':', " ", 1)).as_deref() {
        Some(&[nm, value]) => Some([nm, value]),
        _ => None,
    };
    words.map(pair).collect()
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
