//! Maps added.

use super::*;
use crate::engine::combine::mix;
use crate::engine::{
    MapReader, MixError, MixPart, ProbePoint, Solution, SolveRequest, Watch, solve,
};
use crate::map::IlluminationMap;
use isolux_geometry::Normal;

/// A grey room, 4 m by 3 m by 2.5 m, with a lamp near one end, another near the other, and a panel that
/// shines in the ceiling.
fn room() -> Scene {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.push(rectangle([1.8, 1.3, 2.4], [0.0, 0.4, 0.0], [0.4, 0.0, 0.0], 1));
    let lamp = |x: f64, cd: f64, group: u32| Luminaire { group, ..isotropic([x, 1.5, 2.0], cd) };
    let parts = SceneParts {
        shapes,
        materials: vec![painted(Rgb([0.6, 0.5, 0.4])), glowing(900.0)],
        luminaires: vec![lamp(0.8, 100.0, 1), lamp(3.2, 40.0, 2), lamp(0.5, 30.0, 1)],
        groups: ["panel", "left", "right"].map(str::to_owned).into(),
        ..SceneParts::default()
    };
    Scene::assemble(parts).unwrap()
}

fn solved(scene: &Scene, seed: u64) -> IlluminationMap {
    let request = SolveRequest { accuracy: Some(0.04), seed, ..SolveRequest::default() };
    let Solution { map, .. } = solve(scene, &request, None, &mut |_| Watch::Continue).unwrap();
    assert!(map.provenance.complete, "{:?}", map.provenance);
    map
}

fn part<'a>(scene: &'a Scene, map: &'a IlluminationMap, dimming: f64) -> MixPart<'a> {
    MixPart { scene, map, dimming }
}

fn near(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{what}: {found} for {expected}");
}

#[test]
fn groups_share_out_the_light() {
    let whole = room();
    let groups: Vec<Scene> = (0..3).map(|group| whole.lit_by(group).unwrap()).collect();
    let lamps: Vec<usize> = groups.iter().map(|scene| scene.luminaires().len()).collect();
    let panels: Vec<usize> = groups.iter().map(|scene| scene.area_luminaires().len()).collect();
    assert_eq!((lamps, panels), (vec![0, 2, 1], vec![1, 0, 0]));
    assert!(whole.lit_by(3).is_none(), "there is no such group");
    for scene in &groups {
        assert_eq!(scene.surfaces_hash(), whole.surfaces_hash());
        assert_ne!(scene.hash(), whole.hash());
    }
    let dims = [0.5, 2.0, 0.0];
    let dimmed: Vec<(&Scene, f64)> = groups.iter().zip(dims).collect();
    let mixed = Scene::mixed(&dimmed);
    assert_eq!(mixed.luminaires().len(), 2, "those that are off are left out");
    let expected: f64 =
        groups.iter().zip(dims).map(|(scene, by)| scene.luminous_flux_lm() * by).sum();
    near(mixed.luminous_flux_lm(), expected, "flux");
}

#[test]
fn one_map_alone_is_itself() {
    let scene = room().lit_by(1).unwrap();
    let map = solved(&scene, 1);
    let (same, sum) = mix(&[part(&scene, &map, 1.0)]).unwrap();
    assert_eq!(same.luminaires(), scene.luminaires());
    assert_eq!(sum.values.len(), map.values.len());
    let place = |map: &IlluminationMap, v: usize| map.elements.vertices()[v].position;
    // Vertices may come in another order; every one has its value.
    let key = |p: Point| [p.x, p.y, p.z].map(f64::to_bits);
    let sorted = |map: &IlluminationMap| {
        let mut all: Vec<_> = (0..map.values.len())
            .map(|v| (key(place(map, v)), map.values[v].map(|e| e.illuminance_lx().to_bits())))
            .collect();
        all.sort_unstable();
        all
    };
    assert!(sorted(&sum) == sorted(&map), "the values differ");
    let (a, b) = (sum.provenance.accuracy.unwrap(), map.provenance.accuracy.unwrap());
    for (found, expected, what) in [
        (a.reached, b.reached, "reached"),
        (a.statistical, b.statistical, "statistical"),
        (a.discretization, b.discretization, "discretization"),
        (a.bias, b.bias, "bias"),
        (a.interpolated, b.interpolated, "interpolated"),
    ] {
        assert!((found - expected).abs() <= 1e-9 * b.reached, "{what}: {found} for {expected}");
    }
}

#[test]
fn noise_adds_in_squares_where_it_is_independent() {
    let scene = room().lit_by(1).unwrap();
    let (one, other) = (solved(&scene, 1), solved(&scene, 2));
    let statistical =
        |parts: &[MixPart<'_>]| mix(parts).unwrap().1.provenance.accuracy.unwrap().statistical;
    let of = |map: &IlluminationMap| map.provenance.accuracy.unwrap().statistical;
    let same = statistical(&[part(&scene, &one, 0.5), part(&scene, &one, 0.5)]);
    assert!((same / of(&one) - 1.0).abs() < 1e-9, "the same noise twice is no less: {same}");
    let apart = statistical(&[part(&scene, &one, 0.5), part(&scene, &other, 0.5)]);
    let expected = 0.5 * libm::hypot(of(&one), of(&other));
    // Root mean squares of the light of two runs differ by their noise.
    assert!((apart / expected - 1.0).abs() < 0.02, "{apart} for {expected}");
}

/// The sum of groups against a run of the whole scene, at places that are nobody's vertices.
#[test]
fn the_sum_of_groups_is_the_light_of_the_dimmed_scene() {
    let whole = room();
    let groups: Vec<Scene> = (0..3).map(|group| whole.lit_by(group).unwrap()).collect();
    let maps: Vec<IlluminationMap> = (0..3).map(|k| solved(&groups[k], 10 + k as u64)).collect();
    let dims = [0.6, 0.25, 1.0];
    let parts: Vec<MixPart<'_>> = (0..3).map(|k| part(&groups[k], &maps[k], dims[k])).collect();
    let (scene, sum) = mix(&parts).unwrap();
    assert_eq!(sum.provenance.scene_hash, scene.hash());
    let direct = solved(&scene, 20);
    let readers = [MapReader::new(&scene, &sum), MapReader::new(&scene, &direct)];
    let (mut squared, mut count) = (0.0, 0);
    for k in 0..40 {
        let along = (f64::from(k) + 0.5) / 40.0;
        let position = Point::from([4.0 * along, 3.0 * ((7.0 * along) % 1.0), 0.0]);
        let at = ProbePoint { position, normal: Normal::Z };
        let [a, b] = readers.each_ref().map(|reader| reader.probe(at).unwrap());
        let error = libm::hypot(a.standard_error_lx, b.standard_error_lx);
        let off = (a.illuminance_lx() - b.illuminance_lx()) / error;
        assert!(off.abs() < SIGMAS, "{position:?}: {a:?} and {b:?}");
        squared += off * off;
        count += 1;
    }
    assert!(squared / f64::from(count) > 0.01, "errors are far too large: {squared}");
    let parts = &sum.provenance.mixed;
    assert_eq!(parts.iter().map(|p| p.dimming).collect::<Vec<_>>(), dims);
    assert_eq!(parts[1].groups, ["left"]);
}

#[test]
fn what_cannot_be_added_is_refused() {
    let scene = room().lit_by(1).unwrap();
    let map = solved(&scene, 1);
    let mut other = scene.to_parts();
    other.materials[0] = painted(Rgb::grey(0.1));
    let other = Scene::assemble(other).unwrap();
    let brighter = Scene::mixed(&[(&scene, 2.0)]);
    for (parts, expected) in [
        (vec![], MixError::Dark),
        (vec![part(&scene, &map, 0.0)], MixError::Dark),
        (vec![part(&scene, &map, -1.0)], MixError::Dimming(0)),
        (vec![part(&scene, &map, f64::NAN)], MixError::Dimming(0)),
        (vec![part(&scene, &map, 1.0), part(&other, &map, 1.0)], MixError::Surfaces(1)),
        (vec![part(&scene, &map, 1.0), part(&brighter, &map, 1.0)], MixError::Stale(1)),
    ] {
        assert_eq!(mix(&parts).err(), Some(expected));
    }
}

#[test]
fn a_room_that_a_group_does_not_light_is_known_by_another() {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    for mut shape in inward_box([3.0, 3.0, 2.5], 0) {
        shape.positions.iter_mut().for_each(|p| p[0] += 5.0);
        shapes.push(shape);
    }
    let lamp = |x: f64, cd: f64, group: u32| Luminaire { group, ..isotropic([x, 1.5, 2.0], cd) };
    let parts = SceneParts {
        shapes,
        materials: vec![painted(Rgb::grey(0.5))],
        luminaires: vec![lamp(2.0, 100.0, 0), lamp(6.5, 60.0, 1)],
        groups: ["a", "b"].map(str::to_owned).into(),
        ..SceneParts::default()
    };
    let whole = Scene::assemble(parts).unwrap();
    let groups: Vec<Scene> = (0..2).map(|group| whole.lit_by(group).unwrap()).collect();
    let maps: Vec<IlluminationMap> = (1..).zip(&groups).map(|(k, g)| solved(g, k)).collect();
    let unknown = maps[0].values.iter().filter(|v| v.is_none()).count();
    assert!(unknown > 0, "the first group knows nothing of the second room");
    let all: Vec<MixPart<'_>> =
        groups.iter().zip(&maps).map(|(scene, map)| part(scene, map, 1.0)).collect();
    let (_, map) = mix(&all).unwrap();
    assert!(map.values.iter().all(Option::is_some));
    assert!(map.provenance.accuracy.is_some_and(|a| a.reached < 0.08), "no less than the worse");
    let mean_lx = |map: &IlluminationMap| {
        let vertices = map.elements.vertices().iter().zip(&map.values);
        vertices.filter_map(|(v, e)| Some(v.area_m2 * e.as_ref()?.illuminance_lx())).sum::<f64>()
    };
    near(mean_lx(&map), mean_lx(&maps[0]) + mean_lx(&maps[1]), "flux that arrives");
}
