//! Errors of the scene from numbers whose error is known.

use super::*;
use crate::engine::gather::Unlit;
use crate::engine::judge::{Check, InterpolationErrors, Pooled, accuracy, check_points, filter};
use crate::engine::light::Lighting;
use crate::engine::pilot::{PilotRequest, pilot};
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, NEVER, Noise, ProbePoint, Sample};
use crate::engine::read::{ExactSettings, MapReader};
use crate::engine::run::prediction;
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::Accuracy;

pub(super) fn room() -> Scene {
    let lamp = isotropic([1.0, 1.2, 1.5], 100.0);
    scene(inward_box([3.0, 2.0, 2.5], 0), vec![painted(Rgb::grey(0.5))], vec![lamp])
}

pub(super) fn small_plan<'s>(scene: &'s Scene, lighting: &'s Lighting<'s>) -> Plan<'s> {
    let request = PilotRequest {
        target: 1.0,
        goal: 1.0,
        mesh_target: 1.0,
        seed: 1,
        is_fitted: true,
        is_hybrid: true,
        refines_caustics: true,
        max_vertices: 150,
        most_for_indirect_light: None,
        least_edge_m: None,
        deadline: NEVER.clone(),
        end: NEVER.clone(),
    };
    pilot(scene, lighting, &request, &Unlit::default(), &mut |_| true)
}

/// A number about zero with variance one, close to normal: the sum of twelve.
pub(super) fn noise(key: Key) -> f64 {
    (0..12).map(|k| key.with(k).uniform()).sum::<f64>() - 6.0
}

/// Sums of increments at every check point: an error common to all of them, and noise.
pub(super) fn check_sums(
    checks: &[Check],
    plan: &Plan,
    common: impl Fn(&Check) -> f64,
    sigma: f64,
) -> Accumulator {
    let mut sums = Accumulator::new(check_points::places(checks, true), plan.light.reference_lx);
    let vertices = plan.mesh.elements.vertices().len();
    let (coarse, fine) =
        (vec![Rgb::grey(5.0); plan.mesh.indirect_vertices], vec![Rgb::BLACK; vertices]);
    for increment in 0..16 {
        let key = Key::new(4).with(increment);
        let fresh: Vec<Rgb> = checks
            .iter()
            .enumerate()
            .map(|(k, c)| Rgb::grey(5.0 - common(c) + sigma * noise(key.with(k as u64))))
            .collect();
        let direct = vec![Rgb::BLACK; checks.len()];
        sums.add(check_points::samples(checks, (&fresh, &direct), [&fine, &fine, &coarse], None));
    }
    sums
}

/// The share of the surface where readers interpolate: what an error of one everywhere comes to there.
fn trusted_share(checks: &[Check], plan: &Plan) -> f64 {
    check_points::errors(
        &check_sums(checks, plan, |_| 1.0, 0.0),
        checks,
        (plan.trust(), Noise::Counted),
    )
    .indirect_lx
    .powi(2)
}

/// Mean square of the error over all the surface, where readers interpolate and where not.
fn squared(found: &InterpolationErrors, trusted_share: f64) -> f64 {
    found.indirect_lx.powi(2) + (1.0 - trusted_share) * found.untrusted_lx.powi(2)
}

#[test]
fn check_points_stand_for_the_whole_surface() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let checks = check_points::draw(&plan, 0, Key::new(2));
    assert!(checks.len() > 100);
    // Floor against all, by the same weights: their common error is one on the floor, zero elsewhere.
    let on_floor = |c: &Check| if c.gatherer.surface.point.z < 1e-3 { 1.0 } else { 0.0 };
    let found = check_points::errors(
        &check_sums(&checks, &plan, on_floor, 0.0),
        &checks,
        (plan.trust(), Noise::Counted),
    );
    let share: f64 = 6.0 / (2.0 * (6.0 + 7.5 + 5.0));
    // Half the points are drawn where errors are large; weights differ by a factor of a few, so a
    // share of a sixth of some 256 points is known to 0.04 or better.
    let trusted = trusted_share(&checks, &plan);
    assert!(
        trusted > 0.1 && trusted < 0.9,
        "elements are large, so that edges beset many: {trusted}"
    );
    assert!((squared(&found, trusted) - share).abs() < 0.08, "{found:?} {share}");
    assert!((found.indirect_mean_lx - share).abs() < 0.08);
}

#[test]
fn common_errors_are_seen_through_noise() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let checks = check_points::draw(&plan, 0, Key::new(2));
    let near = |found: f64, expected: f64, allowed: f64| {
        assert!((found - expected).abs() < allowed, "{found} {expected}");
    };
    let found_if = |error: &dyn Fn(&Check) -> f64, sigma: f64, noise_is: Noise| {
        check_points::errors(
            &check_sums(&checks, &plan, error, sigma),
            &checks,
            (plan.trust(), noise_is),
        )
    };
    // Without noise the error is what it is.
    let trusted = trusted_share(&checks, &plan);
    let found = found_if(&|_| 0.3, 0.0, Noise::Counted);
    near(found.indirect_lx, 0.3 * trusted.sqrt(), 1e-3);
    near(found.untrusted_lx, 0.3, 1e-3);
    near(found.indirect_mean_lx, 0.3, 1e-3);
    near(found.trusted_mean_lx, 0.3 * trusted, 1e-3);
    near(found.total_lx, 0.3, 1e-3);
    // Noise of 0.4 an increment, 0.1 of the mean of sixteen: its square is taken off, and its standard error left on. Twice the product of both,
    // 0.06, over the root of 256 points, is 0.004, and a few times that for uneven weights.
    let found = found_if(&|_| 0.3, 0.4, Noise::Counted);
    near(squared(&found, trusted), 0.09, 0.015);
    near(found.indirect_mean_lx, 0.3, 0.04);
    // Noise alone is no error beyond what it may hide.
    let found = found_if(&|_| 0.0, 0.4, Noise::Counted);
    assert!(found.indirect_lx < 0.06, "{found:?}");
    let noisy = |error: f64, noise_is: Noise| found_if(&|_| error, 0.4, noise_is);
    // It is ruled out, but for what one standard error does not cover, and an error that is there is not.
    assert!(noisy(0.0, Noise::RuledOut).indirect_lx < 0.03);
    let [ruled, taken_off, counted] =
        [Noise::RuledOut, Noise::TakenOff, Noise::Counted].map(|noise| noisy(0.3, noise));
    assert!(
        ruled.indirect_lx < taken_off.indirect_lx && taken_off.indirect_lx < counted.indirect_lx
    );
    near(ruled.indirect_lx, 0.3 * trusted.sqrt(), 0.02);
    assert!(ruled.indirect_mean_lx < counted.indirect_mean_lx && ruled.indirect_mean_lx > 0.25);
    // As much one way as the other: an error, but no bias.
    let sign =
        |c: &Check| if (c.gatherer.surface.point.x * 997.0) as i64 % 2 == 0 { 1.0 } else { -1.0 };
    let found = found_if(&sign, 0.0, Noise::Counted);
    near(squared(&found, trusted), 1.0, 2e-3);
    assert!(found.indirect_mean_lx.abs() < 0.3, "{found:?}");
}

/// Sums with noise of a share of a value at every vertex.
fn sums(plan: &Plan, increments: u64, sigma: f64) -> Accumulator {
    let count = plan.mesh.elements.vertices().len();
    let mut sums = Accumulator::new(count, 100.0);
    for increment in 0..increments {
        let key = Key::new(9).with(increment);
        sums.add((0..count as u64).map(|k| Sample {
            indirect: Rgb::grey(60.0 + 100.0 * sigma * noise(key.with(k))),
            direct: Rgb::grey(40.0),
            ..Sample::default()
        }));
    }
    sums
}

/// The error of a map of such sums.
fn of_map(plan: &Plan, sums: &Accumulator, seen: &InterpolationErrors) -> Option<Accuracy> {
    accuracy(plan, &Pooled::of(plan, |k| sums.estimate(k)), seen)
}

/// What maps of increments read scatters by less than their vertices: at the middle of an element by
/// the root of a third.
#[test]
fn noise_is_that_of_readings_over_the_surface() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let checks = check_points::draw(&plan, 0, Key::new(2));
    let mut sums = Accumulator::new(check_points::places(&checks, true), plan.light.reference_lx);
    let black = vec![Rgb::BLACK; plan.mesh.elements.vertices().len().max(checks.len())];
    for increment in 0..16 {
        let key = Key::new(5).with(increment);
        let coarse: Vec<Rgb> = (0..plan.mesh.indirect_vertices)
            .map(|k| Rgb::grey(5.0 + noise(key.with(k as u64))))
            .collect();
        let fresh = &black[..checks.len()];
        sums.add(check_points::samples(&checks, (fresh, fresh), [&black, &black, &coarse], None));
    }
    let noise_lx =
        check_points::errors(&sums, &checks, (plan.trust(), Noise::Counted)).noise_lx.unwrap();
    // Barycentric weights have a mean square of 1/6 each; 16 increments; some hundred vertices tell.
    let expected = (3.0 / 6.0_f64).sqrt() / 4.0;
    assert!((noise_lx / expected - 1.0).abs() < 0.2, "{noise_lx} {expected}");
}

#[test]
fn accuracy_is_relative_and_its_parts_add_in_squares() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let errors = InterpolationErrors {
        caustics_lx: 0.0,
        indirect_lx: 3.0,
        total_lx: 4.0,
        indirect_mean_lx: -2.0,
        trusted_mean_lx: -2.0,
        direct_mean_lx: -100.0,
        untrusted_lx: 8.0,
        close: 0.25,
        given_up_lx: 0.0,
        noise_lx: None,
        over_expected: None,
    };
    let found = of_map(&plan, &sums(&plan, 25, 0.1), &errors).unwrap();
    // Some 150 vertices of 25 increments: the variance is known to sqrt(2 / 3600) = 2.4 %.
    assert!((found.statistical / 0.02 - 1.0).abs() < 5.0 * 0.012, "{found:?}");
    // The root mean square of 100 lx with noise of 2 lx.
    // Where readers gather, they read a quarter of a light that errs by 8 lx close by: 2 lx.
    assert!((found.discretization - 0.03_f64.hypot(0.02)).abs() < 2e-4, "{found:?}");
    // At a reflectance of one half what is read wrong is reflected once in all, and adds to what is
    // wrong where it is read: (1 + 1)2 of its square, less the one of discretization.
    let bias = 0.02 * 3.0_f64.sqrt();
    assert!((found.bias - bias).abs() < 2e-4, "{found:?}");
    let root = |a: f64| (found.statistical.powi(2) + a * a + found.bias.powi(2)).sqrt();
    assert!((found.reached - root(found.discretization)).abs() < 1e-12);
    assert!((found.interpolated - root(0.04)).abs() < 1e-4);
    // Where it is wrong nobody interpolates: they read what is reflected alone, but the bare map is as it was.
    let untrusted = InterpolationErrors { trusted_mean_lx: 0.0, ..errors };
    let gathered = of_map(&plan, &sums(&plan, 25, 0.1), &untrusted).unwrap();
    assert!((gathered.bias - 0.02).abs() < 2e-4, "{gathered:?}");
    assert!((gathered.interpolated - found.interpolated).abs() < 1e-12);
}

#[test]
fn too_few_increments_and_darkness_have_no_accuracy() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let none = InterpolationErrors::default();
    let mut dark = Accumulator::new(plan.mesh.elements.vertices().len(), 1.0);
    (0..16).for_each(|_| dark.add(plan.mesh.elements.vertices().iter().map(|_| Sample::default())));
    assert!(of_map(&plan, &dark, &none).is_none());
}

fn parts(statistical: f64, discretization: f64, bias: f64) -> Accuracy {
    Accuracy { reached: 0.0, statistical, discretization, caustics: 0.0, bias, interpolated: 0.0 }
}

#[test]
fn increments_needed_follow_the_inverse_square() {
    let needed = |a: Accuracy, target| prediction::increments_needed(&a, 20, target);
    let near = |found: Option<f64>, expected: f64| {
        assert!(found.is_some_and(|n| (n / expected - 1.0).abs() < 1e-12), "{found:?} {expected}");
    };
    near(needed(parts(0.02, 0.0, 0.0), 0.01), 80.0);
    near(needed(parts(0.02, 0.006, 0.0), 0.01), 20.0 * 4e-4 / 6.4e-5);
    near(needed(parts(0.02, 0.0, 0.008), 0.01), 20.0 * 4e-4 / 3.6e-5);
    near(needed(parts(0.005, 0.0, 0.0), 0.01), 5.0);
    assert_eq!(needed(parts(0.001, 0.01, 0.0), 0.01), None);
    assert_eq!(needed(parts(0.001, 0.008, 0.008), 0.01), None);
}

#[test]
fn what_is_in_doubt_falls_with_the_noise() {
    let needed = |a: Accuracy, seen: Accuracy| {
        prediction::increments_needed_beyond_doubt(&a, &seen, 20, 0.01)
    };
    // Of 1.2 % that elements are said to err by, 0.6 % are seen: 4e-4 and 1.08e-4 have to fall to 6.4e-5.
    let found = needed(parts(0.02, 0.012, 0.0), parts(0.02, 0.006, 0.0)).unwrap();
    assert!((found / (20.0 * (4e-4 + 1.08e-4) / 6.4e-5) - 1.0).abs() < 1e-12, "{found}");
    // Without doubt, as ever; where what is seen is too much, none are enough.
    let certain = parts(0.02, 0.006, 0.0);
    assert_eq!(needed(certain, certain), prediction::increments_needed(&certain, 20, 0.01));
    assert_eq!(needed(parts(0.001, 0.012, 0.0), parts(0.001, 0.01, 0.0)), None);
}

#[test]
fn predictions_lie_in_their_interval_and_sharpen() {
    let at = |increments| prediction::finish(100.0, increments, 0.5, 3.0 + 0.5 * increments as f64);
    for increments in [1, 8, 50, 99] {
        let p = at(increments);
        assert!((p.finish_s - 53.0).abs() < 1e-9);
        assert!(p.earliest_s <= p.finish_s && p.finish_s <= p.latest_s);
        assert!(p.earliest_s >= 3.0 + 0.5 * increments as f64, "before now");
    }
    assert!(at(50).latest_s - at(50).earliest_s < at(8).latest_s - at(8).earliest_s);
    // Done already: now.
    let done = prediction::finish(5.0, 20, 0.5, 10.0);
    assert_eq!((done.earliest_s, done.finish_s, done.latest_s), (10.0, 10.0, 10.0));
}

/// Backs of walls that no light comes to halve every mean over the surface, and nothing else that a user sees.
#[test]
fn what_has_one_sign_is_told_as_it_is_where_light_is() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let vertices = plan.mesh.elements.vertices();
    let of_surfaces = |is_lit: &dyn Fn(usize) -> bool, mean_lx: f64| {
        let mut sums = Accumulator::new(vertices.len(), 100.0);
        for _ in 0..16 {
            let lx = |k| if is_lit(k) { 100.0 } else { 0.0 };
            let indirect = |k| Rgb::grey(lx(k));
            let sample = |k| Sample { indirect: indirect(k), ..Sample::default() };
            sums.add((0..vertices.len()).map(sample));
        }
        let lit: f64 =
            (0..vertices.len()).filter(|&k| is_lit(k)).map(|k| vertices[k].area_m2).sum();
        let lit = lit / vertices.iter().map(|v| v.area_m2).sum::<f64>();
        let [all_lx, given_up_lx] = [mean_lx * lit, 0.5 * lit];
        let errors = InterpolationErrors {
            indirect_mean_lx: all_lx,
            trusted_mean_lx: all_lx,
            given_up_lx,
            ..InterpolationErrors::default()
        };
        of_map(&plan, &sums, &errors).unwrap().bias
    };
    let whole = of_surfaces(&|_| true, 2.0);
    let half = of_surfaces(&|k| k % 2 == 0, 2.0);
    assert!(whole > 0.03 && (half - whole).abs() < 1e-6, "{half} for {whole}");
}

/// Light that bends one way all over a wall, in noise: what is smoothed comes to as much light as before.
#[test]
fn a_filter_takes_no_light() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let vertices = &plan.mesh.elements.vertices()[..plan.mesh.indirect_vertices];
    let key = Key::new(3);
    let bent = |(k, vertex): (usize, &crate::elements::Vertex)| {
        let from_middle = vertex.position - Point::new(1.5, 1.0, 1.25);
        Rgb::grey(100.0 - 10.0 * from_middle.length_squared() + 5.0 * noise(key.with(k as u64)))
    };
    let values: Vec<Rgb> = vertices.iter().enumerate().map(bent).collect();
    let filtered = filter(&plan, std::slice::from_ref(&values), &vec![25.0; values.len()], 100.0);
    assert!(filtered.report.share > 0.2, "{:?}", filtered.report);
    let flux = |values: &[Rgb]| -> f64 {
        values.iter().zip(vertices).map(|(e, v)| e.luminance() * v.area_m2).sum()
    };
    let (before, after) = (flux(&values), flux(&filtered.values[0]));
    assert!((after / before - 1.0).abs() < 1e-12, "{after} for {before}");
}

#[test]
fn readings_of_a_map_of_unknown_error_have_none_either() {
    let scene = room();
    let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
    let mut map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let up = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
    let on_floor = ProbePoint { position: Point::new(1.0, 0.7, 0.0), normal: up };
    let in_space = ProbePoint { position: Point::new(1.0, 0.7, 0.4), normal: up };
    for is_known in [true, false] {
        if !is_known {
            map.provenance.accuracy = None;
        }
        let reader = MapReader::new(&scene, &map);
        let probed = [reader.probe(on_floor), reader.measure(in_space)].map(Option::unwrap);
        let exact = [on_floor, in_space].map(|at| reader.estimate(at, &ExactSettings::default()));
        for read in probed.into_iter().chain(exact) {
            assert_eq!(read.standard_error_lx.is_finite(), is_known, "{read:?}");
            let own = reader.by_replicates(read).standard_error_lx;
            assert_eq!(own.is_finite(), is_known, "by replicates {own}");
        }
    }
}
