//! Walls that rays are judged by.

use super::*;
use crate::elements::Subdivision;
use crate::engine::backdrop::{Backdrop, lacking};
use crate::engine::gather::Gatherer;
use crate::sampling::CosineHemisphere;

const ROOM_M: [f64; 3] = [6.0, 4.0, 3.0];

/// A room whose walls are brighter where a lamp would hang, and a thing in it.
fn room(things: Vec<Shape>) -> (Scene, Backdrop) {
    let mut shapes = inward_box(ROOM_M, 0);
    shapes.extend(things);
    let scene = scene(shapes, vec![painted(Rgb([0.7, 0.5, 0.3]))], vec![]);
    let mut backdrop = Backdrop::of(&Subdivision::new(&scene)).expect("a room has walls");
    backdrop.see(&scene, |at| {
        let from_lamp = (at.point - Point::new(2.0, 1.5, 2.2)).length_squared();
        Some(Rgb::grey(100.0 / (1.0 + from_lamp)))
    });
    (scene, backdrop)
}

/// What so many rays find of the walls from a place, in the mean over nets, and its error.
fn found(backdrop: &Backdrop, of: &Gatherer, nets: std::ops::Range<u64>) -> (f64, f64) {
    let walls = backdrop.seen_from(of);
    mean_and_error(nets.map(|net| {
        let sequence = Sequence::new(Key::new(7).with(net));
        let directions: Vec<_> = (0..of.rays)
            .map(|k| {
                let local = CosineHemisphere::sample(Dice::new(sequence, k).pair());
                of.normal.to_direction().from_local(local)
            })
            .collect();
        -lacking(&walls, &directions).luminance() / f64::from(of.rays)
    }))
}

#[test]
fn rays_find_of_the_walls_what_they_give() {
    let (scene, backdrop) = room(vec![]);
    for at in [[3.0, 2.0, 0.0], [0.01, 2.0, 0.0], [5.99, 3.99, 0.0], [1.0, 0.0, 0.02], [4.0, 1.0, 3.0]] {
        let at = front_at(&scene, Point::from(at));
        let of = Gatherer::on_surface(at, 16);
        let whole = backdrop.behind(&scene, &of).expect("nothing stands there").luminance();
        let (mean, error) = found(&backdrop, &of, 0..20_000);
        println!("{whole} {mean} +- {error}");
        assert!((mean - whole).abs() < 4.0 * error, "{:?}: {whole}, {mean} +- {error}", at.point);
    }
}

#[test]
fn debug_all_vertices() {
    let (scene, backdrop) = room(vec![]);
    let mut subdivision = Subdivision::new(&scene);
    subdivision.bisect_to(0.4, 1 << 20);
    let mut sums = std::collections::BTreeMap::new();
    for (n, receiver) in subdivision.receivers(2e-3).iter().enumerate() {
        let of = Gatherer::at_vertex(&scene, receiver, 16);
        let Some(whole) = backdrop.behind(&scene, &of).map(|l| l.luminance()) else { println!("none"); continue };
        let (mean, error) = found(&backdrop, &of, n as u64 * 1000..n as u64 * 1000 + 400);
        let p = receiver.point;
        let d = [p.x, 6.0 - p.x, p.y, 4.0 - p.y, p.z, 3.0 - p.z];
        let near = d.iter().filter(|d| **d < 0.02).count();
        let s: &mut (f64, f64, f64, usize) = sums.entry(near).or_default();
        s.0 += mean - whole; s.1 += error * error; s.2 += whole; s.3 += 1;
        if (mean - whole).abs() > 6.0 * error { println!("{p:?} {whole} {mean} {error}"); }
    }
    for (near, s) in sums { println!("{near}: {} {:.5} +- {:.5}", s.3, s.0 / s.2, s.1.sqrt() / s.2); }
}
