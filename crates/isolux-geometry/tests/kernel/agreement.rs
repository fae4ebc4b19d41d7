//! The hierarchy answers as brute force does, bit for bit.

use crate::room::{self, Random};
use isolux_geometry::bvh::brute_force;
use isolux_geometry::{Bvh, Ray, TriangleMesh};

/// Compares on rays, and on what lies behind the first hit and before it; every third triangle is
/// transparent. Returns how many rays hit.
#[track_caller]
fn check(mesh: &TriangleMesh, rays: impl IntoIterator<Item = Ray>) -> usize {
    let is_transparent = |triangle: u32| triangle.is_multiple_of(3);
    let kernels = room::kernels(mesh, is_transparent);
    let rays: Vec<Ray> = rays.into_iter().collect();
    check_together(mesh, is_transparent, &kernels, &rays);
    let mut hits = 0;
    for ray in rays {
        let expected = brute_force::closest_hit(mesh, &ray);
        let expected_any = brute_force::any_hit(mesh, is_transparent, &ray);
        let onward = expected.map(|hit| ray.skipping(hit.triangle));
        let expected_onward = onward.and_then(|ray| brute_force::closest_hit(mesh, &ray));
        for bvh in &kernels {
            assert_eq!(bvh.closest_hit(&ray), expected, "{ray:?}");
            assert_eq!(bvh.any_hit(&ray), expected_any, "{ray:?}");
            assert_eq!(onward.and_then(|ray| bvh.closest_hit(&ray)), expected_onward, "{ray:?}");
            if let Some(hit) = expected {
                let up_to_hit = ray.up_to(hit.t);
                assert_eq!(bvh.closest_hit(&up_to_hit), None, "{ray:?}");
                assert!(!bvh.any_hit(&up_to_hit), "{ray:?}");
            }
        }
        hits += usize::from(expected.is_some());
    }
    hits
}

/// Compares rays that are asked about together.
#[track_caller]
fn check_together(
    mesh: &TriangleMesh,
    is_transparent: impl Fn(u32) -> bool,
    kernels: &[Bvh],
    rays: &[Ray],
) {
    let closest: Vec<_> = rays.iter().map(|ray| brute_force::closest_hit(mesh, ray)).collect();
    let any: Vec<bool> =
        rays.iter().map(|ray| brute_force::any_hit(mesh, &is_transparent, ray)).collect();
    let (mut hits, mut are_hit) = (vec![None; rays.len()], vec![false; rays.len()]);
    for bvh in kernels.iter().flat_map(|bvh| [true, false].map(|b| bvh.clone().in_flight(b))) {
        bvh.closest_hits(rays, &mut hits);
        assert!(hits == closest);
        bvh.any_hits(rays, &mut are_hit);
        assert!(are_hit == any);
    }
}

fn random_rays(count: usize) -> Vec<Ray> {
    let mut random = Random(2);
    (0..count).map(|_| room::random_ray(&mut random)).collect()
}

#[test]
fn random_directions() {
    assert_eq!(check(&room::hall(), random_rays(2000)), 2000);
}

#[test]
fn aimed_at_edges_and_corners() {
    let (mesh, mut random) = (room::hall(), Random(3));
    let aim = |ray| room::aimed(ray, room::edge_point(&mesh, &mut random));
    assert_eq!(check(&mesh, random_rays(2000).into_iter().map(aim)), 2000);
}

#[test]
fn parallel_to_axes() {
    let mut random = Random(4);
    let straighten = |ray: Ray| {
        let (axis, mut direction) = (random.below(3), ray.direction);
        direction[axis] = 0.0;
        direction[(axis + 1) % 3] *= if random.below(2) == 0 { -0.0 } else { 1.0 };
        Ray { direction, ..ray }
    };
    check(&room::hall(), random_rays(2000).into_iter().map(straighten));
}

/// Along edges and within planes: from one point of an edge to another.
#[test]
fn grazing() {
    let (mesh, mut random) = (room::hall(), Random(5));
    let graze = |ray: Ray| {
        let origin = room::edge_point(&mesh, &mut random);
        let mut target = room::edge_point(&mesh, &mut random);
        if random.below(2) == 0 {
            let axis = random.below(3);
            target[axis] = origin[axis];
        }
        room::aimed(Ray { origin: origin.into(), ..ray }, target)
    };
    check(&mesh, random_rays(2000).into_iter().map(graze));
}

/// Origins ten to a million times farther away than the scene is large.
#[test]
fn from_outside() {
    let (mesh, mut random) = (room::hall(), Random(6));
    let withdraw = |ray: Ray| {
        let distance = 10.0_f32.powi(1 + random.below(6) as i32);
        let origin = random.direction().map(|x| x * 20.0 * distance);
        room::aimed(Ray { origin: origin.into(), ..ray }, room::edge_point(&mesh, &mut random))
    };
    assert!(check(&mesh, random_rays(2000).into_iter().map(withdraw)) > 1000);
}

/// The length of the direction changes `t` alone, and exactly for powers of two.
#[test]
fn direction_need_not_have_length_one() {
    let (mesh, mut random) = (room::hall(), Random(7));
    let bvh = Bvh::build(mesh.clone(), |_| false);
    let stretch = |ray: Ray| {
        let factor = 2.0_f32.powi(random.below(61) as i32 - 30);
        let stretched = Ray { direction: ray.direction.map(|x| x * factor), ..ray };
        let (t, t_stretched) = (bvh.closest_hit(&ray), bvh.closest_hit(&stretched));
        assert_eq!(t.map(|hit| hit.t), t_stretched.map(|hit| hit.t * factor));
        stretched
    };
    check(&mesh, random_rays(500).into_iter().map(stretch));
}

/// Metres of 0.1 mm and of 100 km.
#[test]
fn small_and_large_scenes() {
    for scale in [1e-4, 1e5] {
        let mut mesh = room::hall();
        mesh.positions.iter_mut().flatten().for_each(|x| *x *= scale);
        let mut random = Random(8);
        let rays: Vec<Ray> = random_rays(500)
            .into_iter()
            .map(|ray| Ray { origin: ray.origin.to_f32().map(|x| x * scale).into(), ..ray })
            .map(|ray| room::aimed(ray, room::edge_point(&mesh, &mut random)))
            .collect();
        assert_eq!(check(&mesh, rays), 500, "scale {scale}");
    }
}

/// Where `f32` resolves no more than millimetres, triangles fold and vanish, yet all agree.
#[test]
fn far_from_the_origin() {
    for distance in [1e3, 1e5, 1e6] {
        let mut mesh = room::hall();
        mesh.positions.iter_mut().flatten().for_each(|x| *x += distance);
        let mut random = Random(9);
        let rays: Vec<Ray> = random_rays(500)
            .into_iter()
            .map(|ray| Ray { origin: ray.origin.to_f32().map(|x| x + distance).into(), ..ray })
            .map(|ray| room::aimed(ray, room::edge_point(&mesh, &mut random)))
            .collect();
        check(&mesh, rays);
    }
}

/// Triangles thrown together at random: all sizes, slivers, common planes, exact copies.
#[test]
fn soup() {
    let mut random = Random(10);
    for _ in 0..60 {
        let mut mesh = TriangleMesh::default();
        for _ in 0..1 + random.below(200) {
            let size = 10.0_f32.powi(-(random.below(7) as i32));
            let mut corners = [0; 3].map(|_| random.direction().map(|x| x * size));
            if random.below(3) == 0 {
                corners.iter_mut().for_each(|corner| corner[0] = 0.25);
            }
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corners);
            mesh.triangles.extend(vec![[first, first + 1, first + 2]; 1 + random.below(2)]);
        }
        let rays: Vec<Ray> = (0..300)
            .map(|k| {
                let origin = random.direction().map(|x| x * 2.0);
                let ray = Ray { origin: origin.into(), ..room::random_ray(&mut random) };
                let target = room::edge_point(&mesh, &mut random);
                if k % 3 == 0 { ray } else { room::aimed(ray, target) }
            })
            .collect();
        check(&mesh, rays);
    }
}
