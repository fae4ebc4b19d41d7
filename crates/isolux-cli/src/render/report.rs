//! What `render` tells of the views it has drawn.

use super::outputs::Output;
use super::refined::NoiseReport;
use crate::cached_view::CacheUse;
use crate::console::facts;
use crate::quantity::show_share;
use crate::shown::name;
use crate::trouble::Trouble;
use isolux_view::Gathered;
use serde::Serialize;

/// What `render --json` prints: of one view the view, of several a list.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Report {
    One(Box<ViewReport>),
    Several {
        views: Vec<ViewReport>,
        /// Why there is no picture of other cameras.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        problems: Vec<Trouble>,
    },
}

/// A view that has been drawn.
#[derive(Serialize)]
pub(super) struct ViewReport {
    /// The first file.
    pub(super) picture: String,
    /// All files.
    pub(super) files: Vec<String>,
    pub(super) camera: String,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) profile: String,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub(super) indirect: Option<Indirect>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub(super) cache: Option<CacheUse>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub(super) noise: Option<NoiseReport>,
}

/// Where the indirect light of a view from a map comes from, by places of surfaces.
#[derive(Serialize)]
pub(super) struct Indirect {
    places_interpolated: usize,
    places_gathered: usize,
    places_continued: usize,
}

impl Report {
    /// The views that are drawn, and why others are not.
    pub(super) fn of(mut views: Vec<ViewReport>, problems: Vec<Trouble>) -> Self {
        match views.pop() {
            Some(one) if views.is_empty() && problems.is_empty() => Self::One(Box::new(one)),
            last => {
                views.extend(last);
                Self::Several { views, problems }
            }
        }
    }

    pub(super) fn text(&self) -> String {
        match self {
            Self::One(view) => view.text(),
            Self::Several { views, .. } => {
                views.iter().map(ViewReport::text).collect::<Vec<String>>().join("\n")
            }
        }
    }
}

/// Names of files, as given.
pub(super) fn files(outputs: &[Output]) -> Vec<String> {
    outputs.iter().map(|output| output.path.path().display().to_string()).collect()
}

impl ViewReport {
    fn text(&self) -> String {
        let mut lines = vec![
            ("picture", self.files.join(", ")),
            ("camera", name(&self.camera)),
            ("size", format!("{} x {}", self.width, self.height)),
            ("profile", name(&self.profile)),
        ];
        lines.extend(self.indirect.iter().map(Indirect::fact));
        lines.extend(self.noise.iter().map(NoiseReport::fact));
        lines.extend(self.cache.iter().flat_map(CacheUse::facts));
        facts(&lines)
    }
}

impl Indirect {
    pub(super) fn of(found: Gathered) -> Self {
        let Gathered { interpolated, gathered, continued } = found;
        Self {
            places_interpolated: interpolated,
            places_gathered: gathered,
            places_continued: continued,
        }
    }

    /// For people.
    fn fact(&self) -> (&'static str, String) {
        let all = self.places_interpolated + self.places_gathered + self.places_continued;
        let share = |part: usize| show_share(part as f64 / all.max(1) as f64);
        let text = format!(
            "interpolated in {} of what is seen, gathered in {}, continued from that in {}",
            share(self.places_interpolated),
            share(self.places_gathered),
            share(self.places_continued)
        );
        ("indirect light", text)
    }
}
