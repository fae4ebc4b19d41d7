//! No ray leaves a closed room.

use crate::room::{self, Random};
use isolux_geometry::{Bvh, Point, Ray, TriangleMesh};

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

/// A billion rays: half of them towards edges and corners, half anywhere. It takes minutes, and is part of
/// `cargo xtask test --all`.
#[test]
#[ignore = "a billion rays"]
fn nothing_leaves_the_hall_in_a_billion_rays() {
    const THREADS: u64 = 2;
    const RAYS_EACH: u64 = 1_000_000_000 / THREADS;
    let mesh = room::hall();
    let bvh = Bvh::build(mesh.clone(), |_| false);
    let leaks = |seed: u64| {
        let mut random = Random(seed << 40);
        let one = |number: u64| {
            let ray = room::random_ray(&mut random);
            let towards = number.is_multiple_of(2).then(|| room::edge_point(&mesh, &mut random));
            let ray = towards.map_or(ray, |point| room::aimed(ray, point));
            u64::from(bvh.closest_hit(&ray).is_none())
        };
        (0..RAYS_EACH).map(one).sum::<u64>()
    };
    let leaks = &leaks;
    let leaks = std::thread::scope(|scope| {
        let threads: Vec<_> = (1..=THREADS).map(|seed| scope.spawn(move || leaks(seed))).collect();
        threads.into_iter().map(|thread| thread.join().expect("no thread panics")).sum::<u64>()
    });
    assert_eq!(leaks, 0);
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
