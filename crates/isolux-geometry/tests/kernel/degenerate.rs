//! Inputs at the border of sense: the hierarchy is built, answers, and answers as brute force does.

use crate::room::{self, Random};
use isolux_geometry::bvh::brute_force;
use isolux_geometry::{Bvh, End, Hit, Point, Ray, TriangleMesh};

const DOWN: Ray = Ray {
    origin: Point::new(0.25, 0.25, 1.0),
    direction: [0.0, 0.0, -1.0],
    end: End::At(10.0),
    skip: None,
};

fn mesh(triangles: &[[[f32; 3]; 3]]) -> TriangleMesh {
    TriangleMesh {
        positions: triangles.concat(),
        triangles: (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
        ..TriangleMesh::default()
    }
}

/// A triangle at a height, its front upwards.
fn level(z: f32) -> [[f32; 3]; 3] {
    [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]]
}

fn turned_over([a, b, c]: [[f32; 3]; 3]) -> [[f32; 3]; 3] {
    [a, c, b]
}

/// Compares with brute force on one ray, and on many around the scene.
#[track_caller]
fn check(name: &str, triangles: &[[[f32; 3]; 3]], expected: Option<Hit>) {
    let mesh = mesh(triangles);
    let kernels = room::kernels(&mesh, |_| false);
    for bvh in &kernels {
        assert_eq!(bvh.closest_hit(&DOWN), expected, "{name}");
    }
    let mut random = Random(12);
    for _ in 0..200 {
        let ray = Ray { origin: random.direction().into(), ..room::random_ray(&mut random) };
        let closest = brute_force::closest_hit(&mesh, &ray);
        let any = brute_force::any_hit(&mesh, |_| false, &ray);
        for bvh in &kernels {
            assert_eq!(bvh.closest_hit(&ray), closest, "{name} {ray:?}");
            assert_eq!(bvh.any_hit(&ray), any, "{name} {ray:?}");
        }
    }
}

#[test]
fn meshes() {
    let nan = [[f32::NAN; 3]; 3];
    let infinite = [[f32::INFINITY, 0.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0]];
    let huge = [[-1e30, -1e30, 0.0], [1e30, 0.0, 0.0], [0.0, 1e30, 0.0]];
    let point = [[0.25, 0.25, 0.0]; 3];
    let line = [[0.0, 0.25, 0.0], [1.0, 0.25, 0.0], [0.5, 0.25, 0.0]];
    let edge_on = [[0.25, 0.0, 0.0], [0.25, 1.0, 0.0], [0.25, 0.5, 0.5]];
    let sliver = [[0.25, 0.25 - 1e-7, 0.0], [1.0, 0.25, 0.0], [0.0, 0.25, 0.0]];
    let hit = |triangle: u32, t: f32| Some(Hit { t, u: 0.25, v: 0.25, triangle, back: false });
    check("nothing", &[], None);
    check("one triangle", &[level(0.0)], hit(0, 1.0));
    check("a back", &[turned_over(level(0.0))], hit(0, 1.0).map(|h| Hit { back: true, ..h }));
    check("coincident: the first", &[level(0.0); 100], hit(0, 1.0));
    let coincident = [turned_over(level(0.0)), level(0.0), level(0.0)];
    check("coincident: a front before a back", &coincident, hit(1, 1.0));
    check("stacked", &[level(-1.0), level(0.5), level(0.0)], hit(1, 0.5));
    check("at the origin of the ray", &[level(1.0), level(0.0)], hit(1, 1.0));
    check("beyond the end of the ray", &[level(-9.5)], None);
    check("at the end of the ray", &[level(-9.0)], None);
    check("a point", &[point], None);
    check("a line", &[line], None);
    check("seen edge-on", &[edge_on], None);
    check("among points and lines", &[point, line, edge_on, level(0.0)], hit(3, 1.0));
    check("not a number", &[nan, infinite, level(0.0), nan], hit(2, 1.0));
    check("only not a number", &[nan; 20], None);
    check("too large", &[huge, level(0.0)], hit(1, 1.0));
    check("a sliver", &[sliver], brute_force::closest_hit(&mesh(&[sliver]), &DOWN));
    assert!(brute_force::closest_hit(&mesh(&[sliver]), &DOWN).is_some_and(|hit| hit.t == 1.0));
}

#[test]
fn indices_out_of_range_are_never_met() {
    let mut mesh = mesh(&[level(0.0)]);
    mesh.triangles.extend([[0, 1, 3], [u32::MAX; 3]]);
    let bvh = Bvh::build(mesh, |_| false);
    assert_eq!(bvh.closest_hit(&DOWN).map(|hit| hit.triangle), Some(0));
    assert_eq!(bvh.closest_hit(&DOWN.skipping(0)), None);
}

#[test]
fn rays_that_meet_nothing() {
    let mesh = mesh(&[level(0.0)]);
    let bvh = Bvh::build(mesh.clone(), |_| false);
    let rays = [
        Ray { direction: [0.0; 3], ..DOWN },
        Ray { direction: [-0.0, 0.0, -0.0], ..DOWN },
        Ray { direction: [0.0, 0.0, f32::NAN], ..DOWN },
        Ray { direction: [f32::NAN, 0.0, -1.0], ..DOWN },
        Ray { direction: [0.0, f32::NAN, -1.0], ..DOWN },
        Ray { direction: [f32::INFINITY, 0.0, -1.0], ..DOWN },
        Ray { direction: [0.0, 0.0, f32::NEG_INFINITY], ..DOWN },
        Ray { direction: [0.0, 0.0, -1e-30], ..DOWN },
        Ray { direction: [0.0, 0.0, -1e30], ..DOWN },
        Ray { origin: Point::new(f64::NAN, 0.25, 1.0), ..DOWN },
        Ray { origin: Point::new(0.25, f64::INFINITY, 1.0), ..DOWN },
        Ray { origin: Point::new(0.25, 0.25, 1e30), ..DOWN.up_to(f32::INFINITY) },
        DOWN.up_to(f32::NAN),
        DOWN.up_to(0.0),
        DOWN.up_to(-1.0),
        DOWN.up_to(f32::NEG_INFINITY),
        DOWN.skipping(0),
    ];
    for ray in rays {
        assert_eq!(bvh.closest_hit(&ray), None, "{ray:?}");
        assert_eq!(brute_force::closest_hit(&mesh, &ray), None, "{ray:?}");
        assert!(!bvh.any_hit(&ray), "{ray:?}");
    }
    assert!(bvh.any_hit(&DOWN.up_to(f32::INFINITY)));
    assert!(bvh.any_hit(&DOWN.skipping(1)));
}

#[test]
fn transparent_triangles_stop_closest_hit_alone() {
    let bvh = Bvh::build(mesh(&[level(0.5), level(0.0), level(0.25)]), |triangle| triangle != 1);
    assert_eq!(bvh.closest_hit(&DOWN).map(|hit| hit.triangle), Some(0));
    assert!(bvh.any_hit(&DOWN));
    assert!(!bvh.any_hit(&DOWN.up_to(0.9)));
    assert!(!bvh.any_hit(&DOWN.skipping(1)));
}

/// Sizes that grow by a factor make the heuristic peel triangles off one by one: the depth must
/// stay bounded all the same.
#[test]
fn growing_sizes_do_not_deepen_the_tree_without_bound() {
    let grown = |k: i32| level(0.0).map(|corner| corner.map(|x| x * 1.02_f32.powi(k)));
    let triangles: Vec<_> = (-1200..1200).map(grown).collect();
    check("growing", &triangles, brute_force::closest_hit(&mesh(&triangles), &DOWN));
}

/// A ray that must look at everything: more is left to be visited than the stack first holds.
#[test]
fn a_hundred_thousand_coincident_transparent_triangles() {
    let triangles = vec![turned_over(level(0.0)); 100_000];
    let last = |triangle: u32| triangle != 99_999;
    for bvh in room::kernels(&mesh(&triangles), last) {
        assert!(bvh.any_hit(&DOWN));
        assert!(!bvh.any_hit(&DOWN.skipping(99_999)));
        assert_eq!(bvh.closest_hit(&DOWN).map(|hit| hit.triangle), Some(0));
        assert_eq!(bvh.closest_hit(&DOWN.skipping(0)).map(|hit| hit.triangle), Some(1));
    }
}
