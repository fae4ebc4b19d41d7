//! Readings against expectations, and what chance allows.
//!
//! With `n` replicates the error over its estimate follows Student's distribution with `n - 1` degrees
//! of freedom, so the number of outliers among independent readings is binomial, and so many are
//! accepted as chance exceeds only once in ten thousand rows; none may be farther off than the farthest of
//! all readings would be as seldom. Readings of one map share part of their noise; that spreads the
//! number of outliers, which is why calibration is judged over many seeds.

use super::allowance::Allowance;
use super::row::{Reading, Verdict};
use crate::expectation::Expectation;
use crate::statistics::accepted_outliers;
use crate::tolerance::SIGNIFICANCE;
use isolux::engine::MapReader;
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::Scene;

/// What was counted in one map.
pub(super) struct Count {
    pub(super) readings: u64,
    pub(super) statistical: u64,
    pub(super) outliers: u64,
    pub(super) accepted_outliers: u64,
    pub(super) outside_interval: u64,
    pub(super) worst: Option<Reading>,
    pub(super) verdict: Verdict,
}

/// Compares a map with all that is expected of it.
pub(super) fn count(scene: &Scene, map: &IlluminationMap, expected: &[Expectation]) -> Count {
    let allowance = Allowance::of(map);
    let reader = MapReader::new(scene, map);
    let found: Vec<Option<Reading>> =
        expected.iter().map(|e| Some(allowance.reading(e, &by_replicates(&reader, e)?))).collect();
    let readings = || found.iter().flatten();
    let statistical = || readings().filter(|r| r.is_statistical());
    let trials = statistical().count() as u64;
    let chance = statistical().map(Reading::chance_to_be_off).fold(0.0, f64::max);
    let mut count = Count {
        readings: readings().count() as u64,
        statistical: trials,
        outliers: statistical().filter(|r| r.is_off()).count() as u64,
        accepted_outliers: accepted_outliers(trials, chance, SIGNIFICANCE),
        outside_interval: statistical().filter(|r| r.is_outside_interval()).count() as u64,
        worst: readings().copied().max_by(|a, b| a.ratio.total_cmp(&b.ratio)),
        verdict: Verdict::Pass,
    };
    if let Some(reason) = complaint(&count, &found, map) {
        count.verdict = Verdict::Fail { reason };
    }
    count
}

/// What the map reports of other errors is allowed by itself.
fn by_replicates(reader: &MapReader, expectation: &Expectation) -> Option<Illuminance> {
    reader.probe(expectation.at).map(|found| reader.by_replicates(found))
}

fn complaint(count: &Count, found: &[Option<Reading>], map: &IlluminationMap) -> Option<String> {
    let unknown = found.iter().filter(|r| r.is_none()).count();
    if unknown > 0 {
        return Some(format!("{unknown} of {} places have no value", found.len()));
    }
    if map.provenance.accuracy.is_none() {
        return Some("too few increments to believe the error".into());
    }
    let certain = found.iter().flatten().filter(|r| !r.is_statistical() && r.is_off()).count();
    if certain > 0 {
        return Some(format!("{certain} values without statistical error are wrong"));
    }
    let impossible = found.iter().flatten().filter(|r| r.is_impossible(count.statistical)).count();
    if impossible > 0 {
        return Some(format!("{impossible} values are farther off than chance explains"));
    }
    (count.outliers > count.accepted_outliers).then(|| {
        format!("{} outliers where chance allows {}", count.outliers, count.accepted_outliers)
    })
}
