//! The operator of transport: enclosures whose light is known whatever their shape.

use super::*;
use crate::elements::{Elements, Subdivision};
use crate::engine::gather::{DirectAtEnds, Gatherer, Gathering, GivenRow, Operator, known_weights};
use crate::engine::light::Lighting;
use crate::engine::mesh::Carriers;
use crate::map::Standing;
use std::f64::consts::PI;

fn elements_of(scene: &Scene, rays: u32) -> (Elements, Vec<Gatherer>) {
    let mut subdivision = Subdivision::new(scene);
    subdivision.bisect_to(0.9, usize::MAX);
    let receivers = subdivision.receivers(0.01);
    let gatherers = receivers.iter().map(|r| Gatherer::at_vertex(scene, r, rays)).collect();
    (subdivision.elements(), gatherers)
}

/// The operator of a scene over its own vertices, direct light read from the map.
fn operator(scene: &Scene, elements: &Elements, gatherers: &[Gatherer]) -> Operator {
    let lighting = Lighting::new(scene);
    let standings = vec![Some(Standing::Open); elements.vertices().len()];
    let black = vec![Rgb::BLACK; standings.len()];
    let gathering = Gathering {
        scene,
        lighting: &lighting,
        elements,
        level: u32::MAX,
        standings: &standings,
        direct: DirectAtEnds::Read { values: &black, level: u32::MAX },
        regathers: false,
        bright: None,
        cuts: None,
        backdrop: None,
    };
    gathering.operator(gatherers, |k| Key::new(1).with(k as u64))
}

const REFLECTANCE: Rgb = Rgb::new(0.9, 0.5, 0.1);

fn room() -> Scene {
    scene(inward_box([3.0, 2.0, 2.5], 0), vec![painted(REFLECTANCE)], vec![])
}

/// Weights of a ray are stored in `f32`.
const STORED: f64 = 1e-6;

#[test]
fn a_furnace_settles_where_all_light_is_alike() {
    let scene = room();
    let (elements, gatherers) = elements_of(&scene, 32);
    let operator = operator(&scene, &elements, &gatherers);
    let n = gatherers.len();
    let given = vec![Rgb::new(7.0, 5.0, 3.0); n];
    let expected = Rgb::new(7.0, 5.0, 3.0) * REFLECTANCE.map(|rho| rho / (1.0 - rho));
    for guess in [Rgb::BLACK, Rgb::grey(1e4)] {
        let solved =
            operator.solve(&vec![guess; n], &given, &Carriers::all().waiting(), (1e-9, &NEVER));
        for e in solved {
            for c in 0..3 {
                // An error of a ray's weight is reflected as the light is.
                let allowed = STORED / (1.0 - REFLECTANCE.0[c]) * expected.0[c];
                assert!((e.0[c] - expected.0[c]).abs() < allowed, "{e:?} for {expected:?}");
            }
        }
    }
}

#[test]
fn one_application_reflects_once() {
    let scene = room();
    let (elements, gatherers) = elements_of(&scene, 32);
    let operator = operator(&scene, &elements, &gatherers);
    assert_eq!(operator.rays, 32 * gatherers.len() as u64);
    for e in operator.apply(&vec![Rgb::WHITE; gatherers.len()]) {
        assert!((0..3).all(|c| (e.0[c] - REFLECTANCE.0[c]).abs() < STORED), "{e:?}");
    }
    // One wall of the box faces away from no other: all rays end on fronts.
    assert!(operator.open().iter().all(|open| !open));
}

#[test]
fn the_fixed_point_is_one() {
    let scene = room();
    let (elements, gatherers) = elements_of(&scene, 32);
    let operator = operator(&scene, &elements, &gatherers);
    let given: Vec<Rgb> = (0..gatherers.len()).map(|k| Rgb::grey((k % 7) as f64)).collect();
    let solved = operator.solve(&given, &given, &Carriers::all().waiting(), (1e-10, &NEVER));
    let light: Vec<Rgb> = solved.iter().zip(&given).map(|(&e, &g)| e + g).collect();
    for (a, b) in operator.apply(&light).iter().zip(&solved) {
        // The last change was 1e-10 of the root mean square, of values of about ten.
        assert!((0..3).all(|c| (a.0[c] - b.0[c]).abs() < 1e-7), "{a:?} {b:?}");
    }
}

#[test]
fn a_dim_room_settles_beside_a_bright_one() {
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    for shape in inward_box([3.0, 2.0, 2.5], 0) {
        let positions = shape.positions.iter().map(|&[x, y, z]| [x + 9.0, y, z]).collect();
        shapes.push(Shape { positions, ..shape });
    }
    let scene = scene(shapes, vec![painted(REFLECTANCE)], vec![]);
    let (elements, gatherers) = elements_of(&scene, 32);
    let operator = operator(&scene, &elements, &gatherers);
    let is_dim: Vec<bool> = elements.vertices().iter().map(|v| v.position.x > 5.0).collect();
    let given: Vec<Rgb> =
        is_dim.iter().map(|&dim| Rgb::grey(if dim { 1.0 } else { 1e4 })).collect();
    // The bright one is right from the start.
    let shares = REFLECTANCE.map(|rho| rho / (1.0 - rho));
    let guess: Vec<Rgb> =
        is_dim.iter().map(|&dim| if dim { Rgb::BLACK } else { shares * 1e4 }).collect();
    let solved = operator.solve(&guess, &given, &Carriers::all().waiting(), (1e-3, &NEVER));
    for (e, _) in solved.iter().zip(&is_dim).filter(|(_, dim)| **dim) {
        // The last sweep may have changed it by ten times the tolerance, of which nine times as much is left at 0.9.
        assert!((0..3).all(|c| (e.0[c] / shares.0[c] - 1.0).abs() < 0.09), "{e:?} for {shares:?}");
    }
}

/// Form factor of a rectangle `a x b` in a parallel plane at distance `h` from a point below one of its
/// corners (Howell, "A catalog of radiation heat transfer configuration factors", B-3).
pub(super) fn corner_form_factor(a: f64, b: f64, h: f64) -> f64 {
    let (x, y) = (a / h, b / h);
    let part = |x: f64, y: f64| {
        let root = (1.0 + x * x).sqrt();
        x / root * libm::atan(y / root)
    };
    (part(x, y) + part(y, x)) / (2.0 * PI)
}

#[test]
fn what_leaves_through_an_opening_is_its_form_factor() {
    // The room without its ceiling, from the middle of the floor.
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    shapes.truncate(5);
    let scene = scene(shapes, vec![painted(Rgb::WHITE)], vec![]);
    let (elements, _) = elements_of(&scene, 32);
    let (up, rays) = (isolux_geometry::Normal::Z, 4096);
    let gatherer = Gatherer::in_space(&scene, Point::new(1.5, 1.0, 1e-6), up, rays);
    let operator = operator(&scene, &elements, &[gatherer]);
    let found = operator.apply(&vec![Rgb::WHITE; elements.vertices().len()])[0].luminance();
    let expected = 1.0 - 4.0 * corner_form_factor(1.5, 1.0, 2.5);
    // Independent rays would scatter by this; a net scatters less.
    let sigma = (expected * (1.0 - expected) / f64::from(rays)).sqrt();
    assert!((found - expected).abs() < SIGMAS * sigma, "{found} {expected}");
    assert_eq!(operator.open(), [true]);
}

#[test]
fn receivers_shut_in_by_black_backs_are_not_open() {
    // The room inside out: from inside all walls are black backs.
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    shapes.iter_mut().flat_map(|s| &mut s.triangles).for_each(|t| t.swap(1, 2));
    let scene = scene(shapes, vec![painted(REFLECTANCE)], vec![]);
    let (elements, _) = elements_of(&scene, 32);
    let inside =
        Gatherer::in_space(&scene, Point::new(1.0, 1.0, 1.0), isolux_geometry::Normal::Z, 64);
    let outside =
        Gatherer::in_space(&scene, Point::new(1.0, 1.0, 9.0), isolux_geometry::Normal::Z, 64);
    let operator = operator(&scene, &elements, &[inside, outside]);
    assert_eq!(operator.open(), [false, true]);
    let light = vec![Rgb::WHITE; elements.vertices().len()];
    assert_eq!(operator.apply(&light), [Rgb::BLACK; 2]);
}

#[test]
fn weights_go_to_what_is_known() {
    let corners = [(0, 0.2), (1, 0.3), (2, 0.5)];
    let [rim, gap, open] = Standing::ALL.map(Some);
    for (known, expected) in [
        ([open, open, open], Some([0.2, 0.3, 0.5])),
        ([open, open, None], Some([0.4, 0.6, 0.0])),
        ([open, open, gap], Some([0.4, 0.6, 0.0])),
        ([gap, rim, open], Some([0.0, 0.0, 1.0])),
        ([gap, gap, rim], Some([0.4, 0.6, 0.0])),
        ([rim, rim, rim], Some([0.2, 0.3, 0.5])),
        ([None, None, rim], Some([0.0, 0.0, 1.0])),
        ([None, None, None], None),
    ] {
        let found = known_weights(corners, &known);
        assert_eq!(found.is_some(), expected.is_some());
        for (a, b) in found.into_iter().flatten().zip(expected.into_iter().flatten()) {
            assert!((a - b).abs() < 1e-15, "{known:?}: {found:?}");
        }
    }
    // On the edge of two unknown vertices the third is all there is.
    let far = [(0, 0.0), (1, 0.4), (2, 0.6)];
    assert_eq!(known_weights(far, &[open, None, None]), Some([1.0, 0.0, 0.0]));
}

/// In a furnace every ray reads the same light, wherever it ends and however often it goes on; and
/// only what has gone on three times is read close by.
#[test]
fn rays_that_end_close_by_gather_again() {
    let scene = scene(inward_box([3.0, 2.0, 2.5], 0), vec![painted(Rgb::grey(0.5))], vec![]);
    // Walls as they are.
    let subdivision = Subdivision::new(&scene);
    let receivers = subdivision.receivers(0.01);
    let gatherers: Vec<Gatherer> =
        receivers.iter().map(|r| Gatherer::at_vertex(&scene, r, 64)).collect();
    let elements = subdivision.elements();
    let lighting = Lighting::new(&scene);
    let vertices = elements.vertices().len();
    let standings = vec![Some(Standing::Open); vertices];
    // Half of the light is direct, so that half of it, reflected, and that again make up the rest.
    let half = vec![Rgb::grey(0.5); vertices];
    let gathering = |regathers: bool| Gathering {
        scene: &scene,
        lighting: &lighting,
        elements: &elements,
        level: u32::MAX,
        standings: &standings,
        direct: DirectAtEnds::Read { values: &half, level: u32::MAX },
        regathers,
        bright: None,
        cuts: None,
        backdrop: None,
    };
    let [once, again] = [false, true]
        .map(|again| gathering(again).operator(&gatherers, |k| Key::new(1).with(k as u64)));
    for (read, regathered) in once.apply(&half).iter().zip(again.apply(&half)) {
        // Weights are stored in 32 bits.
        assert!((*read - Rgb::grey(0.5)).luminance().abs() < 1e-6, "{read:?}");
        assert!((regathered - Rgb::grey(0.5)).luminance().abs() < 1e-6, "{regathered:?}");
    }
    assert!(once.close().all(|close| close == 0.0), "nobody asked");
    let most = 0.5_f64.powi(4) * (1.0 + 1e-12);
    assert!(
        again.close().all(|close| close > 0.25 * most && close <= most),
        "of walls so long most is close"
    );
    assert!(again.rays > 2 * once.rays, "{} {}", again.rays, once.rays);
}

/// What rays from within a gap meet in it, where all vertices lie in the open, is not lost: they go on until they are out of it.
#[test]
fn rays_in_gaps_of_which_nothing_is_known_go_on() {
    let scene = scene(inward_box([3.0, 2.0, 0.6], 0), vec![painted(Rgb::WHITE)], vec![]);
    let subdivision = Subdivision::new(&scene);
    let receivers = subdivision.receivers(0.01);
    let gatherers = receivers.iter().map(|r| Gatherer::at_vertex(&scene, r, 64).in_gap(true));
    let gatherers: Vec<Gatherer> = gatherers.collect();
    let elements = subdivision.elements();
    let lighting = Lighting::new(&scene);
    let vertices = elements.vertices().len();
    let dark = vec![Rgb::BLACK; vertices];
    let operator = |standing: Standing| {
        let standings = vec![Some(standing); vertices];
        let gathering = Gathering {
            scene: &scene,
            lighting: &lighting,
            elements: &elements,
            level: u32::MAX,
            standings: &standings,
            direct: DirectAtEnds::Read { values: &dark, level: u32::MAX },
            regathers: false,
            bright: None,
            cuts: None,
            backdrop: None,
        };
        gathering.operator(&gatherers, |k| Key::new(1).with(k as u64))
    };
    let [open, gap] = [Standing::Open, Standing::Gap].map(operator);
    let light = vec![Rgb::WHITE; vertices];
    for (on, read) in open.apply(&light).iter().zip(gap.apply(&light)) {
        // Half of the rays get out at every step; weights are stored in 32 bits.
        assert!((*on - Rgb::WHITE).luminance().abs() < 1e-5, "{on:?}");
        assert!((read - Rgb::WHITE).luminance().abs() < 1e-5, "{read:?}");
    }
    assert!(open.rays > gap.rays, "{} {}", open.rays, gap.rays);
}

#[test]
fn what_is_read_is_read_by_somebody() {
    let scene = room();
    let (elements, gatherers) = elements_of(&scene, 32);
    let operator = operator(&scene, &elements, &gatherers);
    let alike = |k: usize, n: usize| ((k * 7 + n) % 11) as f64;
    let light: Vec<f64> = (0..gatherers.len()).map(|k| alike(k, 3)).collect();
    let receivers: Vec<f64> = (0..gatherers.len()).map(|k| alike(k, 5)).collect();
    let grey: Vec<Rgb> = light.iter().map(|&lx| Rgb::grey(lx)).collect();
    let gathered = operator.reflected(&grey).into_iter().zip(&receivers);
    let forward: f64 = gathered.map(|(e, of)| e.luminance() * of).sum();
    let read = operator.read_by(&receivers, receivers.len());
    let back: f64 = read.iter().zip(&light).map(|(read, lx)| read * lx).sum();
    // The same products, added up in another order.
    assert!((forward - back).abs() < 1e-9 * forward, "{forward} {back}");
}

#[test]
fn receivers_that_no_light_comes_to_have_none_at_once() {
    // The first has a light of its own, the second reads it, the third and the fourth read each other alone.
    let reading = |source: f64, vertex: u32| -> GivenRow {
        (Rgb::grey(source), vec![([vertex; 3], [0.5, 0.25, 0.25])])
    };
    let operator = Operator::of_rows(
        &[reading(1.0, 1), reading(0.0, 0), reading(0.0, 3), reading(0.0, 2)],
        0.9,
    );
    let black = [Rgb::BLACK; 4];
    let waiting = Carriers::all().waiting();
    let solved = operator.solve(&[Rgb::grey(100.0); 4], &black, &waiting, (1e-6, &NEVER));
    assert_eq!(solved[2..], [Rgb::BLACK; 2]);
    // E1 = 1 + 0.9 E2, E2 = 0.9 E1.
    assert!((solved[0].0[0] * 0.19 - 1.0).abs() < 1e-5, "{:?}", solved[0]);
    // Light that is given beside reaches them.
    let given = [Rgb::BLACK, Rgb::BLACK, Rgb::grey(1.0), Rgb::BLACK];
    let solved = operator.solve(&[Rgb::grey(100.0); 4], &given, &waiting, (1e-6, &NEVER));
    assert!((solved[3].0[0] * 0.19 - 0.9).abs() < 1e-5, "{:?}", solved[3]);
}
