//! Instances answer as brute force over each of them does, bit for bit.

use crate::room::{self, Random};
use isolux_geometry::bvh::{Instance, InstanceProblem, InstancedBvh, brute_force};
use isolux_geometry::{Bvh, Direction, Hit, Point, Ray, Transform, TriangleMesh, Vector};

fn objects() -> Vec<Bvh> {
    let is_transparent = |triangle: u32| triangle.is_multiple_of(3);
    vec![Bvh::build(room::cube(), is_transparent), Bvh::build(room::hall(), is_transparent)]
}

/// Turned, moved, stretched, some of them mirrored.
fn somewhere(random: &mut Random) -> Transform {
    let axis = Vector::from(random.direction().map(f64::from)).direction().expect("no zero vector");
    let mut size = || f64::from(random.between(0.05, 1.5));
    let (x, y, z) = (size(), size(), size());
    let mirror = if random.below(2) == 0 { -1.0 } else { 1.0 };
    Transform::translation(Vector::from(random.direction().map(|x| 10.0 * f64::from(x))))
        .then_from(&Transform::rotation_about(axis, f64::from(random.between(0.0, 6.0))))
        .then_from(&Transform::scale(x, y, mirror * z))
}

fn scattered(count: usize, random: &mut Random) -> Vec<Instance> {
    (0..count)
        .map(|k| Instance { object: u32::from(k % 10 == 0), world_from_object: somewhere(random) })
        .collect()
}

/// Every instance is tried.
fn expected(bvh: &InstancedBvh, instances: &[Instance], ray: &Ray) -> (Option<Hit>, bool) {
    let (mut closest, mut any, mut first) = (None::<Hit>, false, 0);
    for (k, instance) in instances.iter().enumerate() {
        let mesh = bvh.objects()[instance.object as usize].mesh();
        let local = bvh.ray_in(k, ray);
        any |= brute_force::any_hit(mesh, |triangle| triangle.is_multiple_of(3), &local);
        let mirrored = instance.world_from_object.determinant() < 0.0;
        for hit in brute_force::hits(mesh, &local) {
            let hit = Hit { triangle: first + hit.triangle, back: hit.back != mirrored, ..hit };
            let rank = |hit: &Hit| (hit.t, hit.back, hit.triangle);
            if closest.is_none_or(|best| rank(&hit) < rank(&best)) {
                closest = Some(hit);
            }
        }
        first += mesh.len() as u32;
    }
    (closest, any)
}

/// Compares, and says how many rays hit.
#[track_caller]
fn check(instances: &[Instance], rays: impl IntoIterator<Item = Ray>) -> usize {
    check_of(objects(), instances, rays)
}

/// The same of other objects.
#[track_caller]
fn check_of(
    objects: Vec<Bvh>,
    instances: &[Instance],
    rays: impl IntoIterator<Item = Ray>,
) -> usize {
    let bvh = InstancedBvh::build(objects, instances).expect("proper instances");
    assert_eq!((bvh.len(), bvh.is_empty()), (instances.len(), instances.is_empty()));
    let mut hits = 0;
    for ray in rays {
        let (closest, any) = expected(&bvh, instances, &ray);
        assert_eq!(bvh.closest_hit(&ray), closest, "{ray:?}");
        assert_eq!(bvh.any_hit(&ray), any, "{ray:?}");
        if let Some(hit) = closest {
            hits += 1;
            let onward = ray.skipping(hit.triangle);
            assert_eq!(bvh.closest_hit(&onward), expected(&bvh, instances, &onward).0);
            let (instance, local) = bvh.locate(hit.triangle).expect("a triangle that was hit");
            let object = instances[instance].object as usize;
            assert!((local as usize) < bvh.objects()[object].mesh().len());
        }
    }
    hits
}

fn rays(count: usize, random: &mut Random) -> Vec<Ray> {
    let mut ray = || {
        let ray = room::ray(random.direction().map(|x| 12.0 * x), random.direction());
        if random.below(4) == 0 { ray.up_to(20.0) } else { ray }
    };
    (0..count).map(|_| ray()).collect()
}

#[test]
fn scattered_instances() {
    let mut random = Random(21);
    let instances = scattered(80, &mut random);
    assert!(check(&instances, rays(400, &mut random)) > 100);
}

/// Meshes whose coordinates count from afar, brought back by where they stand.
#[test]
fn instances_of_meshes_far_from_the_origin() {
    let mut random = Random(25);
    let far = Vector::new(4096.0, -8192.0, 1024.0);
    let objects = objects().into_iter().map(|object| {
        let mesh = TriangleMesh { origin: Point::ORIGIN + far, ..object.mesh().clone() };
        Bvh::build(mesh, |triangle| triangle.is_multiple_of(3))
    });
    let back = |instance: Instance| {
        let map = instance.world_from_object.then_from(&Transform::translation(-far));
        Instance { world_from_object: map, ..instance }
    };
    let instances: Vec<Instance> = scattered(80, &mut random).into_iter().map(back).collect();
    let between = |rays: Vec<Ray>| {
        let segments = rays.windows(2).map(|pair| Ray::between(pair[0].origin, pair[1].origin));
        segments.chain(rays.iter().copied()).collect::<Vec<_>>()
    };
    let rays = between(rays(400, &mut random));
    assert!(check_of(objects.collect(), &instances, rays) > 100);
}

/// At the same place: what counts is the side, then the index.
#[test]
fn coincident_instances() {
    let mut random = Random(22);
    let mirror = Transform::scale(-1.0, 1.0, 1.0);
    let instances = [mirror, Transform::IDENTITY, Transform::IDENTITY, mirror]
        .map(|world_from_object| Instance { object: 0, world_from_object });
    let inside =
        (0..400).map(|_| room::ray(random.direction().map(|x| 0.9 * x), random.direction()));
    assert_eq!(check(&instances, inside), 400);
}

/// Along the faces of boxes in a row, and parallel to axes.
#[test]
fn grazing_a_row_of_boxes() {
    let mut random = Random(23);
    let at = |k: i32| Transform::translation(Vector::new(2.0 * f64::from(k), 0.0, 0.0));
    let instances: Vec<Instance> =
        (-5..5).map(|k| Instance { object: 0, world_from_object: at(k) }).collect();
    let grazing = (0..400).map(|_| {
        let mut origin = random.direction().map(|x| 12.0 * x);
        let mut direction = random.direction();
        let axis = random.below(3);
        (origin[axis], direction[axis]) = (if random.below(2) == 0 { 1.0 } else { -1.0 }, 0.0);
        room::ray(origin, direction)
    });
    check(&instances, grazing);
}

/// A closed room stays closed wherever it stands, seen from inside.
#[test]
fn no_leak_at_edges_and_corners() {
    let mut random = Random(24);
    for _ in 0..20 {
        let instance = Instance { object: 0, world_from_object: somewhere(&mut random) };
        let bvh = InstancedBvh::build(objects(), &[instance]).unwrap();
        let mesh: TriangleMesh = room::cube();
        for _ in 0..2000 {
            let world = |p: [f32; 3]| instance.world_from_object.point(p.into()).to_f32();
            let origin = world(random.direction().map(|x| 0.9 * x));
            let target = world(room::edge_point(&mesh, &mut random));
            let ray = room::aimed(room::ray(origin, [0.0; 3]), target);
            assert!(bvh.closest_hit(&ray).is_some(), "{ray:?}");
        }
    }
}

#[test]
fn nothing_and_nonsense() {
    let none = InstancedBvh::build(Vec::new(), &[]).unwrap();
    let ray = room::ray([0.0; 3], [1.0; 3]).up_to(1.0);
    assert_eq!((none.closest_hit(&ray), none.any_hit(&ray), none.locate(0)), (None, false, None));
    let problem = |object, world_from_object| {
        let fine = Instance { object: 0, world_from_object: Transform::IDENTITY };
        let instances = [fine, Instance { object, world_from_object }];
        InstancedBvh::build(objects(), &instances).unwrap_err()
    };
    let not_invertible = InstanceProblem::NotInvertible { instance: 1 };
    assert_eq!(problem(2, Transform::IDENTITY), InstanceProblem::NoSuchObject { instance: 1 });
    assert_eq!(problem(0, Transform::scale(1.0, 0.0, 1.0)), not_invertible);
    assert_eq!(problem(0, Transform::scale(1.0, f64::NAN, 1.0)), not_invertible);
    assert_eq!(problem(0, Transform::scale(1e4, 1e-4, 1.0)), not_invertible);
    let far = Transform::translation(Direction::X * f64::INFINITY);
    assert_eq!(problem(0, far), not_invertible);
    let cube = InstancedBvh::build(
        vec![Bvh::build(TriangleMesh::default(), |_| false), Bvh::build(room::cube(), |_| false)],
        &[0, 1].map(|object| Instance { object, world_from_object: Transform::IDENTITY }),
    )
    .unwrap();
    assert_eq!(cube.closest_hit(&ray).map(|hit| hit.t), None);
    let nan = Ray { direction: [f32::NAN, 0.0, 1.0], ..ray };
    assert_eq!((cube.closest_hit(&nan), cube.any_hit(&nan)), (None, false));
    let long = ray.up_to(2.0);
    assert_eq!(cube.closest_hit(&long).map(|hit| hit.t), Some(1.0));
}
