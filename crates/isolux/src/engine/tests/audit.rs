//! The audit: what it finds of maps whose error is known.

use super::{inward_box, isotropic, painted, scene};
use crate::engine::{AuditSettings, SolveRequest, Watch, audit, solve};
use crate::map::{Audit, IlluminationMap};
use crate::scene::Scene;
use crate::units::Rgb;

fn room() -> Scene {
    let lamps = vec![isotropic([1.3, 2.1, 1.7], 300.0)];
    scene(inward_box([4.0, 5.0, 3.0], 0), vec![painted(Rgb::grey(0.6))], lamps)
}

fn solved(scene: &Scene, audit: bool) -> IlluminationMap {
    let request = SolveRequest { accuracy: Some(0.02), audit, ..SolveRequest::default() };
    solve(scene, &request, None, &mut |_| Watch::Continue).unwrap().map
}

fn audited(scene: &Scene, map: &IlluminationMap, seed: u64) -> Audit {
    audit(scene, map, &AuditSettings { places: 512, seed, ..AuditSettings::default() }).unwrap()
}

/// A map whose indirect light is off by a factor.
fn falsified(map: &IlluminationMap, factor: f64) -> IlluminationMap {
    let mut map = map.clone();
    for value in map.values.iter_mut().flatten() {
        value.indirect_lx = value.indirect_lx * factor;
    }
    // Read as it is everywhere: gathered light would be off by a reflectance less.
    map.provenance.fresh = None;
    map
}

#[test]
fn a_true_claim_stands() {
    let scene = room();
    let found = audited(&scene, &solved(&scene, false), 1);
    assert!(!found.contradicts, "{found:?}");
    assert!(found.error.low <= found.told && found.told < found.would_find, "{found:?}");
    assert_eq!((found.places, found.unknown_places, found.untested), (384, 0, 0.0));
    assert!(found.trust.passes(), "{:?}", found.trust);
}

#[test]
fn a_false_claim_is_contradicted_and_its_error_found() {
    let scene = room();
    let map = solved(&scene, false);
    let factor = 1.3;
    let found = audited(&scene, &falsified(&map, factor), 1);
    // The error of the indirect light that was put in, relative as that of a map is, and what the map erred by before.
    let (mut wrong, mut squares) = (0.0, 0.0);
    for (vertex, value) in map.elements.vertices().iter().zip(&map.values) {
        let value = value.unwrap();
        let (indirect, all) = (value.indirect_lx.luminance(), value.illuminance_lx());
        wrong += vertex.area_m2 * ((factor - 1.0) * indirect).powi(2);
        squares += vertex.area_m2 * (all + (factor - 1.0) * indirect).powi(2);
    }
    let put_in = (wrong / squares).sqrt();
    let before = map.provenance.accuracy.unwrap().reached;
    assert!(found.contradicts && found.at_least > found.told, "{found:?}");
    assert!(
        found.error.low - before < put_in && put_in < found.error.high + before,
        "{put_in} {found:?}"
    );
    assert!(found.readings.at_least > Audit::MOST_UNTOLD, "{:?}", found.readings);
    assert!(found.mean_error > 0.0, "{found:?}");
    assert_eq!(found.surfaces.len(), 6, "{:?}", found.surfaces);
    assert!(found.surfaces.iter().all(|surface| surface.read_lx > surface.traced_lx));
}

#[test]
fn the_squared_error_found_has_no_bias() {
    let scene = room();
    let map = falsified(&solved(&scene, false), 1.1);
    let few = |seed| {
        let settings = AuditSettings { places: 64, paths: 8, seed, ..AuditSettings::default() };
        let found = audit(&scene, &map, &settings).unwrap().error.value;
        found * found
    };
    // So few paths have ten times the noise of what is looked for, which the mean over audits does not see.
    let (mean, error) = super::mean_and_error((0..64).map(few));
    let many = AuditSettings { places: 1024, paths: 256, ..AuditSettings::default() };
    let truth = audit(&scene, &map, &many).unwrap().error.value;
    // Squares below zero count as none, which half of the audits of a true map would have; of this one hardly any.
    assert!((mean - truth * truth).abs() < super::SIGMAS * error, "{mean} +- {error}, {truth}");
}

#[test]
fn a_run_tells_its_audit_and_is_the_same_without_it() {
    let scene = room();
    let (with, without) = (solved(&scene, true), solved(&scene, false));
    let found = with.provenance.audit.clone().unwrap();
    assert!(without.provenance.audit.is_none() && !found.contradicts);
    assert_eq!(found.number, 1);
    assert_eq!((&with.values, with.provenance.rays), (&without.values, without.provenance.rays));
    assert_eq!(solved(&scene, true), with);
}
