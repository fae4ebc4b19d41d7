//! Light that falls off towards walls.

use super::*;
use crate::elements::{Subdivision, Vertex};
use crate::engine::mesh::{Beside, Carriers, EdgeFalloffs, LeafError, WorstElements};
use crate::engine::pilot::Survey;

const SIDE_M: f64 = 4.0;

fn cube(material: Material) -> Scene {
    let grey = painted(Rgb::grey(0.5));
    let mut shapes = inward_box([SIDE_M; 3], 0);
    // One wall of its own.
    shapes[1].material = 1;
    scene(shapes, vec![grey, material], vec![])
}

fn subdivided(scene: &Scene) -> Subdivision {
    let mut subdivision = Subdivision::new(scene);
    subdivision.bisect_to(0.75, 1 << 20);
    subdivision
}

/// How far a place of the floor is from each of its walls, m.
fn from_walls(at: &Vertex) -> [f64; 4] {
    let Point { x, y, .. } = at.position;
    [x, SIDE_M - x, y, SIDE_M - y]
}

/// Light on the floor, and none elsewhere: it falls off towards its walls, over a quadratic function.
fn light(at: &Vertex) -> f64 {
    if at.normal.to_vector().z < 0.9 {
        return 100.0;
    }
    let fall = |d: f64| if d > 0.0 { d * libm::log(d / SIDE_M) } else { 0.0 };
    let Point { x, y, .. } = at.position;
    100.0 + 0.3 * x * y - 0.2 * x * x - from_walls(at).map(fall).iter().sum::<f64>()
}

fn errors_of(subdivision: &Subdivision) -> Vec<LeafError> {
    let error = |node: u32| LeafError {
        node,
        area_m2: subdivision.triangle(node).area(),
        error: 1.0,
        excess: 1.0,
        is_beset: true,
        is_beset_afar: false,
        is_at_wall: false,
        weight: 1.0,
        seen: 0.0,
    };
    subdivision.leaves().map(error).collect()
}

struct Resolved {
    subdivision: Subdivision,
    look: Survey,
    rows: Vec<Beside>,
    first: usize,
    corners: Vec<[u32; 3]>,
}

/// Elements of a cube halved towards its walls for an accuracy.
fn resolved(accuracy_lx: f64) -> Resolved {
    let scene = cube(painted(Rgb::grey(0.5)));
    let mut subdivision = subdivided(&scene);
    let first = subdivision.vertex_count();
    let walls = EdgeFalloffs::of(&scene, &subdivision, &vec![true; first]);
    let values: Vec<Option<f64>> = subdivision.vertices().iter().map(|v| Some(light(v))).collect();
    let errors = errors_of(&subdivision);
    let mut look = Survey {
        elements: subdivision.elements(),
        carriers: first,
        worst: WorstElements::of(&errors),
        errors,
        walls: EdgeFalloffs::default(),
        left_by_fit: 1.0,
        reference_lx: 100.0,
        dim_m2: 0.0,
        is_noisy: false,
    };
    look.resolve(walls, &subdivision, &values, accuracy_lx);
    let leaves: Vec<u32> = subdivision.leaves().collect();
    let corners = leaves.iter().map(|&n| subdivision.node(n).0.vertices).collect();
    leaves.into_iter().for_each(|node| subdivision.bisect_twice(node));
    let rows = look.walls.refine(&mut subdivision, 1 << 20);
    Resolved { subdivision, look, rows, first, corners }
}

#[test]
fn noisy_direct_light_leaves_large_meshes_without_smooth_elements() {
    let mut look = resolved(1.0).look;
    look.left_by_fit = 0.1;
    let few = look.errors.clone();
    let many: Vec<LeafError> = few.iter().cycle().take(100_000).copied().collect();
    let mut is_smooth = |errors: &[LeafError], is_noisy: bool| {
        (look.errors, look.is_noisy) = (errors.to_vec(), is_noisy);
        look.is_smooth(&usual_request())
    };
    assert!(is_smooth(&few, false) && is_smooth(&few, true) && is_smooth(&many, false));
    assert!(!is_smooth(&many, true));
}

#[test]
fn every_face_of_a_room_ends_before_four_walls() {
    let of = |scene: &Scene| {
        let subdivision = subdivided(scene);
        let walls = EdgeFalloffs::of(scene, &subdivision, &vec![true; subdivision.vertex_count()]);
        let at = |v: u32| {
            let about: Vec<u32> = (0..subdivision.vertex_count() as u32)
                .filter(|&k| {
                    let of = |k: u32| subdivision.vertices()[k as usize].normal;
                    of(k).dot(of(v)) > 0.9
                })
                .collect();
            let at = &subdivision.vertices()[v as usize];
            walls
                .near(&about, at.position)
                .iter()
                .map(|wall| wall.distance_m(at.position))
                .collect()
        };
        let floor = |v: &u32| subdivision.vertices()[*v as usize].normal.to_vector().z > 0.9;
        let all = (0..subdivision.vertex_count() as u32).filter(floor);
        all.map(|v| (subdivision.vertices()[v as usize], at(v)))
            .collect::<Vec<(Vertex, Vec<f64>)>>()
    };
    for (vertex, near) in of(&cube(painted(Rgb::grey(0.5)))) {
        let mut expected = from_walls(&vertex);
        expected.sort_by(f64::total_cmp);
        assert_eq!(near.len(), 2, "{vertex:?}");
        // Coordinates are sums of a few doubles.
        assert!((near[0] - expected[0]).abs() + (near[1] - expected[1]).abs() < 1e-9, "{near:?}");
    }
    // The wall at x = 0 is a mirror: it does not end the floor.
    let mirror = Material::one_sided("mirror", Finish::mirror(Rgb::WHITE));
    for (vertex, near) in of(&cube(mirror)) {
        let [_, others @ ..] = from_walls(&vertex);
        let nearest = others.into_iter().fold(f64::INFINITY, f64::min);
        assert!((near[0] - nearest).abs() < 1e-9, "{vertex:?} {near:?}");
    }
}

/// Outer sides of a box in the air end before nothing.
#[test]
fn outer_edges_are_no_walls() {
    let mut shapes = inward_box([SIDE_M; 3], 0);
    for shape in &mut shapes {
        shape.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    }
    let scene = scene(shapes, vec![painted(Rgb::grey(0.5))], vec![]);
    let subdivision = subdivided(&scene);
    let all: Vec<u32> = (0..subdivision.vertex_count() as u32).collect();
    let walls = EdgeFalloffs::of(&scene, &subdivision, &vec![true; all.len()]);
    assert!(walls.near(&all, subdivision.vertices()[0].position).is_empty());
}

#[test]
fn elements_are_halved_towards_walls_as_often_as_an_accuracy_asks_for() {
    let counts: Vec<usize> = [50.0, 0.3, 0.05, 0.01]
        .into_iter()
        .map(|accuracy_lx| resolved(accuracy_lx).subdivision.vertex_count())
        .collect();
    assert!(!resolved(50.0).look.walls.are_resolved(), "light falls off by less than that");
    let look = resolved(0.3).look;
    assert!(look.walls.are_resolved());
    // All of the first and second rows of elements, and none amid a face.
    let at_walls: f64 = look.errors.iter().filter(|e| e.is_at_wall).map(|e| e.area_m2).sum();
    let share = at_walls / look.errors.iter().map(|e| e.area_m2).sum::<f64>();
    assert!((0.43..0.76).contains(&share), "{share}");
    assert!(look.errors.iter().all(|e| (e.error < 1.0) == e.is_at_wall));
    assert!(counts.windows(2).all(|w| w[0] < w[1]), "{counts:?}");
}

#[test]
fn rows_stand_beside_all_walls_a_quarter_of_an_element_away() {
    let Resolved { subdivision, rows, first, .. } = resolved(0.3);
    let at = |v: u32| &subdivision.vertices()[v as usize];
    let on_floor = |v: u32| at(v).normal.to_vector().z > 0.9;
    let is_on_wall = |v: &u32| from_walls(at(*v)).iter().any(|d| *d < 1e-9);
    let on_walls = (0..first as u32).filter(|&v| on_floor(v)).filter(is_on_wall).count();
    let of_floor: Vec<&Beside> = rows.iter().filter(|row| on_floor(row.of)).collect();
    assert_eq!(of_floor.len(), on_walls, "one for each");
    for row in of_floor {
        let nearest = from_walls(at(row.vertex)).into_iter().fold(f64::INFINITY, f64::min);
        // Elements have legs of half a metre.
        assert!((nearest - 0.125).abs() < 1e-9, "{nearest}");
        assert!(row.vertex as usize >= first && is_on_wall(&row.of));
    }
}

/// Interpolated from few vertices, light that falls off is nearer to what it is by far.
#[test]
fn what_falls_off_towards_walls_is_interpolated_as_it_falls() {
    let Resolved { subdivision, look, rows, first, corners } = resolved(0.1);
    let open = vec![true; subdivision.vertex_count()];
    let error = |walls: &EdgeFalloffs, rows: &[Beside]| {
        let mut carriers = Carriers::all();
        carriers.smooth(&subdivision, first, &corners, &open, (walls, rows), |_, _| ());
        assert_eq!(carriers.count(open.len()), first + rows.len());
        let value = |v: usize| {
            let carries = carriers.is_active(v as u32);
            Rgb::grey(if carries { light(&subdivision.vertices()[v]) } else { 0.0 })
        };
        let mut values: Vec<Rgb> = (0..open.len()).map(value).collect();
        carriers.fill(&mut values);
        let all = subdivision.vertices().iter().zip(&values);
        let errors = all.map(|(v, value)| (value.luminance() - light(v)).abs());
        let errors: Vec<f64> = errors.collect();
        (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
    };
    let (fallen, smooth) = (error(&look.walls, &rows), error(&EdgeFalloffs::default(), &[]));
    // All but what linear functions beside the two nearest walls leave in corners.
    assert!(fallen < 0.01, "{fallen}");
    assert!(smooth > 5.0 * fallen, "{smooth} {fallen}");
}

/// Beyond the corner of an L-shaped room, light does not fall off towards the line that the wall there would follow.
#[test]
fn walls_end_where_they_end() {
    let place = |x: f64, y: f64| [x, y, 0.0];
    let outline = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]];
    let mut shapes = vec![
        rectangle(place(0.0, 0.0), [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], 0),
        rectangle(place(2.0, 0.0), [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], 0),
        rectangle(place(0.0, 2.0), [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], 0),
    ];
    for (k, [x, y]) in outline.into_iter().enumerate() {
        let [to_x, to_y] = outline[(k + 1) % outline.len()];
        let side = [to_x - x, to_y - y, 0.0];
        shapes.push(rectangle(place(x, y), [0.0, 0.0, 3.0], side, 0));
    }
    let scene = scene(shapes, vec![painted(Rgb::grey(0.5))], vec![]);
    let subdivision = subdivided(&scene);
    let walls = EdgeFalloffs::of(&scene, &subdivision, &vec![true; subdivision.vertex_count()]);
    let floor = |v: &u32| subdivision.vertices()[*v as usize].normal.to_vector().z > 0.9;
    let about: Vec<u32> = (0..subdivision.vertex_count() as u32).filter(floor).collect();
    let nearest = |x: f64, y: f64| {
        let at = Point::new(x, y, 0.0);
        walls.near(&about, at)[0].distance_m(at)
    };
    // Beside the wall from (4, 2) to (2, 2), and half a metre further on.
    assert!((nearest(3.0, 1.9) - 0.1).abs() < 1e-9);
    assert!((nearest(1.5, 1.9) - libm::hypot(0.5, 0.1)).abs() < 1e-9);
}
