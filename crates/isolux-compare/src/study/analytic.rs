//! The analytic cases of CIE 171:2006 through systems: what they find at places whose right values are known.

use super::system::System;
use crate::case::cie171::CASES;
use crate::case::find;
use crate::expectation::{Case, Quantity};
use isolux::engine::{MapReader, ProbePoint};
use isolux::map::IlluminationMap;
use isolux::scene::{Scene, SceneProblem};
use serde::{Deserialize, Serialize};

/// A case and what systems find.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Analytic {
    /// Its number in the standard.
    pub number: String,
    /// What it is about.
    pub title: String,
    /// Its name in `isolux validate`.
    pub name: String,
    /// Right values at its places, lx.
    pub expected_lx: Vec<f64>,
    /// One a system, in the order of [`System::ALL`].
    pub found: Vec<Found>,
}

/// What a system finds at the places of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Which.
    pub system: System,
    /// What it took, s.
    pub time_s: f64,
    /// As it reads, lx; `None` where it knows nothing.
    pub values_lx: Vec<Option<f64>>,
    /// Standard errors as told, lx.
    pub standard_errors_lx: Vec<Option<f64>>,
}

impl Found {
    /// The greatest relative difference, without sign; `None` where a place is not known.
    pub fn worst(&self, expected_lx: &[f64]) -> Option<f64> {
        let share = |(lx, right): (&Option<f64>, &f64)| Some(((*lx)? / right - 1.0).abs());
        let shares = self.values_lx.iter().zip(expected_lx).map(share);
        shares.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
    }
}

/// A place whose whole light is known and not nothing: an error relative to nothing is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LitPlace {
    /// Where.
    pub at: ProbePoint,
    /// The right value, lx.
    pub expected_lx: f64,
    /// What the scene as tessellated may be off by, lx.
    pub bound_lx: f64,
}

/// All such places of a case.
pub fn lit_places(case: &Case) -> Vec<LitPlace> {
    let expectations = (case.expectations)();
    let lit =
        expectations.iter().filter(|e| e.quantity == Quantity::Total && !e.expected_lx.is_black());
    lit.map(|e| LitPlace { at: e.at, expected_lx: e.expected_lx.luminance(), bound_lx: e.bound.lx })
        .collect()
}

/// A case with its scene, before systems are asked.
pub struct AnalyticCase {
    /// Nothing found yet.
    pub analytic: Analytic,
    /// Its scene.
    pub scene: Scene,
    /// Where it is read.
    pub places: Vec<LitPlace>,
}

/// All cases of the standard.
pub fn analytic_cases() -> Result<Vec<AnalyticCase>, SceneProblem> {
    let named = CASES.iter().flat_map(|of| of.names.iter().map(move |name| (of, name)));
    let one = |(of, name): (&crate::case::cie171::Listed, &&'static str)| {
        let case = find(name)?;
        let scene = match Scene::assemble((case.parts)()) {
            Ok(scene) => scene,
            Err(mut problems) => return Some(Err(problems.swap_remove(0))),
        };
        let places = lit_places(&case);
        let analytic = Analytic {
            number: of.number.to_owned(),
            title: of.title.to_owned(),
            name: (*name).to_owned(),
            expected_lx: places.iter().map(|place| place.expected_lx).collect(),
            found: Vec::new(),
        };
        Some(Ok(AnalyticCase { analytic, scene, places }))
    };
    named.filter_map(one).collect()
}

/// What a map reads at the places of a case.
pub fn found_in_map(
    system: System,
    time_s: f64,
    (scene, map): (&Scene, &IlluminationMap),
    places: &[LitPlace],
) -> Found {
    let reader = MapReader::new(scene, map);
    let read: Vec<_> = places.iter().map(|place| reader.probe(place.at)).collect();
    Found {
        system,
        time_s,
        values_lx: read.iter().map(|of| Some(of.as_ref()?.illuminance_lx())).collect(),
        standard_errors_lx: read
            .iter()
            .map(|of| of.as_ref().map(|of| of.standard_error_lx).filter(|e| e.is_finite()))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_relative_and_unknown_is_not_right() {
        let found = |values_lx: Vec<Option<f64>>| Found {
            system: System::Hybrid,
            time_s: 1.0,
            standard_errors_lx: vec![None; values_lx.len()],
            values_lx,
        };
        let of = found(vec![Some(103.0), Some(196.0)]);
        let expected_lx = [100.0, 200.0];
        // Three digits and a division.
        let is_near = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-12;
        assert!(is_near(of.worst(&expected_lx), 0.03));
        assert_eq!(found(vec![Some(100.0), None]).worst(&expected_lx), None);
        assert_eq!(found(vec![None, None]).worst(&expected_lx), None);
    }

    #[test]
    fn every_case_of_the_standard_has_places_with_light() {
        for case in analytic_cases().unwrap() {
            assert!(!case.places.is_empty(), "{}", case.analytic.name);
            assert!(case.places.iter().all(|place| place.expected_lx > 0.0));
        }
    }
}
