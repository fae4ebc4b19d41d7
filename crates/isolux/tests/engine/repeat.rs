//! The same input gives the same bits.

use crate::rooms::{
    clear_glass, glowing, inward_box, lamp, outward_box, painted, rectangle, scene,
};
use crate::runs::{METHODS, assert_valid, coarse, go_on, run};
use isolux::engine::{
    PilotState, Progress, SoFar, Solution, SolveRequest, Stage, StopFlag, Watch, solve,
    solve_elsewhere, solve_looked_at,
};
use isolux::map::{IlluminationMap, Method};
use isolux::scene::{Finish, Gloss, Material, Scene};
use isolux::units::Rgb;
use std::time::Duration;

/// A room with some of everything: lamps, a glowing square, mirror, gloss, pane, solid glass.
fn everything() -> Scene {
    let mut shapes = inward_box([0.0; 3], [3.0, 2.0, 2.5], 0);
    shapes.push(rectangle([1.0, 0.8, 2.4], [0.0, 0.4, 0.0], [0.6, 0.0, 0.0], 1));
    shapes.push(rectangle([2.9, 0.2, 0.2], [0.0, 0.0, 1.5], [0.0, 1.5, 0.0], 2));
    shapes.extend(outward_box([0.4, 0.5, 0.0], [0.9, 1.0, 0.6], 3));
    shapes.push(rectangle([0.3, 1.6, 0.1], [1.5, 0.0, 0.0], [0.0, 0.2, 1.0], 4));
    shapes.extend(outward_box([1.5, 0.4, 0.5], [2.0, 0.9, 1.0], 5));
    let gloss = Finish {
        gloss: Some(Gloss { f0: Rgb::new(0.3, 0.2, 0.1), alpha: 0.2 }),
        ..Finish::diffuse(Rgb::new(0.2, 0.5, 0.3))
    };
    let materials = vec![
        painted(0.5),
        glowing(500.0, 0.2),
        Material::two_sided("mirror", Finish::mirror(Rgb::new(0.9, 0.8, 0.7))),
        Material::two_sided("gloss", gloss),
        clear_glass(1.5, true),
        clear_glass(1.5, false),
    ];
    scene(shapes, materials, vec![lamp([1.0, 1.2, 1.5], 100.0), lamp([2.2, 0.4, 1.9], 40.0)])
}

/// A map written out, so that zeros of either sign count as different.
fn written(map: &IlluminationMap) -> String {
    format!("{map:?}")
}

fn on_threads(threads: usize, scene: &Scene, request: &SolveRequest) -> Solution {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
    pool.install(|| run(scene, request, 9)).expect("the scene has light")
}

#[test]
fn threads_change_no_bit() {
    let scene = everything();
    for method in METHODS {
        let request = coarse(method, 250);
        let one = on_threads(1, &scene, &request);
        for threads in [1, 2, 3] {
            let again = on_threads(threads, &scene, &request);
            assert_eq!(written(&again.map), written(&one.map), "{method:?} on {threads} threads");
            assert_eq!(again.state, one.state, "{method:?} on {threads} threads");
        }
    }
}

#[test]
fn other_seeds_give_other_maps_of_the_same_light() {
    let scene = everything();
    for method in METHODS {
        let of = |seed: u64| {
            let request = SolveRequest { seed, ..coarse(method, 250) };
            run(&scene, &request, 9).expect("the scene has light").map
        };
        let (a, b) = (of(1), of(2));
        assert_eq!(a.elements, b.elements);
        let mean = |map: &IlluminationMap| {
            let values = map.values.iter().flatten();
            values.map(|v| v.illuminance_lx()).sum::<f64>() / map.values.len() as f64
        };
        assert_ne!(written(&a), written(&b));
        assert!((mean(&a) / mean(&b) - 1.0).abs() < 0.05, "{method:?}: {} {}", mean(&a), mean(&b));
    }
}

#[test]
fn a_run_stopped_and_resumed_gives_the_same_bits() {
    let scene = everything();
    for method in METHODS {
        let request = coarse(method, 250);
        let whole = run(&scene, &request, 12).expect("the scene has light");
        let part = run(&scene, &request, 5).expect("the scene has light");
        assert_eq!(part.state.increments, 5);
        let mut seen = Vec::new();
        let stop = &mut |p: &Progress| {
            let is_increment = p.stage == Stage::Increments;
            seen.extend(is_increment.then_some(p.increments));
            if is_increment && p.increments >= 12 { Watch::Stop } else { Watch::Continue }
        };
        let resumed = solve(&scene, &request, Some(&part.state), stop).expect("the same run");
        // The run may have been stopped where its increments end, which is decided before one more is added.
        assert!(seen.starts_with(&[5, 6]), "{method:?}: {seen:?}");
        assert_eq!(written(&resumed.map), written(&whole.map), "{method:?}");
    }
}

/// Whoever asks from outside does so within a step, at any moment.
#[test]
fn a_run_asked_to_stop_at_any_moment_is_a_map_and_goes_on_to_the_same_bits() {
    let scene = everything();
    for method in METHODS {
        let request = coarse(method, 250);
        let whole = run(&scene, &request, 12).expect("the scene has light");
        for delay_ms in [0, 1, 3, 10, 30, 100, 300] {
            let asked = SolveRequest { stop: StopFlag::default(), ..request.clone() };
            let stop = asked.stop.clone();
            if delay_ms == 0 {
                stop.raise();
            }
            let asking = std::thread::spawn(move || {
                std::thread::sleep(Duration::from_millis(delay_ms));
                stop.raise();
            });
            let part = run(&scene, &asked, 12).expect("the scene has light");
            asking.join().expect("it only waits");
            let name = format!("{method:?} after {delay_ms} ms");
            assert_valid(&name, &part.map);
            assert!(part.map.provenance.increments >= 1, "{name}");
            let is_told = part.map.provenance.accuracy.is_some();
            assert!(!is_told || part.state.increments > 0, "{name}: nothing is known of a pilot");
            let resumed = go_on(&scene, &request, Some(&part.state), 12).expect("the same");
            assert_eq!(written(&resumed.map), written(&whole.map), "{name}");
        }
    }
}

/// Regression: increments made elsewhere were added to a run that had no time to prepare for any, and refused.
#[test]
fn a_run_asked_to_stop_before_increments_made_elsewhere_is_a_map() {
    let scene = everything();
    let request = coarse(Method::Hybrid, 250);
    request.stop.raise();
    let mut elsewhere = |_: &PilotState, _: u64| panic!("no increment is wanted");
    let solution =
        solve_elsewhere(&scene, &request, None, &mut elsewhere, &mut |_, _| Watch::Continue);
    let map = solution.expect("the scene has light").map;
    assert_valid("of the pilot", &map);
    assert!(map.provenance.accuracy.is_none() && !map.provenance.complete);
}

/// What a run comes to in the first of several rooms and accuracies where it is not `None`. Which of them take elements
/// made anew depends on what the pilot foresees.
fn where_first_elements_are_too_coarse<T>(
    run: impl Fn(&Scene, SolveRequest) -> Option<T>,
) -> Option<T> {
    let accuracies = [1e-2, 5e-3, 3e-3, 2e-3, 1.5e-3, 1e-3];
    let rooms = [0.95, 0.9, 0.7].into_iter();
    let mut all = rooms.flat_map(|reflectance| accuracies.map(|accuracy| (reflectance, accuracy)));
    all.find_map(|(reflectance, accuracy)| {
        let room = inward_box([0.0; 3], [4.0, 5.0, 2.8], 0);
        let table = outward_box([1.0, 1.0, 0.7], [3.0, 2.0, 0.8], 0);
        let shapes = room.into_iter().chain(table).collect();
        let lamps = vec![lamp([2.0, 2.5, 2.5], 100.0)];
        let scene = scene(shapes, vec![painted(reflectance)], lamps);
        run(&scene, SolveRequest { accuracy: Some(accuracy), ..SolveRequest::default() })
    })
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn who_stops_while_finer_elements_are_made_has_what_was_known_before() {
    let found = where_first_elements_are_too_coarse(|scene, request| {
        let (mut seen, mut stopped) = (None, false);
        let solution = solve(scene, &request, None, &mut |p| {
            stopped |= p.stage == Stage::Pilot && seen.is_some();
            if p.stage == Stage::Increments && !stopped {
                seen = Some((p.increments, p.receivers));
            }
            if stopped { Watch::Stop } else { Watch::Continue }
        });
        let solution = solution.expect("the scene has light");
        (!solution.map.provenance.complete).then_some((solution, seen))
    });
    let (solution, seen) = found.expect("some first elements were to be too coarse");
    let (increments, receivers) = seen.expect("increments came first");
    assert_eq!(solution.state.stage, 1);
    assert_eq!(solution.state.increments, increments);
    assert_eq!(solution.map.elements.vertices().len() as u64, receivers);
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn a_state_tells_whether_its_run_lacked_time_for_finer_elements() {
    // Far longer than the first elements take. A third of it is slept away with their last report, so that no time is left for
    // finer ones: a pilot may take 0.4 of it.
    let limit = Duration::from_secs(30);
    let found = where_first_elements_are_too_coarse(|scene, request| {
        let (mut rounds, mut last) = (0, None);
        let unlimited = solve(scene, &request, None, &mut |p| match (p.stage, last) {
            (Stage::Increments, last_of_all) if last_of_all < Some(p.increments) => {
                last = Some(p.increments);
                Watch::Continue
            }
            (_, None) => {
                rounds += 1;
                Watch::Continue
            }
            (_, Some(_)) => Watch::Stop,
        });
        let unlimited = unlimited.expect("the scene has light");
        let last = last.filter(|_| !unlimited.map.provenance.complete)?;
        assert!(!unlimited.state.stayed_coarse);
        let request = SolveRequest { time_limit: Some(limit), ..request };
        let mut left = rounds;
        let limited = solve(scene, &request, None, &mut |p| {
            if p.stage == Stage::Increments {
                return if p.increments > last { Watch::Stop } else { Watch::Continue };
            }
            left -= 1;
            if left == 0 {
                let until_s = limit.as_secs_f64() / 3.0 - p.elapsed_s;
                std::thread::sleep(Duration::from_secs_f64(until_s.max(0.0)));
            }
            Watch::Continue
        });
        Some((limited.expect("the scene has light").state, last))
    });
    let (state, last) = found.expect("some first elements were to be too coarse");
    assert_eq!((state.stage, state.increments), (1, last + 1));
    assert!(state.stayed_coarse);
}

#[test]
fn a_map_looked_at_on_the_way_is_that_of_a_run_stopped_there() {
    let scene = everything();
    for method in METHODS {
        let request = coarse(method, 250);
        let (mut looked, mut ended_at) = (None, None);
        let watch = &mut |p: &Progress, so_far: &SoFar| {
            assert_eq!(so_far.map().is_some(), p.stage == Stage::Increments);
            // From the end of a run nothing goes on to the same bits.
            assert_eq!(so_far.state().is_some(), p.stage == Stage::Increments && !p.ends);
            if p.ends && ended_at.is_none() {
                (looked, ended_at) = (so_far.map(), Some(p.increments));
            }
            match ended_at {
                Some(end) if p.increments > end + 2 => Watch::Stop,
                Some(_) => Watch::Insist,
                None => Watch::Continue,
            }
        };
        let on = solve_looked_at(&scene, &request, None, watch).expect("the scene has light");
        let itself = solve(&scene, &request, None, &mut |_| Watch::Continue).expect("the same");
        let end = itself.map.provenance.increments;
        assert_eq!((ended_at, on.state.increments), (Some(end), end + 3), "{method:?}");
        let looked = looked.expect("a map at the end");
        assert_eq!(looked.values, itself.map.values, "{method:?}");
        assert_eq!(looked.provenance.accuracy, itself.map.provenance.accuracy, "{method:?}");
    }
}

#[test]
fn increments_are_predicted_from_the_first_on_and_not_charged_for_the_pilot() {
    let scene = everything();
    let (mut pilot_s, mut seen) = (0.0, 0);
    let watch = &mut |p: &Progress| {
        if p.stage == Stage::Pilot {
            pilot_s = p.elapsed_s;
            return Watch::Continue;
        }
        let finish_s = p.prediction.expect("a target has a time").finish_s;
        // At an accuracy of one hundred per cent the fewest increments are enough.
        let left = 8_u64.saturating_sub(p.increments) as f64 / p.increments as f64;
        let latest_s = p.elapsed_s + left * (p.elapsed_s - pilot_s);
        assert!(finish_s >= p.elapsed_s && finish_s <= latest_s + 1e-9, "{p:?} {pilot_s}");
        seen += 1;
        Watch::Continue
    };
    let request = coarse(isolux::map::Method::Hybrid, 250);
    solve(&scene, &request, None, watch).expect("the scene has light");
    assert_eq!(seen, 8);
}
