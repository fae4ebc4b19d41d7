//! Rooms far from the origin of their coordinates.

use super::*;
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::{IlluminationMap, Standing, VertexLight};
use crate::scene::LuminaireKind;

/// Coarse.
const ACCURACY: f64 = 0.1;

/// About a millimetre, a binary fraction, so that no coordinate is rounded.
const MM: f64 = 1.0 / 1024.0;

/// A room with a closed cupboard of sheet metal, painted inside and out, that touches a wall.
fn room(by: Vector) -> Scene {
    let mut shapes = inward_box([4.0, 4.0, 3.0], 0);
    let outside = ([1.0, 0.0, 0.0], [1.0, 0.5, 2.0]);
    let inside = ([1.0 + MM, MM, MM], outside.1.map(|side| side - 2.0 * MM));
    for (index, (low, size)) in [outside, inside].into_iter().enumerate() {
        shapes.extend(inward_box(size, 0).into_iter().map(|mut face| {
            face.positions.iter_mut().for_each(|p| *p = [0, 1, 2].map(|k| p[k] + low[k]));
            if index == 0 {
                face.triangles.iter_mut().for_each(|corners| corners.reverse());
            }
            face
        }));
    }
    for position in shapes.iter_mut().flat_map(|shape| &mut shape.positions) {
        *position = (Point::from(*position) + by).into();
    }
    let mut lamp = isotropic([2.5, 2.25, 2.75], 100.0);
    if let LuminaireKind::Point { position, .. } = &mut lamp.kind {
        *position = *position + by;
    }
    scene(shapes, vec![painted(Rgb::grey(0.5))], vec![lamp])
}

fn solved(scene: &Scene) -> IlluminationMap {
    let request = SolveRequest { accuracy: Some(ACCURACY), ..SolveRequest::default() };
    solve(scene, &request, None, &mut |_| Watch::Continue).unwrap().map
}

/// A room 9 km away had rays start behind sheets of a millimetre: a closed cupboard was lit.
#[test]
fn a_cupboard_far_away_is_as_dark_as_here() {
    let by = Vector::new(4096.0, -8192.0, 0.0);
    let (here, there) = (room(Vector::ZERO), room(by));
    assert_eq!(here.bvh().mesh().positions, there.bvh().mesh().positions);
    assert_eq!(there.bvh().mesh().origin, Point::ORIGIN + by);
    let (here, there) = (solved(&here), solved(&there));
    let places = |map: &IlluminationMap, by: Vector| -> Vec<Point> {
        map.elements.vertices().iter().map(|vertex| vertex.position + by).collect()
    };
    assert_eq!(places(&here, by), places(&there, Vector::ZERO));
    let standings = |map: &IlluminationMap| -> Vec<Option<Standing>> {
        map.values.iter().map(|value| value.map(|value| value.standing)).collect()
    };
    assert_eq!(standings(&here), standings(&there));
    let is_inside =
        |p: &Point| p.x > 1.0 && p.x < 2.0 && p.y > 0.0 && p.y < 0.5 && p.z > 0.0 && p.z < 2.0;
    let inside: Vec<usize> = (0..here.values.len())
        .filter(|&k| is_inside(&here.elements.vertices()[k].position))
        .collect();
    assert!(!inside.is_empty());
    assert!(inside.iter().all(|&k| there.values[k].is_none()), "no light comes there");
    // Random numbers belong to places: what is left is noise.
    let sum_lx = |map: &IlluminationMap| {
        map.values.iter().flatten().map(VertexLight::illuminance_lx).sum::<f64>()
    };
    let (here_lx, there_lx) = (sum_lx(&here), sum_lx(&there));
    assert!((here_lx - there_lx).abs() < ACCURACY * here_lx, "{here_lx} {there_lx}");
}

/// A map holds coordinates of the world: read again, a scene has the same origin and thereby the same bits.
#[test]
fn a_scene_far_away_comes_back_from_its_parts() {
    let skewed = Vector::new(3001.3, -777.7, 112.1);
    for by in [Vector::ZERO, skewed, skewed * 100.0] {
        let scene = room(by);
        let again = Scene::assemble(scene.to_parts()).unwrap();
        assert_eq!(again.bvh().mesh().origin, scene.bvh().mesh().origin);
        assert_eq!(again.hash(), scene.hash());
    }
    assert_ne!(room(Vector::ZERO).hash(), room(Vector::new(4096.0, 0.0, 0.0)).hash());
}
