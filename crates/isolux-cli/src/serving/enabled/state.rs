//! The state of a run, as `web/src/wire.ts` has it.

use super::world::Versions;
use crate::request::method_name;
use isolux::engine::{Prediction, Progress, Stage};
use isolux::map::{Audit, IlluminationMap, Method};
use isolux_serve::Point;
use serde::Serialize;

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Phase {
    Starting,
    Elements,
    Increments,
    Done,
    Stopped,
}

/// The state that viewers are told.
#[derive(Clone, Debug, Serialize)]
pub(super) struct State {
    number: u64,
    pub(super) phase: Phase,
    pub(super) paused: bool,
    method: &'static str,
    elapsed_s: f64,
    increments: u64,
    rays: u64,
    rays_per_s: f64,
    receivers: u64,
    error: Option<f64>,
    error_statistical: Option<f64>,
    error_elements: Option<f64>,
    pub(super) target: Option<f64>,
    filtered_share: Option<f64>,
    unshot: Option<f64>,
    prediction: Option<Foreseen>,
    audit: Option<Audited>,
    mesh: u64,
    light: u64,
    pub(super) saved: Option<String>,
    pub(super) message: Option<String>,
    /// The time of runs before this one.
    #[serde(skip)]
    before_s: f64,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct Foreseen {
    finish_s: f64,
    earliest_s: f64,
    latest_s: f64,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct Audited {
    error: f64,
    low: f64,
    high: f64,
    told: f64,
    places: u64,
    contradicts: bool,
}

impl State {
    /// Before anything is known, or where nothing is under way.
    pub(super) fn new(method: Method, phase: Phase) -> Self {
        Self {
            number: 0,
            phase,
            paused: false,
            method: method_name(method),
            elapsed_s: 0.0,
            increments: 0,
            rays: 0,
            rays_per_s: 0.0,
            receivers: 0,
            error: None,
            error_statistical: None,
            error_elements: None,
            target: None,
            filtered_share: None,
            unshot: None,
            prediction: None,
            audit: None,
            mesh: 0,
            light: 0,
            saved: None,
            message: None,
            before_s: 0.0,
        }
    }

    /// The same with the number and the time of another one.
    pub(super) fn after(self, before: &Self) -> Self {
        let &Self { number, paused, elapsed_s, .. } = before;
        Self { number, paused, elapsed_s, before_s: elapsed_s, ..self }
    }

    /// Takes what a run says of itself.
    pub(super) fn learn(&mut self, progress: &Progress) {
        self.phase = match progress.stage {
            Stage::Pilot => Phase::Elements,
            Stage::Increments => Phase::Increments,
        };
        self.elapsed_s = self.before_s + progress.elapsed_s;
        self.increments = progress.increments;
        self.rays = progress.rays;
        self.rays_per_s = progress.rays_per_s();
        self.receivers = progress.receivers;
        self.error = progress.accuracy.map(|accuracy| accuracy.reached);
        self.error_statistical = progress.accuracy.map(|accuracy| accuracy.statistical);
        self.error_elements = progress.accuracy.map(|accuracy| accuracy.of_elements());
        self.target = progress.target;
        self.unshot = progress.unshot;
        let before_s = self.before_s;
        let foreseen = |p: Prediction| Foreseen {
            finish_s: before_s + p.finish_s,
            earliest_s: before_s + p.earliest_s,
            latest_s: before_s + p.latest_s,
        };
        self.prediction = progress.prediction.map(foreseen);
    }

    /// Takes what a map says of itself.
    pub(super) fn learn_of_map(&mut self, map: &IlluminationMap) {
        let from = &map.provenance;
        self.filtered_share = from.filter.map(|filter| filter.share);
        let audited = |audit: &Audit| Audited {
            error: audit.error.value,
            low: audit.error.low,
            high: audit.error.high,
            told: audit.told,
            places: audit.places,
            contradicts: audit.contradicts,
        };
        self.audit = from.audit.as_ref().map(audited);
        self.error = from.accuracy.map(|accuracy| accuracy.reached).or(self.error);
        self.increments = from.increments;
        self.receivers = map.values.len() as u64;
    }

    /// What can be fetched.
    pub(super) fn offer(&mut self, versions: Versions) {
        (self.mesh, self.light) = (versions.mesh, versions.light);
    }

    /// An error and when it was told.
    pub(super) fn point(&self) -> Option<Point> {
        self.error.map(|error| Point { elapsed_s: self.elapsed_s, error })
    }

    /// The next state as JSON.
    pub(super) fn next_json(&mut self) -> String {
        self.number += 1;
        // Numbers, strings and truths alone: what is not finite becomes null.
        serde_json::to_string(self).unwrap_or_default()
    }
}
