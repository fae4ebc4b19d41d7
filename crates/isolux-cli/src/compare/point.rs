//! One map of a comparison.

use super::plan::{Case, Plan};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use isolux::engine::{self, AuditSettings, Progress, SolveRequest, Watch};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_compare::Readings;
use isolux_compare::metric::landed_over_emitted;
use isolux_compare::study::{Audited, Errors, Measured, Point, Prediction, Reported, System};
use std::time::{Duration, Instant};

/// A prediction is kept if so many times as much time has passed as at the one before: graphs show time in logarithms.
const LATER: f64 = 1.1;

/// One system within one time.
pub(crate) struct Asked<'a> {
    pub(crate) case: &'a Case,
    pub(crate) system: System,
    pub(crate) asked_s: f64,
    /// The accuracy that it is asked for.
    pub(crate) accuracy: f64,
}

impl Asked<'_> {
    /// The beginning of the names of its files.
    pub(crate) fn stem(&self) -> String {
        self.case.point_stem(self.system, self.asked_s)
    }

    /// Makes the map, tells what it takes and what it is like, and where it errs if right values are known; `None` if the user stops it.
    pub(crate) fn make(
        &self,
        scene: &Scene,
        plan: &Plan,
        interrupt: &Interrupt,
    ) -> Result<Option<(IlluminationMap, Point, Option<Errors>)>, Failure> {
        let about = Duration::from_secs_f64(self.asked_s);
        let request = self.system.request(self.accuracy, about, plan.seed);
        let request = request.expect("peers are asked elsewhere");
        let begun = Instant::now();
        let Some((map, predictions)) = solve(scene, &request, interrupt)? else { return Ok(None) };
        let time_s = begun.elapsed().as_secs_f64();
        let case = &self.case.name;
        let readings = Readings::of_map(case, scene, &map).transpose();
        let readings = readings.map_err(|e| Failure::bad_input(format!("{}: {e}", self.stem())))?;
        let readings = readings.as_ref();
        let point = Point {
            asked_s: self.asked_s,
            accuracy: Some(self.accuracy),
            time_s,
            rays: Some(map.provenance.rays),
            receivers: Some(map.values.len() as u64),
            landing: landed_over_emitted(scene, &map),
            reported: reported(&map),
            predictions,
            audited: audited(scene, &map, plan),
            measured: readings.and_then(Measured::of),
            ..Point::default()
        };
        Ok(Some((map, point, readings.and_then(|of| Errors::of(case, of)))))
    }
}

/// A map and when it was said to be done on the way.
pub(crate) fn solve(
    scene: &Scene,
    request: &SolveRequest,
    interrupt: &Interrupt,
) -> Result<Option<(IlluminationMap, Vec<Prediction>)>, Failure> {
    let mut predictions: Vec<Prediction> = Vec::new();
    let solved = engine::solve_looked_at(scene, request, None, &mut |progress, _| {
        let is_later = |before: &Prediction| progress.elapsed_s >= LATER * before.at_s;
        if predictions.last().is_none_or(is_later) {
            predictions.extend(prediction(progress));
        }
        if interrupt.is_requested() { Watch::Stop } else { Watch::Continue }
    });
    let map = solved.map_err(Failure::bad_input)?.map;
    Ok((!interrupt.is_requested()).then_some((map, predictions)))
}

fn prediction(progress: &Progress) -> Option<Prediction> {
    let isolux::engine::Prediction { finish_s, earliest_s, latest_s } = progress.prediction?;
    let error = progress.accuracy.map(|accuracy| accuracy.reached);
    Some(Prediction { at_s: progress.elapsed_s, error, finish_s, earliest_s, latest_s })
}

fn reported(map: &IlluminationMap) -> Reported {
    let from = &map.provenance;
    Reported {
        error: from.accuracy.map(|accuracy| accuracy.reached),
        noise: from.accuracy.map(|accuracy| accuracy.statistical),
        bare: from.accuracy.map(|accuracy| accuracy.interpolated),
        unshot: from.unshot.map(|unshot| unshot.share),
        filtered: from.filter.map(|filter| filter.share),
    }
}

/// `None` of a map that tells no error to test.
fn audited(scene: &Scene, map: &IlluminationMap, plan: &Plan) -> Option<Audited> {
    let settings =
        AuditSettings { most_rays: plan.audit_rays, seed: plan.seed, ..AuditSettings::default() };
    let audit = engine::audit(scene, map, &settings)?;
    let isolux::map::AuditedError { value: error, low, high } = audit.error;
    Some(Audited { error, low, high, contradicts: audit.contradicts })
}
