//! What is compared: the engines, with what the study switched on and off.

use isolux::engine::{RadiositySettings, SolveRequest};
use isolux::map::Method;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// A way to make maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum System {
    /// Gathering over a map that is solved for as a fixed point: what isolux does unless told otherwise.
    Hybrid,
    /// Particles from luminaires, filtered where maps show noise: as the study's Inspirer.
    Forward,
    /// The same without filter.
    ForwardUnfiltered,
    /// Progressive radiosity with an ambient term in place of unshot light: as the study's LVS, but over specular surfaces, too.
    Radiosity,
    /// The same without ambient term.
    RadiosityWithoutAmbient,
    /// The same in a scene without mirrors, gloss and glass: as the study's LVS.
    RadiosityDiffuse,
    /// Irradiance cache: as Radiance.
    Cache,
    /// Radiance itself, of Greg Ward: `rtrace` at the points that are judged.
    Radiance,
    /// Mitsuba 3, of Wenzel Jakob and others: paths from the points.
    Mitsuba,
    /// LuxCore's baker of light maps.
    #[serde(rename = "luxcore")]
    LuxCore,
}

impl System {
    /// In the order of reports.
    pub const ALL: [Self; 10] = [
        Self::Hybrid,
        Self::Forward,
        Self::ForwardUnfiltered,
        Self::Radiosity,
        Self::RadiosityWithoutAmbient,
        Self::RadiosityDiffuse,
        Self::Cache,
        Self::Radiance,
        Self::Mitsuba,
        Self::LuxCore,
    ];

    /// Its name in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hybrid => "hybrid",
            Self::Forward => "forward",
            Self::ForwardUnfiltered => "forward-unfiltered",
            Self::Radiosity => "radiosity",
            Self::RadiosityWithoutAmbient => "radiosity-without-ambient",
            Self::RadiosityDiffuse => "radiosity-diffuse",
            Self::Cache => "cache",
            Self::Radiance => "radiance",
            Self::Mitsuba => "mitsuba",
            Self::LuxCore => "luxcore",
        }
    }

    /// Its name for people.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Hybrid => "hybrid",
            Self::Forward => "forward, filtered",
            Self::ForwardUnfiltered => "forward, unfiltered",
            Self::Radiosity => "radiosity",
            Self::RadiosityWithoutAmbient => "radiosity without ambient term",
            Self::RadiosityDiffuse => "radiosity without specular exchange",
            Self::Cache => "irradiance cache",
            Self::Radiance => "Radiance",
            Self::Mitsuba => "Mitsuba 3",
            Self::LuxCore => "LuxCore",
        }
    }

    /// The one of a name.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|system| system.name() == name)
    }

    /// Which engine of isolux it is; `None` of another renderer.
    pub const fn method(self) -> Option<Method> {
        match self {
            Self::Hybrid => Some(Method::Hybrid),
            Self::Forward | Self::ForwardUnfiltered => Some(Method::Forward),
            Self::Radiosity | Self::RadiosityWithoutAmbient | Self::RadiosityDiffuse => {
                Some(Method::Radiosity)
            }
            Self::Cache => Some(Method::Cache),
            Self::Radiance | Self::Mitsuba | Self::LuxCore => None,
        }
    }

    /// What it is asked for, if it is of isolux: an accuracy in about so much time, at most twice that. Of [`System::RadiosityDiffuse`] the scene is to be made diffuse by the caller.
    pub fn request(self, accuracy: f64, about: Duration, seed: u64) -> Option<SolveRequest> {
        Some(SolveRequest {
            method: self.method()?,
            accuracy: Some(accuracy),
            time_limit: Some(2 * about),
            seed,
            filter: self != Self::ForwardUnfiltered,
            audit: false,
            radiosity: RadiositySettings {
                ambient: self != Self::RadiosityWithoutAmbient,
                diffuse_only: self == Self::RadiosityDiffuse,
                ..RadiositySettings::default()
            },
            ..SolveRequest::default()
        })
    }
}

/// Times that double, from the first up to the limit, s; the limit alone if it is less than the first.
pub fn times_s(first_s: f64, limit_s: f64) -> Vec<f64> {
    let doubled = std::iter::successors(Some(first_s), |s| Some(2.0 * s));
    let mut times_s: Vec<f64> = doubled.take_while(|&s| s < limit_s).collect();
    times_s.push(limit_s);
    times_s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_double_up_to_the_limit() {
        assert_eq!(times_s(1.0, 8.0), [1.0, 2.0, 4.0, 8.0]);
        assert_eq!(times_s(0.5, 3.0), [0.5, 1.0, 2.0, 3.0]);
        assert_eq!(times_s(1.0, 0.5), [0.5]);
    }

    #[test]
    fn names_are_read_as_they_are_written() {
        for system in System::ALL {
            assert_eq!(System::parse(system.name()), Some(system));
            let json = serde_json::to_value(system).unwrap();
            assert_eq!(json, system.name());
        }
    }
}
