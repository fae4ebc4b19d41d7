//! Carriers: vertices that stand for others.

use super::*;
use crate::elements::{Subdivision, Vertex};
use crate::engine::mesh::Carriers;

/// A unit square of so many small squares a side, slightly bent into a paraboloid, its shading normals
/// smooth.
pub(super) fn bent_shape(side: u32, bend: f64) -> Shape {
    let place = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) / f64::from(side), f64::from(j) / f64::from(side));
        (x, y, bend * (x * x + y * y))
    };
    let corners = |i: u32, j: u32| i * (side + 1) + j;
    let all = || (0..=side).flat_map(|i| (0..=side).map(move |j| (i, j)));
    let positions = all().map(|(i, j)| place(i, j)).map(|(x, y, z)| [x, y, z]).collect();
    let normals = all().map(|(i, j)| place(i, j)).map(|(x, y, _)| {
        let normal = Vector::new(-2.0 * bend * x, -2.0 * bend * y, 1.0).normal().unwrap();
        let Vector { x, y, z } = normal.to_vector();
        [x, y, z]
    });
    let squares = (0..side).flat_map(|i| (0..side).map(move |j| (i, j)));
    let halves = squares.flat_map(|(i, j)| {
        let [a, b] = [corners(i, j), corners(i + 1, j)];
        let [c, d] = [corners(i + 1, j + 1), corners(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Shape {
        name: "bent".into(),
        positions,
        triangles: halves.collect(),
        normals: Some(normals.collect()),
        ..Shape::default()
    }
}

fn bent(side: u32, bend: f64) -> Scene {
    scene(vec![bent_shape(side, bend)], vec![painted(Rgb::grey(0.5))], vec![])
}

fn sparse(subdivision: &Subdivision, spacing_m: f64) -> Carriers {
    Carriers::sparse(subdivision, spacing_m, &vec![true; subdivision.vertex_count()])
}

/// The values of a function at all vertices, those that do not carry it interpolated; and itself.
fn filled(
    subdivision: &Subdivision,
    carriers: &Carriers,
    f: impl Fn(&Vertex) -> f64,
) -> (Vec<f64>, Vec<f64>) {
    let truth: Vec<f64> = subdivision.vertices().iter().map(f).collect();
    let carried = |v: usize| if carriers.is_active(v as u32) { truth[v] } else { -1e6 };
    let mut values: Vec<Rgb> = (0..truth.len()).map(|v| Rgb::grey(carried(v))).collect();
    carriers.fill(&mut values);
    (values.iter().map(|v| v.0[1]).collect(), truth)
}

fn greatest_error((found, truth): (Vec<f64>, Vec<f64>)) -> f64 {
    found.iter().zip(&truth).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn what_belongs_to_others_is_handed_down_whole() {
    let subdivision = Subdivision::new(&bent(30, 0.1));
    let carriers = sparse(&subdivision, 0.3);
    let elements = subdivision.elements();
    let mut areas_m2: Vec<f64> = elements.vertices().iter().map(|v| v.area_m2).collect();
    let whole_m2: f64 = areas_m2.iter().sum();
    carriers.hand_down(&mut areas_m2);
    // A thousand sums of doubles.
    assert!((areas_m2.iter().sum::<f64>() - whole_m2).abs() < 1e-12 * whole_m2);
    for (v, &m2) in areas_m2.iter().enumerate() {
        assert_eq!(m2 > 0.0, carriers.is_active(v as u32), "vertex {v}: {m2}");
    }
}

#[test]
fn few_vertices_of_a_fine_mesh_carry_light() {
    let subdivision = Subdivision::new(&bent(60, 0.1));
    let carriers = sparse(&subdivision, 0.2);
    let (all, few) = (subdivision.vertex_count(), carriers.count(subdivision.vertex_count()));
    // No two of a level nearer than 0.1: at most 140 discs that far apart have room on a unit square, and some more carry
    // light where nothing tells theirs.
    assert!(few > 60 && few < 160, "{few} of {all}");
    let finer = carriers.count(all) < sparse(&subdivision, 0.1).count(all);
    assert!(finer, "half as far apart they are more");
}

#[test]
fn corners_carry_and_borders_between_them_wait() {
    let subdivision = Subdivision::new(&bent(40, 0.0));
    let carriers = sparse(&subdivision, 0.5);
    let is_at_end = |c: f64| c == 0.0 || c == 1.0;
    let (mut corners, mut borders, mut waiting) = (0, 0, 0);
    for (v, Vertex { position, .. }) in subdivision.vertices().iter().enumerate() {
        let carries = carriers.is_active(v as u32);
        match (is_at_end(position.x), is_at_end(position.y)) {
            (true, true) => corners += u32::from(carries),
            (false, false) => {}
            _ => (borders, waiting) = (borders + 1, waiting + u32::from(!carries)),
        }
    }
    assert_eq!((corners, borders), (4, 156));
    // Those that carry are a quarter apart: three between two corners, and one more each at most.
    assert!(waiting >= 156 - 16, "{waiting} of {borders}");
}

#[test]
fn what_is_quadratic_over_the_surface_is_interpolated_exactly() {
    let subdivision = Subdivision::new(&bent(40, 0.0));
    let carriers = sparse(&subdivision, 0.15);
    let quadratic = |v: &Vertex| {
        let Point { x, y, .. } = v.position;
        // No vertex leaves the range of its neighbours by more than is allowed: steep in x.
        9.0 + 4.0 * x + 0.2 * y * y - 0.3 * x * y
    };
    let error = greatest_error(filled(&subdivision, &carriers, quadratic));
    // On borders it is linear where a quadratic function is not told: 0.3 times half the spacing squared.
    assert!(error < 0.3 * 0.15 * 0.15, "{error}");
    let linear = |v: &Vertex| 5.0 + v.position.x - 2.0 * v.position.y;
    let (found, truth) = filled(&subdivision, &carriers, linear);
    let off = found.iter().zip(&truth).map(|(a, b)| (a - b).abs()).filter(|error| *error > 1e-9);
    // Beside corners some lie beyond all carriers about them, and have the value of the last: by half of the finer spacing at most.
    let off: Vec<f64> = off.collect();
    assert!(
        100 * off.len() < found.len(),
        "rounding alone elsewhere: {} of {}",
        off.len(),
        found.len()
    );
    assert!(off.iter().all(|error| *error < 5.0_f64.sqrt() * 0.25 * 0.15), "{off:?}");
}

#[test]
fn errors_of_smooth_light_shrink_with_the_third_power_of_the_spacing_or_nearly() {
    let subdivision = Subdivision::new(&bent(80, 0.3));
    let light = |v: &Vertex| 10.0 + libm::sin(5.0 * v.position.x) * libm::cos(4.0 * v.position.y);
    let rms = |spacing_m: f64| {
        let (found, truth) = filled(&subdivision, &sparse(&subdivision, spacing_m), light);
        let squares = found.iter().zip(&truth).map(|(a, b)| (a - b) * (a - b));
        (squares.sum::<f64>() / found.len() as f64).sqrt()
    };
    let (coarse, fine) = (rms(0.3), rms(0.15));
    // Third order inside, second on borders: between 4 and 8 times, and irregular places cost a little.
    assert!(fine < coarse / 3.5, "{coarse} {fine}");
    // Carriers are half a spacing apart; straight lines between them err by an eighth of the square of that in radians.
    let by_lines = libm::pow(5.0 * 0.15, 2.0) / 8.0;
    assert!(coarse < by_lines, "better than straight lines: {coarse}");
}

#[test]
fn every_level_asked_for_is_nearer_until_all_carry() {
    let subdivision = Subdivision::new(&bent(30, 0.1));
    let mut carriers = sparse(&subdivision, 0.4);
    let all: Vec<u32> = (0..subdivision.vertex_count() as u32).collect();
    let mut counts = vec![carriers.count(all.len())];
    while counts.last() != Some(&all.len()) {
        carriers.activate(&all);
        counts.push(carriers.count(all.len()));
        assert!(counts.windows(2).all(|w| w[0] < w[1]), "no round is in vain: {counts:?}");
    }
    assert!(counts.len() >= 3, "level by level: {counts:?}");
    assert!(carriers.parents().is_empty(), "nobody is interpolated any more");
}

#[test]
fn one_vertex_wakes_only_what_it_depends_on() {
    let subdivision = Subdivision::new(&bent(60, 0.1));
    let mut carriers = sparse(&subdivision, 0.4);
    let all = subdivision.vertex_count();
    let vertex = (0..all as u32).rev().find(|&v| !carriers.is_active(v)).unwrap();
    let before = carriers.count(all);
    let mut rounds = 0;
    while !carriers.is_active(vertex) {
        carriers.activate(&[vertex]);
        rounds += 1;
        assert!(rounds < 12, "a level a round");
    }
    let woken = carriers.count(all) - before;
    // Twelve neighbours on each of a few levels, which share most of theirs.
    assert!(woken <= 12 * 12, "{woken} of {all}");
}

#[test]
fn nothing_is_interpolated_from_or_to_gaps() {
    let subdivision = Subdivision::new(&bent(40, 0.0));
    let open: Vec<bool> = subdivision.vertices().iter().map(|v| v.position.x < 0.5).collect();
    let carriers = Carriers::sparse(&subdivision, 0.2, &open);
    let gap = |v: &Vertex| if v.position.x < 0.5 { 3.0 } else { 1e9 };
    let (found, truth) = filled(&subdivision, &carriers, gap);
    assert!(carriers.count(found.len()) < found.len(), "there is something to be interpolated");
    let error = greatest_error((found, truth));
    assert!(error < 1e-9, "rounding alone: {error}");
}

#[test]
fn facets_are_left_as_they_are() {
    let subdivision = {
        let scene = scene(inward_box([1.0; 3], 0), vec![painted(Rgb::grey(0.5))], vec![]);
        let mut subdivision = Subdivision::new(&scene);
        subdivision.bisect_to(0.1, usize::MAX);
        subdivision
    };
    let carriers = sparse(&subdivision, 0.5);
    assert_eq!(carriers.count(subdivision.vertex_count()), subdivision.vertex_count());
    let told = carriers.told(&vec![Some(1.0); subdivision.vertex_count()], |_, _| false);
    assert!(told.iter().all(Option::is_none));
}
