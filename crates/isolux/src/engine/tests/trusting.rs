//! Where maps are to be trusted.

use super::*;
use crate::elements::Subdivision;
use crate::engine::gather::Unlit;
use crate::engine::light::Lighting;
use crate::engine::mesh::{LeafError, Trust, TrustLevels, WorstElements, trust};
use crate::engine::occlusion::nearby;
use crate::engine::pilot::{PilotRequest, pilot};
use crate::engine::ray::{NEVER, SurfacePoint};

pub(super) fn errors(of: &[(f64, f64)]) -> Vec<LeafError> {
    let error = |(node, &(area_m2, error)): (usize, &(f64, f64))| LeafError {
        node: node as u32,
        area_m2,
        error,
        excess: 0.0,
        is_beset: false,
        is_beset_afar: false,
        weight: 1.0,
        seen: 0.0,
    };
    of.iter().enumerate().map(error).collect()
}

#[test]
fn the_worst_are_left_out_until_the_rest_is_good() {
    let all = errors(&[(1.0, 8.0), (6.0, 1.0), (2.0, 4.0), (1.0, 4.0)]);
    // Squares over 10 m2: 64, 6, 32 and 16.
    for (name, goal, most_share, expected) in [
        ("good as it is", 3.5, 1.0, f64::INFINITY),
        ("one is enough", 2.4, 1.0, 0.5 * (8.0 + 4.0)),
        ("all but the good ones", 0.8, 1.0, 0.5 * (4.0 + 1.0)),
        ("no more than a part of the area", 0.8, 0.15, 0.5 * (8.0 + 4.0)),
        ("none of it", 0.8, 0.05, f64::INFINITY),
    ] {
        assert_eq!(WorstElements::of(&all).limit(goal, most_share), expected, "{name}");
    }
    let rest = trust::error_of(&all, |e| e.error < 2.5);
    assert!((rest - 0.6_f64.sqrt()).abs() < 1e-15, "the good ones over the whole area: {rest}");
    assert_eq!(WorstElements::of(&[]).limit(1.0, 1.0), f64::INFINITY);
    let beset: Vec<LeafError> = all.iter().map(|&e| LeafError { is_beset: true, ..e }).collect();
    assert_eq!(
        WorstElements::of(&beset).limit(0.8, 1.0),
        f64::INFINITY,
        "nobody trusts them anyway"
    );
}

/// What counts more, as it lies where it is dim, counts so in what is left out and in what remains.
#[test]
fn what_is_left_out_counts_as_what_remains() {
    let mut all = errors(&[(1.0, 8.0), (1.0, 2.0), (1.0, 1.0)]);
    all[0].weight = 4.0;
    let worst = WorstElements::of(&all);
    // Squares of 1024, 4 and 1 over 3 m2: without the first the others err by 1.29.
    assert_eq!(worst.limit(1.5, 1.0), 0.5 * (8.0 + 2.0));
    let trusts = TrustLevels::of(&worst, f64::INFINITY);
    assert_eq!(trusts.least(), Trust::UpTo(0.5 * (8.0 + 2.0)), "a third of 18.5");
    let less = TrustLevels::of(&worst, 3.0).all_but_least().nth(1);
    assert_eq!(less, Some(Trust::UpTo(0.5 * (2.0 + 1.0))), "0.7 of 1.29");
}

/// Where more than foreseen is found, the worst of what was trusted are left out, however much was.
#[test]
fn less_is_trusted_by_what_elements_are_expected_to_err() {
    // Squares of 64, 16, 4 and 1.
    let worst = WorstElements::of(&errors(&[(1.0, 8.0), (1.0, 4.0), (1.0, 2.0), (1.0, 1.0)]));
    let limits = |foreseen_lx: f64| {
        let trusts = TrustLevels::of(&worst, foreseen_lx);
        assert_eq!(trusts.foreseen(), Trust::UpTo(foreseen_lx));
        trusts.all_but_least().chain([trusts.least()]).map(Trust::up_to_lx).collect::<Vec<_>>()
    };
    // A half and a quarter of 85 are 42 and 21.2, an eighth is 10.4; of 21 these are 10.3, 5.2 and 2.6.
    assert_eq!(limits(f64::INFINITY), [f64::INFINITY, 6.0, 6.0, 3.0]);
    assert_eq!(limits(6.0), [6.0, 3.0, 3.0, 1.5]);
    // Nothing is left out of nothing.
    assert_eq!(limits(0.5), [0.5; 4]);
    assert_eq!(TrustLevels::of(&WorstElements::of(&[]), 1.0).least(), Trust::UpTo(1.0));
}

/// Files keep errors at vertices; the least over an element's vertices is never less than its own,
/// and untouched elements have none.
#[test]
fn errors_at_vertices_bound_those_of_elements() {
    let shape = rectangle([0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], 0);
    let scene = scene(vec![shape], vec![painted(Rgb::WHITE)], vec![]);
    let mut coarse = Subdivision::new(&scene);
    coarse.bisect_to(1.0, 1 << 20);
    let left = |node: u32| coarse.triangle(node).centroid().x < 2.0;
    let error = |node: u32| LeafError {
        node,
        area_m2: coarse.triangle(node).area(),
        error: if left(node) { 1.0 + f64::from(node) } else { 0.0 },
        excess: 0.0,
        is_beset: false,
        is_beset_afar: false,
        weight: 1.0,
        seen: 0.0,
    };
    let errors: Vec<LeafError> = coarse.leaves().map(error).collect();
    let mut fine = coarse.clone();
    fine.bisect_to(0.3, 1 << 20);
    let elements = fine.elements();
    let at = trust::at_vertices(&elements, &errors, Trust::UpTo(f64::INFINITY));
    let mut compared = 0;
    for error in &errors {
        elements.visit_below(error.node, &mut |corners| {
            let least = corners.iter().map(|&v| at[v as usize]).fold(f64::INFINITY, f64::min);
            assert!(least >= error.error);
            compared += 1;
        });
    }
    assert!(compared > 4 * errors.len());
    for (vertex, &error) in elements.vertices().iter().zip(&at) {
        assert_eq!(error > 0.0, vertex.position.x <= 2.0, "{:?}", vertex.position);
    }
}

/// What direct light asks for makes elements smaller, and nothing stands nearer than they are long any more; but
/// indirect light is still carried by the vertices of those that were beset.
#[test]
fn elements_for_direct_light_do_not_pass_for_those_of_indirect_light() {
    // A shelf before a wall throws a shadow that takes fine elements.
    let shelf = rectangle([1.0, 0.2, 1.0], [1.0, 0.0, 0.0], [0.0, 0.2, 0.0], 0);
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    shapes.push(shelf);
    let scene =
        scene(shapes, vec![painted(Rgb::grey(0.5))], vec![isotropic([1.5, 1.5, 2.0], 100.0)]);
    let lighting = Lighting::new(&scene);
    let request = PilotRequest {
        target: 0.1,
        goal: 0.1,
        mesh_target: 0.02,
        seed: 1,
        is_fitted: true,
        is_hybrid: true,
        refines_caustics: true,
        max_vertices: 20_000,
        most_for_indirect_light: Some(200),
        least_edge_m: None,
        deadline: NEVER.clone(),
        end: NEVER.clone(),
    };
    let plan = pilot(&scene, &lighting, &request, &Unlit::default(), &mut |_| true);
    let at = plan.expected_lx(plan.trust());
    let split = |e: &&LeafError| e.is_beset && plan.mesh.elements.node(e.node).split.is_some();
    let beset: Vec<&LeafError> = plan.errors.of_elements.iter().filter(split).collect();
    assert!(beset.len() > 10, "there is something to be seen: {}", beset.len());
    for error in beset {
        plan.mesh.elements.visit_below(error.node, &mut |corners| {
            let least = corners.iter().map(|&v| at[v as usize]).fold(f64::INFINITY, f64::min);
            assert!(!plan.trust().includes(least, false), "{least} {:?}", plan.trust());
        });
    }
}

/// A cupboard 1 mm before a wall: its back and the wall behind it are closed in, the wall beside it,
/// an edge of the room and the floor before it are not.
#[test]
fn gaps_are_closed_in_and_edges_are_not() {
    let cupboard = rectangle([1.0, 0.001, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 0);
    let mut shapes = inward_box([4.0, 4.0, 3.0], 0);
    let wall = 2 * 3;
    shapes.push(cupboard);
    let scene = scene(shapes, vec![painted(Rgb::WHITE)], vec![]);
    let closed = |triangle: u32, [x, y, z]: [f64; 3]| {
        let [u, v] = scene.triangle(triangle).barycentric(Point::new(x, y, z));
        nearby::is_closed_in(&scene, &SurfacePoint::new(&scene, triangle, false, u, v), 0.5)
    };
    let wall_at = |x: f64, z: f64| {
        let near = |t: &u32| {
            let [u, v] = scene.triangle(*t).barycentric(Point::new(x, 0.0, z));
            u.min(v).min(1.0 - u - v) >= 0.0
        };
        let triangle = (wall..wall + 2).find(near).unwrap();
        closed(triangle, [x, 0.0, z])
    };
    assert!(wall_at(1.4, 1.5), "behind the cupboard");
    assert!(!wall_at(3.0, 1.5), "beside it");
    assert!(!wall_at(3.0, 1e-3), "at the edge to the floor");
}

#[test]
fn readers_gather_beside_a_picture_on_a_wall() {
    // The wall is bisected at x = 7: a vertex lies just behind the rim.
    let mut shapes = inward_box([14.0, 7.0, 4.5], 0);
    shapes.push(rectangle([7.0, 0.01, 1.0], [1.2, 0.0, 0.0], [0.0, 0.0, 1.0], 0));
    let lamps = vec![isotropic([4.6, 1.8, 4.3], 100.0)];
    let scene = scene(shapes, vec![painted(Rgb::grey(0.6))], lamps);
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let at = front_at(&scene, Point::new(6.85, 0.0, 1.45));
    let corners = plan.mesh.elements.locate(at.triangle, at.back, at.u, at.v).expect("it is lit");
    let expected_lx = plan.expected_lx(plan.trust());
    let is_gathered = |&(v, _): &(u32, f64)| !plan.trust().includes(expected_lx[v as usize], false);
    assert!(corners.iter().any(is_gathered));
}
