//! How pictures are to look, as written.

use crate::quantity::luminance_cd_m2;
use isolux_formats::scene_toml::light_of_temperature;
use isolux_view::{Exposure, WhiteAdaptation};
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// What the exposure of a picture goes by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ExposureChoice {
    /// The view, or a figure.
    Of(Exposure),
    /// The map, whatever of it is seen.
    Map,
}

/// The light that is to look white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum WhiteChoice {
    /// The light of the luminaires, nearly.
    Light,
    /// Whatever the scene is.
    Of(WhiteAdaptation),
}

/// The display that a picture is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ProfileChoice {
    Srgb,
    DisplayP3,
    /// An ICC file.
    File(PathBuf),
}

/// Exposure as written: `auto`, `map`, `ev 8`, `500 cd/m2`, `grey 90 cd/m2`, `99%`.
pub(crate) fn exposure(text: &str) -> Result<ExposureChoice, String> {
    let text = text.trim();
    match text {
        "auto" => return Ok(ExposureChoice::Of(Exposure::Automatic)),
        "map" => return Ok(ExposureChoice::Map),
        _ => {}
    }
    let figure = if let Some(value) = text.strip_prefix("ev") {
        number(value).map(Exposure::Ev100)
    } else if let Some(value) = text.strip_prefix("grey").or(text.strip_prefix("gray")) {
        luminance_cd_m2(value).ok().map(Exposure::GreyCdM2)
    } else if let Some(share) = text.strip_suffix('%') {
        let share = number(share).filter(|share| (0.0..=100.0).contains(share));
        share.map(|share| Exposure::Percentile(share / 100.0))
    } else {
        luminance_cd_m2(text).ok().map(Exposure::WhiteCdM2)
    };
    figure.map(ExposureChoice::Of).ok_or_else(|| {
        "write auto, map, an exposure value as ev8, the luminance shown as white as 500cd/m2 or as middle grey as \
         `grey 90cd/m2`, or the share of pixels no brighter than white as 99%"
            .into()
    })
}

/// The light that is to look white, as written: `auto`, `none`, `2700K`, `scene`.
pub(crate) fn white(text: &str) -> Result<WhiteChoice, String> {
    let text = text.trim();
    match text {
        "auto" => return Ok(WhiteChoice::Light),
        "none" => return Ok(WhiteChoice::Of(WhiteAdaptation::None)),
        "scene" => return Ok(WhiteChoice::Of(WhiteAdaptation::Scene)),
        _ => {}
    }
    let kelvin = text.strip_suffix(['K', 'k']).and_then(number);
    let light = kelvin.and_then(light_of_temperature);
    let remedy = "write auto, none, a colour temperature from 1000K to 25000K as 2700K, or scene";
    light.map(|light| WhiteChoice::Of(WhiteAdaptation::To(light))).ok_or_else(|| remedy.into())
}

/// The display of a picture, as written: `srgb`, `display-p3`, the path of a file.
pub(crate) fn profile(text: &str) -> Result<ProfileChoice, String> {
    match text {
        "" => Err("write srgb, display-p3, or the path of an ICC file".into()),
        "srgb" => Ok(ProfileChoice::Srgb),
        "display-p3" => Ok(ProfileChoice::DisplayP3),
        path => Ok(ProfileChoice::File(path.into())),
    }
}

/// What is added to the signal.
pub(crate) fn brightness(text: &str) -> Result<f64, String> {
    within(text, -1.0..=1.0).ok_or_else(|| "write a number from -1 to 1; 0 changes nothing".into())
}

/// A factor on the signal.
pub(crate) fn contrast(text: &str) -> Result<f64, String> {
    within(text, 0.0..=100.0)
        .ok_or_else(|| "write a number from 0 to 100; 1 changes nothing".into())
}

/// The luminance of the white of a display, cd/m2.
pub(crate) fn display_white(text: &str) -> Result<f64, String> {
    let white = luminance_cd_m2(text).ok().filter(|white| (1.0..=1e5).contains(white));
    white.ok_or_else(|| "write a luminance from 1cd/m2 to 100000cd/m2 as 250cd/m2".into())
}

fn within(text: &str, range: RangeInclusive<f64>) -> Option<f64> {
    number(text).filter(|value| range.contains(value))
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exposures() {
        for (text, expected) in [
            ("auto", Exposure::Automatic),
            ("ev8", Exposure::Ev100(8.0)),
            ("ev-1.5", Exposure::Ev100(-1.5)),
            ("500cd/m2", Exposure::WhiteCdM2(500.0)),
            ("2.5 cd/m2", Exposure::WhiteCdM2(2.5)),
            ("grey 90cd/m2", Exposure::GreyCdM2(90.0)),
            ("gray90cd/m2", Exposure::GreyCdM2(90.0)),
            ("50%", Exposure::Percentile(0.5)),
        ] {
            assert_eq!(exposure(text), Ok(ExposureChoice::Of(expected)), "{text}");
        }
        assert_eq!(exposure("map"), Ok(ExposureChoice::Map));
        for text in ["", "8", "ev", "evNaN", "0cd/m2", "-1cd/m2", "cd/m2", "grey", "101%", "%"] {
            assert!(exposure(text).is_err(), "{text}");
        }
    }

    #[test]
    fn whites() {
        assert_eq!(white("auto"), Ok(WhiteChoice::Light));
        assert_eq!(white("none"), Ok(WhiteChoice::Of(WhiteAdaptation::None)));
        assert_eq!(white("scene"), Ok(WhiteChoice::Of(WhiteAdaptation::Scene)));
        let warm = light_of_temperature(2700.0).map(WhiteAdaptation::To).map(WhiteChoice::Of);
        assert_eq!((white("2700K").ok(), white(" 2700 k").ok()), (warm, warm));
        for text in ["", "K", "2700", "999K", "NaNK", "infK", "-2700K", "white"] {
            assert!(white(text).is_err(), "{text}");
        }
    }

    #[test]
    fn displays() {
        assert_eq!(profile("srgb"), Ok(ProfileChoice::Srgb));
        assert_eq!(profile("display-p3"), Ok(ProfileChoice::DisplayP3));
        assert_eq!(profile("m.icc"), Ok(ProfileChoice::File("m.icc".into())));
        assert!(profile("").is_err());
        assert_eq!((brightness("-0.1"), contrast("1.2")), (Ok(-0.1), Ok(1.2)));
        assert_eq!(display_white("250 cd/m2"), Ok(250.0));
        for text in ["", "x", "NaN", "-2", "101"] {
            assert!(brightness(text).is_err() && contrast(text).is_err(), "{text}");
        }
        assert!(display_white("0.5cd/m2").is_err() && display_white("250").is_err());
    }
}
