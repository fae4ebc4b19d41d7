//! Scenes with exact answers, one idea a file.

pub mod cie171;
pub mod cube;
mod emitters;
mod full_sphere;
mod furnace;
mod glass;
mod many_luminaires;
mod mirrors;
pub mod sphere;
mod spots;

use crate::expectation::Case;

/// All cases.
pub fn cases() -> Vec<Case> {
    let mut all = Vec::from(cube::cases());
    all.push(sphere::case());
    all.extend(full_sphere::cases());
    all.extend(furnace::cases());
    all.extend(emitters::cases());
    all.extend(spots::cases());
    all.extend(mirrors::cases());
    all.push(many_luminaires::case());
    all.extend(glass::cases());
    all.extend(cie171::cases());
    all
}

/// A case by its name.
pub fn find(name: &str) -> Option<Case> {
    cases().into_iter().find(|case| case.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::scene::Scene;

    #[test]
    fn every_case_is_a_scene_with_finite_answers_and_a_name_of_its_own() {
        let all = cases();
        for case in &all {
            assert_eq!(all.iter().filter(|c| c.name == case.name).count(), 1, "{}", case.name);
            let parts = (case.parts)();
            assert_eq!(parts.name, case.name);
            let scene = Scene::assemble(parts).unwrap_or_else(|e| panic!("{}: {e:?}", case.name));
            assert!(scene.gives_light(), "{}", case.name);
            let expectations = (case.expectations)();
            assert!(!expectations.is_empty());
            for e in &expectations {
                assert!(e.expected_lx.is_finite() && e.expected_lx.min_channel() >= 0.0);
                assert!(
                    e.bound.lx >= 0.0 && e.bound.lx <= 1e-2 * e.expected_lx.max_channel(),
                    "{}: {e:?}",
                    case.name
                );
            }
        }
    }
}
