//! Tables that are not distributions, and what a file may not smuggle in.

use super::*;
use crate::photometry::WebError;
use serde::Deserialize;
use serde::de::value::{Error, MapDeserializer};

fn refused(planes: &[f64], gammas: &[f64], candela: &[f64]) -> WebError {
    PhotometricWeb::new(planes.to_vec(), gammas.to_vec(), candela.to_vec()).unwrap_err()
}

#[test]
fn every_kind_of_nonsense_has_its_name() {
    let two = [1.0, 1.0];
    let ends = [0.0, 90.0];
    type E = WebError;
    assert!(matches!(refused(&[], &[], &[]), E::TooFewAngles { planes: 0, gammas: 0, least: 1 }));
    assert!(matches!(
        refused(&[0.0], &[0.0], &[1.0]),
        E::TooFewAngles { planes: 1, gammas: 1, .. }
    ));
    assert!(matches!(refused(&[0.0], &ends, &[1.0]), E::WrongCount { found: 1, expected: 2 }));
    assert!(matches!(refused(&vec![0.0; 3000], &vec![0.0; 3000], &two), E::TooLarge { .. }));
    for plane in [-1.0, 360.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(&[plane], &ends, &two), E::PlaneOutOfRange { index: 0, .. }));
    }
    for gamma in [-1.0, 180.1, f64::NAN, f64::NEG_INFINITY] {
        assert!(matches!(
            refused(&[0.0], &[0.0, gamma], &two),
            E::GammaOutOfRange { index: 1, .. }
        ));
    }
    for gamma in [40.0, 30.0, 40.0 + 1e-9] {
        let gammas = [40.0, gamma];
        assert!(matches!(refused(&[0.0], &gammas, &two), E::GammasNotIncreasing { index: 1, .. }));
    }
    for system in [AngleSystem::A, AngleSystem::B] {
        let refused = |planes: &[f64]| {
            let candela = vec![1.0; 2 * planes.len()];
            PhotometricWeb::in_system(system, planes.to_vec(), ends.to_vec(), candela).unwrap_err()
        };
        assert!(matches!(refused(&[90.0]), E::TooFewAngles { planes: 1, least: 2, .. }));
        assert!(matches!(refused(&[0.0, 180.1]), E::PlaneOutOfRange { index: 1, .. }));
    }
    let four = [1.0; 4];
    for plane in [90.0, 0.0] {
        let planes = [90.0, plane];
        assert!(matches!(refused(&planes, &ends, &four), E::PlanesNotIncreasing { index: 1, .. }));
    }
    for cd in [-1.0, f64::NAN, f64::INFINITY, 2e30] {
        let found = refused(&[0.0, 90.0], &ends, &[1.0, 1.0, 1.0, cd]);
        assert!(matches!(found, E::BadIntensity { plane: 1, gamma: 1, .. }));
        assert!(found.to_string().contains("plane 1, gamma angle 1"), "{found}");
    }
}

#[test]
fn a_web_of_darkness_is_a_web_without_samples() {
    let web = axial(vec![0.0, 90.0], |_| 0.0);
    assert_eq!((web.luminous_flux_lm(), web.sample([0.5, 0.5])), (0.0, None));
}

#[test]
fn the_brightest_table_still_has_a_finite_flux() {
    let web = axial((0..=180).map(f64::from).collect(), |_| 1e30);
    assert!(web.luminous_flux_lm().is_finite());
    assert_eq!(web.scaled(1e30).max_intensity_cd(), 1e30);
    assert_eq!(web.scaled(f64::NAN).luminous_flux_lm(), 0.0);
}

#[test]
fn the_thinnest_strip_is_sampled_inside_itself() {
    let web = axial(vec![89.999_999, 90.0], |_| 3.0);
    for k in 0..100 {
        let d = web.sample([f64::from(k) / 100.0, 0.25]).unwrap();
        assert!(web.intensity_cd(d) > 0.0 || k == 0, "{k}");
    }
}

fn deserialized(candela: Vec<f64>) -> Result<PhotometricWeb, Error> {
    let fields = [("planes_deg", vec![0.0]), ("gammas_deg", vec![0.0, 90.0]), ("candela", candela)];
    PhotometricWeb::deserialize(MapDeserializer::new(fields.into_iter()))
}

#[test]
fn a_stored_web_is_checked_and_its_sums_are_made_anew() {
    assert_eq!(deserialized(vec![3.0, 4.0]), Ok(axial(vec![0.0, 90.0], |g| 3.0 + g / 90.0)));
    let refusal = deserialized(vec![3.0, -4.0]).unwrap_err().to_string();
    assert!(refusal.contains("-4 cd at plane 0, gamma angle 1"), "{refusal}");
}

#[test]
fn a_stored_web_keeps_its_system() {
    let web = floodlight(AngleSystem::B);
    let stored = serde_json::to_string(&web).unwrap();
    assert_eq!(serde_json::from_str::<PhotometricWeb>(&stored).unwrap(), web);
    // Webs of the system C are stored as they always were.
    assert!(!serde_json::to_string(&lopsided()).unwrap().contains("system"));
}
