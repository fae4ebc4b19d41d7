//! The path tracer, which shares no map and no elements with the engines, against closed forms.

use isolux::engine::{ExactSettings, PathTracer, ProbePoint};
use isolux::map::Illuminance;
use isolux::scene::Scene;
use isolux_compare::case::cases;
use isolux_compare::statistics::student_two_sided;
use isolux_compare::tolerance::{RAY_KERNEL_POSITION, SIGNIFICANCE};
use isolux_compare::{Expectation, Quantity};

const SETTINGS: ExactSettings = ExactSettings { rays: 256, replicates: 16, seed: 1 };

/// Light that glass throws on the place itself is left out where luminaires have no surface.
fn is_covered(tracer: &PathTracer, expectation: &Expectation) -> bool {
    !tracer.leaves_caustics() || expectation.quantity == Quantity::Indirect
}

fn part(quantity: Quantity, found: &Illuminance) -> f64 {
    match quantity {
        Quantity::Total => found.illuminance_lx(),
        Quantity::Direct => found.direct_lx.luminance(),
        Quantity::Indirect => found.indirect_lx.luminance(),
    }
}

/// The chance of an error at least as large if there is no bias.
fn chance(expectation: &Expectation, found: &Illuminance) -> f64 {
    let expected_lx = expectation.expected_lx.luminance();
    let known_to_lx = expectation.bound.lx + RAY_KERNEL_POSITION * expected_lx;
    let error_lx = (part(expectation.quantity, found) - expected_lx).abs() - known_to_lx;
    if error_lx <= 0.0 {
        return 1.0;
    }
    student_two_sided(error_lx / found.standard_error_lx, f64::from(SETTINGS.replicates - 1))
}

#[test]
fn closed_forms_lie_within_its_standard_errors() {
    let mut readings = 0;
    for case in &cases() {
        let scene = Scene::assemble((case.parts)()).unwrap();
        let tracer = PathTracer::new(&scene);
        let expectations = (case.expectations)().into_iter();
        // Parts of the light at one place follow each other.
        let mut last: Option<(ProbePoint, Illuminance)> = None;
        for expectation in expectations.filter(|e| is_covered(&tracer, e)) {
            let at = expectation.at;
            let known = last.filter(|(place, _)| *place == at);
            let found = known.map_or_else(|| tracer.estimate(at, &SETTINGS), |(_, found)| found);
            last = Some((at, found));
            let chance = chance(&expectation, &found);
            assert!(
                chance > SIGNIFICANCE,
                "{}: {:?} at {:?}: {} +- {} for {}",
                case.name,
                expectation.quantity,
                expectation.at.position,
                part(expectation.quantity, &found),
                found.standard_error_lx,
                expectation.expected_lx.luminance()
            );
            readings += 1;
        }
    }
    assert!(readings > 100, "{readings}");
}

/// The point of the paper, seen by three mirrors: 1353.247877 lx.
#[test]
fn the_sphere_between_mirrors_is_known_to_a_per_cent() {
    let at: ProbePoint = isolux_compare::case::sphere::centre();
    let scene = Scene::assemble(isolux_compare::case::sphere::parts()).unwrap();
    let found = PathTracer::new(&scene).estimate(at, &SETTINGS);
    let expected_lx = isolux_compare::case::sphere::total_lx(&at);
    assert!(found.standard_error_lx < 0.01 * expected_lx, "{found:?}");
    assert!((found.illuminance_lx() - expected_lx).abs() < 0.05 * expected_lx, "{found:?}");
}

#[test]
fn places_and_seeds_have_numbers_of_their_own() {
    let scene = Scene::assemble(isolux_compare::case::cube::parts()).unwrap();
    let tracer = PathTracer::new(&scene);
    let error = |x: f64, seed| {
        let at = isolux_compare::case::cube::floor_point(x, 0.3);
        tracer.estimate(at, &ExactSettings { seed, ..SETTINGS }).indirect_lx
    };
    assert_eq!(error(0.2, 1), error(0.2, 1));
    assert_ne!(error(0.2, 1), error(0.2, 2));
    // Mirror images of each other: the light is the same, the noise is not.
    assert_ne!(error(0.2, 1), error(-0.2, 1));
}
