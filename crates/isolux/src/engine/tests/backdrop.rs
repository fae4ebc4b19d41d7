//! Walls that rays are judged by.

use super::carrying::bent_shape;
use super::*;
use crate::engine::gather::{ControlVariate, Gatherer, Gathering, Unlit, lacking};
use crate::engine::light::Lighting;
use crate::engine::pilot::pilot;
use crate::engine::{MapReader, ProbePoint, SolveRequest, Watch, solve};
use crate::map::Fresh;
use crate::sampling::CosineHemisphere;
use isolux_geometry::Normal;

const ROOM_M: [f64; 3] = [6.0, 4.0, 3.0];

/// A room whose walls are brighter where a lamp would hang, and a thing in it.
fn room(things: Vec<Shape>) -> (Scene, ControlVariate) {
    let mut shapes = inward_box(ROOM_M, 0);
    shapes.extend(things);
    let scene = scene(shapes, vec![painted(Rgb([0.7, 0.5, 0.3]))], vec![]);
    let mut backdrop = ControlVariate::of(&scene).expect("a room has walls");
    backdrop.see(&scene, |at| {
        let from_lamp = (at.point - Point::new(2.0, 1.5, 2.2)).length_squared();
        Some(Rgb::grey(100.0 / (1.0 + from_lamp)))
    });
    (scene, backdrop)
}

/// What so many rays find of the walls from a place, in the mean over nets, and its error.
fn found(backdrop: &ControlVariate, of: &Gatherer, nets: std::ops::Range<u64>) -> (f64, f64) {
    let walls = backdrop.seen_from(&of.stand());
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
    for at in
        [[3.0, 2.0, 0.0], [0.01, 2.0, 0.0], [5.99, 3.99, 0.0], [1.0, 0.0, 0.02], [4.0, 1.0, 3.0]]
    {
        let at = front_at(&scene, Point::from(at));
        let of = Gatherer::on_surface(at, 16);
        let whole = backdrop.behind(&scene, &of.stand()).expect("nothing stands there").luminance();
        let (mean, error) = found(&backdrop, &of, 0..20_000);
        assert!((mean - whole).abs() < 4.0 * error, "{:?}: {whole}, {mean} +- {error}", at.point);
    }
}

#[test]
fn walls_behind_things_are_left_alone() {
    // A table top close above a part of the floor.
    let top = rectangle([1.0, 1.0, 0.2], [2.0, 0.0, 0.0], [0.0, 1.5, 0.0], 0);
    let (scene, backdrop) = room(vec![top]);
    let at = |x: f64, y: f64| Gatherer::on_surface(front_at(&scene, Point::new(x, y, 0.0)), 16);
    assert!(backdrop.behind(&scene, &at(2.0, 1.7).stand()).is_none(), "below the table");
    assert!(backdrop.behind(&scene, &at(5.0, 3.0).stand()).is_some(), "beside it");
}

#[test]
fn outer_sides_of_walls_are_none() {
    let (scene, backdrop) = room(vec![]);
    let outside = front_at(&scene, Point::new(3.0, 2.0, 0.0)).other_side();
    let of = Gatherer::on_surface(outside, 16);
    assert!(backdrop.behind(&scene, &of.stand()).is_none(), "no wall is above its horizon");
}

/// A lit room, whose pilot judges rays by walls.
fn lit_room() -> Scene {
    let lamps = vec![isotropic([2.0, 1.5, 1.6], 100.0)];
    scene(inward_box(ROOM_M, 0), vec![painted(Rgb::grey(0.5))], lamps)
}

#[test]
fn walls_take_noise_off_and_leave_the_light() {
    let scene = lit_room();
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let gathering = Gathering::of(&plan, &plan.light.direct);
    let judged = plan.mesh.gatherers.iter().filter(|of| of.behind.is_some()).step_by(61);
    let judged: Vec<Gatherer> = judged.map(|of| of.with_rays(16)).collect();
    assert!(judged.len() > 5, "{}", judged.len());
    let raw: Vec<Gatherer> = judged.iter().map(|of| Gatherer { behind: None, ..*of }).collect();
    let nets = |rows: &[Gatherer]| -> Vec<Vec<f64>> {
        let net = |net: u64| {
            let key = Key::new(3).with(net);
            let operator = gathering.operator(rows, |row| key.with(row as u64));
            operator.apply(&plan.light.guess).iter().map(|light| light.luminance()).collect()
        };
        (0..256).map(net).collect()
    };
    let [judged, raw] = [nets(&judged), nets(&raw)];
    let (mut noise, mut noise_of_raw) = (0.0, 0.0);
    for row in 0..raw[0].len() {
        let [(own, error), (other, other_error)] =
            [&judged, &raw].map(|nets| mean_and_error(nets.iter().map(|net| net[row])));
        let both = libm::hypot(error, other_error);
        assert!((own - other).abs() < 4.0 * both, "{row}: {own} {other} +- {both}");
        noise += error * error;
        noise_of_raw += other_error * other_error;
    }
    // On CUBE a twentieth is left; here the lamp hangs nearer to some walls, and a fifth is.
    assert!(noise.sqrt() < 0.35 * noise_of_raw.sqrt(), "{noise} {noise_of_raw}");
}

#[test]
fn light_settles_among_carriers_as_it_does_among_all() {
    // A room with a finely tessellated sheet in it.
    let mut sheet = bent_shape(40, 0.2);
    sheet.positions.iter_mut().for_each(|[x, y, z]| (*x, *y, *z) = (*x + 0.7, *y + 0.6, *z + 0.5));
    let shapes = inward_box(ROOM_M, 0).into_iter().chain([sheet]).collect();
    let lamps = vec![isotropic([2.0, 1.5, 1.6], 100.0)];
    let scene = scene(shapes, vec![painted(Rgb::grey(0.5))], lamps);
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let vertices = plan.light.guess.len();
    assert!(2 * plan.mesh.waiting.count() >= vertices, "few carry light");
    let gathering = Gathering::of(&plan, &plan.light.direct);
    let rows: Vec<Gatherer> = (0..vertices)
        .map(|v| {
            plan.mesh.gatherers[v].with_rays(if plan.mesh.carriers.is_active(v as u32) {
                8
            } else {
                0
            })
        })
        .collect();
    let operator = gathering.operator(&rows, |row| Key::new(4).with(row as u64));
    let black = vec![Rgb::BLACK; vertices];
    let fit = &plan.mesh.fit;
    let (settled, left) =
        operator.solve_or_give_up(&black, &black, (&plan.mesh.waiting, Some(fit)), (1e-10, &NEVER));
    let mut image = operator.apply(&fit.apply(&settled));
    plan.mesh.waiting.fill(&mut image);
    let rms = |of: &dyn Fn(usize) -> f64| {
        ((0..vertices).map(|k| of(k) * of(k)).sum::<f64>() / vertices as f64).sqrt()
    };
    let change = rms(&|k| (image[k] - settled[k]).luminance());
    let size = rms(&|k| settled[k].luminance());
    // What a sweep changes shrinks at every further one.
    assert!(
        size > 1.0 && change <= 1e-10 * size && left <= 1e-10 * 2.0 * size,
        "{change} {left} {size}"
    );
}

#[test]
fn readers_gather_with_fewer_rays_before_walls_and_read_the_same() {
    let scene = lit_room();
    let request = SolveRequest { accuracy: Some(0.01), ..SolveRequest::default() };
    let mut map =
        solve(&scene, &request, None, &mut |_| Watch::Continue).expect("it has light").map;
    // Everywhere, and until noise is a hundredth of the light.
    let everywhere = Fresh { above_lx: Some(0.0), in_gaps_alone: false, lookup_lx: 0.0 };
    map.provenance.fresh = Some(everywhere);
    let judged = MapReader::new(&scene, &map);
    assert!(judged.backdrop.is_some(), "a room has walls");
    let mut raw = MapReader::new(&scene, &map);
    raw.backdrop = None;
    let (mut rays, mut rays_of_raw) = (0, 0);
    for k in 0..40 {
        let [x, y] = Sequence::new(Key::new(5)).pair(k, 0);
        let position = Point::new(x * ROOM_M[0], y * ROOM_M[1], 0.0);
        let at = ProbePoint { position, normal: Normal::Z };
        let [own, other] = [&judged, &raw].map(|reader| {
            let read = reader.probe(at).expect("a floor");
            reader.by_replicates(read)
        });
        rays += own.samples;
        rays_of_raw += other.samples;
        let error = libm::hypot(own.indirect_standard_error_lx, other.indirect_standard_error_lx);
        let apart = (own.indirect_lx - other.indirect_lx).luminance();
        // Errors of 16 replicates: Student's distribution goes beyond 4.5 of them once in 2000 times.
        assert!(apart.abs() < 4.5 * error, "{position:?}: {apart} +- {error}");
    }
    assert!(4 * rays < rays_of_raw, "{rays} {rays_of_raw}");
}
