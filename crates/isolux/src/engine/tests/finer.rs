//! Maps that are shown with finer shadows.

use super::*;
use crate::elements::PlaceOnSide;
use crate::engine::{
    Finer, FinerSettings, MapReader, PictureLight, ShadowRays, Solution, SolveRequest, Watch,
    reference_lx, solve,
};
use crate::map::IlluminationMap;
use crate::sampling::{Key, Sequence};

/// A room with a lamp near the ceiling and a table below it, which throws a sharp shadow.
fn room() -> Scene {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.push(rectangle([1.5, 1.0, 0.7], [1.0, 0.0, 0.0], [0.0, 0.8, 0.0], 0));
    let parts = SceneParts {
        shapes,
        materials: vec![painted(Rgb::grey(0.5))],
        luminaires: vec![isotropic([1.7, 1.6, 2.2], 200.0)],
        ..SceneParts::default()
    };
    Scene::assemble(parts).unwrap()
}

fn coarse(scene: &Scene) -> IlluminationMap {
    let request =
        SolveRequest { accuracy: Some(0.05), mesh_accuracy: 0.5, ..SolveRequest::default() };
    let Solution { map, .. } = solve(scene, &request, None, &mut |_| Watch::Continue).unwrap();
    map
}

fn finer(scene: &Scene, map: &IlluminationMap, least_edge_m: f64) -> IlluminationMap {
    let mut finer = Finer::new(scene, map);
    let how = FinerSettings { least_edge_m, most_vertices: 200_000 };
    assert!(!finer.refine(&how, &mut || true), "nothing is left to do");
    finer.map()
}

/// Root mean square of what a bare map errs by at places of the floor, beside direct light afresh, lx.
fn off_lx(scene: &Scene, of: &IlluminationMap, map: &IlluminationMap) -> f64 {
    let reader = MapReader::new(scene, map);
    let sequence = Sequence::new(Key::new(3));
    let floor: Vec<u32> = (0..scene.triangle_count())
        .filter(|&t| scene.triangle(t).corners.iter().all(|c| c.z == 0.0))
        .collect();
    let squares = (0..4000).filter_map(|k| {
        let mut dice = crate::engine::ray::Dice::new(sequence, k);
        let ([a, b], pick) = (dice.pair(), dice.pair()[0]);
        let (u, v) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
        let triangle = floor[(pick * floor.len() as f64) as usize];
        let back = map.interpolate(triangle, false, u, v).is_none();
        let rays = ShadowRays { fewest: 8, most: 32 };
        let place = PlaceOnSide { triangle, back, uv: [u, v] };
        let glance = reader.glance(place, (0, rays), PictureLight::default())?;
        let true_lx = glance.illuminance_lx();
        let shown_lx = of.interpolate(triangle, back, u, v)?.illuminance_lx();
        Some((shown_lx - true_lx).powi(2))
    });
    let squares: Vec<f64> = squares.collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn shadows_become_sharp_as_edges_become_short() {
    let scene = room();
    let map = coarse(&scene);
    let before_lx = off_lx(&scene, &map, &map);
    let [middling, fine] = [0.1, 0.02].map(|least_edge_m| finer(&scene, &map, least_edge_m));
    let [middling_lx, fine_lx] = [&middling, &fine].map(|of| off_lx(&scene, of, &map));
    // What errs lies within an edge of the border of the shadow: the mean square falls as its length does. What nobody sees is left.
    let unseen_lx = 0.02 * reference_lx(&map);
    let expected_lx = f64::hypot(middling_lx / 5.0_f64.sqrt(), unseen_lx);
    assert!(fine_lx < expected_lx, "{before_lx} {middling_lx} {fine_lx} for {expected_lx}");
    assert!(fine_lx < 0.35 * before_lx, "{before_lx} {middling_lx} {fine_lx}");
}

#[test]
fn what_was_known_stays() {
    let scene = room();
    let map = coarse(&scene);
    let fine = finer(&scene, &map, 0.05);
    let all: Vec<[u64; 3]> = fine
        .elements
        .vertices()
        .iter()
        .map(|v| <[f64; 3]>::from(v.position).map(f64::to_bits))
        .collect();
    let mut values: Vec<f64> = fine.values.iter().flatten().map(|v| v.illuminance_lx()).collect();
    values.sort_by(f64::total_cmp);
    for (vertex, value) in map.elements.vertices().iter().zip(&map.values) {
        assert!(all.contains(&<[f64; 3]>::from(vertex.position).map(f64::to_bits)));
        let Some(value) = value else { continue };
        assert!(values.binary_search_by(|v| v.total_cmp(&value.illuminance_lx())).is_ok());
    }
    assert_eq!(fine, finer(&scene, &map, 0.05), "the same again");
}

#[test]
fn it_stops_when_told_and_at_its_limit() {
    let scene = room();
    let map = coarse(&scene);
    let mut finer = Finer::new(&scene, &map);
    let how = FinerSettings { least_edge_m: 1e-3, most_vertices: map.values.len() + 100 };
    assert!(finer.refine(&how, &mut || false), "it was not let");
    assert_eq!(finer.vertices(), map.values.len());
    assert!(!finer.refine(&how, &mut || true));
    // One bisection goes on over neighbours: a few more than asked for.
    assert!(finer.vertices() < map.values.len() + 200, "{}", finer.vertices());
}
