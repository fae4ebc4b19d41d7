//! Means of beset elements, and quadratic functions between carriers.

use super::*;
use crate::elements::Subdivision;
use crate::engine::gather::Unlit;
use crate::engine::light::Lighting;
use crate::engine::mesh::{Carriers, EdgeFalloffs};
use crate::engine::pilot::{PilotRequest, pilot};
use crate::engine::plan::Plan;
use isolux_geometry::{Point, Triangle};

/// A room with a block in it: light is resolved towards the walls of empty ones.
fn furnished() -> Scene {
    let mut block = inward_box([0.8, 0.7, 0.6], 0);
    for shape in &mut block {
        shape.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
        shape.positions.iter_mut().for_each(|[x, y, _]| (*x, *y) = (*x + 1.6, *y + 0.5));
    }
    let shapes = inward_box([3.0, 2.0, 2.5], 0).into_iter().chain(block).collect();
    scene(shapes, vec![painted(Rgb::grey(0.5))], vec![isotropic([1.0, 1.2, 1.5], 100.0)])
}

/// For so small an error that edges have to be measured.
fn measured_plan<'s>(scene: &'s Scene, lighting: &'s Lighting<'s>) -> Plan<'s> {
    let request = PilotRequest {
        target: 0.00005,
        goal: 0.00005,
        mesh_target: 0.1,
        seed: 1,
        is_fitted: true,
        has_means: true,
        refines_caustics: true,
        max_vertices: 1 << 20,
        most_for_indirect_light: Some(1500),
        least_edge_m: None,
    };
    pilot(scene, lighting, &request, &mut Unlit::default(), &mut |_| true)
}

fn is_in(triangle: &Triangle, at: Point) -> bool {
    let [u, v] = triangle.barycentric(at);
    let off_m = (triangle.point(u, v) - at).length();
    u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9 && off_m < 1e-6
}

/// The integral of a piecewise linear function over the surfaces, and over those that readers trust alone.
fn integrals(plan: &Plan, values: &[Rgb]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for error in &plan.errors.of_elements {
        let is_trusted = plan.trust().includes(error.error, error.is_beset);
        plan.mesh.elements.visit_below(error.node, &mut |corners| {
            let [a, b, c] = corners.map(|v| plan.mesh.elements.vertices()[v as usize].position);
            let third_m2 = (b - a).cross(c - a).length() / 6.0;
            let own: f64 = corners.iter().map(|&v| values[v as usize].luminance()).sum();
            sums[0] += third_m2 * own;
            sums[1] += if is_trusted { third_m2 * own } else { 0.0 };
        });
    }
    sums
}

/// Where all that is measured exceeds the map by one, the map rises by one in the mean over it, and nowhere that
/// readers interpolate.
#[test]
fn what_is_measured_is_given_to_elements_that_nobody_trusts() {
    let scene = furnished();
    let lighting = Lighting::new(&scene);
    let plan = measured_plan(&scene, &lighting);
    let places = plan.places_of_means(1, Key::new(3));
    assert!(places.gatherers.len() > 100, "{}", places.gatherers.len());
    let zero = vec![Rgb::BLACK; plan.mesh.indirect_vertices];
    let measured = vec![Rgb::WHITE; places.gatherers.len()];
    let moved = plan.mesh.means.moves(&zero, &places, &measured);
    // What is applied stays between what was there and what was measured.
    let mut applied = zero;
    plan.mesh.means.apply(&mut applied, &places, &measured);
    assert!(applied.iter().all(|lx| (0.0..=1.0).contains(&lx.luminance())));
    assert!(applied.iter().zip(&moved).all(|(a, b)| b.luminance() > 1.0 || a == b));
    let mut measured_m2 = 0.0;
    for gatherer in &places.gatherers {
        let at = gatherer.surface.point;
        let of = |e: &&crate::engine::mesh::LeafError| {
            e.is_beset && is_in(&plan.mesh.subdivision.triangle(e.node), at)
        };
        let found = plan.errors.of_elements.iter().find(of).expect("places lie in beset elements");
        measured_m2 += found.area_m2;
    }
    // Elements for direct light are finer and read what indirect light is between its own vertices.
    let [all, trusted] = integrals(&plan, &plan.prolongate(&moved));
    assert!((all / measured_m2 - 1.0).abs() < 1e-6, "{all} {measured_m2}");
    assert_eq!(trusted, 0.0);
    // Right already: nothing moves.
    let mut still = plan.light.guess.clone();
    let read: Vec<Rgb> = places.interpolated(&plan.light.guess).collect();
    plan.mesh.means.apply(&mut still, &places, &read);
    assert_eq!(still, plan.light.guess);
}

/// A floor of 4 m by 3 m bisected twice more, its first vertex that makes, and the corners of the elements before.
fn floor() -> (Subdivision, usize, Vec<[u32; 3]>) {
    let shapes = vec![rectangle([0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], 0)];
    let scene = scene(shapes, vec![painted(Rgb::WHITE)], vec![]);
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(0.5, 1 << 20);
    let first = subdivision.vertex_count();
    let leaves: Vec<u32> = subdivision.leaves().collect();
    let corners: Vec<[u32; 3]> = leaves.iter().map(|&n| subdivision.node(n).0.vertices).collect();
    leaves.into_iter().for_each(|node| subdivision.bisect_twice(node));
    (subdivision, first, corners)
}

/// Quadratic functions come out as they are inside a surface, linear ones everywhere.
#[test]
fn vertices_between_carriers_have_the_quadratic_function_of_those_about_them() {
    let (subdivision, first, corners) = floor();
    let open = vec![true; subdivision.vertex_count()];
    let mut carriers = Carriers::all();
    carriers.smooth(
        &subdivision,
        first,
        &corners,
        &open,
        (&EdgeFalloffs::default(), &[]),
        |_, _| (),
    );
    assert_eq!(carriers.count(open.len()), first, "none of the new ones carries light");
    let worst = |truth: &dyn Fn(Point) -> f64, margin_m: f64| {
        let all = subdivision.vertices();
        let value = |k: usize| if k < first { truth(all[k].position) } else { 0.0 };
        let mut values: Vec<Rgb> = (0..all.len()).map(|k| Rgb::grey(value(k))).collect();
        carriers.fill(&mut values);
        let within = |p: Point| p.x.min(4.0 - p.x) >= margin_m && p.y.min(3.0 - p.y) >= margin_m;
        let inside = (first..all.len()).filter(|&k| within(all[k].position));
        let error = |k: usize| (values[k].luminance() - truth(all[k].position)).abs();
        inside.map(error).fold(0.0, f64::max)
    };
    assert!(worst(&|p| 3.0 + p.x - 0.5 * p.y, 0.0) < 1e-9);
    let parabola = |p: Point| 9.0 + 0.7 * p.x * p.x - 0.3 * p.x * p.y + 0.2 * p.y * p.y;
    assert!(worst(&parabola, 0.6) < 1e-9, "{}", worst(&parabola, 0.6));
}

/// A vertex beside one that is hidden has the light of the other end of its edge, not half of it.
#[test]
fn what_is_hidden_tells_nothing() {
    let (subdivision, first, corners) = floor();
    let hidden = first - 1;
    let mut open: Vec<bool> = (0..first).map(|v| v != hidden).collect();
    for vertex in &subdivision.vertices()[first..] {
        open.push(vertex.parents.unwrap().iter().all(|&end| open[end as usize]));
    }
    let mut carriers = Carriers::all();
    carriers.smooth(
        &subdivision,
        first,
        &corners,
        &open,
        (&EdgeFalloffs::default(), &[]),
        |_, _| (),
    );
    let grey = |v: usize| Rgb::grey(if v < first && v != hidden { 7.0 } else { 0.0 });
    let mut values: Vec<Rgb> = (0..open.len()).map(grey).collect();
    carriers.fill(&mut values);
    let beside = (first..open.len()).filter(|&v| !open[v]);
    assert!(beside.clone().count() >= 4);
    for v in beside.chain((first..open.len()).filter(|&v| open[v])) {
        assert!((values[v].luminance() - 7.0).abs() < 1e-9, "{v}: {:?}", values[v]);
    }
}
