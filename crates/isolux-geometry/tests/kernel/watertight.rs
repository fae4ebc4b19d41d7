//! No ray leaves a closed room.

use crate::room::{self, Random};
use isolux_geometry::{Point, Ray, TriangleMesh};

/// Rays from inside towards edges and corners, and how many of them met nothing.
fn leaks(mesh: &TriangleMesh, count: usize, origin: impl Fn(&mut Random) -> Ray) -> usize {
    let kernels = room::kernels(mesh, |_| false);
    let mut random = Random(11);
    let leaks = |_| {
        let ray = origin(&mut random);
        let ray = room::aimed(ray, room::edge_point(mesh, &mut random));
        kernels.iter().any(|bvh| bvh.closest_hit(&ray).is_none() || !bvh.any_hit(&ray))
    };
    (0..count).map(leaks).filter(|&leaks| leaks).count()
}

#[test]
fn hall_has_no_leak_at_edges_and_corners() {
    assert_eq!(leaks(&room::hall(), 1_000_000, room::random_ray), 0);
}

#[test]
fn cube_has_no_leak_at_edges_and_corners() {
    let origin = |random: &mut Random| Ray {
        origin: random.direction().map(|x| x * 0.999).into(),
        ..room::random_ray(random)
    };
    assert_eq!(leaks(&room::cube(), 200_000, origin), 0);
}

/// From the very middle, all sheared coordinates are exact and edge functions vanish exactly.
#[test]
fn cube_has_no_leak_from_its_centre() {
    let origin = |random: &mut Random| Ray { origin: Point::ORIGIN, ..room::random_ray(random) };
    assert_eq!(leaks(&room::cube(), 200_000, origin), 0);
}

#[test]
fn the_hall_has_the_size_it_is_documented_with() {
    assert_eq!(room::hall().len(), 11_592);
}
