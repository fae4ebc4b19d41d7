//! What cannot be solved is said, and what is stopped is still a map.

use crate::rooms::{clear_glass, inward_box, lamp, mirror, painted, rectangle, room, scene};
use crate::runs::{METHODS, assert_valid, coarse, ends, run};
use isolux::engine::{RunState, SolveError, SolveRequest, Watch, solve};
use isolux::map::Method;
use isolux::scene::{Luminaire, Material, Scene};
use std::time::Duration;

fn box_of(material: Material, luminaires: Vec<Luminaire>) -> Scene {
    scene(inward_box([0.0; 3], [1.0; 3], 0), vec![material], luminaires)
}

fn refusal(scene: &Scene, request: &SolveRequest) -> SolveError {
    run(scene, request, 1).expect_err("it cannot be solved")
}

#[test]
fn scenes_that_cannot_be_solved_are_refused() {
    let light = || vec![lamp([0.5; 3], 10.0)];
    for method in METHODS {
        let request = coarse(method, 150);
        let dark = box_of(painted(0.5), vec![]);
        assert_eq!(refusal(&dark, &request), SolveError::NoLight);
        let off = box_of(painted(0.5), vec![lamp([0.5; 3], 0.0)]);
        assert_eq!(refusal(&off, &request), SolveError::NoLight);
        for material in [mirror(0.9), clear_glass(1.5, true), clear_glass(1.5, false)] {
            let nothing = box_of(material, light());
            assert_eq!(refusal(&nothing, &request), SolveError::NoReceiver);
        }
        let needed = refusal(&box_of(painted(0.5), light()), &coarse(method, 3));
        assert!(matches!(needed, SolveError::Memory { needed, allowed } if needed > allowed));
    }
}

#[test]
fn other_runs_are_not_resumed() {
    let scene = room();
    let request = coarse(Method::Hybrid, 150);
    let state = run(&scene, &request, 2).expect("a map").state;
    let resume = |request: &SolveRequest, state: &RunState| {
        solve(&scene, request, Some(state), &mut |_| Watch::Stop)
    };
    let other_seed = SolveRequest { seed: 2, ..request.clone() };
    let found = resume(&other_seed, &state);
    assert_eq!(found.map(|s| s.map), Err(SolveError::OtherRun("the seed")));
    let mut other_build = state.clone();
    other_build.identity.build = "another".to_owned();
    let found = resume(&request, &other_build);
    assert_eq!(found.map(|s| s.map), Err(SolveError::OtherRun("the build of isolux")));
    let mut short = state.clone();
    short.receivers.pop();
    assert!(resume(&request, &short).is_err());
    assert!(resume(&request, &state).is_ok());
}

#[test]
fn a_run_stopped_at_once_is_a_map() {
    let scene = room();
    for method in METHODS {
        // Stopped at the first word, from the pilot; after one increment; after two; by the clock.
        let request = SolveRequest { method, ..SolveRequest::default() };
        let mut calls = 0;
        let first = solve(&scene, &request, None, &mut |_| {
            calls += 1;
            Watch::Stop
        });
        assert!(calls <= 2, "asked again after saying stop");
        let late = SolveRequest { time_limit: Some(Duration::ZERO), ..request };
        let coarse = coarse(method, 150);
        for (name, solution) in [
            ("at the first word", first),
            ("after one increment", run(&scene, &coarse, 1)),
            ("after two increments", run(&scene, &coarse, 2)),
            ("by the clock", solve(&scene, &late, None, &mut |_| Watch::Continue)),
        ] {
            let map = solution.expect(name).map;
            assert_valid(name, &map);
            assert!(map.provenance.increments >= 1 && !map.provenance.complete, "{name}");
            // Check points judge a map by shots; a spread of replicates takes some.
            let is_judged = map.provenance.accuracy.is_some();
            assert!(!is_judged || method == Method::Radiosity, "{name}: believed too soon");
            let lit = map.values.iter().flatten().filter(|v| v.illuminance_lx() > 0.0).count();
            assert!(lit > map.values.len() / 2, "{name}, {method:?}: {lit} are lit");
        }
    }
}

#[test]
fn one_increment_has_no_finite_error() {
    let map = run(&room(), &coarse(Method::Hybrid, 150), 1).expect("a map").map;
    assert!(map.values.iter().flatten().all(|v| v.standard_error_lx == f64::INFINITY));
}

#[test]
fn runs_that_reach_their_accuracy_end_by_themselves() {
    let scene = room();
    let request = SolveRequest { accuracy: Some(0.05), ..coarse(Method::Hybrid, 400) };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).expect("a map").map;
    assert!(map.provenance.complete);
    assert!(map.provenance.accuracy.is_some_and(|a| a.reached <= 0.05));
}

/// Runs to their end; `None` if that does not come.
fn increments_to_the_end(scene: Scene, method: Method) -> Option<u64> {
    ends(move || {
        let request = SolveRequest { accuracy: Some(0.05), ..coarse(method, 150) };
        // Far more than the receivers of these scenes ask for.
        run(&scene, &request, 2000).expect("a map").map.provenance.increments
    })
}

#[test]

fn where_no_light_arrives_runs_end() {
    // A lamp below a floor that has only an upper side, and one shut in a box of black backs.
    let floor = || rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0);
    let below = || scene(vec![floor()], vec![painted(0.5)], vec![lamp([0.5, 0.5, -1.0], 100.0)]);
    for method in METHODS {
        let increments = increments_to_the_end(below(), method);
        assert!(increments.is_some_and(|n| n < 100), "{method:?}: {increments:?} increments");
    }
}
