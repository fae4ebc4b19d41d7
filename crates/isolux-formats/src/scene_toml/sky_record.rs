//! The sky as written.

use super::quantity::{Colour, NonNegative, Number, Positive, Share, Triple};
use super::spans::{At, Span};
use serde::Deserialize;
use toml::value::Datetime;

/// `[sky]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SkyRecord {
    #[serde(rename = "type")]
    pub(super) kind: Option<At<String>>,
    pub(super) horizontal_lx: Option<At<NonNegative>>,
    pub(super) zenith_cd_m2: Option<At<NonNegative>>,
    pub(super) sun: Option<At<SunRecord>>,
    pub(super) place: Option<At<PlaceRecord>>,
    pub(super) time: Option<At<Datetime>>,
    pub(super) sun_normal_lx: Option<At<NonNegative>>,
    pub(super) direct_normal_w_m2: Option<At<NonNegative>>,
    pub(super) diffuse_horizontal_w_m2: Option<At<NonNegative>>,
    pub(super) dew_point_c: Option<At<Number>>,
    pub(super) weather: Option<At<String>>,
    pub(super) picture: Option<At<String>>,
    pub(super) luminance_factor: Option<At<Positive>>,
    pub(super) gradation: Option<At<[Number; 2]>>,
    pub(super) indicatrix: Option<At<[Number; 4]>>,
    pub(super) ground_reflectance: Option<At<Share>>,
    pub(super) north_deg: Option<At<Number>>,
    pub(super) group: Option<String>,
    pub(super) sun_group: Option<String>,
    pub(super) colour: Option<At<Colour>>,
    pub(super) cct_k: Option<At<Number>>,
    pub(super) sun_colour: Option<At<Colour>>,
    pub(super) sun_cct_k: Option<At<Number>>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SunRecord {
    /// From north by east.
    pub(super) azimuth_deg: Number,
    pub(super) elevation_deg: Number,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaceRecord {
    pub(super) latitude_deg: Number,
    pub(super) longitude_deg: Number,
}

/// `sky` of a `[[luminaire]]`: luminances alone.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LuminancesRecord {
    pub(super) gradation: Option<[Number; 2]>,
    pub(super) indicatrix: Option<[Number; 4]>,
    /// Towards it, in the frame of skies.
    pub(super) sun: Option<Triple>,
    pub(super) scale_cd_m2: Option<NonNegative>,
    pub(super) ground_cd_m2: Option<NonNegative>,
    pub(super) picture: Option<At<String>>,
    pub(super) north_deg: Option<Number>,
    /// Towards east, north and the zenith of the sky, in place of `north_deg`.
    pub(super) axes: Option<At<[Triple; 3]>>,
}

impl SkyRecord {
    /// The groups of sky and sun.
    pub(super) fn groups(&self) -> [Option<&str>; 2] {
        let group = self.group.as_deref();
        [group, self.sun_group.as_deref().or(group)]
    }

    /// Keys that say what only some kinds of skies are asked for, and where they stand.
    pub(super) fn special_keys(&self) -> Vec<(&'static str, Option<Span>)> {
        fn span<T>(value: &Option<At<T>>) -> Option<Span> {
            value.as_ref().map(At::span)
        }
        vec![
            ("horizontal_lx", span(&self.horizontal_lx)),
            ("zenith_cd_m2", span(&self.zenith_cd_m2)),
            ("sun", span(&self.sun)),
            ("place", span(&self.place)),
            ("direct_normal_w_m2", span(&self.direct_normal_w_m2)),
            ("diffuse_horizontal_w_m2", span(&self.diffuse_horizontal_w_m2)),
            ("dew_point_c", span(&self.dew_point_c)),
            ("weather", span(&self.weather)),
            ("picture", span(&self.picture)),
            ("luminance_factor", span(&self.luminance_factor)),
            ("gradation", span(&self.gradation)),
            ("indicatrix", span(&self.indicatrix)),
            ("ground_reflectance", span(&self.ground_reflectance)),
        ]
    }
}
