//! Where a scene lies changes no bit of what its rays meet.

use crate::room::{self, Random};
use isolux_geometry::bvh::brute_force;
use isolux_geometry::{Bvh, Point, Ray, TriangleMesh, Vector};

/// Offsets that leave all coordinates of the hall exact: kilometres, and a thousand of them.
const FAR: [[f64; 3]; 3] =
    [[4096.0, -8192.0, 0.0], [1048576.0, 2097152.0, -4096.0], [0.0, 0.0, 1048576.0]];

fn moved(mesh: &TriangleMesh, by: Vector) -> TriangleMesh {
    TriangleMesh { origin: mesh.origin + by, ..mesh.clone() }
}

/// Rays without end, and segments between places in the hall.
fn rays() -> Vec<Ray> {
    let mut random = Random(31);
    let mut ray = || room::random_ray(&mut random);
    let rays = (0..1000).map(|k| match k % 2 {
        0 => ray(),
        _ => Ray::between(ray().origin, ray().origin),
    });
    rays.collect()
}

#[test]
fn a_hall_far_away_is_met_alike() {
    let (mesh, rays) = (room::hall(), rays());
    let here = room::kernels(&mesh, |triangle| triangle.is_multiple_of(3));
    for by in FAR.map(Vector::from) {
        let away = moved(&mesh, by);
        let there = room::kernels(&away, |triangle| triangle.is_multiple_of(3));
        let moved: Vec<Ray> =
            rays.iter().map(|ray| Ray { origin: ray.origin + by, ..*ray }).collect();
        for (here, there) in here.iter().zip(&there) {
            let (mut hits, mut expected) = (vec![None; rays.len()], vec![None; rays.len()]);
            there.closest_hits(&moved, &mut hits);
            here.closest_hits(&rays, &mut expected);
            assert!(hits == expected, "{by:?}");
            for ((ray, moved), hit) in rays.iter().zip(&moved).zip(&expected) {
                assert_eq!(there.closest_hit(moved), *hit, "{by:?} {ray:?}");
                assert_eq!(there.any_hit(moved), here.any_hit(ray), "{by:?} {ray:?}");
            }
        }
        for (moved, ray) in moved.iter().zip(&rays) {
            let expected = brute_force::closest_hit(&mesh, ray);
            assert_eq!(brute_force::closest_hit(&away, moved), expected, "{by:?} {ray:?}");
            assert_eq!(moved.t_max(away.origin), ray.t_max(mesh.origin), "{by:?} {ray:?}");
        }
    }
}

#[test]
fn rays_start_as_close_to_surfaces_far_away() {
    let mesh = room::hall();
    let here = Bvh::build(mesh.clone(), |_| false);
    let mut random = Random(32);
    for by in FAR.map(Vector::from) {
        let there = Bvh::build(moved(&mesh, by), |_| false);
        for _ in 0..100 {
            let place = Point::from(room::edge_point(&mesh, &mut random));
            assert_eq!(there.offset_m(place + by), here.offset_m(place), "{place:?}");
        }
    }
}

/// What stands a tenth of a millimetre before the end of a segment is met, a kilometre away as here.
#[test]
fn segments_end_as_close_to_their_target_far_away() {
    let sheet = vec![[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [0.0, 1.0, 1.0]];
    let mesh =
        TriangleMesh { positions: sheet, triangles: vec![[0, 1, 2]], ..TriangleMesh::default() };
    for by in FAR.map(Vector::from) {
        let kernel = Bvh::build(moved(&mesh, by), |_| false);
        let segment =
            |height_m: f64| Ray::between(Point::ORIGIN + by, Point::new(0.0, 0.0, height_m) + by);
        assert!(kernel.any_hit(&segment(1.0001)), "{by:?}");
        assert!(!kernel.any_hit(&segment(1.0)), "{by:?}");
    }
}
