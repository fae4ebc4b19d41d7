//! Kinds of skies by name.

use crate::scene_toml::context::Context;
use crate::scene_toml::sky_record::SkyRecord;
use crate::scene_toml::spans::Span;

/// What a sky is computed from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A type of the CIE standard general sky, 1 to 16.
    Cie(u8),
    Formula,
    Perez,
    Weather,
    Picture,
}

/// The traditional overcast sky, three times as bright in the zenith as at the horizon: type 16 of CIE S 011.
pub(super) const TRADITIONAL: u8 = 16;

const KINDS: &str = "write \"overcast\", \"clear\", \"intermediate\", \"uniform\", \"cie 1\" to \"cie 16\", \"perez\", \"weather\", \
                     \"picture\" or \"formula\"";

/// Keys of skies whose form is known and whose brightness is given.
const BRIGHTNESS: [&str; 5] =
    ["horizontal_lx", "zenith_cd_m2", "sun", "place", "ground_reflectance"];

impl Kind {
    /// The kind that is named or, without a name, that a key is of; `None` after a problem.
    pub(super) fn of(record: &SkyRecord, at: &Span, context: &mut Context) -> Option<Self> {
        let Some(name) = &record.kind else {
            let implied = implied(record);
            if implied.is_none() {
                context.problem(at, "the sky has no `type`", KINDS);
            }
            return implied;
        };
        let known = named(name.get_ref());
        if known.is_none() {
            let shown: String = name.get_ref().chars().take(60).collect();
            context.problem(&name.span(), format!("there is no sky `{shown}`"), KINDS);
        }
        known
    }

    /// Keys among [`SkyRecord::special_keys`] that it is asked for.
    fn keys(self) -> Vec<&'static str> {
        match self {
            Self::Cie(_) => BRIGHTNESS.to_vec(),
            Self::Formula => [&BRIGHTNESS[..], &["gradation", "indicatrix"]].concat(),
            Self::Perez => vec![
                "sun",
                "place",
                "direct_normal_w_m2",
                "diffuse_horizontal_w_m2",
                "dew_point_c",
                "ground_reflectance",
            ],
            Self::Weather => vec!["weather", "ground_reflectance"],
            Self::Picture => {
                vec!["picture", "luminance_factor", "horizontal_lx", "sun", "place"]
            }
        }
    }

    /// Reports keys that say nothing of this kind.
    pub(super) fn refuse_others(self, record: &SkyRecord, context: &mut Context) {
        let keys = self.keys();
        for (key, span) in record.special_keys() {
            if let Some(span) = span.filter(|_| !keys.contains(&key)) {
                let what = format!("`{key}` of a sky of this type");
                context.problem(&span, what, format!("remove it; give {}", list(&keys)));
            }
        }
    }
}

fn list(keys: &[&str]) -> String {
    keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ")
}

fn named(name: &str) -> Option<Kind> {
    Some(match name {
        "overcast" => Kind::Cie(1),
        "uniform" => Kind::Cie(5),
        "intermediate" => Kind::Cie(7),
        "clear" => Kind::Cie(12),
        "formula" => Kind::Formula,
        "perez" => Kind::Perez,
        "weather" => Kind::Weather,
        "picture" => Kind::Picture,
        _ => {
            let number = name.strip_prefix("cie")?.trim_start().parse().ok()?;
            (1..=TRADITIONAL).contains(&number).then_some(Kind::Cie(number))?
        }
    })
}

fn implied(record: &SkyRecord) -> Option<Kind> {
    if record.weather.is_some() {
        Some(Kind::Weather)
    } else if record.picture.is_some() {
        Some(Kind::Picture)
    } else if record.diffuse_horizontal_w_m2.is_some() {
        Some(Kind::Perez)
    } else {
        None
    }
}
