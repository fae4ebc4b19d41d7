//! The scenes are there, valid and different.

use super::places::{Stratum, places};
use super::{COUNT, Half, KINDS, TruthScene};
use isolux::scene::Scene;
use std::collections::BTreeSet;

fn scene(of: TruthScene) -> Scene {
    Scene::assemble(of.parts()).unwrap_or_else(|problems| panic!("{}: {problems:?}", of.name()))
}

#[test]
fn all_are_valid_and_lit_and_no_two_are_alike() {
    let hashes: BTreeSet<String> = TruthScene::all()
        .map(|of| {
            let scene = scene(of);
            assert!(scene.gives_light(), "{}", of.name());
            assert_eq!(scene.name(), of.name());
            scene.hash()
        })
        .collect();
    assert_eq!((COUNT, hashes.len()), (60, 60));
}

#[test]
fn a_seed_gives_the_same_scene_and_another_seed_another() {
    for of in TruthScene::all() {
        assert_eq!(of.parts(), of.parts());
        let other = TruthScene::parse(&format!("{},seed=2", of.name())).unwrap();
        assert_ne!(scene(of).hash(), scene(other).hash(), "{}", of.name());
    }
}

#[test]
fn every_kind_is_in_both_halves() {
    let of = |half: Half| {
        TruthScene::all().filter(|s| s.half() == half).map(TruthScene::kind).collect::<Vec<_>>()
    };
    assert_eq!(of(Half::Tuning), of(Half::Judging));
    assert_eq!(of(Half::Tuning).len(), KINDS.len());
}

#[test]
fn names_are_read_in_one_way() {
    for of in TruthScene::all() {
        assert_eq!(TruthScene::parse(&of.name()), Some(of));
    }
    for name in
        ["truth-60", "truth-7", "truth-", "truth-é", "truth-007", "truth-07,seed=", "truth-07;"]
    {
        assert_eq!(TruthScene::parse(name), None, "{name}");
    }
}

/// From 1 to 500 luminaires, and none larger than a minute's work.
#[test]
fn scenes_are_of_usual_sizes() {
    let counts = TruthScene::all().map(|of| {
        let scene = scene(of);
        assert!(scene.triangle_count() < 5000, "{}: {}", of.name(), scene.triangle_count());
        scene.luminaires().len() + scene.area_luminaires().len()
    });
    let counts: Vec<usize> = counts.collect();
    assert_eq!(counts.iter().min(), Some(&1));
    assert!(counts.iter().all(|&n| n <= 500) && counts.iter().any(|&n| n > 100), "{counts:?}");
}

#[test]
fn places_lie_where_they_are_meant_to() {
    let scene = scene(TruthScene::parse("truth-00").unwrap());
    let found = places(&scene, 200, 20, 1);
    assert_eq!(found, places(&scene, 200, 20, 1));
    let of = |stratum| found.iter().filter(move |place| place.stratum == stratum);
    assert_eq!(of(Stratum::Area).count(), 200);
    // A fifth of the surface at least is walls; they come up by area, and cupboards by number.
    let on = |stratum, name: &str| of(stratum).filter(|place| place.surface == name).count();
    assert!(on(Stratum::Area, "wall") > 40);
    assert!(on(Stratum::Small, "wall") < 4);
    assert_eq!(of(Stratum::Edge).count(), 20);
    assert_eq!(of(Stratum::Lamp).count(), 20);
}
