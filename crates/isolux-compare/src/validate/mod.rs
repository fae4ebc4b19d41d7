//! Cases through engines, and what comes of it, as plain values.

mod allowance;
mod calibration;
mod judge;
mod row;

pub use calibration::Calibration;
pub use row::{Reading, ValidateRow, Verdict};

use crate::expectation::Case;
use isolux::engine::{Progress, Solution, SolveError, SolveRequest, Watch, solve};
use isolux::map::Method;
use isolux::scene::{Scene, SceneProblem};
use serde::Serialize;
use std::time::Duration;

/// How hard engines try.
#[derive(Clone, Debug, PartialEq)]
pub struct ValidateSettings {
    /// Accuracy asked of every run, a fraction.
    pub accuracy: f64,
    /// Longest run.
    pub time_limit: Duration,
    /// Memory allowed, bytes.
    pub max_memory_bytes: u64,
}

impl Default for ValidateSettings {
    /// Half a per cent, at most half a minute a run.
    fn default() -> Self {
        let max_memory_bytes = SolveRequest::default().max_memory_bytes;
        Self { accuracy: 0.005, time_limit: Duration::from_secs(30), max_memory_bytes }
    }
}

/// All rows, and how well error bars keep their promise.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ValidateTable {
    /// Cases in the outer, methods in the middle, seeds in the inner loop.
    pub rows: Vec<ValidateRow>,
    /// One a method.
    pub calibrations: Vec<Calibration>,
}

/// Why there is no row.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ValidateError {
    /// The case is not a scene: a fault of this crate.
    #[error("case `{case}` is not a scene: {problem}")]
    Scene {
        /// Its name.
        case: &'static str,
        /// The first problem.
        problem: SceneProblem,
    },
    /// The engine gave no map.
    #[error("case `{case}`: {error}")]
    Solve {
        /// Its name.
        case: &'static str,
        /// Why.
        error: SolveError,
    },
}

/// The scene of a case.
pub(crate) fn scene_of(case: &Case) -> Result<Scene, ValidateError> {
    Scene::assemble((case.parts)()).map_err(|mut problems| ValidateError::Scene {
        case: case.name,
        problem: problems.swap_remove(0),
    })
}

/// Runs a case through an engine, unless it is over before the run ends: then there is no row, as a run cut short shows
/// nothing of the engine.
pub fn validate(
    case: &Case,
    method: Method,
    seed: u64,
    settings: &ValidateSettings,
    is_over: &dyn Fn() -> bool,
) -> Result<Option<ValidateRow>, ValidateError> {
    let scene = scene_of(case)?;
    let request = SolveRequest {
        method,
        seed,
        accuracy: Some(settings.accuracy),
        time_limit: Some(settings.time_limit),
        max_memory_bytes: settings.max_memory_bytes,
        ..SolveRequest::default()
    };
    let mut was_stopped = false;
    let watch = &mut |_: &Progress| {
        was_stopped = was_stopped || is_over();
        if was_stopped { Watch::Stop } else { Watch::Continue }
    };
    let Solution { map, time_s, .. } = solve(&scene, &request, None, watch)
        .map_err(|error| ValidateError::Solve { case: case.name, error })?;
    if was_stopped {
        return Ok(None);
    }
    let count = judge::count(&scene, &map, &(case.expectations)());
    Ok(Some(ValidateRow {
        case: case.name,
        method,
        seed,
        readings: count.readings,
        statistical: count.statistical,
        outliers: count.outliers,
        accepted_outliers: count.accepted_outliers,
        outside_interval: count.outside_interval,
        worst: count.worst,
        accuracy: map.provenance.accuracy,
        audit: map.provenance.audit.clone(),
        increments: map.provenance.increments,
        rays: map.provenance.rays,
        time_s,
        verdict: count.verdict,
    }))
}

/// Who sees every row as it comes.
pub type OnRow<'r> = dyn FnMut(&ValidateRow) + 'r;

/// Runs cases through engines from several seeds. `on_row` sees every row as it comes; `is_over` is asked after every
/// increment, and what is not done then is left out. An engine that gives no map has a failed row.
pub fn validate_all(
    cases: &[Case],
    methods: &[Method],
    seeds: &[u64],
    settings: &ValidateSettings,
    (on_row, is_over): (&mut OnRow<'_>, &dyn Fn() -> bool),
) -> ValidateTable {
    let mut rows: Vec<ValidateRow> = Vec::new();
    'all: for case in cases {
        for &method in methods {
            for &seed in seeds {
                if is_over() {
                    break 'all;
                }
                let row = validate(case, method, seed, settings, is_over)
                    .unwrap_or_else(|error| Some(failed(case.name, method, seed, &error)));
                if let Some(row) = row {
                    on_row(&row);
                    rows.push(row);
                }
            }
        }
    }
    let calibrations = methods.iter().map(|&m| Calibration::of(m, &rows)).collect();
    ValidateTable { rows, calibrations }
}

fn failed(case: &'static str, method: Method, seed: u64, error: &ValidateError) -> ValidateRow {
    ValidateRow {
        case,
        method,
        seed,
        readings: 0,
        statistical: 0,
        outliers: 0,
        accepted_outliers: 0,
        outside_interval: 0,
        worst: None,
        accuracy: None,
        audit: None,
        increments: 0,
        rays: 0,
        time_s: 0.0,
        verdict: Verdict::Fail { reason: error.to_string() },
    }
}
