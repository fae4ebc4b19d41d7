//! Runs in parts: the same map, however increments are made and merged.

use super::errors::room;
use crate::engine::{
    MergeError, PilotState, Progress, RunPart, SoFar, SolveError, SolveRequest, Watch, make_pilot,
    solve, solve_elsewhere, solve_merged, with_parts,
};
use crate::map::Method;
use crate::scene::Scene;
use proptest::prelude::*;
use std::ops::Range;
use std::sync::{Arc, LazyLock};

fn go_on(_: &Progress, _: &SoFar<'_>) -> Watch {
    Watch::Continue
}

fn request(method: Method) -> SolveRequest {
    SolveRequest { method, accuracy: Some(0.05), mesh_accuracy: 0.3, ..SolveRequest::default() }
}

fn pilot(scene: &Scene, request: &SolveRequest) -> PilotState {
    make_pilot(scene, request, &mut go_on).unwrap().unwrap()
}

/// The parts of some ranges, each made by itself.
fn parts(scene: &Scene, request: &SolveRequest, ranges: &[Range<u64>]) -> Vec<RunPart> {
    let pilot = pilot(scene, request);
    let make = |range: &Range<u64>| {
        let range = range.clone();
        with_parts(scene, request, &pilot, |maker| maker.make(range, &mut go_on))
    };
    ranges.iter().map(|range| make(range).unwrap()).collect()
}

fn merged(parts: impl IntoIterator<Item = RunPart>) -> RunPart {
    let mut parts = parts.into_iter();
    let mut all = parts.next().unwrap();
    parts.for_each(|part| all.merge(part).unwrap());
    all
}

#[test]
fn parts_merge_to_the_map_of_one_run() {
    let scene = room();
    for method in [Method::Hybrid, Method::Forward, Method::Cache] {
        let request = request(method);
        let whole = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap();
        let count = whole.map.provenance.increments;
        assert!(count > 6, "{method:?}: {count}");
        let parts = parts(&scene, &request, &[3..count - 1, 0..3, count - 1..count]);
        let part = merged(parts);
        assert_eq!(part.complete_until(), Some(count));
        let pilot = pilot(&scene, &request);
        for pilot in [None, Some(&pilot)] {
            let solution = solve_merged(&scene, &request, pilot, &part, &mut go_on).unwrap();
            assert_eq!(solution.map, whole.map, "{method:?}");
        }
    }
}

#[test]
fn increments_from_elsewhere_give_the_map_of_one_run() {
    let scene = room();
    let request = request(Method::Hybrid);
    let whole = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap();
    let mut made = Vec::new();
    let mut elsewhere = |pilot: &PilotState, index: u64| {
        made.push(index);
        with_parts(&scene, &request, pilot, |maker| maker.make(index..index + 1, &mut go_on))
            .map(Some)
    };
    let solution = solve_elsewhere(&scene, &request, None, &mut elsewhere, &mut go_on).unwrap();
    assert_eq!(solution.map, whole.map);
    assert_eq!(made, (0..whole.map.provenance.increments).collect::<Vec<_>>());
}

const COUNT: u64 = 12;

/// A part for each of the first increments.
static SINGLE: LazyLock<Vec<RunPart>> = LazyLock::new(|| {
    let ranges: Vec<Range<u64>> = (0..COUNT).map(|k| k..k + 1).collect();
    parts(&room(), &request(Method::Hybrid), &ranges)
});

proptest! {
    #[test]
    fn neither_order_nor_grouping_of_parts_matters(
        order in Just((0..COUNT as usize).collect::<Vec<_>>()).prop_shuffle(),
        cuts in prop::collection::vec(any::<bool>(), COUNT as usize),
    ) {
        let whole = merged(SINGLE.iter().cloned());
        // Groups of parts in a random order, each merged by itself.
        let mut groups: Vec<Vec<RunPart>> = vec![Vec::new()];
        for (k, is_cut) in order.into_iter().zip(cuts) {
            groups.last_mut().unwrap().push(SINGLE[k].clone());
            if is_cut {
                groups.push(Vec::new());
            }
        }
        let groups = groups.into_iter().filter(|group| !group.is_empty()).map(merged);
        prop_assert_eq!(merged(groups), whole);
    }
}

#[test]
fn ranges_made_at_once_are_sums_of_single_increments() {
    let (scene, request) = (room(), request(Method::Hybrid));
    for range in [0..5, 2..9, 5..COUNT] {
        let at_once = parts(&scene, &request, std::slice::from_ref(&range)).remove(0);
        let single = SINGLE[range.start as usize..range.end as usize].iter().cloned();
        assert_eq!(at_once, merged(single), "{range:?}");
        assert!(at_once.is_sound());
    }
}

#[test]
fn parts_that_do_not_belong_together_are_refused() {
    let (scene, wanted) = (room(), request(Method::Hybrid));
    let mut part = SINGLE[3].clone();
    assert_eq!(part.merge(SINGLE[3].clone()), Err(MergeError::Overlap(3..4)));
    let mut other = SINGLE[4].clone();
    other.identity.seed = 2;
    assert_eq!(part.merge(other), Err(MergeError::OtherRun("the seed")));
    let mut longer = SINGLE[4].clone();
    longer.segments[0].receivers.pop();
    assert_eq!(part.merge(longer), Err(MergeError::OtherRun("the number of receivers")));
    let error = |part: &RunPart, request: &SolveRequest| {
        solve_merged(&scene, request, None, part, &mut go_on).unwrap_err()
    };
    assert_eq!(error(&part, &wanted), SolveError::Missing(0..3));
    assert_eq!(
        error(&merged([0, 1, 3].map(|k| SINGLE[k].clone())), &wanted),
        SolveError::Missing(2..3)
    );
    let finer = SolveRequest { accuracy: Some(0.01), ..wanted.clone() };
    assert_eq!(error(&part, &finer), SolveError::OtherRun("the accuracy"));
    let radiosity = request(Method::Radiosity);
    assert_eq!(make_pilot(&scene, &radiosity, &mut go_on).unwrap_err(), SolveError::Indivisible);
}

#[test]
fn pilots_without_errors_of_elements_are_refused() {
    let (scene, request) = (room(), request(Method::Hybrid));
    let mut spoilt = pilot(&scene, &request);
    let made = |pilot: &PilotState| {
        with_parts(&scene, &request, pilot, |maker| maker.make(0..1, &mut go_on)).map(drop)
    };
    assert_eq!(made(&spoilt), Ok(()));
    Arc::get_mut(&mut spoilt.result.errors).unwrap().of_elements[0].error = f64::NAN;
    assert_eq!(made(&spoilt), Err(SolveError::Unsound("the saved pilot")));
    Arc::get_mut(&mut spoilt.result.errors).unwrap().of_elements.clear();
    assert_eq!(made(&spoilt), Err(SolveError::Unsound("the saved pilot")));
}
