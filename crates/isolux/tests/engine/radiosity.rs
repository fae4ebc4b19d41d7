//! Radiosity alone: what is unshot, what stands in its place, what is left out.

use crate::rooms::{inward_box, lamp, mirror, painted, rectangle, scene};
use crate::runs::{coarse, run};
use isolux::engine::{RadiositySettings, SoFar, SolveRequest, Stage, Watch, solve_looked_at};
use isolux::map::{IlluminationMap, Method};
use isolux::scene::Scene;

fn room() -> Scene {
    let walls = inward_box([0.0; 3], [3.0, 2.0, 2.5], 0);
    scene(walls, vec![painted(0.6)], vec![lamp([1.0, 1.2, 1.5], 100.0)])
}

fn request(settings: RadiositySettings) -> SolveRequest {
    let accuracy = Some(0.02);
    SolveRequest { accuracy, radiosity: settings, ..coarse(Method::Radiosity, 1600) }
}

fn mean_lx(map: &IlluminationMap) -> f64 {
    let vertices = map.elements.vertices().iter().zip(0..);
    let (lumen, m2) = vertices.fold((0.0, 0.0), |(lumen, m2), (vertex, k)| {
        let lx = map.read_at_vertex(k).map_or(0.0, |value| value.illuminance_lx());
        (lumen + lx * vertex.area_m2, m2 + vertex.area_m2)
    });
    lumen / m2
}

/// Mean illuminance, share unshot and error reported after every shot.
fn on_the_way(ambient: bool) -> Vec<(f64, f64, f64)> {
    let mut seen = Vec::new();
    let settings = RadiositySettings { ambient, ..RadiositySettings::default() };
    let watch = &mut |progress: &isolux::engine::Progress, so_far: &SoFar| {
        if progress.stage == Stage::Increments {
            let map = so_far.map().expect("there is a map after every shot");
            let unshot = progress.unshot.expect("radiosity knows");
            let error = progress.accuracy.expect("check points know").reached;
            seen.push((mean_lx(&map), unshot, error));
        }
        Watch::Continue
    };
    solve_looked_at(&room(), &request(settings), None, watch).expect("the scene has light");
    seen
}

#[test]
fn what_is_unshot_fades_and_the_whole_scene_is_seen_from_the_first_shot() {
    let seen = on_the_way(true);
    assert!(seen.len() >= 6, "every wall shoots: {seen:?}");
    let unshot: Vec<f64> = seen.iter().map(|s| s.1).take(6).collect();
    assert!(unshot.is_sorted_by(|a, b| a > b), "{unshot:?}");
    // 4 pi 100 lm over 37 m2, of which 0.4 is absorbed; what the pilot expects is rough.
    let exact = 4.0 * std::f64::consts::PI * 100.0 / 37.0 / 0.4;
    for (lx, _, error) in &seen {
        assert!((lx / exact - 1.0).abs() < 0.1, "{lx} of {exact} lx");
        assert!((lx / exact - 1.0).abs() < 3.0 * error, "{lx} of {exact} lx, error {error}");
    }
}

#[test]
fn without_the_ambient_term_unshot_light_is_dark() {
    let (with, without) = (on_the_way(true), on_the_way(false));
    assert!(without[0].0 < 0.8 * with[0].0, "{} {}", without[0].0, with[0].0);
    let ends = [with, without].map(|seen| seen.last().expect("shots").0);
    assert!((ends[0] / ends[1] - 1.0).abs() < 0.02, "{ends:?}");
}

#[test]
fn a_limit_set_by_hand_stops_the_shots() {
    let settings = RadiositySettings { unshot: Some(0.5), ..RadiositySettings::default() };
    let accuracy = Some(1e-4);
    let request = SolveRequest { accuracy, ..request(settings) };
    let map = run(&room(), &request, 1000).expect("the scene has light").map;
    let unshot = map.provenance.unshot.expect("of radiosity").share;
    assert!(unshot <= 0.5 && !map.provenance.complete, "{unshot}");
}

#[test]
fn a_diffuse_scene_has_no_mirrors() {
    let mut walls = inward_box([0.0; 3], [3.0, 2.0, 2.5], 0);
    walls.push(rectangle([0.01, 0.2, 0.2], [0.0, 1.6, 0.0], [0.0, 0.0, 2.0], 1));
    let lamps = vec![lamp([1.0, 1.2, 1.5], 100.0)];
    let with = scene(walls, vec![painted(0.6), mirror(1.0)], lamps);
    let without = with.diffuse_only().expect("the same but for its materials");
    let mean = |scene: &Scene| {
        let request = request(RadiositySettings::default());
        mean_lx(&run(scene, &request, 100).expect("the scene has light").map)
    };
    // The mirror takes 3.2 of 37 m2, which absorb what they would have reflected.
    let ratio = mean(&without) / mean(&with);
    assert!(ratio < 0.95, "{ratio}");
}
