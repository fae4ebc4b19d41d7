//! Rooms far from the origin of their coordinates.

use super::*;
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::IlluminationMap;
use crate::scene::LuminaireKind;

/// Binary numbers, so that no coordinate of a millimetre is rounded.
const MM: f64 = 1.0 / 1024.0;

/// A room with a closed cupboard of sheet metal, painted inside and out, that touches a wall.
fn room(by: Vector) -> Scene {
    let mut shapes = inward_box([4.0, 4.0, 3.0], 0);
    let sheets = [
        ([1.0, 0.0, 0.0], [1.0, 0.5, 2.0]),
        ([1.0 + MM, MM, MM], [1.0 - 2.0 * MM, 0.5 - 2.0 * MM, 2.0 - 2.0 * MM]),
    ];
    for (index, (low, size)) in sheets.into_iter().enumerate() {
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
    let request = SolveRequest { accuracy: Some(0.1), ..SolveRequest::default() };
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
    let places = |map: &IlluminationMap| {
        map.elements.vertices().iter().map(|v| v.position).collect::<Vec<_>>()
    };
    eprintln!("{} {}", here.values.len(), there.values.len());
    let (a, b) = (places(&here), places(&there));
    let mut same = 0;
    let mut known = 0;
    let mut worst: f64 = 0.0;
    let mut differ = 0;
    for k in 0..a.len().min(b.len()) {
        if a[k] + by == b[k] {
            same += 1;
        }
        match (&here.values[k], &there.values[k]) {
            (Some(x), Some(y)) => {
                known += 1;
                let d = (x.indirect_lx - y.indirect_lx + x.direct_lx - y.direct_lx).0[0].abs();
                worst = worst.max(d);
                if x.standing != y.standing {
                    differ += 1;
                }
            }
            (None, None) => (),
            _ => differ += 1,
        }
    }
    eprintln!("same {same} known {known} worst {worst} differ {differ}");
    panic!();
}
