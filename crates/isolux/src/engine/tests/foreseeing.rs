//! What a run says of itself before it is done.

use super::errors::room;
use super::{Rgb, Scene, inward_box, isotropic, painted, scene, usual_request};
use crate::engine::gather::Unlit;
use crate::engine::light::Lighting;
use crate::engine::pilot::{Costs, EachIncrement, GoOn, Outlook, PilotRequest, Round, pilot};
use crate::engine::plan::Plan;
use crate::engine::ray::{Deadline, NEVER};
use crate::engine::{Solution, SolveRequest, Stage, Watch, foresee, solve};
use std::time::{Duration, Instant};

/// A thousand carriers of two thousand vertices that have gathered, good enough, at a microsecond a ray.
fn known() -> (Outlook, Costs) {
    let mut costs = Costs::default();
    costs.rays.add(Duration::from_millis(64), 64_000.0);
    costs.direct.add(Duration::from_millis(2), 2000.0);
    costs.looks.add(Duration::from_millis(4), 2000.0);
    let outlook = Outlook {
        carriers: 1000.0,
        gathered: 1000.0,
        vertices: 2000.0,
        most: f64::INFINITY,
        measured: 2000.0,
        pilot_rays: 64.0,
        each: EachIncrement { rays: 16.0, check_rays: 0.0, particles: 0.0, measures_direct: false },
        checks: 0.0,
        trials: 0.0,
        target: 0.01,
        excess: Some(1.0),
        before: None,
        usual: None,
        more_for_direct: 0.0,
        measured_again: 0.0,
    };
    (outlook, costs)
}

/// What is done once before increments on these elements: two looks at two thousand vertices, 2 microseconds each, and readers' rays.
const ONCE_S: f64 = 2.0 * 0.004 + 0.016;

#[test]
fn when_elements_are_fixed_increments_are_left() {
    let (outlook, costs) = known();
    // Eight increments or more of a thousand times sixteen rays, four tenths more for the fixed point, and a ray's time for each vertex.
    let left_s = outlook.left(&costs).time_s;
    let expected_s = ONCE_S + 8.5 * (0.016 * 1.4 + 0.002);
    assert!((left_s - expected_s).abs() < 1e-9, "{left_s} {expected_s}");
    let beside = {
        let each = EachIncrement { check_rays: 8000.0, particles: 8000.0, ..outlook.each };
        Outlook { each, ..outlook }.left(&costs).time_s
    };
    assert!(
        (beside - left_s - 8.5 * 0.016).abs() < 1e-9,
        "half as many to check, and for caustics"
    );
    // Direct light of check points is read exactly, a microsecond at vertices; others tell where it is noisy.
    let once = Outlook { checks: 500.0, trials: 8000.0, ..outlook }.left(&costs).time_s - left_s;
    assert!((once - 6.5 * 0.0005 - 0.008).abs() < 1e-9, "{once}");
    let measured =
        Outlook { each: EachIncrement { measures_direct: true, ..outlook.each }, ..outlook };
    let direct_s = measured.left(&costs).time_s - left_s;
    assert!((direct_s - 8.5 * 0.002).abs() < 1e-9, "direct light in each: {direct_s}");
    // As increments do it is known sooner or later, as is what rays take without sweeps.
    let mut tried = costs;
    tried.again.add(Duration::from_millis(1), 4000.0);
    let direct_s = measured.left(&tried).time_s - left_s;
    assert!((direct_s - 8.5 * 0.0005).abs() < 1e-9, "{direct_s}");
    tried.tried.add(Duration::from_millis(1), 2000.0);
    let rays_s = left_s - outlook.left(&tried).time_s;
    assert!((rays_s - 0.5 * (left_s - 2.0 * 0.004)).abs() < 1e-9, "half as long: {rays_s}");
    // Those for direct light alone do not gather, and cost more than others, as much as is seen.
    let added = Outlook { more_for_direct: 500.0, ..outlook };
    let more_s = added.left(&costs).time_s - left_s;
    let looks_s = 2e-6 * (3.0 * 2000.0 + 2.0 * 500.0);
    let expected_s = looks_s + 2.3 * 0.0005 + 8.5 * 0.0005;
    assert!((more_s - expected_s).abs() < 1e-9, "{more_s} {expected_s}");
    let mut seen = costs;
    seen.in_shadows.add(Duration::from_millis(4), 1000.0);
    let seen_s = added.left(&seen).time_s - left_s;
    assert!((seen_s - more_s - (4.0 - 2.3) * 0.0005).abs() < 1e-9, "{seen_s}");
    let blind = Outlook { excess: None, ..outlook }.left(&costs);
    assert!((blind.time_s - 3.0 * left_s).abs() < 1e-9 && blind.factor > 2.5, "{blind:?}");
}

#[test]
fn elements_grow_as_errors_are_seen_to_fall() {
    let (outlook, costs) = known();
    let first = Outlook { excess: Some(2.0), ..outlook };
    assert_eq!(first.vertices_then(), 3000.0, "first power");
    assert_eq!(
        Outlook { most: 2500.0, ..first }.vertices_then(),
        2500.0,
        "no more than there may be"
    );
    // From 500 to 1000 carriers errors fell by 2^(2/3) only: it takes 2^(3/2) times as many.
    let slow = Outlook { before: Some((2.0 * 2.0_f64.powf(2.0 / 3.0), 500.0)), ..first };
    let more = 1000.0 * (2.0_f64.powf(1.5) - 1.0);
    // Where one round did next to nothing, the next ones will do more: no power below 0.7 is believed.
    let least = 1000.0 * (2.0_f64.powf(1.0 / 0.7) - 1.0);
    assert!((slow.vertices_then() - 2000.0 - least).abs() < 1e-6 && least < more);
    let left = slow.left(&costs);
    // So many gather in the pilot, with 64 rays each, and with the thousand in increments.
    let rays_s = 1e-6 * (least * 64.0 + (8.5 * 1.4 + 1.0) * (1000.0 + least) * 16.0);
    // And five rounds to come, and increments before they begin, look at all there are, 2 microseconds each; direct light is measured
    // at the new ones, and increments take a ray's time for every vertex.
    let vertices = slow.vertices_then();
    let looks_s = 2e-6 * (5.0 + 2.0) * vertices;
    let beside_s = looks_s + 1e-6 * (vertices - 2000.0) + 1e-6 * 8.5 * vertices;
    let expected_s = rays_s + beside_s;
    assert!((left.time_s - expected_s).abs() < 1e-9, "{} {expected_s}", left.time_s);
    assert!(left.factor > outlook.left(&costs).factor, "less is known");
}

#[test]
fn among_many_things_the_usual_mesh_is_foreseen() {
    let (outlook, costs) = known();
    let blind =
        Outlook { excess: None, gathered: 0.0, measured: 125.0, usual: Some(1.5), ..outlook };
    // The mesh for 1 % has the root of two times the vertices of that for 2 %, and direct light adds three
    // quarters of what the latter has more than the first.
    let carriers = 1500.0 * 2.0_f64.sqrt();
    let vertices = 1000.0 + carriers + 0.75 * 0.5 * 2000.0;
    assert!((blind.vertices_then() - vertices).abs() < 1e-6, "{}", blind.vertices_then());
    // By rays that were only traced, half a microsecond each, before any has gathered.
    let mut early = Costs::default();
    early.traced.add(Duration::from_millis(1), 2000.0);
    early.direct.add(Duration::from_millis(2), 2000.0);
    let left_s = blind.left(&early).time_s;
    let rays = carriers * (64.0 + (8.5 * 1.4 + 1.0) * 16.0) + 8.5 * vertices;
    let more = 0.75 * 0.5 * 2000.0;
    let direct_s = 1e-6 * (vertices - more - 125.0 + 2.3 * more);
    // Eight looks at all there is to look at, two later ones before increments, and a fifth more in all.
    let first_s = 0.5e-6 * 19.0;
    let looks_s = first_s * (8.0 * (1000.0 + carriers) + 2.0 * 0.1 * vertices);
    let expected = 1.2 * (0.5e-6 * 1.9 * rays + direct_s + looks_s);
    assert!((left_s / expected - 1.0).abs() < 1e-9, "{left_s} {expected}");
    // As soon as rays have gathered and vertices were looked at, that tells.
    assert!(blind.left(&Costs { rays: costs.rays, ..early }).time_s != left_s);
    assert_eq!(
        Outlook { usual: Some(1.5), ..outlook }.left(&costs).factor,
        outlook.left(&costs).factor
    );
}

/// A room with a block in it.
fn furnished() -> Scene {
    let mut block = inward_box([0.8, 0.7, 0.6], 0);
    for shape in &mut block {
        shape.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
        shape.positions.iter_mut().for_each(|[x, y, _]| (*x, *y) = (*x + 1.6, *y + 0.5));
    }
    let shapes = inward_box([3.0, 2.0, 2.5], 0).into_iter().chain(block).collect();
    scene(shapes, vec![painted(Rgb::grey(0.5))], vec![isotropic([1.0, 1.2, 1.5], 100.0)])
}

#[test]
fn a_step_that_takes_too_long_is_told_before_it_is_begun() {
    let scene = furnished();
    let lighting = Lighting::new(&scene);
    let request = PilotRequest { mesh_target: 0.005, ..usual_request() };
    let with = |go_on: &mut GoOn<'_>| pilot(&scene, &lighting, &request, &Unlit::default(), go_on);
    let mut longest = (0.0, 0);
    let whole = with(&mut |round: &Round| {
        if round.step_s > longest.0 {
            longest = (round.step_s, round.receivers);
        }
        true
    });
    let size = |plan: &Plan| plan.mesh.elements.vertices().len();
    // The block throws shadows, and their borders take vertices.
    assert!(longest.0 > 0.0 && size(&whole) > longest.1, "{longest:?} {}", size(&whole));
    let cut = with(&mut |round: &Round| round.step_s == 0.0);
    assert!(whole.is_whole && !cut.is_whole);
    assert_eq!(size(&cut), longest.1, "what there was before");
}

#[test]
fn a_run_says_when_it_will_end_before_it_has_elements() {
    let scene = room();
    let request = SolveRequest { accuracy: Some(0.02), ..SolveRequest::default() };
    let mut said = Vec::new();
    let solution = solve(&scene, &request, None, &mut |progress| {
        said.push((progress.stage, progress.prediction));
        Watch::Continue
    });
    let solution = solution.unwrap();
    assert!(solution.map.provenance.complete);
    assert_eq!(said[0].0, Stage::Pilot);
    for (_, prediction) in &said {
        let p = prediction.expect("a run with a goal says something from the first");
        assert!(p.earliest_s <= p.finish_s && p.finish_s <= p.latest_s && p.finish_s > 0.0);
    }
}

#[test]
fn a_dry_run_foresees_the_elements_of_the_run() {
    let scene = room();
    let request = SolveRequest { accuracy: Some(0.02), ..SolveRequest::default() };
    let seen = foresee(&scene, &request, Duration::from_secs(60), None).unwrap();
    let solution = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap();
    let receivers = solution.map.elements.vertices().len() as f64;
    let share = seen.receivers.unwrap() as f64 / receivers;
    // Refinement grows by rounds, of which the last may go a little beyond what was needed.
    assert!((0.7..1.5).contains(&share), "{seen:?} for {receivers}");
    assert!(seen.finish.is_some());
    let endless = SolveRequest { accuracy: None, ..request.clone() };
    let seen = foresee(&scene, &endless, Duration::ZERO, None).unwrap();
    assert!(seen.receivers.is_some() && seen.finish.is_none(), "{seen:?}: no goal, no end");
    // Without time to look at the light there are elements, and nothing else is known.
    let seen = foresee(&scene, &request, Duration::ZERO, Some(Duration::ZERO)).unwrap();
    assert!(seen.receivers_so_far > 100 && seen.receivers.is_none(), "{seen:?}");
    assert!(seen.finish.is_none(), "{seen:?}");
}

#[test]
fn a_first_survey_without_time_takes_a_ray_of_each_place() {
    let scene = furnished();
    let lighting = Lighting::new(&scene);
    let with = |deadline: Deadline| {
        let request = PilotRequest { deadline, ..usual_request() };
        pilot(&scene, &lighting, &request, &Unlit::default(), &mut |_| false)
    };
    let (whole, cut) = (with(NEVER.clone()), with(Deadline::at(Some(Instant::now()))));
    assert!(cut.rays < whole.rays, "{} of {}", cut.rays, whole.rays);
    let mean = |plan: &Plan| {
        let light = plan.light.guess.iter().map(|light| light.luminance());
        light.sum::<f64>() / plan.light.guess.len() as f64
    };
    // One ray of each of a few hundred vertices tells their mean to some hundredths.
    assert!((mean(&cut) / mean(&whole) - 1.0).abs() < 0.2, "{} {}", mean(&cut), mean(&whole));
}

#[test]
fn a_run_without_time_has_the_light_of_its_pilot_and_says_that_its_error_is_unknown() {
    let scene = room();
    let of = |time_limit: Option<Duration>| {
        let request = SolveRequest { accuracy: Some(0.02), time_limit, ..SolveRequest::default() };
        solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap()
    };
    let (whole, cut) = (of(None), of(Some(Duration::ZERO)));
    assert!(cut.map.provenance.accuracy.is_none() && !cut.map.provenance.complete);
    assert_eq!(cut.state.increments, 0, "no other run goes on from the light of a pilot");
    let mean = |solution: &Solution| {
        let known: Vec<f64> =
            solution.map.values.iter().flatten().map(|light| light.illuminance_lx()).collect();
        known.iter().sum::<f64>() / known.len() as f64
    };
    let ratio = mean(&cut) / mean(&whole);
    assert!((0.7..1.4).contains(&ratio), "{ratio}: means over different vertices");
}
