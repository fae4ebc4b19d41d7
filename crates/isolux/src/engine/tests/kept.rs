//! Direct light that varies between vertices, as rays read it.

use super::*;
use crate::elements::{Elements, Subdivision};
use crate::engine::gather::{DirectAtEnds, DirectResidual, Gatherer, Gathering, Over};
use crate::engine::light::{Goal, Lighting};
use crate::engine::ray::NEVER;
use crate::engine::{MapReader, ProbePoint, SolveRequest, Watch, solve};
use crate::map::{IlluminationMap, Standing};

const ROOM_M: [f64; 3] = [12.6, 12.6, 3.0];
const REFLECTANCE: f64 = 0.7;

/// A room with lamps in rows, so many each way, ten centimetres below its ceiling.
fn room(side: usize) -> Scene {
    let at = |k: usize| ROOM_M[0] * (k as f64 + 0.1) / side as f64;
    let lamp = |k: usize| isotropic([at(k % side), at(k / side), ROOM_M[2] - 0.1], 1.0);
    let lamps = (0..side * side).map(lamp).collect();
    scene(inward_box(ROOM_M, 0), vec![painted(Rgb::grey(REFLECTANCE))], lamps)
}

/// Elements of a room, and direct light at their vertices.
fn mapped(scene: &Scene, lighting: &Lighting<'_>) -> (Elements, Vec<Rgb>) {
    let mut subdivision = Subdivision::new(scene);
    subdivision.bisect_to(1.2, usize::MAX);
    let receivers = subdivision.receivers(0.01);
    let at = receivers.iter().map(|r| Gatherer::at_vertex(scene, r, 0).surface);
    let light = |at| lighting.measured(&at, Goal::ANY, Sequence::new(Key::new(0))).lx;
    (subdivision.elements(), at.map(light).collect())
}

#[test]
fn rays_read_the_light_that_lands_between_vertices() {
    // Two lamps an element: vertices lie at the same place between them, all of them in the dark or all in the light.
    let scene = room(2 * 16);
    let lighting = Lighting::new(&scene);
    assert!(lighting.are_countless());
    let (elements, direct) = mapped(&scene, &lighting);
    let standings = vec![Some(Standing::Open); direct.len()];
    let over = Over {
        scene: &scene,
        lighting: &lighting,
        elements: &elements,
        standings: &standings,
        direct: &direct,
        bright: None,
    };
    let gathered = |direct: DirectAtEnds<'_>, trials: u64| {
        let gathering = Gathering {
            scene: &scene,
            lighting: &lighting,
            elements: &elements,
            level: u32::MAX,
            standings: &standings,
            direct,
            regathers: false,
            bright: None,
            cuts: None,
            backdrop: None,
        };
        let at = front_at(&scene, Point::new(5.1, 6.2, 0.0));
        let rows = vec![Gatherer::on_surface(at, 1024); 16];
        let operator = gathering.operator(&rows, |k| Key::new(trials).with(k as u64));
        let black = vec![Rgb::BLACK; standings.len()];
        mean_and_error(operator.apply(&black).iter().map(|lx| lx.luminance()))
    };
    let (expected_lx, expected_error_lx) = gathered(DirectAtEnds::Evaluated, 1);
    let read = |values: &[Rgb], trial: u64| {
        gathered(DirectAtEnds::Read { values, level: u32::MAX }, trial)
    };
    let (bare_lx, _) = read(&direct, 2);
    assert!((bare_lx / expected_lx - 1.0).abs() > 0.1, "{bare_lx} {expected_lx}");
    let kept =
        DirectResidual::of(&over, 0.01 * expected_lx, (Key::new(1), &NEVER)).expect("light varies");
    let increment = |k: u64| {
        let kept = kept.read(&over, (1, Key::new(2).with(k)), &NEVER).unwrap();
        read(&kept.values, 3 + k).0
    };
    let (kept_lx, error_lx) = mean_and_error((0..16).map(increment));
    let error_lx = libm::hypot(error_lx, expected_error_lx);
    // As Student has it, with fifteen degrees of freedom.
    assert!(
        (kept_lx - expected_lx).abs() < SIGMAS * error_lx,
        "{kept_lx} {expected_lx} {error_lx}"
    );
    assert!(error_lx < 0.01 * expected_lx, "{error_lx} {expected_lx}");
}

#[test]
fn light_that_vertices_tell_is_left_as_it_is() {
    // Few luminaires are evaluated, and where much is allowed nothing is lacking.
    let few = room(2);
    let few_lighting = Lighting::new(&few);
    let many = room(3);
    let many_lighting = Lighting::new(&many);
    for (scene, lighting, allowed_lx) in [(&few, &few_lighting, 1e-3), (&many, &many_lighting, 1e3)]
    {
        let (elements, direct) = mapped(scene, lighting);
        let standings = vec![Some(Standing::Open); direct.len()];
        let (elements, standings, direct) = (&elements, &standings[..], &direct[..]);
        let over = Over { scene, lighting, elements, standings, direct, bright: None };
        assert!(DirectResidual::of(&over, allowed_lx, (Key::new(1), &NEVER)).is_none());
    }
}

/// Regression: readers of maps that ended early measured direct light without end, as no error was too small for them.
#[test]
fn maps_whose_error_is_not_known_are_read_by_few_rays() {
    let scene = room(2 * 16);
    let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
    let known = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let mut unknown = known.clone();
    unknown.provenance.accuracy = None;
    let at = ProbePoint {
        position: Point::new(5.1, 6.2, 0.0),
        normal: isolux_geometry::Direction::Z.to_normal(),
    };
    let read = |map: &IlluminationMap| {
        let reader = MapReader::new(&scene, map);
        (reader.probe(at).unwrap(), reader.rays())
    };
    let ((known, many), (unknown, few)) = (read(&known), read(&unknown));
    assert!(few < many, "{few} {many}");
    assert_eq!(unknown.standard_error_lx, f64::INFINITY);
    assert!((unknown.illuminance_lx() / known.illuminance_lx() - 1.0).abs() < 0.2);
}

/// Regression: readings in space told the noise of their own rays alone, and not that of the direct light that all of them read. Walls that
/// shine on both sides are so many luminaires that rays read it from the map.
#[test]
fn readings_tell_the_noise_that_they_share() {
    const LUMINANCE_CD_M2: f64 = 50.0;
    let finish =
        Finish { luminance_cd_m2: Rgb::grey(LUMINANCE_CD_M2), ..Finish::diffuse(Rgb::grey(0.5)) };
    let material = Material::two_sided("furnace", finish);
    let room = scene(inward_box([4.0, 3.0, 2.5], 0), vec![material], vec![]);
    assert!(Lighting::new(&room).are_read_at_ends());
    let lx = std::f64::consts::PI * LUMINANCE_CD_M2 / 0.5;
    let off = |seed: u64| {
        let request = SolveRequest { accuracy: Some(0.03), seed, ..SolveRequest::default() };
        let map = solve(&room, &request, None, &mut |_| Watch::Continue).unwrap().map;
        let at = ProbePoint {
            position: Point::new(1.5, 1.0, 1.0),
            normal: isolux_geometry::Direction::Z.to_normal(),
        };
        let found = MapReader::new(&room, &map).measure(at).unwrap();
        assert!(found.standard_error_lx < 0.03 * lx, "{found:?}");
        (found.illuminance_lx() - lx) / found.standard_error_lx
    };
    let squares: f64 = (1..=12).map(off).map(|off| off * off).sum();
    // The sum of twelve squares is larger once in a thousand times.
    assert!(squares < 32.9, "{squares}");
}
