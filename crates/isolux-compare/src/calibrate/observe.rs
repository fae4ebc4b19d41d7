//! One run, looked at in stages.

use super::places::Place;
use crate::expectation::Quantity;
use crate::statistics::student_two_sided;
use crate::tolerance::RAY_KERNEL_POSITION;
use isolux::engine::{
    AuditSettings, MapReader, Progress, SolveError, SolveRequest, Watch, audit, solve_looked_at,
};
use isolux::map::{Accuracy, Audit, Illuminance, IlluminationMap};
use isolux::scene::Scene;
use serde::Serialize;

/// Places of the audit of one run, of which there are many.
const AUDIT_PLACES: u64 = 256;

/// When a run is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// At the first error that is believed.
    FirstBelieved,
    /// At four times the increments of that.
    FourTimes,
    /// Where the run ends of itself.
    AtStop,
    /// After a number of increments fixed beforehand.
    FixedWork,
}

impl Stage {
    /// In the order of a run, mostly.
    pub const ALL: [Self; 4] =
        [Self::FirstBelieved, Self::FourTimes, Self::AtStop, Self::FixedWork];
}

/// A reading against the truth, with all that is said about its error, lx.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Measured less exact.
    pub error_lx: f64,
    /// Standard error, from replicates.
    pub standard_error_lx: f64,
    /// Independent values behind it, less one.
    pub degrees_of_freedom: f64,
    /// What the reading counts of other errors that the map reports.
    pub rest_lx: f64,
    /// How far the answer itself may be off.
    pub bound_lx: f64,
}

impl Interval {
    /// Whether nothing is said to be uncertain but the answer.
    pub fn is_exact(&self) -> bool {
        self.standard_error_lx == 0.0 && self.rest_lx == 0.0
    }

    /// Whether the interval by noise alone holds the truth.
    pub fn noise_holds(&self, confidence: f64) -> bool {
        let alone = Self { rest_lx: 0.0, ..*self };
        alone.holds(confidence)
    }

    /// Whether the interval by noise and all other errors reported holds the truth. The degrees of
    /// freedom are those of Welch and Satterthwaite, the other errors being known.
    pub fn holds(&self, confidence: f64) -> bool {
        let noise = self.standard_error_lx * self.standard_error_lx;
        let variance = noise + self.rest_lx * self.rest_lx;
        if variance == 0.0 {
            return self.error_lx.abs() <= self.bound_lx;
        }
        let freedom = self.degrees_of_freedom * (variance / noise) * (variance / noise);
        let beyond_lx = (self.error_lx.abs() - self.bound_lx).max(0.0);
        // Beyond a million the distribution is normal to six digits.
        let chance = student_two_sided(beyond_lx / variance.sqrt(), freedom.min(1e6));
        chance >= 1.0 - confidence
    }
}

/// A map at a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Replicates so far.
    pub increments: u64,
    /// What the map says of itself.
    pub accuracy: Accuracy,
    /// One a place; `None` where the map has no value.
    pub readings: Vec<Option<Interval>>,
    /// Root mean square of the exact light at the places, lx.
    pub rms_lx: f64,
    /// What an independent test finds of the map where its run ends.
    pub audit: Option<Audit>,
}

impl Observation {
    /// Root mean square of the errors over that of the light.
    pub fn true_error(&self) -> f64 {
        let known = || self.readings.iter().flatten();
        let squares: f64 = known().map(|r| r.error_lx * r.error_lx).sum();
        (squares / known().count().max(1) as f64).sqrt() / self.rms_lx
    }
}

/// One seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Observed {
    /// Of the run.
    pub seed: u64,
    /// At the stages it came to.
    pub stages: Vec<(Stage, Observation)>,
    /// Whether it came to the accuracy asked for.
    pub reached: bool,
}

impl Observed {
    /// The map at a stage.
    pub fn at(&self, stage: Stage) -> Option<&Observation> {
        self.stages.iter().find(|(s, _)| *s == stage).map(|(_, observation)| observation)
    }

    fn has(&self, stage: Stage) -> bool {
        self.at(stage).is_some()
    }

    fn set(&mut self, stage: Stage, observation: Observation) {
        self.stages.retain(|(s, _)| *s != stage);
        self.stages.push((stage, observation));
    }
}

/// Runs a scene, and on past its end until every stage was seen. `fixed_work` are the increments of
/// [`Stage::FixedWork`], none to leave that out.
pub(super) fn observe(
    scene: &Scene,
    request: &SolveRequest,
    places: &[Place],
    fixed_work: Option<u64>,
) -> Result<Observed, SolveError> {
    let mut observed = Observed { seed: request.seed, stages: Vec::new(), reached: false };
    let mut first = None;
    solve_looked_at(scene, request, None, &mut |progress, so_far| {
        if progress.increments == 1 && !observed.has(Stage::AtStop) {
            // Finer elements: what was seen of the coarser ones is no stage of this run.
            observed.stages.retain(|(stage, _)| *stage == Stage::FirstBelieved);
        }
        if progress.accuracy.is_some() && first.is_none() {
            first = Some(progress.increments);
        }
        let due = due(&observed, progress, first, fixed_work);
        if let (false, Some(map)) = (due.is_empty(), due.first().and_then(|_| so_far.map())) {
            let ends = due.contains(&Stage::AtStop);
            observed.reached |= ends && map.provenance.complete;
            if let Some(mut observation) = look(scene, &map, places) {
                observation.audit = ends.then(|| audited(scene, &map)).flatten();
                due.into_iter().for_each(|stage| observed.set(stage, observation.clone()));
            }
        }
        answer(&observed, fixed_work)
    })?;
    Ok(observed)
}

/// The stages that a run is at.
fn due(
    observed: &Observed,
    progress: &Progress,
    first: Option<u64>,
    fixed_work: Option<u64>,
) -> Vec<Stage> {
    let count = progress.increments;
    let is_at = |stage: &Stage| match stage {
        Stage::FirstBelieved => first == Some(count),
        Stage::FourTimes => first.is_some_and(|first| count == 4 * first),
        Stage::AtStop => progress.ends,
        Stage::FixedWork => fixed_work == Some(count),
    };
    Stage::ALL.into_iter().filter(|stage| !observed.has(*stage)).filter(is_at).collect()
}

fn answer(observed: &Observed, fixed_work: Option<u64>) -> Watch {
    if !observed.has(Stage::AtStop) {
        return Watch::Continue;
    }
    let fixed = fixed_work.is_none() || observed.has(Stage::FixedWork);
    if observed.has(Stage::FourTimes) && fixed { Watch::Stop } else { Watch::Insist }
}

/// Reads a map; nothing while its error is not believed.
fn look(scene: &Scene, map: &IlluminationMap, places: &[Place]) -> Option<Observation> {
    let accuracy = map.provenance.accuracy?;
    let reader = MapReader::new(scene, map);
    let rms_lx = rms_lx(places.iter().map(|p| p.total_lx));
    let freedom = map.provenance.increments.saturating_sub(1).max(1) as f64;
    let reading = |place: &Place| {
        let found = reader.probe(place.at)?;
        let whole_lx = said_lx(place.quantity, &found);
        let standard_error_lx = said_lx(place.quantity, &reader.by_replicates(found));
        let rest_lx = (whole_lx * whole_lx - standard_error_lx * standard_error_lx).max(0.0).sqrt();
        Some(Interval {
            error_lx: value_lx(place.quantity, &found) - place.expected_lx,
            standard_error_lx,
            degrees_of_freedom: freedom,
            rest_lx,
            bound_lx: place.bound_lx + RAY_KERNEL_POSITION * place.total_lx,
        })
    };
    let readings = places.iter().map(reading).collect();
    Some(Observation {
        increments: map.provenance.increments,
        accuracy,
        readings,
        rms_lx,
        audit: None,
    })
}

fn audited(scene: &Scene, map: &IlluminationMap) -> Option<Audit> {
    let seed = map.provenance.seed;
    audit(scene, map, &AuditSettings { places: AUDIT_PLACES, seed, ..AuditSettings::default() })
}

fn value_lx(quantity: Quantity, found: &Illuminance) -> f64 {
    match quantity {
        Quantity::Total => found.total_lx(),
        Quantity::Direct => found.direct_lx,
        Quantity::Indirect => found.indirect_lx,
    }
    .luminance()
}

/// The standard error that a reading says: of direct light, what that of all of it has beside the rest.
fn said_lx(quantity: Quantity, found: &Illuminance) -> f64 {
    let (all, indirect) = (found.standard_error_lx, found.indirect_standard_error_lx);
    match quantity {
        Quantity::Total => all,
        Quantity::Direct => (all * all - indirect * indirect).max(0.0).sqrt(),
        Quantity::Indirect => indirect,
    }
}

fn rms_lx(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1) as f64;
    (values.map(|lx| lx * lx).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const INTERVAL: Interval = Interval {
        error_lx: 0.0,
        standard_error_lx: 3.0,
        degrees_of_freedom: 1e9,
        rest_lx: 4.0,
        bound_lx: 1.0,
    };

    #[test]
    fn intervals_add_noise_and_rest_in_squares_and_bounds_as_they_are() {
        // 1.96 times 3 or 5, and one more.
        let with = |error_lx| Interval { error_lx, ..INTERVAL };
        assert!(with(-6.8).noise_holds(0.95) && !with(-6.9).noise_holds(0.95));
        assert!(with(10.7).holds(0.95) && !with(10.9).holds(0.95));
    }

    #[test]
    fn few_replicates_make_wide_intervals_and_none_only_the_bound() {
        let few = Interval { degrees_of_freedom: 2.0, rest_lx: 0.0, error_lx: 13.5, ..INTERVAL };
        // Student's quantile of two degrees is 4.303.
        assert!(few.holds(0.95) && !Interval { error_lx: 14.0, ..few }.holds(0.95));
        let exact = Interval { standard_error_lx: 0.0, error_lx: 0.9, ..few };
        assert!(exact.holds(0.95) && !Interval { error_lx: 1.1, ..exact }.holds(0.95));
    }

    #[test]
    fn readings_are_judged_by_the_error_of_what_is_read() {
        let noisy = Illuminance {
            standard_error_lx: 5.0,
            indirect_standard_error_lx: 3.0,
            ..Illuminance::NOTHING
        };
        assert_eq!(said_lx(Quantity::Total, &noisy), 5.0);
        assert_eq!(said_lx(Quantity::Direct, &noisy), 4.0);
        assert_eq!(said_lx(Quantity::Indirect, &noisy), 3.0);
    }
}
