//! Whether standard errors are what they say.

use crate::rooms::{glowing, inward_box, lamp, outward_box, painted, rectangle, room, scene};
use crate::runs::{coarse, run};
use isolux::engine::SolveRequest;
use isolux::map::Method;
use isolux::scene::Scene;

/// Values and standard errors of one run, lx.
fn values(scene: &Scene, method: Method, seed: u64, increments: u64) -> Vec<(f64, f64)> {
    let request = SolveRequest { seed, filter: false, ..coarse(method, 90) };
    let map = run(scene, &request, increments).expect("the scene has light").map;
    let known = map.values.iter().flatten();
    known.map(|v| (v.illuminance_lx(), v.standard_error_lx)).collect()
}

/// Share of the receivers whose interval, so many standard errors wide, holds the mean of all other
/// runs, one share a run. That mean has an error of its own, which widens the interval.
fn shares_inside(runs: &[Vec<(f64, f64)>], errors: f64) -> Vec<f64> {
    let others = runs.len() as f64 - 1.0;
    let sums: Vec<f64> =
        (0..runs[0].len()).map(|k| runs.iter().map(|run| run[k].0).sum()).collect();
    let share = |run: &Vec<(f64, f64)>| {
        let inside = |(&(value, error), sum): (&(f64, f64), &f64)| {
            let mean = (sum - value) / others;
            (value - mean).abs() <= errors * error * (1.0 + 1.0 / others).sqrt()
        };
        run.iter().zip(&sums).filter(|&pair| inside(pair)).count() as f64 / run.len() as f64
    };
    runs.iter().map(share).collect()
}

/// A case, and Student's t of 95 % for its increments less one.
struct Trial {
    name: &'static str,
    scene: Scene,
    method: Method,
    seeds: u64,
    increments: u64,
    student: f64,
}

fn check(trial: &Trial) {
    let Trial { name, scene, method, seeds, increments, student } = trial;
    let runs: Vec<_> = (1..=*seeds).map(|seed| values(scene, *method, seed, *increments)).collect();
    assert!(runs[0].len() > 60, "{name}: too few receivers to tell");
    let shares = shares_inside(&runs, *student);
    let n = shares.len() as f64;
    let mean = shares.iter().sum::<f64>() / n;
    let squares: f64 = shares.iter().map(|s| (s - mean) * (s - mean)).sum();
    // Receivers of one run share its light and are not independent; runs are. Of ten runs the mean is
    // six standard errors off once in five thousand trials.
    let error = (squares / (n * (n - 1.0))).sqrt();
    assert!(error < 0.015, "{name}: coverage known to {error} tells nothing");
    assert!((mean - 0.95).abs() < 6.0 * error, "{name}: {mean} +- {error} are inside");
}

#[test]
fn ninety_five_per_cent_intervals_hold_the_truth_so_often() {
    let (method, seeds, increments, student) = (Method::Hybrid, 40, 16, 2.131);
    check(&Trial { name: "room", scene: room(), method, seeds, increments, student });
}

#[test]
fn so_they_do_with_glowing_surfaces_and_shadows() {
    let mut shapes = inward_box([0.0; 3], [3.0, 2.0, 2.5], 0);
    shapes.extend(outward_box([0.5, 0.5, 0.3], [1.2, 1.2, 1.0], 0));
    shapes.push(rectangle([1.0, 0.8, 2.4], [0.0, 0.4, 0.0], [0.6, 0.0, 0.0], 1));
    let materials = vec![painted(0.5), glowing(500.0, 0.2)];
    let scene = scene(shapes, materials, vec![lamp([2.0, 1.2, 1.5], 100.0)]);
    let (method, seeds, increments, student) = (Method::Hybrid, 12, 8, 2.365);
    check(&Trial { name: "furnished room", scene, method, seeds, increments, student });
}

#[test]
fn so_they_do_with_particles() {
    let (method, seeds, increments, student) = (Method::Forward, 12, 8, 2.365);
    check(&Trial { name: "room", scene: room(), method, seeds, increments, student });
}

#[test]
fn the_test_sees_intervals_that_are_too_short() {
    let runs: Vec<_> = (1..=12).map(|seed| values(&room(), Method::Hybrid, seed, 8)).collect();
    let coverage = |errors: f64| {
        let shares = shares_inside(&runs, errors);
        shares.iter().sum::<f64>() / shares.len() as f64
    };
    // Intervals a fifth too short, or made for a normal distribution, hold less: 0.90, 0.91.
    assert!(coverage(0.8 * 2.365) < 0.93, "{}", coverage(0.8 * 2.365));
    assert!(coverage(1.960) < 0.935, "{}", coverage(1.960));
}
