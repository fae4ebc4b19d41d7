//! One map of a comparison: made, or found where an earlier comparison has left it.

use super::folder::Folder;
use super::plan::{Case, Plan};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::map_file;
use isolux::engine::{self, AuditSettings, Progress, SolveRequest, Watch};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_compare::study::{Audited, Point, Prediction, Reported, System, measure};
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// Rays that the audit of a point may take, so that it takes no longer than a few seconds.
const AUDIT_RAYS: u64 = 1 << 19;

/// A prediction is kept if so many times as much time has passed as at the one before: graphs show time in logarithms.
const LATER: f64 = 1.1;

/// What a point was made of: one that was made otherwise is made anew.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Made {
    version: String,
    scene_hash: String,
    seed: u64,
    threads: usize,
    picture: [u32; 2],
}

#[derive(Serialize, Deserialize)]
struct Kept {
    made: Made,
    point: Point,
}

/// One system within one time.
pub(crate) struct Asked<'a> {
    pub(crate) case: &'a Case,
    pub(crate) system: System,
    pub(crate) asked_s: f64,
}

impl Asked<'_> {
    /// The beginning of the names of its files.
    pub(crate) fn stem(&self) -> String {
        format!("{}-{}-{}s", self.case.stem(), self.system.name(), self.asked_s)
    }

    fn made(&self, scene_hash: &str, plan: &Plan) -> Made {
        Made {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_hash: scene_hash.to_owned(),
            seed: plan.seed,
            threads: rayon::current_num_threads(),
            picture: plan.picture,
        }
    }

    /// The point of an earlier comparison, if it was made alike.
    pub(crate) fn found(&self, scene_hash: &str, plan: &Plan, folder: &Folder) -> Option<Point> {
        let text = std::fs::read(folder.path(&format!("maps/{}.json", self.stem()))).ok()?;
        let kept: Kept = serde_json::from_slice(&text).ok()?;
        (kept.made == self.made(scene_hash, plan)).then_some(kept.point)
    }

    /// Keeps what was made.
    pub(crate) fn keep(
        &self,
        (scene_hash, plan, folder): (&str, &Plan, &Folder),
        (scene, map): (&Scene, &IlluminationMap),
        point: &Point,
    ) -> Result<(), Failure> {
        let stem = self.stem();
        map_file::write(&folder.output(&format!("maps/{stem}.glb"), "glb")?, scene, map)?;
        let kept = Kept { made: self.made(scene_hash, plan), point: point.clone() };
        let json = serde_json::to_vec_pretty(&kept).expect("plain values always have a JSON text");
        folder.write(&format!("maps/{stem}.json"), &json)
    }

    /// Makes the map, tells what it takes and what it is like; `None` if the user stops it.
    pub(crate) fn make(
        &self,
        scene: &Scene,
        plan: &Plan,
        interrupt: &Interrupt,
    ) -> Result<Option<(IlluminationMap, Point)>, Failure> {
        let request = self.system.request(Duration::from_secs_f64(self.asked_s), plan.seed);
        let begun = Instant::now();
        let Some((map, predictions)) = solve(scene, &request, interrupt)? else { return Ok(None) };
        let time_s = begun.elapsed().as_secs_f64();
        let measured = measure(&self.case.name, scene, &map).transpose();
        let point = Point {
            asked_s: self.asked_s,
            time_s,
            rays: map.provenance.rays,
            receivers: map.values.len() as u64,
            reported: reported(&map),
            predictions,
            audited: audited(scene, &map, plan.seed),
            measured: measured.map_err(|e| Failure::bad_input(format!("{}: {e}", self.stem())))?,
            picture: None,
            from_last: None,
            from_reference: None,
        };
        Ok(Some((map, point)))
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
fn audited(scene: &Scene, map: &IlluminationMap, seed: u64) -> Option<Audited> {
    let settings = AuditSettings { most_rays: AUDIT_RAYS, seed, ..AuditSettings::default() };
    let audit = engine::audit(scene, map, &settings)?;
    let isolux::map::AuditedError { value: error, low, high } = audit.error;
    Some(Audited { error, low, high, contradicts: audit.contradicts })
}
